// Free bodies on hinges and rails, and surfaces that change.
#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 240.0F;

WorldDef held_def() {
    WorldDef def = tank_def(32, 32, 4096, 3, 64);
    def.capacity.two_way = true;
    return def;
}

WEIR_SUITE(HeldBody, RoomyScalars);

/// A rod that hangs on its end falls from level: at the bottom ω² = 3 g / L.
TYPED_TEST(HeldBody, ARodSwingsAboutItsEnd) {
    TestWorld<TypeParam> world{held_def()};
    const Vec2f rod[] = {{0.0F, -0.01F}, {0.2F, -0.01F}, {0.2F, 0.01F}, {0.0F, 0.01F}};
    BodyDef def;
    def.polygon = {rod, 4};
    def.motion.position_m = {0.32F, 0.4F};
    def.hold = Hold::hinge;
    const BodyId id = put_free(*world, def);
    float fastest = 0;
    Motion start;
    Motion now;
    expect_ok(world->motion(id, &start));
    for (int k = 0; k < 240; ++k) {
        world->step(kDt);
        expect_ok(world->motion(id, &now));
        ASSERT_EQ(now.position_m.x, start.position_m.x);
        ASSERT_EQ(now.position_m.y, start.position_m.y);
        fastest = std::max(fastest, std::fabs(now.spin_radps));
    }
    const double inertia = (0.04 * 1.0 + 0.0004) / 12 + 0.01;  // over its mass, about the end
    EXPECT_NEAR(fastest, std::sqrt(2 * 9.81 * 0.1 / inertia), 0.03 * static_cast<double>(fastest));
}

/// What carries the hinge is not moved by what hangs on it.
TYPED_TEST(HeldBody, AHingeGoesAsTold) {
    TestWorld<TypeParam> world{held_def()};
    BodyDef def = body_of(kTriangle, {0.2F, 0.3F});
    def.hold = Hold::hinge;
    def.motion.velocity_mps = {0.25F, 0.0F};
    const BodyId id = put_free(*world, def);
    double t = 0;
    for (int k = 0; k < 120; ++k) {
        t += static_cast<double>(world->step(kDt).dt_s);
    }
    Motion now;
    expect_ok(world->motion(id, &now));
    EXPECT_NEAR(now.position_m.x, 0.2 + 0.25 * t, 2e-5);
    EXPECT_NEAR(now.position_m.y, 0.3, 1e-6);
    EXPECT_GT(std::fabs(now.spin_radps), 0.1F) << "and hangs on it";
}

/// Led on for ever, at the most that a call may ask for, it is further away than whole numbers tell.
TYPED_TEST(HeldBody, AHingeMayLeaveForGood) {
    constexpr bool kFixed = std::is_same_v<TypeParam, Fixed>;
    WorldDef tank = tank_def(4, 4, 4, 1, 4);
    tank.capacity.two_way = true;
    tank.gravity_mps2 = {0.0F, 0.0F};
    tank.max_substeps = 1;
    TestWorld<TypeParam> world{tank};
    BodyDef def = body_of(kSquare4cm, {0.04F, 0.04F});
    def.hold = Hold::hinge;
    const float fastest = kFixed ? 300.0F : 19900.0F;
    def.motion.velocity_mps = {fastest, -fastest};
    const BodyId id = put_free(*world, def);
    for (int k = 0; k < 2300; ++k) {
        EXPECT_TRUE(world->step(1.0F).dt_s > 0.0F);
    }
    const Motion now = motion_of(*world, id);
    EXPECT_TRUE(std::isfinite(now.position_m.x) && std::isfinite(now.position_m.y));
    EXPECT_GT(now.position_m.x, kFixed ? 600.0F : 4.4e7F);
}

/// Upright it falls freely, wherever its middle is, and does not turn.
TYPED_TEST(HeldBody, UprightItMovesAndDoesNotTurn) {
    TestWorld<TypeParam> world{held_def()};
    BodyDef def = body_of(kTriangle, {0.2F, 0.4F}, 0.3F);
    def.hold = Hold::upright;
    def.motion.velocity_mps = {0.25F, 0.0F};
    const BodyId id = put_free(*world, def);
    const Motion start = motion_of(*world, id);
    double t = 0;
    for (int k = 0; k < 60; ++k) {
        t += static_cast<double>(world->step(kDt).dt_s);
        ASSERT_EQ(motion_of(*world, id).angle_rad, start.angle_rad);
    }
    const Motion now = motion_of(*world, id);
    EXPECT_NEAR(now.position_m.x, 0.2 + 0.25 * t, 2e-4);
    EXPECT_NEAR(now.position_m.y, 0.4 - 0.5 * 9.81 * t * t, 0.01);
    EXPECT_EQ(now.spin_radps, 0.0F);
}

