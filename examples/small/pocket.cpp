// A tank in your pocket: the smallest boards run the same library, in fixed point. Gravity turns
// slowly, as if the board were tilted. With POCKET_OLED the liquid is drawn on the board's display.
#include "port/port.hpp"
#include "port/print.hpp"
#include "weir/display.hpp"
#include "weir/weir.hpp"

#ifdef POCKET_OLED
#include "oled.hpp"
#endif

namespace {

constexpr weir::Capacity kCapacity = [] {
    weir::Capacity c;
    c.cells_x = POCKET_CELLS_X;
    c.cells_y = POCKET_CELLS_Y;
    c.particles = POCKET_PARTICLES;
    c.bodies = POCKET_BODIES;
    c.vertices = POCKET_BODIES == 1 ? 3 : 4 * POCKET_BODIES;
    c.moving_bodies = POCKET_BODIES > 1;
    return c;
}();

alignas(weir::world_alignment) std::byte
    g_memory[weir::world_bytes<weir::SmallFixed>(kCapacity)];
weir::World<weir::SmallFixed> g_world;

constexpr float kCell = 0.02F;

void require(weir::Status status) {
    if (status != weir::Status::ok) {
        port::print(weir::status_text(status), "\n");
        port::exit(1);
    }
}

constexpr weir::WorldDef kDefinition = [] {
    weir::WorldDef def;
    def.capacity = kCapacity;
    def.cell_m = kCell;
    def.cfl = 2.0F;  // one substep a step, but in the wildest splash
    def.pressure_sweeps = POCKET_SWEEPS;
    return def;
}();

/// A hump on the floor, and in a larger tank a bar that turns and a ledge.
[[gnu::noinline]] void add_bodies() {
    constexpr float kMiddle = 0.6F * POCKET_CELLS_X * kCell;
    constexpr weir::Vec2f kHump[] = {{-0.06F, -0.02F}, {0.06F, -0.02F}, {0.0F, 0.07F}};
    constexpr weir::Vec2f kBar[] = {
        {-0.09F, -0.015F}, {0.09F, -0.015F}, {0.09F, 0.015F}, {-0.09F, 0.015F}};
    weir::BodyId id;
    weir::BodyDef def;
    if (POCKET_BODIES > 0) {
        def.polygon = kHump;
        def.motion.position_m = {kMiddle, 0.0F};
        require(g_world.add_static_body(def, &id));
    }
    if (POCKET_BODIES > 1) {
        def.polygon = kBar;
        def.motion.position_m = {kMiddle, 0.25F};
        def.motion.spin_radps = 3.0F;
        require(g_world.add_moving_body(def, &id));
        def.motion.position_m = {0.1F, 0.3F};
        def.motion.spin_radps = 0.0F;
        require(g_world.add_static_body(def, &id));
    }
}

/// The board is tipped to one side and the other, once in four seconds.
weir::Vec2f gravity_at(int step) {
    const int phase = step % 240;
    const int away = phase < 60 ? phase : (phase < 180 ? 120 - phase : phase - 240);
    return {0.08F * static_cast<float>(away), -9.0F};
}

/// Not in main(), whose frame every step stands on.
[[gnu::noinline]] void tell(std::int32_t substeps, std::uint64_t ticks) {
    port::print("scene pocket_", POCKET_CELLS_X, "x", POCKET_CELLS_Y, " ", POCKET_STEPS, " ",
                g_world.particle_positions().size, " ", port::hex(g_world.state_hash()), "\n");
    port::print("world ", sizeof g_memory, ", ram ", port::ram_bytes(), ", stack ",
                port::stack_high_water(), " of ", port::stack_bytes(), ", code ",
                port::code_bytes(), " bytes\n");
    port::print("steps ", POCKET_STEPS, ", substeps ", substeps, ", ticks ", ticks, " ",
                port::tick_unit(), "\n");
}

}  // namespace

int main() {
    port::init();
    require(g_world.init(kDefinition, g_memory));
    add_bodies();
    require(g_world.fill({{0.0F, 0.0F}, {POCKET_FILL_X * kCell, POCKET_FILL_HALVES * 0.5F * kCell}}));
#ifdef POCKET_OLED
    oled::start();
#endif
    const std::uint64_t start = port::ticks();
    std::int32_t substeps = 0;
    for (int step = 1; step <= POCKET_STEPS; ++step) {
        require(g_world.set_gravity(gravity_at(step)));
        port::wait_for_tick();
        // Of gravity that a sensor tells 1/66 s: at 1/64 its noise makes two substeps of many.
        substeps += g_world.step(1.0F / 64.0F).substeps;
#ifdef POCKET_OLED
        oled::show(g_world);
        if (step % 30 == 0) {
            port::print("frame ", step, "\n");
        }
#endif
    }
    tell(substeps, port::ticks() - start);
    port::exit(0);
}
