#include "weir/weir.hpp"

#include "port/port.hpp"

constexpr weir::Capacity kCapacity = [] {
    weir::Capacity c;
    c.particles = 1000, c.cells_x = 40, c.cells_y = 24, c.bodies = 2, c.vertices = 8;
    return c;
}();
alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<float>(kCapacity)];
static_assert(sizeof g_memory <= 96 * 1024, "must leave room in 128 KB of RAM");
weir::World<float> g_world;

constexpr weir::Vec2f kRamp[] = {{0.40F, 0.00F}, {0.60F, 0.00F}, {0.60F, 0.10F}};
constexpr weir::Vec2f kPaddle[] = {{-0.1F, -0.02F}, {0.1F, -0.02F}, {0.1F, 0.02F}, {-0.1F, 0.02F}};

int main() {
    port::init();
    weir::WorldDef def;  // water, in cells of 2 cm; every field is explained in weir/config.hpp
    def.capacity = kCapacity;
    weir::BodyDef ramp, paddle;
    ramp.polygon = {kRamp, 3};
    paddle.polygon = {kPaddle, 4};
    paddle.motion.position_m = {0.70F, 0.25F};
    paddle.motion.spin_radps = 4.0F;  // it keeps turning
    weir::BodyId ramp_id, paddle_id;
    if (g_world.init(def, g_memory) != weir::Status::ok ||
        g_world.add_static_body(ramp, &ramp_id) != weir::Status::ok ||
        g_world.add_moving_body(paddle, &paddle_id) != weir::Status::ok ||
        g_world.fill({{0.02F, 0.00F}, {0.32F, 0.30F}}) != weir::Status::ok) {
        port::exit(1);
    }
    for (int frame = 0; frame < 300; ++frame) {
        port::wait_for_tick();
        const weir::StepReport report = g_world.step(1.0F / 60.0F);  // never fails
        if (report.particles != g_world.particle_positions().size) port::exit(2);
        // draw g_world.particle_positions() here
    }
    port::exit(0);
}