/// A float in a shaft goes up and down, and stands as deep as it is heavy.
TYPED_TEST(HeldBody, ARailLeadsAFloat) {
    WorldDef def = held_def();
    def.pressure_sweeps = 16;
    TestWorld<TypeParam> world{def};
    const Ring box = rectangle(0.16F, 0.16F);
    BodyDef body = body_of(box, {0.31F, 0.3F}, 0.2F);
    body.hold = Hold::rail_y;
    const BodyId id = put_free(*world, body);
    expect_ok(world->fill({{0, 0}, {0.64F, 0.28F}}));
    double mean = 0;
    Motion now;
    for (int k = 0; k < 2400; ++k) {
        world->step(kDt);
        expect_ok(world->motion(id, &now));
        ASSERT_NEAR(now.position_m.x, 0.31F, 1e-6F);
        ASSERT_NEAR(now.angle_rad, 0.2F, 1e-5F);
        mean += k >= 1200 ? static_cast<double>(now.position_m.y) / 1200 : 0.0;
    }
    LiquidIn found;
    expect_ok(world->liquid_in({{0, 0}, {0.1F, 0.64F}}, &found));
    const float level = 2 * found.centroid_m.y;
    EXPECT_NEAR(mean, level, 0.01) << "half as dense as the liquid, symmetric: its centre";
}

/// Spun by the torque of the step before such a wheel had been 900 rad/s fast.
TYPED_TEST(HeldBody, ALightWheelTurnsWithTheStream) {
    for (const float density : {2.0F, 0.5F, 0.05F}) {
        WorldDef def = held_def();
        def.capacity.cells_x = 64;
        TestWorld<TypeParam> world{def};
        std::vector<Vec2f> wheel;  // four paddles
        for (int k = 0; k < 4; ++k) {
            const double a = 1.57079632679 * k;
            const auto at = [&](double along, double across) {
                wheel.push_back({static_cast<float>(along * std::cos(a) - across * std::sin(a)),
                                 static_cast<float>(along * std::sin(a) + across * std::cos(a))});
            };
            at(0.15, -0.02), at(0.15, 0.02), at(0.02, 0.02);
        }
        BodyDef body;
        body.polygon = {wheel.data(), static_cast<std::int32_t>(wheel.size())};
        body.motion.position_m = {0.7F, 0.2F};
        body.density_ratio = density;
        body.hold = Hold::hinge;
        const BodyId id = put_free(*world, body);
        expect_ok(world->fill({{0, 0}, {0.4F, 0.4F}}));  // breaks, and runs beneath it
        float least = 0;
        float most = 0;
        Motion now;
        for (int k = 0; k < 400; ++k) {
            const StepReport report = world->step(1.0F / 120.0F);
            EXPECT_EQ(report.bodies_slowed, 0);
            expect_ok(world->motion(id, &now));
            ASSERT_EQ(now.position_m.x, 0.7F);
            least = std::min(least, now.spin_radps);
            most = std::max(most, now.spin_radps);
        }
        EXPECT_GT(most, 2.0F) << "counter-clockwise, " << density;
        EXPECT_LT(most, 40.0F) << "no faster than the stream, " << density;
        EXPECT_GT(least, -20.0F) << density;
    }
}

/// Along its rail it falls freely, across it not at all, and it does not turn.
TYPED_TEST(HeldBody, RailsBearWhatIsAcross) {
    for (const bool along_x : {true, false}) {
        WorldDef def = held_def();
        def.gravity_mps2 = {2.0F, -3.0F};
        TestWorld<TypeParam> world{def};
        BodyDef body = body_of(kTriangle, {0.2F, 0.4F}, 0.3F);
        body.hold = along_x ? Hold::rail_x : Hold::rail_y;
        const BodyId id = put_free(*world, body);
        const Motion start = motion_of(*world, id);
        double t = 0.0;
        for (int k = 0; k < 60; ++k) {
            t += static_cast<double>(world->step(kDt).dt_s);
        }
        const Motion now = motion_of(*world, id);
        const double fallen = 0.5 * t * t;
        EXPECT_NEAR(now.position_m.x - start.position_m.x, along_x ? 2.0 * fallen : 0.0, 2e-3);
        EXPECT_NEAR(now.position_m.y - start.position_m.y, along_x ? 0.0 : -3.0 * fallen, 2e-3);
        EXPECT_EQ(now.angle_rad, start.angle_rad);
        EXPECT_EQ(now.spin_radps, 0.0F);
    }
}

