// Surfaces: restitution, friction, conveyor, of bodies and of the tank's walls.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "solid/reflect.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr Vec2<double> kUp{0.0, 1.0};

TEST(Reflect, TurnsTheNormalPartAndKeepsTheOther) {
    const SurfaceLaw<double> mirror{1.0, 0.0, 0.0, false};
    const Vec2<double> after = reflect(mirror, {}, {3.0, -2.0}, kUp);
    EXPECT_DOUBLE_EQ(after.x, 3.0);
    EXPECT_DOUBLE_EQ(after.y, 2.0);
    const Vec2<double> leaving = reflect(mirror, {}, {3.0, 2.0}, kUp);
    EXPECT_DOUBLE_EQ(leaving.y, 2.0) << "a particle that leaves is left alone";
}

TEST(Reflect, FrictionIsBoundedByTheBlowAndByRest) {
    const SurfaceLaw<double> rough{0.5, 0.2, 0.0, false};
    const Vec2<double> slips = reflect(rough, {}, {3.0, -2.0}, kUp);
    EXPECT_DOUBLE_EQ(slips.x, 3.0 - 0.2 * 3.0) << "0.2 of the normal change 1.5 × 2";
    EXPECT_DOUBLE_EQ(slips.y, 1.0);
    const Vec2<double> stops = reflect(rough, {}, {-0.1, -2.0}, kUp);
    EXPECT_DOUBLE_EQ(stops.x, 0.0) << "friction does not turn it round";
    const Vec2<double> oblique =
        reflect(rough, {1.0, 1.0}, {1.0 - 0.8, 1.0 - 0.6}, Vec2<double>{0.8, 0.6});
    EXPECT_NEAR(oblique.x, 1.4, 1e-12) << "met straight on: nothing along the surface";
    EXPECT_NEAR(oblique.y, 1.3, 1e-12);
}

TEST(Reflect, AConveyorRunsCounterClockwise) {
    const SurfaceLaw<double> belt{0.0, 10.0, 2.0, false};
    const Vec2<double> top = surface_velocity(belt, {0.5, 0.0}, kUp);
    EXPECT_DOUBLE_EQ(top.x, -1.5) << "the upper side of a body runs to the left";
    const Vec2<double> after = reflect(belt, top, {0.0, -1.0}, kUp);
    EXPECT_DOUBLE_EQ(after.x, -1.5) << "carried along";
}

/// One particle thrown at each wall of an empty tank.
TEST(Surface, TankWallsRubAndCarry) {
    WorldDef def;
    def.gravity_mps2 = {0, 0};
    def.flip_ratio = 1.0F;
    def.volume_gain = 0.0F;
    Surface belt;
    belt.friction = 100.0F;
    belt.conveyor_mps = 0.1F;
    def.walls = every_wall(belt);
    const Vec2f start[] = {{0.3F, 0.05F}, {0.6F, 0.3F}, {0.3F, 0.6F}, {0.05F, 0.3F}};
    const Vec2f thrown[] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    const Vec2f carried[] = {{0.1F, 0}, {0, 0.1F}, {-0.1F, 0}, {0, -0.1F}};
    for (int k = 0; k < 4; ++k) {
        TestWorld<float> world{def};
        ASSERT_EQ(world->add_particle(start[k], thrown[k]), Status::ok);
        for (int step = 0; step < 30; ++step) {
            world->step(0.01F);
        }
        const Vec2f v = world->particle_velocities()[0];
        EXPECT_NEAR(v.x * def.cell_m, carried[k].x, 1e-3F) << "wall " << k;
        EXPECT_NEAR(v.y * def.cell_m, carried[k].y, 1e-3F) << "wall " << k;
    }
}

/// The same against a body's four sides.
TEST(Surface, BodiesRubAndCarry) {
    WorldDef def;
    def.gravity_mps2 = {0, 0};
    def.flip_ratio = 1.0F;
    def.volume_gain = 0.0F;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    const Ring square{{-0.1F, -0.1F}, {0.1F, -0.1F}, {0.1F, 0.1F}, {-0.1F, 0.1F}};
    const Vec2f start[] = {{0.32F, 0.05F}, {0.6F, 0.32F}, {0.32F, 0.6F}, {0.05F, 0.32F}};
    const Vec2f thrown[] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const Vec2f carried[] = {{0.1F, 0}, {0, 0.1F}, {-0.1F, 0}, {0, -0.1F}};
    for (int k = 0; k < 4; ++k) {
        TestWorld<float> world{def};
        BodyDef body = body_of(square, {0.32F, 0.32F});
        body.surface.friction = 100.0F;
        body.surface.conveyor_mps = 0.1F;
        put_static(*world, body);
        ASSERT_EQ(world->add_particle(start[k], thrown[k]), Status::ok);
        for (int step = 0; step < 30; ++step) {
            world->step(0.01F);
        }
        const Vec2f v = world->particle_velocities()[0];
        EXPECT_NEAR(v.x * def.cell_m, carried[k].x, 1e-3F) << "side " << k;
        EXPECT_NEAR(v.y * def.cell_m, carried[k].y, 1e-3F) << "side " << k;
    }
}

