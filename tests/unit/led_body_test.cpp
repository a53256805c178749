// Bodies that something outside of the liquid stops or leads: the liquid keeps its volume.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;

WorldDef pool_def(std::int32_t cells_x, std::int32_t cells_y) {
    WorldDef def = tank_def(cells_x, cells_y, 4 * cells_x * cells_y, 2, 8);
    def.capacity.two_way = true;
    return def;
}

WEIR_SUITE(LedBody, RoomyScalars);

/// It lies flat, the liquid around it keeps its volume, and nothing lifts it again.
TYPED_TEST(LedBody, SunkenBodyLeavesTheLiquidItsVolume) {
    for (const float angle : {0.0F, 0.4F}) {
        for (const float x : {0.24F, 0.05F}) {  // in the middle, and beside a wall
            TestWorld<TypeParam> world{pool_def(24, 20)};
            expect_ok(world->fill({{0, 0}, {0.48F, 0.24F}}));
            const Ring box = rectangle(0.1F, 0.06F);
            BodyDef body = body_of(box, {x, 0.3F}, angle);
            body.density_ratio = 2.0F;
            const BodyId id = put_free(*world, body);
            Motion m;
            for (int k = 0; k < 900; ++k) {
                world->step(kDt);
                expect_ok(world->motion(id, &m));
                if (k > 600) {
                    ASSERT_LT(m.position_m.y, 0.1F) << "it rose";
                }
            }
            EXPECT_GT(volume_left(*world), 0.97) << angle << " " << x;
        }
    }
}

/// What stops it does not hold it: under water light bodies leave the floor and the wall.
TYPED_TEST(LedBody, LightBodyLeavesTheFloor) {
    TestWorld<TypeParam> world{pool_def(24, 20)};
    const Ring box = rectangle(0.1F, 0.06F);
    BodyDef body = body_of(box, {0.05F, 0.03F});
    body.density_ratio = 0.4F;
    const BodyId id = put_free(*world, body);
    expect_ok(world->fill({{0, 0}, {0.48F, 0.24F}}));
    // Beneath it there is no liquid to press: it is lifted so far that some comes in.
    Motion m;
    expect_ok(world->motion(id, &m));
    m.position_m.y += 0.02F;
    expect_ok(world->set_motion(id, m));
    for (int k = 0; k < 300; ++k) {
        world->step(kDt);
    }
    expect_ok(world->motion(id, &m));
    EXPECT_GT(m.position_m.y, 0.2F);
    EXPECT_GT(volume_left(*world), 0.97);
}

/// Held in a stream it is not thrown, once it is let go, by all that hit it meanwhile.
TYPED_TEST(LedBody, ForgetsWhatHitItMeanwhile) {
    WorldDef def = pool_def(24, 20);
    def.gravity_mps2 = {};
    TestWorld<TypeParam> world{def};
    const BodyId id = put_free(*world, body_of(kSquare4cm, {0.24F, 0.2F}));
    for (int k = 0; k < 20; ++k) {
        expect_ok(world->add_particle({0.21F, 0.19F + 0.001F * static_cast<float>(k)},
                                      {3.0F, 0.0F}));
        expect_ok(world->move_body(id, {0.24F, 0.2F}, 0.0F, kDt));
        world->step(kDt);
    }
    expect_ok(world->drain({{0.0F, 0.0F}, {0.48F, 0.4F}}));
    world->step(kDt);
    EXPECT_NEAR(motion_of(*world, id).velocity_mps.x, 0.0F, 1.0e-3F);
}

/// There by the end of the step, the shorter way round, and no further after it.
template <class Real>
void lead_round(World<Real>& world, BodyId id, float turn) {
    Motion m = motion_of(world, id);
    const Vec2f from = m.position_m;
    for (int k = 1; k <= 10; ++k) {
        const auto n = static_cast<float>(k);
        const Vec2f to{from.x + 0.01F * n, from.y + 0.004F * n};
        const float angle = 3.0F + turn * n;
        const float round = turn > 0.0F ? -6.2831853F : 6.2831853F;
        expect_ok(world.move_body(id, to, k % 2 == 0 ? angle : angle + round, kDt));
        expect_ok(world.motion(id, &m));
        EXPECT_NEAR(m.spin_radps, turn / kDt, 1e-2F);
        world.step(kDt);
        expect_ok(world.motion(id, &m));
        EXPECT_NEAR(m.position_m.x, to.x, 1e-5F);
        EXPECT_NEAR(m.position_m.y, to.y, 1e-5F);
        EXPECT_NEAR(std::remainder(m.angle_rad - angle, 6.2831853F), 0.0F, 1e-3F);
        EXPECT_EQ(m.velocity_mps.x, 0.0F);
        EXPECT_EQ(m.spin_radps, 0.0F);
    }
}

