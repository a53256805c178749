// Loops of worlds in float that some processors have their own code for: one hash on every machine,
// which is that of the plain loops.
#include "numbers.hpp"

#include "base/hash.hpp"
#include "fluid/particles.hpp"
#include "port/port.hpp"
#include "port/print.hpp"
#include "pressure/projection.hpp"
#include "solid/walls.hpp"
#include "step/blend_change.hpp"
#include "step/grid_to_particle.hpp"
#include "step/particle_to_grid.hpp"

namespace {

constexpr std::int32_t kRounds = 400;
constexpr std::int32_t kColumns = 10;
constexpr std::int32_t kRows = 7;
constexpr std::int32_t kEntries = (kColumns + 2) * (kRows + 2);
constexpr std::int32_t kParticles = 60;
constexpr std::int32_t kCoarseColumns = weir::coarse_cells(kColumns);
constexpr std::int32_t kCoarseEntries = (kCoarseColumns + 2) * (weir::coarse_cells(kRows) + 2);

/// Fields as they lie in a world.
struct Fields {
    float u[kEntries];
    float mass_u[kEntries];
    float v[kEntries];
    float mass_v[kEntries];
    float pressure[kEntries];
    float divergence[kEntries];
    float inverse_diagonal[kEntries];
    float density[kEntries];
    float level[kEntries];
    float open_u[kEntries];
    float open_v[kEntries];
    float coarse[weir::kCoarseFields][kCoarseEntries];
    weir::CutOff cut_off[kCoarseEntries];
    weir::Vec2<float> position[kParticles];
    weir::Vec2<float> velocity[kParticles];
};

Fields g_fields;
Numbers g_numbers;
weir::Hash g_hash;

/// Of all sizes up to `most`.
float number(float most) { return most * static_cast<float>(g_numbers.either(24)) / 16777216.0F; }

weir::StaggeredGrid<float> grid() {
    weir::StaggeredGrid<float> grid;
    grid.shape = {kColumns, kRows, kColumns + 2, 0, 0};
    grid.u = g_fields.u;
    grid.v = g_fields.v;
    grid.mass_u = g_fields.mass_u;
    grid.mass_v = g_fields.mass_v;
    return grid;
}

template <std::size_t Count>
void add_to_hash(const float (&numbers)[Count]) {
    for (const float one : numbers) {
        g_hash.add(one);
    }
}
template <std::size_t Count>
void add_to_hash(const weir::Vec2<float> (&pairs)[Count]) {
    for (const weir::Vec2<float>& one : pairs) {
        g_hash.add(one.x);
        g_hash.add(one.y);
    }
}

/// Some at the walls, where half of them lead out of the tank.
weir::Particles<float> particles() {
    const auto within = [](std::int32_t cells) {
        const float size = static_cast<float>(cells);
        const float at = size * static_cast<float>(g_numbers.word() >> 8U) / 16777216.0F;
        return weir::clamp(at, weir::kWallGap<float>, size - weir::kWallGap<float>);
    };
    for (std::int32_t k = 0; k < kParticles; ++k) {
        g_fields.position[k] = {within(kColumns), within(kRows)};
        g_fields.velocity[k] = {number(60.0F), number(60.0F)};
    }
    return {g_fields.position, g_fields.velocity, kParticles, kParticles, nullptr};
}

void scatter() {
    weir::StaggeredGrid<float> to = grid();
    weir::particle_to_grid<float>(particles(), {}, 1.0F, to, nullptr, {});
    add_to_hash(g_fields.u);
    add_to_hash(g_fields.v);
    add_to_hash(g_fields.mass_u);
    add_to_hash(g_fields.mass_v);
}

void fill_velocities() {
    for (std::int32_t k = 0; k < kEntries; ++k) {
        g_fields.u[k] = number(50.0F);
        g_fields.v[k] = number(50.0F);
        g_fields.mass_u[k] = number(10.0F);
        g_fields.mass_v[k] = number(10.0F);
    }
}

/// Some of the particles are too fast, for the tank or for those who count.
void gather() {
    fill_velocities();
    weir::Transfer<float> transfer{0.01F + number(0.01F), 0.97F, 60.0F};
    transfer.near = 40.0F;
    weir::Particles<float> moved = particles();
    const weir::TransferResult<float> result = weir::grid_to_particle(grid(), transfer, moved);
    g_hash.add(result.far + 256 * result.slowed);
    g_hash.add(result.max_speed);
    add_to_hash(g_fields.position);
    add_to_hash(g_fields.velocity);
}

weir::PressureFields<float> pressure() {
    weir::PressureFields<float> fields;
    fields.pressure = g_fields.pressure;
    fields.divergence = g_fields.divergence;
    fields.inverse_diagonal = g_fields.inverse_diagonal;
    fields.density = g_fields.density;
    fields.level = g_fields.level;
    weir::CoarseGrid<float>& coarse = fields.coarse;
    coarse.shape.stride = kCoarseColumns + 2;
    coarse.correction = g_fields.coarse[0];
    coarse.residual = g_fields.coarse[1];
    coarse.inverse_diagonal = g_fields.coarse[2];
    coarse.weight_u = coarse.reach_u = g_fields.coarse[3];
    coarse.weight_v = coarse.reach_v = g_fields.coarse[4];
    coarse.centre_x = g_fields.coarse[5];
    coarse.centre_y = g_fields.coarse[6];
    coarse.cut_off = g_fields.cut_off;
    return fields;
}

/// In tanks of all sizes that fit, two thirds full; among solids an eighth of the faces are closed
/// in part or altogether.
void project(bool solids) {
    weir::StaggeredGrid<float> to = grid();
    weir::PressureFields<float> fields = pressure();
    to.shape.nx = 1 + static_cast<std::int32_t>(g_numbers.word() % kColumns);
    to.shape.ny = 1 + static_cast<std::int32_t>(g_numbers.word() % kRows);
    fields.coarse.shape.nx = weir::coarse_cells(to.shape.nx);
    fields.coarse.shape.ny = weir::coarse_cells(to.shape.ny);
    fill_velocities();
    for (std::int32_t k = 0; k < kEntries; ++k) {
        g_fields.pressure[k] = number(5.0F);
        g_fields.density[k] = 1.0F + number(0.5F);
        g_fields.level[k] = -1.55F;
        constexpr float kShares[] = {0.0F, 0.3F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F,
                                     0.7F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
        g_fields.open_u[k] = kShares[g_numbers.word() % 16U];
        g_fields.open_v[k] = kShares[g_numbers.word() % 16U];
    }
    for (std::int32_t j = 0; j < to.shape.ny; ++j) {
        for (std::int32_t i = 0; i < to.shape.nx; ++i) {
            const bool wet = g_numbers.word() % 3U != 0;
            g_fields.level[to.shape.index(i, j)] = (wet ? 0.8F : -0.8F) + number(0.7F);
        }
    }
    fields.last_dt = 0.01F;
    fields.cell_weight = 0.1F;
    const std::int32_t sweeps = 1 + static_cast<std::int32_t>(g_numbers.word() % 4U);
    const weir::Borders<float> borders;
    weir::Walls<float> walls;
    const weir::Domain<float> domain{to, fields, borders, walls};
    if (solids) {
        walls.active = true;
        walls.open_u = g_fields.open_u;
        walls.open_v = g_fields.open_v;
        walls.full_density = g_fields.open_u;  // as good as any
        weir::projection<true>(domain, 0.01F, sweeps);
    } else {
        weir::projection<false>(domain, 0.01F, sweeps);
    }
    for (std::int32_t j = 0; j < to.shape.ny; ++j) {
        for (std::int32_t i = 0; i < to.shape.nx; ++i) {
            const std::int32_t c = to.shape.index(i, j);
            g_hash.add(g_fields.pressure[c]);
            g_hash.add(g_fields.u[c]);
            g_hash.add(g_fields.v[c]);
        }
    }
}

void blend() {
    weir::StaggeredGrid<float> to = grid();
    weir::PressureFields<float> fields = pressure();
    fill_velocities();
    for (float& level : g_fields.level) {
        level = (g_numbers.word() % 8U != 0 ? 0.8F : -0.8F) + number(0.7F);
    }
    const weir::Borders<float> borders;
    const weir::Walls<float> walls;
    weir::blend_change(weir::Domain<float>{to, fields, borders, walls}, 0.97F);
    add_to_hash(g_fields.mass_u);
    add_to_hash(g_fields.mass_v);
}

void tell(const char* what) { port::print(what, " ", port::hex(g_hash.value()), "\n"); }

}  // namespace

int main() {
    port::init();
    for (std::int32_t round = 0; round < kRounds; ++round) {
        scatter();
    }
    tell("scatter");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        gather();
    }
    tell("gather");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        project(round % 2 == 1);
    }
    tell("project");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        blend();
    }
    tell("blend");
    port::exit(0);
}