/// Speed of the liquid on a slab, turned against the grid, whose surface runs along itself, in a
/// tank that is full; and what the slab gets.
template <class Real>
float speed_above_a_belt(bool no_slip, bool viscous, float* drag) {
    WorldDef def = small_def();
    def.gravity_mps2 = {0, 0};
    def.capacity.particles = 1024;
    def.capacity.two_way = true;
    def.viscosity_m2ps = viscous ? 2e-3F : 0.0F;
    TestWorld<Real> world{def};
    const Ring slab = rectangle(0.6F, 0.12F);
    BodyDef belt = body_of(slab, {0.16F, 0.05F}, 0.1F);
    belt.surface.no_slip = no_slip;
    belt.surface.conveyor_mps = -0.1F;  // to the right on its upper side
    const BodyId id = put_static(*world, belt);
    EXPECT_EQ(world->fill({{0, 0}, {0.32F, 0.32F}}), Status::ok);
    for (int k = 0; k < 60; ++k) {
        world->step(1.0F / 60.0F);
    }
    BodyForce force;
    EXPECT_EQ(world->force(id, &force), Status::ok);
    *drag = force.impulse_m3ps.x;
    float sum = 0;
    int count = 0;
    for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
        const Vec2<float> x = convert<float>(world->particle_positions()[k]);
        const float height = x.y - (5.54F + 0.1F * (x.x - 8.0F));
        if (height < 1.0F && x.x > 5.0F && x.x < 11.0F) {
            sum += convert<float>(world->particle_velocities()[k]).x * def.cell_m;
            ++count;
        }
    }
    return sum / static_cast<float>(count);
}

TEST(Surface, WallsStickToViscousLiquidAlone) {
    const auto fall = [](bool no_slip, float viscosity_m2ps) {
        WorldDef def = small_def();
        def.viscosity_m2ps = viscosity_m2ps;
        def.walls = every_wall({0.0F, 0.0F, no_slip, 0.0F});
        TestWorld<float> world{def};
        EXPECT_EQ(world->fill({{0.0F, 0.1F}, {0.1F, 0.3F}}), Status::ok);
        for (int k = 0; k < 20; ++k) {
            world->step(1.0F / 60.0F);
        }
        return world->state_hash();
    };
    EXPECT_EQ(fall(true, 0.0F), fall(false, 0.0F));
    EXPECT_NE(fall(true, 2.0e-3F), fall(false, 2.0e-3F));
}

TEST(Surface, ViscousLiquidSticksToBodies) {
    float drag = 0;
    EXPECT_LT(std::fabs(speed_above_a_belt<float>(false, true, &drag)), 0.005F);
    EXPECT_NEAR(drag, 0.0F, 1e-6F);
    EXPECT_GT(speed_above_a_belt<float>(true, true, &drag), 0.05F);
    EXPECT_LT(drag, -1e-5F) << "the liquid holds the belt back";
    EXPECT_GT(speed_above_a_belt<Fixed>(true, true, &drag), 0.05F);
}

/// Torque of the liquid in a ring of 16 cells on a disc of 8 that turns in it, over −4πνB (Couette
/// 1890), B = ω R₁² R₂² / (R₂² − R₁²).
TEST(Surface, ATurningDiscIsBraked) {
    constexpr float kInner = 0.16F, kOuter = 0.32F, kViscosity = 4.0e-3F, kSpin = 1.0F;
    WorldDef def = small_def();
    def.gravity_mps2 = {0, 0};
    def.capacity.cells_x = def.capacity.cells_y = 40;
    def.capacity.particles = 4 * 40 * 40;
    def.capacity.vertices = 512;
    def.capacity.two_way = true;
    def.viscosity_m2ps = kViscosity;
    TestWorld<float> world{def};
    const Ring hole = regular_polygon(96, kOuter), frame = rectangle(1.6F, 1.6F);
    const Ring disc = regular_polygon(64, kInner);
    const View<Vec2f> holes[] = {{hole.data(), static_cast<std::int32_t>(hole.size())}};
    BodyDef outer = body_of(frame, {0.404F, 0.398F}), inner = body_of(disc, {0.404F, 0.398F});
    outer.holes = {holes, 1};
    outer.surface.no_slip = inner.surface.no_slip = true;
    inner.motion.spin_radps = kSpin;
    BodyId id = put_static(*world, outer);
    id = put_moving(*world, inner);
    ASSERT_EQ(world->fill({{0, 0}, {0.8F, 0.8F}}), Status::ok);
    float impulse = 0, time = 0;
    for (int k = 0; k < 600; ++k) {
        const float dt = world->step(1.0F / 60.0F).dt_s;
        BodyForce force;
        ASSERT_EQ(world->force(id, &force), Status::ok);
        impulse += k < 540 ? 0 : force.angular_impulse_m4ps;
        time += k < 540 ? 0 : dt;
    }
    const float squares = kInner * kInner * kOuter * kOuter / (kOuter * kOuter - kInner * kInner);
    EXPECT_NEAR(impulse / time / (-12.56637F * kViscosity * kSpin * squares), 1.0F, 0.08F);
}

TEST(Surface, WithoutViscosityNothingSticks) {
    float drag = 0;
    const float slips = speed_above_a_belt<float>(false, false, &drag);
    EXPECT_EQ(speed_above_a_belt<float>(true, false, &drag), slips);
}

}  // namespace
}  // namespace weir