TYPED_TEST(LedBody, GoesThereAndStandsStill) {
    TestWorld<TypeParam> world{pool_def(24, 20)};
    Motion m;
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}, 3.0F));
    lead_round(*world, id, 0.1F);
    lead_round(*world, put_moving(*world, body_of(kSquare4cm, {0.1F, 0.3F}, 3.0F)), -0.1F);
    expect_ok(world->motion(id, &m));
    const Vec2f last = m.position_m;
    world->step(kDt);
    expect_ok(world->motion(id, &m));
    EXPECT_EQ(m.position_m.x, last.x);
    EXPECT_EQ(m.position_m.y, last.y);
    // Who is told a motion is led no longer.
    expect_ok(world->move_body(id, {0.2F, 0.2F}, 0.0F, kDt));
    m.velocity_mps = {0.3F, 0.0F};
    expect_ok(world->set_motion(id, m));
    world->step(kDt);
    expect_ok(world->motion(id, &m));
    EXPECT_NEAR(m.velocity_mps.x, 0.3F, 1e-3F);
}

/// A held step is made good in the next one.
TYPED_TEST(LedBody, ArrivesAfterAStepThatHeldIt) {
    WorldDef def = pool_def(24, 20);
    def.capacity.two_way = false;
    TestWorld<TypeParam> world{def};
    expect_ok(world->fill({{0, 0}, {0.48F, 0.1F}}));
    Motion m;
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    world->step(kDt);
    expect_ok(world->move_body(id, {0.104F, 0.1F}, 0.0F, kDt));
    ASSERT_TRUE(world->step(kDt, 3).walls_held);
    expect_ok(world->motion(id, &m));
    ASSERT_NEAR(m.position_m.x, 0.1F, 1e-6F);
    expect_ok(world->move_body(id, {0.108F, 0.1F}, 0.0F, kDt));
    ASSERT_FALSE(world->step(kDt, 3).walls_held);
    expect_ok(world->motion(id, &m));
    EXPECT_NEAR(m.position_m.x, 0.108F, 1e-5F);
    EXPECT_EQ(m.velocity_mps.x, 0.0F);
}

/// Who is not led on stands where it was led to, however long the step that takes it there is.
TYPED_TEST(LedBody, GoesNoFurtherAfterAStepThatHeldIt) {
    WorldDef def = pool_def(24, 20);
    def.capacity.two_way = false;
    for (const float dt_s : {kDt, 0.4F * kDt, 5.0F * kDt}) {
        TestWorld<TypeParam> world{def};
        TestWorld<TypeParam> restored{def};
        expect_ok(world->fill({{0, 0}, {0.48F, 0.1F}}));
        const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
        world->step(kDt);
        expect_ok(world->move_body(id, {0.11F, 0.105F}, 0.2F, kDt));
        ASSERT_TRUE(world->step(kDt, 3).walls_held);
        change_worlds(world, restored, def);
        world->step(dt_s);
        restored->step(dt_s);
        EXPECT_EQ(world->state_hash(), restored->state_hash());
        const Motion m = motion_of(*world, id);
        EXPECT_NEAR(m.position_m.x, 0.11F, 3e-5F);
        EXPECT_NEAR(m.position_m.y, 0.105F, 3e-5F);
        EXPECT_NEAR(m.angle_rad, 0.2F, 1e-3F);
        EXPECT_EQ(m.velocity_mps.x, 0.0F);
        EXPECT_EQ(m.spin_radps, 0.0F);
    }
}

