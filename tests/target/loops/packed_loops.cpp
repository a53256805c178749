// Loops of packed worlds that some processors have their own code for, on numbers of all sizes that
// their formats hold: one hash on every machine, which is that of the plain loops.
#include "numbers.hpp"

#include "base/hash.hpp"
#include "fluid/particles.hpp"
#include "port/port.hpp"
#include "port/print.hpp"
#include "pressure/projection.hpp"
#include "step/blend_change.hpp"
#include "step/grid_to_particle.hpp"
#include "step/grid_update.hpp"
#include "step/transfer_packed.hpp"

namespace {

using Real = weir::SmallFixed;
using Speed = weir::VelocityOf<Real>;
using Place = weir::PositionOf<Real>;

constexpr std::int32_t kRounds = 400;
constexpr std::int32_t kColumns = 10;
constexpr std::int32_t kRows = 7;
constexpr std::int32_t kEntries = (kColumns + 2) * (kRows + 2);
constexpr std::int32_t kParticles = 60;

/// Fields as they lie in a world: velocities and, behind them, scratch, in place of momenta.
struct Fields {
    Real u[kEntries];
    Speed mass_u[kEntries];
    Real v[kEntries];
    Speed mass_v[kEntries];
    weir::LevelOf<Real> level[kEntries];
    weir::DensityOf<Real> density[kEntries];
    Real pressure[kEntries];
    weir::Vec2<Place> position[kParticles];
    weir::Vec2<Speed> velocity[kParticles];
    std::uint32_t ways[kParticles];
};

Fields g_fields;
Numbers g_numbers;
weir::Hash g_hash;
const weir::Walls<Real> kNoWalls;

weir::StaggeredGrid<Real> grid() {
    weir::StaggeredGrid<Real> grid;
    grid.shape = {kColumns, kRows, kColumns + 2, 0, 0};
    grid.u = reinterpret_cast<Speed*>(g_fields.u);
    grid.v = reinterpret_cast<Speed*>(g_fields.v);
    grid.mass_u = g_fields.mass_u;
    grid.mass_v = g_fields.mass_v;
    return grid;
}

weir::PressureFields<Real> pressure() {
    weir::PressureFields<Real> fields;
    fields.divergence = grid().u + kEntries;
    fields.inverse_diagonal = grid().v + kEntries;
    fields.pressure = g_fields.pressure;
    fields.density = g_fields.density;
    fields.level = g_fields.level;
    return fields;
}

void add_to_hash(const void* field, std::size_t bytes) {
    const auto* half = static_cast<const unsigned char*>(field);
    for (std::size_t k = 0; k < bytes; k += 2) {
        g_hash.add(static_cast<std::uint32_t>(half[k] + 256 * half[k + 1]));
    }
}
template <class Number, std::size_t Count>
void add_to_hash(const Number (&numbers)[Count]) {
    add_to_hash(numbers, sizeof numbers);
}

weir::Particles<Real> particles(bool crowd) {
    for (std::int32_t k = 0; k < kParticles; ++k) {
        const auto within = [&](std::int32_t cells) {
            // So near to each other that faces are full.
            const auto most = static_cast<std::uint32_t>(crowd ? 40 : 256 * cells - 8);
            return static_cast<std::uint16_t>(4U + g_numbers.word() % most);
        };
        g_fields.position[k] = {Place::of_raw(within(kColumns)), Place::of_raw(within(kRows))};
        const auto speed = [] {
            return Speed::of_raw(static_cast<std::int16_t>(g_numbers.either(15)));
        };
        g_fields.velocity[k] = {speed(), speed()};
    }
    return {g_fields.position, g_fields.velocity, kParticles, kParticles, nullptr};
}

/// `bits`: 0: all of them.
void fill(Speed* field, std::uint32_t bits) {
    for (std::int32_t k = 0; k < kEntries; ++k) {
        const bool none = g_numbers.word() % 4U == 0;
        field[k].raw = static_cast<std::int16_t>(
            none ? 0
                 : (bits == 0 ? static_cast<std::int32_t>(g_numbers.word() & 0xFFFFU) - 0x8000
                              : g_numbers.either(bits)));
    }
}

void scatter(bool crowd) {
    weir::StaggeredGrid<Real> to = grid();
    weir::clear_rows(to.shape, {0, kRows + 2}, g_fields.u);
    weir::clear_rows(to.shape, {0, kRows + 2}, g_fields.v);
    weir::clear_rows(to.shape, {0, kRows + 2}, g_fields.mass_u);
    weir::clear_rows(to.shape, {0, kRows + 2}, g_fields.mass_v);
    g_hash.add(static_cast<std::uint32_t>(weir::scatter_packed(particles(crowd), to)));
    add_to_hash(g_fields.u);
    add_to_hash(g_fields.v);
    add_to_hash(g_fields.mass_u);
    add_to_hash(g_fields.mass_v);
}

/// Momenta over masses, also where they do not fit together.
void divide() {
    weir::StaggeredGrid<Real> to = grid();
    for (std::int32_t k = 0; k < kEntries; ++k) {
        g_fields.u[k].raw = g_numbers.either(30);
        g_fields.v[k].raw = g_numbers.either(24);
        const auto mass = [&] {
            return static_cast<std::int16_t>(g_numbers.word() % 3U == 0 ? 0 : g_numbers.size(15));
        };
        g_fields.mass_u[k].raw = mass();
        g_fields.mass_v[k].raw = mass();
        g_fields.level[k].raw = 64;
    }
    weir::Borders<Real> borders;
    borders.wrap_x = borders.wrap_y = true;  // no face is closed
    const weir::Vec2<Real> gravity{Real::of_raw(g_numbers.either(26)),
                                   Real::of_raw(g_numbers.either(20))};
    weir::PressureFields<Real> fields;
    fields.level = g_fields.level;
    weir::grid_update(weir::Domain<Real>{to, fields, borders, kNoWalls},
                      weir::Seconds<Real>(0.0625) * gravity);
    add_to_hash(to.u, kEntries * sizeof(Speed));
    add_to_hash(to.v, kEntries * sizeof(Speed));
    add_to_hash(g_fields.mass_u);
    add_to_hash(g_fields.mass_v);
}

void fill_velocities() {
    const weir::StaggeredGrid<Real> to = grid();
    const bool all = g_numbers.word() % 4U == 0;
    const std::uint32_t bits = all ? 0U : 4U + g_numbers.word() % 12U;
    fill(to.u, bits);
    fill(to.v, bits);
    fill(to.mass_u, bits);
    fill(to.mass_v, bits);
}

void blend() {
    weir::StaggeredGrid<Real> to = grid();
    weir::PressureFields<Real> fields = pressure();
    fill_velocities();
    for (std::int32_t k = 0; k < kEntries; ++k) {
        constexpr std::int16_t kDiagonals[] = {512, 512, 512, 512, 384, 384, 0, -300, 431, 0x7FFF};
        fields.inverse_diagonal[k].raw = kDiagonals[g_numbers.word() % 10U];
    }
    const weir::Borders<Real> borders;
    weir::blend_change(weir::Domain<Real>{to, fields, borders, kNoWalls},
                       Real::of_raw(g_numbers.size(16)));
    add_to_hash(to.u, kEntries * sizeof(Speed));
    add_to_hash(to.v, kEntries * sizeof(Speed));
    add_to_hash(g_fields.mass_u);
    add_to_hash(g_fields.mass_v);
}

void gather(bool scratch) {
    fill_velocities();
    weir::Transfer<Real> transfer{
        weir::Seconds<Real>::of_raw(static_cast<std::int32_t>(g_numbers.word() % (1U << 28U))),
        Real::of_raw(g_numbers.size(16)), Real(255)};
    if (scratch) {
        transfer.ways = g_fields.ways;
        transfer.room = kParticles;
        transfer.keeps_places = true;
    }
    weir::Particles<Real> moved = particles(false);
    const weir::TransferResult<Real> result = weir::gather_packed(grid(), transfer, moved);
    g_hash.add(static_cast<std::uint32_t>(result.far + 256 * result.slowed));
    g_hash.add(static_cast<std::uint32_t>(result.max_speed.raw));
    add_to_hash(g_fields.position);
    add_to_hash(g_fields.velocity);
    if (scratch) {
        add_to_hash(g_fields.ways);
    }
}

/// In tanks of all sizes that fit, four fifths full. `pressed`: full, by pressures that grow to what
/// numbers hold.
void project(bool pressed) {
    weir::StaggeredGrid<Real> to = grid();
    weir::PressureFields<Real> fields = pressure();
    to.shape.nx = 1 + static_cast<std::int32_t>(g_numbers.word() % kColumns);
    to.shape.ny = 1 + static_cast<std::int32_t>(g_numbers.word() % kRows);
    fill_velocities();
    const std::uint32_t bits = 8U + g_numbers.word() % 21U;
    for (std::int32_t k = 0; k < kEntries; ++k) {
        g_fields.pressure[k].raw = pressed ? (1 << 28) : g_numbers.either(bits);
        if (pressed) {
            to.u[k].raw = static_cast<std::int16_t>(30000 - 6000 * (k % (kColumns + 2)));
            to.v[k].raw = static_cast<std::int16_t>(30000 - 6000 * (k / (kColumns + 2)));
        }
        g_fields.density[k].raw = static_cast<std::uint8_t>(g_numbers.size(8));
        g_fields.level[k].raw = -100;
    }
    for (std::int32_t j = 0; j < to.shape.ny; ++j) {
        for (std::int32_t i = 0; i < to.shape.nx; ++i) {
            const auto height = static_cast<std::int8_t>(1 + g_numbers.size(6));
            g_fields.level[to.shape.index(i, j)].raw =
                pressed || g_numbers.word() % 5U != 0 ? height : static_cast<std::int8_t>(-height);
        }
    }
    fields.last_dt = weir::Seconds<Real>(0.0625);
    fields.cell_weight = Real(0.25);
    const weir::Borders<Real> borders;
    weir::projection<false>(weir::Domain<Real>{to, fields, borders, kNoWalls},
                            weir::Seconds<Real>(0.0625),
                            (pressed ? 24 : 1) +
                                static_cast<std::int32_t>(g_numbers.word() % 6U));
    add_to_hash(to.u, kEntries * sizeof(Speed));
    add_to_hash(to.v, kEntries * sizeof(Speed));
    for (const Real pressure : g_fields.pressure) {
        g_hash.add(pressure);
    }
}

void calculate() {
    for (std::int32_t k = 0; k < 50; ++k) {
        const Real a = Real::of_raw(g_numbers.either(31));
        const Real b = Real::of_raw(g_numbers.either(31));
        const auto seconds = weir::Seconds<Real>::of_raw(g_numbers.size(30));
        const std::int64_t all = weir::product(a, b).raw;
        g_hash.add(static_cast<std::uint32_t>(all));
        g_hash.add(static_cast<std::uint32_t>(static_cast<std::uint64_t>(all) >> 32U));
        g_hash.add(a * b);
        g_hash.add(seconds * a);
        g_hash.add(a / b);
        g_hash.add(weir::square_root(weir::absolute(a)));
    }
}

void tell(const char* what) { port::print(what, " ", port::hex(g_hash.value()), "\n"); }

}  // namespace

int main() {
    port::init();
    for (std::int32_t round = 0; round < kRounds; ++round) {
        scatter(round % 4 == 0);
    }
    tell("scatter");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        divide();
    }
    tell("divide");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        blend();
    }
    tell("blend");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        gather(round % 2 == 0);
    }
    tell("gather");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        calculate();
    }
    tell("calculate");
    for (std::int32_t round = 0; round < kRounds; ++round) {
        project(round % 8 == 0);
    }
    tell("project");
    port::exit(0);
}
