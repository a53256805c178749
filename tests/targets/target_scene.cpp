// A dam break for counting: 4 particles a cell, 8 sweeps, one substep a step; with TARGET_BODIES a
// hump on the floor. The same scene on every board, small enough for the smallest.
#include "port/port.hpp"
#include "port/print.hpp"
#include "weir/weir.hpp"

namespace {

using weir::SmallFixed;
using Real = TARGET_REAL;

constexpr float kCell = 0.02F;
constexpr int kSteps = 100;
constexpr int kCellsX = TARGET_BODIES > 0 ? 16 : 20;
constexpr int kCellsY = TARGET_BODIES > 0 ? 12 : 13;
constexpr int kFillX = TARGET_BODIES > 0 ? 12 : 16;
constexpr int kFillY = TARGET_BODIES > 0 ? 9 : 12;

constexpr weir::Capacity kCapacity = [] {
    weir::Capacity c;
    c.cells_x = kCellsX;
    c.cells_y = kCellsY;
    c.particles = 4 * kFillX * kFillY;
    c.bodies = TARGET_BODIES;
    c.vertices = 3 * TARGET_BODIES;
    c.moving_bodies = false;
    return c;
}();

constexpr weir::WorldDef kDefinition = [] {
    weir::WorldDef def;
    def.capacity = kCapacity;
    def.cell_m = kCell;
    def.cfl = 2.0F;
    def.pressure_sweeps = weir::Stored<Real>::shares_momentum ? 6 : 8;  // packed worlds add two
    def.ticks = port::ticks;
    return def;
}();

alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<Real>(kCapacity)];
weir::World<Real> g_world;

void require(weir::Status status) {
    if (status != weir::Status::ok) {
        port::print("status ", static_cast<std::int32_t>(status), "\n");  // no texts in the image
        port::exit(1);
    }
}

#if TARGET_BODIES > 0
void add_hump() {
    constexpr weir::Vec2f kHump[] = {{-0.06F, -0.02F}, {0.06F, -0.02F}, {0.0F, 0.07F}};
    weir::BodyId id;
    weir::BodyDef def;
    def.polygon = {kHump, 3};
    def.motion.position_m = {0.7F * kCellsX * kCell, 0.0F};
    require(g_world.add_static_body(def, &id));
}
#endif

}  // namespace

int main() {
    port::init();
    require(g_world.init(kDefinition, g_memory));
#if TARGET_BODIES > 0
    add_hump();
#endif
    require(g_world.fill({{0.0F, 0.0F}, {kFillX * kCell, kFillY * kCell}}));
    const std::int32_t particles = g_world.particle_positions().size;
    std::uint32_t stage[weir::kStageCount] = {};
    std::int32_t substeps = 0;
    const std::uint64_t start = port::ticks();
    for (int step = 0; step < kSteps; ++step) {
        const weir::StepReport report = g_world.step(1.0F / 64.0F);
        substeps += report.substeps;
        for (int k = 0; k < weir::kStageCount; ++k) {
            stage[k] += static_cast<std::uint32_t>(report.ticks[k]);
        }
    }
    const std::uint64_t all = port::ticks() - start;
    port::print("particles ", particles, "\ncells ", kCellsX * kCellsY, "\nsubsteps ", substeps,
                "\ninstructions ", all, "\nworld ", sizeof g_memory, "\nstack ",
                port::stack_high_water(), "\n");
    for (int k = 0; k < weir::kStageCount; ++k) {
        port::print("stage_", weir::stage_name(static_cast<weir::Stage>(k)), " ", stage[k], "\n");
    }
    port::exit(0);
}