/// A character that wades to and fro, known by its position alone.
template <class Real>
void expect_wading_keeps_volume() {
    WorldDef def = pool_def(48, 20);
    def.capacity.two_way = false;
    TestWorld<Real> world{def};
    expect_ok(world->fill({{0, 0}, {0.96F, 0.24F}}));
    const Ring hero = {{-0.04F, 0}, {0.04F, 0}, {0.04F, 0.16F}, {-0.04F, 0.16F}};
    const BodyId id = put_moving(*world, body_of(hero, {0.2F, 0.0F}));
    for (int k = 0; k < 1200; ++k) {
        const float phase = std::fmod(static_cast<float>(k) * kDt * 0.6F, 1.12F);
        const float x = 0.2F + (phase < 0.56F ? phase : 1.12F - phase);
        expect_ok(world->move_body(id, {x, 0.0F}, 0.0F, kDt));
        world->step(kDt);
    }
    EXPECT_GT(volume_left(*world), 0.97);
}
TYPED_TEST(LedBody, WadingKeepsVolume) { expect_wading_keeps_volume<TypeParam>(); }
TEST(LedSmallBody, WadingKeepsVolume) { expect_wading_keeps_volume<SmallFixed>(); }

/// A free body that hangs on a rope moves as told, is free again afterwards, and weighs what it did.
TYPED_TEST(LedBody, FreeBodyIsHeldAndLetGo) {
    for (const float density : {0.2F, 3.0F}) {
        TestWorld<TypeParam> world{pool_def(24, 20)};
        const Ring box = rectangle(0.08F, 0.08F);
        BodyDef body = body_of(box, {0.24F, 0.12F});
        body.density_ratio = density;
        Motion m;
        const BodyId id = put_free(*world, body);
        expect_ok(world->fill({{0, 0}, {0.48F, 0.24F}}));
        float lift = 0;
        for (int k = 0; k < 600; ++k) {
            expect_ok(world->move_body(id, {0.24F, 0.12F}, 0.0F, kDt));
            world->step(kDt);
            BodyForce force;
            expect_ok(world->force(id, &force));
            lift += k < 300 ? 0.0F : force.impulse_m3ps.y / (300 * force.dt_s);
        }
        expect_ok(world->motion(id, &m));
        EXPECT_NEAR(m.position_m.x, 0.24F, 1e-5F);
        EXPECT_NEAR(m.position_m.y, 0.12F, 1e-5F);
        EXPECT_GT(volume_left(*world), 0.98);
        EXPECT_NEAR(lift / (9.81F * 0.0064F), 1.0F, 0.1F) << "what holds it has to know";
        for (int k = 0; k < 30; ++k) {
            world->step(kDt);
        }
        expect_ok(world->motion(id, &m));
        EXPECT_GT(density < 1.0F ? m.position_m.y - 0.12F : 0.12F - m.position_m.y, 0.02F);
    }
}

/// A snapshot between the call and the step goes on as the world does.
TYPED_TEST(LedBody, SnapshotKnowsWhoIsLed) {
    TestWorld<TypeParam> world{pool_def(24, 20)};
    TestWorld<TypeParam> twin{pool_def(24, 20)};
    expect_ok(world->fill({{0, 0}, {0.48F, 0.1F}}));
    BodyId free = put_free(*world, body_of(kSquare4cm, {0.1F, 0.2F}));
    const BodyId moving = put_moving(*world, body_of(kSquare4cm, {0.3F, 0.1F}));
    world->step(kDt);
    const std::uint64_t before = world->state_hash();
    expect_ok(world->move_body(free, {0.11F, 0.2F}, 0.1F, kDt));
    expect_ok(world->move_body(moving, {0.31F, 0.1F}, 0.0F, kDt));
    EXPECT_NE(world->state_hash(), before);
    std::vector<std::byte> snapshot(1U << 20U);
    std::size_t written = 0;
    expect_ok(world->save(snapshot.data(), snapshot.size(), &written));
    expect_ok(twin->restore(snapshot.data(), written));
    EXPECT_EQ(twin->state_hash(), world->state_hash());
    for (int k = 0; k < 40; ++k) {
        world->step(kDt);
        twin->step(kDt);
        ASSERT_EQ(twin->state_hash(), world->state_hash()) << k;
    }
    Motion m;
    expect_ok(twin->body_in_slot(0, &free));
    expect_ok(twin->motion(free, &m));
    EXPECT_LT(m.position_m.y, 0.15F) << "it fell";
}

