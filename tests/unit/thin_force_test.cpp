// What liquid does to walls of no thickness.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;
constexpr float kGravity = 9.81F;

BodyDef line_of(Ring& cells, Vec2f at) {
    for (Vec2f& vertex : cells) {
        vertex = kCell * vertex;
    }
    BodyDef line = body_of(cells, kCell * at);
    line.open = true;
    return line;
}

WorldDef tank() {
    WorldDef def = tank_def(32, 24, 2400, 2, 8);
    def.capacity.wall_edges = 400;
    def.capacity.two_way = true;
    def.cell_m = kCell;
    return def;
}

struct Loads {
    Vec2f wall;
    Vec2f tank;
    float torque = 0.0F;
};

/// Mean of so many steps, m³/s² and m⁴/s².
template <class Real>
Loads mean_loads(TestWorld<Real>& world, BodyId id, int steps) {
    Loads mean;
    const float share = 1.0F / (kFrame * static_cast<float>(steps));
    for (int step = 0; step < steps; ++step) {
        world->step(kFrame);
        BodyForce force;
        expect_ok(world->force(id, &force));
        mean.wall = mean.wall + share * force.impulse_m3ps;
        mean.torque += share * force.angular_impulse_m4ps;
        expect_ok(world->tank_force(&force));
        mean.tank = mean.tank + share * force.impulse_m3ps;
    }
    return mean;
}

WEIR_SUITE(ThinForce, RoomyScalars);

/// Nothing was told to a wall that no node shows.
TYPED_TEST(ThinForce, WaterLeansOnAGate) {
    for (const float lean : {0.0F, 0.35F}) {
        for (const float other_side : {0.0F, 12.0F}) {
            TestWorld<TypeParam> world(tank());
            const float foot = 16.3F;
            Ring ring = {{40.0F * lean, -40}, {-40.0F * lean, 40}};
            const BodyId gate = put_static(*world, line_of(ring, {foot, 0}));
            float volume = 0.0F;  // on the left
            for (float y = 0.25F; y < 12.0F; y += 0.5F) {
                for (float x = 0.25F; x < 32.0F; x += 0.5F) {
                    const float past = x - (foot - lean * y);
                    if (past < -0.1F || (past > 0.1F && y < other_side)) {
                        expect_ok(world->add_particle(kCell * Vec2f{x, y}, {}));
                        volume += past < 0.0F ? 0.25F : 0.0F;
                    }
                }
            }
            const float root = foot * foot - 2.0F * lean * volume;
            const float depth = kCell * 2.0F * volume / (foot + std::sqrt(root));
            for (int step = 0; step < 400; ++step) {
                world->step(kFrame);
            }
            const Loads loads = mean_loads(world, gate, 200);
            const float all = 0.5F * kGravity * depth * depth;
            const float expected = other_side > 0.0F ? 0.0F : all;
            EXPECT_NEAR(loads.wall.x / all, expected / all, 0.03F) << lean << ' ' << other_side;
            EXPECT_NEAR(loads.wall.y / all, lean * expected / all, 0.12F) << lean;
            EXPECT_NEAR(loads.tank.x / all, -expected / all, 0.03F) << lean;
        }
    }
}

TYPED_TEST(ThinForce, WaterBrakesAPaddle) {
    float torque[2];
    for (const int way : {0, 1}) {
        TestWorld<TypeParam> world(tank());
        Ring ring = {{-6, 0}, {6, 0}};
        BodyDef line = line_of(ring, {16, 9});
        line.motion.spin_radps = way == 0 ? 1.0F : -1.0F;
        const BodyId paddle = put_moving(*world, line);
        expect_ok(world->fill({{0, 0}, {32 * kCell, 16 * kCell}}));
        for (int step = 0; step < 60; ++step) {
            world->step(kFrame);
        }
        torque[way] = mean_loads(world, paddle, 377).torque;
    }
    EXPECT_LT(torque[0], 0.0F);
    EXPECT_GT(torque[1], 0.0F);
    EXPECT_NEAR(-torque[0] / torque[1], 1.0F, 0.5F);
}

/// How far a float of three cells, half a cell too deep in the water, a tenth of a cell beside a wall
/// of no thickness, has gone from it after 200 steps, cells.
template <class Real>
float way_of_float(float wall) {
    TestWorld<Real> world(tank());
    Ring ring = {{0, -5}, {0, 30}};
    put_static(*world, line_of(ring, {wall, 0}));
    const Ring square = rectangle(3 * kCell, 3 * kCell);
    const float beside = wall + 0.1F + 1.5F;
    const BodyId id = put_free(*world, body_of(square, kCell * Vec2f{beside, 10}));
    expect_ok(world->fill({{0, 0}, {32 * kCell, 11 * kCell}}));
    for (int step = 0; step < 200; ++step) {
        world->step(kFrame);
    }
    Motion now;
    expect_ok(world->motion(id, &now));
    return now.position_m.x / kCell - beside;
}

/// What presses on the wall pushed it away, 10 cells in that time. At one place of seven it still
/// goes 7, beside slabs 5 to 6.
TYPED_TEST(ThinForce, AFloatStaysBesideAWall) {
    float sum = 0.0F;
    for (const float wall : {15.9F, 16.15F, 16.3F, 16.45F, 16.6F}) {
        const float way = way_of_float<TypeParam>(wall);
        EXPECT_LT(way, 8.0F) << wall;
        sum += way;
    }
    EXPECT_LT(sum / 5.0F, 3.0F);
}

}  // namespace
}  // namespace weir
