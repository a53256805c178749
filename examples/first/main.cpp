#include "port/port.hpp"
#include "weir/weir.hpp"

constexpr weir::WorldDef kWater = [] {
    weir::WorldDef def;  // in cells of 2 cm; weir/config.hpp explains every field
    def.capacity.particles = 1000, def.capacity.bodies = 2, def.capacity.vertices = 8;
    def.capacity.cells_x = 40, def.capacity.cells_y = 24;
    return def;
}();
alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<float>(kWater.capacity)];
static_assert(sizeof g_memory <= 96 * 1024, "must leave room in 128 KB of RAM");
weir::World<float> g_world;

constexpr weir::Vec2f kRamp[] = {{0.40F, 0.00F}, {0.60F, 0.00F}, {0.60F, 0.10F}};
constexpr weir::Vec2f kBar[] = {{-0.1F, -0.02F}, {0.1F, -0.02F}, {0.1F, 0.02F}, {-0.1F, 0.02F}};

void require(weir::Status status) { if (status != weir::Status::ok) port::exit(1); }

int main() {
    port::init();
    require(g_world.init(kWater, g_memory));
    weir::BodyDef ramp, bar;
    weir::BodyId ramp_id, bar_id;
    ramp.polygon = kRamp;
    bar.polygon = kBar;
    bar.motion.position_m = {0.70F, 0.25F};
    bar.motion.spin_radps = 4.0F;  // set once, it keeps turning
    require(g_world.add_static_body(ramp, &ramp_id));
    require(g_world.add_moving_body(bar, &bar_id));
    require(g_world.fill({{0.02F, 0.00F}, {0.32F, 0.30F}}));
    for (int frame = 0; frame < 300; ++frame) {
        port::wait_for_tick();
        g_world.step(1.0F / 60.0F);  // never fails; its report says what had to be clamped
        // draw g_world.particle_positions() here
    }
    port::exit(0);
}