/// Further than it can go in a step a body goes as far as it can, straight there.
WEIR_SUITE(FarLedBody, EveryScalar);
TYPED_TEST(FarLedBody, CatchesUp) {
    WorldDef def = pool_def(200, 20);
    def.capacity.particles = 100;
    TestWorld<TypeParam> world(def);
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
    const Vec2f to{3.8F, 0.3F};
    constexpr float kShort = 1.0F / 8000.0F;  // 180 cells, 1.4 million a second
    Motion motion;
    std::int32_t steps = 0;
    do {
        expect_ok(world->move_body(id, to, 1.0F, kShort));
        world->step(kShort);
        expect_ok(world->motion(id, &motion));
        const float way = (motion.position_m.x - 0.2F) / 3.6F;
        EXPECT_NEAR(motion.position_m.y, 0.1F + 0.2F * way, 0.01F);
        EXPECT_NEAR(motion.angle_rad, way, 0.03F);
    } while (++steps < 20000 && motion.position_m.x < 3.79F);
    EXPECT_GT(steps, 1) << "it would not have been too far";
    EXPECT_LT(steps, 10000);
    EXPECT_NEAR(motion.position_m.x, to.x, 0.01F);
}

/// However short the step is that it has for its way.
TYPED_TEST(FarLedBody, GoesAsFastAsItCan) {
    TestWorld<TypeParam> world{pool_def(24, 20)};
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
    for (const Vec2f way : {Vec2f{0.1F, 0.0F}, Vec2f{0.0F, 0.1F}}) {
        const Vec2f to{0.2F + way.x, 0.1F + way.y};
        const auto along = [&](const Motion& motion) {
            return 10.0F * (motion.velocity_mps.x * way.x + motion.velocity_mps.y * way.y);
        };
        Motion fast;
        expect_ok(world->move_body(id, to, 0.0F, 1e-12F));
        expect_ok(world->motion(id, &fast));
        EXPECT_GT(along(fast), 4.0F);
        for (const float dt : {1e-30F, 1e-38F, 1e-39F, 1e-44F}) {
            Motion motion;
            expect_ok(world->move_body(id, to, 0.0F, dt));
            expect_ok(world->motion(id, &motion));
            EXPECT_NEAR(motion.velocity_mps.x, fast.velocity_mps.x, 1e-3F * along(fast)) << dt;
            EXPECT_NEAR(motion.velocity_mps.y, fast.velocity_mps.y, 1e-3F * along(fast)) << dt;
        }
    }
}

TEST(LedBodyCalls, AreRefusedWhenTheyMakeNoSense) {
    TestWorld<float> world{pool_def(24, 20)};
    const BodyId fixed = put_static(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    const BodyId moving = put_moving(*world, body_of(kSquare4cm, {0.3F, 0.1F}));
    const std::uint64_t before = world->state_hash();
    const Vec2f to{0.31F, 0.1F};
    EXPECT_EQ(World<float>().move_body(moving, to, 0, kDt), Status::not_initialised);
    EXPECT_EQ(world->move_body(fixed, to, 0, kDt), Status::body_is_static);
    EXPECT_EQ(world->move_body(BodyId{}, to, 0, kDt), Status::stale_body);
    for (const float bad : {0.0F, -1.0F, NAN, INFINITY}) {
        EXPECT_EQ(world->move_body(moving, to, 0, bad), Status::motion_not_finite);
    }
    EXPECT_EQ(world->move_body(moving, {NAN, 0}, 0, kDt), Status::motion_not_finite);
    EXPECT_EQ(world->move_body(moving, to, NAN, kDt), Status::motion_not_finite);
    EXPECT_EQ(world->move_body(moving, {1e9F, 0}, 0, kDt), Status::position_out_of_range);
    EXPECT_EQ(world->move_body(moving, to, 2e4F, kDt), Status::motion_out_of_range);
    EXPECT_EQ(world->state_hash(), before);
    StepReport report;
    expect_ok(world->begin_step(kDt, &report));
    EXPECT_EQ(world->move_body(moving, to, 0, kDt), Status::step_in_progress);
}

}  // namespace
}  // namespace weir