/// One end of a seesaw goes down under a crate, which does not go through it; the crate's push along
/// the plank's own axis finds nothing that yields.
TYPED_TEST(HeldBody, ACrateTiltsASeesaw) {
    TestWorld<TypeParam> world{held_def()};
    const Ring plank = rectangle(0.3F, 0.03F);
    BodyDef seesaw = body_of(plank, {0.32F, 0.2F});
    seesaw.hold = Hold::hinge;
    BodyDef crate = body_of(kSquare4cm, {0.42F, 0.26F});
    const BodyId ids[] = {put_free(*world, seesaw), put_free(*world, crate)};
    Motion now;
    float steepest = 0;
    for (int k = 0; k < 240; ++k) {
        world->step(kDt);
        expect_ok(world->motion(ids[0], &now));
        ASSERT_LT(std::fabs(now.spin_radps), 30.0F);
        steepest = std::min(steepest, now.angle_rad);
    }
    EXPECT_LT(steepest, -0.3F);
}

TYPED_TEST(HeldBody, IsKeptInSnapshotsAndInTheHash) {
    std::uint64_t hash[3];
    const Hold holds[] = {Hold::none, Hold::rail_x, Hold::hinge};
    for (int n = 0; n < 3; ++n) {
        TestWorld<TypeParam> world{held_def()};
        BodyDef body = body_of(kTriangle, {0.3F, 0.3F});
        body.hold = holds[n];
        put_free(*world, body);
        hash[n] = world->state_hash();
        TestWorld<TypeParam> other{held_def()};
        world->step(kDt);
        change_worlds(world, other, held_def());
        world->step(kDt);
        other->step(kDt);
        EXPECT_EQ(other->state_hash(), world->state_hash());
    }
    EXPECT_NE(hash[0], hash[1]);
    EXPECT_NE(hash[1], hash[2]);
}

TYPED_TEST(HeldBody, RefusesWhatIsNoWayToHold) {
    TestWorld<TypeParam> world{held_def()};
    BodyDef body = body_of(kTriangle, {0.3F, 0.3F});
    body.hold = static_cast<Hold>(5);
    BodyId id;
    EXPECT_EQ(world->add_free_body(body, &id), Status::unknown_option);
}

TEST(SetSurface, SwitchesABeltOn) {
    TestWorld<float> world{held_def()};
    const Ring floor = rectangle(0.6F, 0.1F);
    BodyDef belt = body_of(floor, {0.32F, 0.1F});
    belt.surface.friction = 0.8F;
    const BodyId belt_id = put_static(*world, belt);
    const BodyId crate_id = put_free(*world, body_of(kSquare4cm, {0.2F, 0.17F}));
    Motion now;
    for (int k = 0; k < 120; ++k) {
        world->step(kDt);
    }
    expect_ok(world->motion(crate_id, &now));
    EXPECT_NEAR(now.velocity_mps.x, 0.0F, 1e-3F);
    Surface running = belt.surface;
    running.conveyor_mps = 0.3F;
    const std::uint64_t before = world->state_hash();
    expect_ok(world->set_surface(belt_id, running));
    EXPECT_NE(world->state_hash(), before);
    for (int k = 0; k < 60; ++k) {
        world->step(kDt);
    }
    expect_ok(world->motion(crate_id, &now));
    EXPECT_NEAR(std::fabs(now.velocity_mps.x), 0.3F, 1e-3F);
    const std::uint64_t kept = world->state_hash();
    running.restitution = 2.0F;
    EXPECT_EQ(world->set_surface(belt_id, running), Status::restitution_out_of_range);
    expect_ok(world->remove_body(belt_id));
    EXPECT_EQ(world->set_surface(belt_id, belt.surface), Status::stale_body);
    EXPECT_NE(world->state_hash(), kept);
}

/// As it is with a body that was viscous liquid's from the start.
TEST(SetSurface, StickingIsSeenAtOnce) {
    std::uint64_t hash[2];
    for (const bool later : {false, true}) {
        WorldDef def = held_def();
        def.viscosity_m2ps = 1e-3F;
        TestWorld<float> world{def};
        BodyDef body = body_of(kTriangle, {0.3F, 0.05F});
        body.surface.no_slip = !later;
        const BodyId id = put_static(*world, body);
        if (later) {
            Surface sticky = body.surface;
            sticky.no_slip = true;
            expect_ok(world->set_surface(id, sticky));
        }
        expect_ok(world->fill({{0, 0}, {0.2F, 0.3F}}));
        for (int k = 0; k < 60; ++k) {
            world->step(kDt);
        }
        hash[later ? 1 : 0] = world->state_hash();
    }
    EXPECT_EQ(hash[0], hash[1]);
}

}  // namespace
}  // namespace weir
