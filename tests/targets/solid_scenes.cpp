// What solids cost a board: the scenes box, standard and complex of the paper's tables, small, with
// and without their solids. 4 particles a cell, 8 sweeps, a dam of 16 cells' height.
#include "paper/setting_solids.hpp"
#include "port/port.hpp"
#include "port/print.hpp"
#include "weir/weir.hpp"

namespace {

using paper_bench::Form;
using paper_bench::PlacedForm;
using paper_bench::Setting;
using weir::SmallFixed;
using weir::Vec2f;
using Real = TARGET_REAL;

constexpr float kCell = 0.02F;
constexpr std::int32_t kSteps = 40;
constexpr std::int32_t kCellsX = 64;
constexpr std::int32_t kCellsY = 32;

constexpr weir::Capacity capacity(bool solids) {
    weir::Capacity c;
    c.cells_x = kCellsX;
    c.cells_y = kCellsY;
    c.particles = 4 * 24 * 24;
    c.bodies = solids ? paper_bench::kMostSettingSolids : 0;
    c.vertices = 10 * c.bodies;
    return c;
}

constexpr weir::WorldDef definition(bool solids) {
    weir::WorldDef def;
    def.capacity = capacity(solids);
    def.cell_m = kCell;
    def.cfl = 2.0F;
    def.pressure_sweeps = weir::Stored<Real>::shares_momentum ? 6 : 8;  // packed worlds add two
    return def;
}

alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<Real>(capacity(true))];

void require(weir::Status status) {
    if (status != weir::Status::ok) {
        port::print("status ", static_cast<std::int32_t>(status), "\n");
        port::exit(1);
    }
}

/// Corners on the unit circle, every 60 and every 72 degrees, and those between the latter.
constexpr Vec2f kSix[] = {{1.0F, 0.0F},  {0.5F, 0.8660254F},   {-0.5F, 0.8660254F},
                          {-1.0F, 0.0F}, {-0.5F, -0.8660254F}, {0.5F, -0.8660254F}};
constexpr Vec2f kTips[] = {{1.0F, 0.0F},
                           {0.309017F, 0.9510565F},
                           {-0.809017F, 0.5877853F},
                           {-0.809017F, -0.5877853F},
                           {0.309017F, -0.9510565F}};
constexpr float kInner = 0.381966F;  // of a pentagram

struct Outline {
    Vec2f point[10];
    std::int32_t count = 0;

    void add(float x, float y) { point[count++] = {kCell * x, kCell * y}; }
};

Outline outline_of(const PlacedForm& solid) {
    Outline ring;
    const float x = solid.size_x;
    const float y = solid.size_y;
    switch (solid.form) {
        case Form::ramp:
            ring.add(-x, -y), ring.add(x, -y), ring.add(x, y);
            break;
        case Form::rectangle:
            ring.add(-x, -y), ring.add(x, -y), ring.add(x, y), ring.add(-x, y);
            break;
        case Form::star:
            for (std::int32_t k = 0; k < 5; ++k) {
                const Vec2f across = kTips[(k + 3) % 5];  // opposite of the corner behind the tip
                ring.add(x * kTips[k].x, x * kTips[k].y);
                ring.add(-x * kInner * across.x, -x * kInner * across.y);
            }
            break;
        default:
            for (std::int32_t k = 0; k < 6; k += solid.form == Form::hexagon ? 1 : 2) {
                ring.add(x * kSix[k].x, x * kSix[k].y);
            }
    }
    return ring;
}

void add(weir::World<Real>& world, const PlacedForm& solid) {
    const Outline ring = outline_of(solid);
    weir::BodyDef body;
    body.polygon = {ring.point, ring.count};
    body.motion.position_m = {kCell * solid.x, kCell * solid.y};
    body.motion.angle_rad = solid.angle_rad;
    body.motion.spin_radps = solid.spin_radps;
    weir::BodyId id;
    require(solid.spin_radps > 0.0F ? world.add_moving_body(body, &id)
                                    : world.add_static_body(body, &id));
}

/// A dam in the corner that the box makes, where there is no solid; without solids in the tank's:
/// else it would fall first.
std::int32_t pour(weir::World<Real>& world, bool solids) {
    const float low = solids ? kCell * paper_bench::kThickness : 0.0F;
    require(world.fill({{low, low}, {low + kCell * 24.0F, low + kCell * 16.0F}}));
    return world.particle_positions().size;
}

void count(const char* name, const char* way, Setting setting, bool solids) {
    weir::World<Real> world;
    require(world.init(definition(solids), g_memory, sizeof g_memory));
    if (solids) {
        paper_bench::for_each_solid(setting, static_cast<float>(kCellsX),
                                    static_cast<float>(kCellsY),
                                    [&](const PlacedForm& one) { add(world, one); });
    }
    const std::int32_t particles = pour(world, solids);
    world.step(1.0F / 64.0F);  // solves for long
    std::int32_t substeps = 0;
    const std::uint64_t start = port::ticks();
    for (std::int32_t step = 0; step < kSteps; ++step) {
        substeps += world.step(1.0F / 64.0F).substeps;
    }
    port::print(name, way, "_particle_substeps ", particles * substeps, "\n", name, way,
                "_instructions ", port::ticks() - start, "\n");
}

}  // namespace

int main() {
    port::init();
    const char* const names[] = {"box", "standard", "complex"};
    for (std::int32_t k = 0; k < 3; ++k) {
        count(names[k], "_with", static_cast<Setting>(k), true);
        count(names[k], "_without", static_cast<Setting>(k), false);
    }
    port::exit(0);
}
