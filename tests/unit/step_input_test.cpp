// A step may not refuse: whatever it is given, it says what it clamped, and the liquid stays.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kFrame = 1.0F / 60.0F;

struct Pool {
    TestWorld<float> world;
    std::int32_t particles = 0;
    BodyId paddle;

    explicit Pool(Pressure pressure = Pressure::projection) : world(def(pressure)) {
        paddle = put_moving(*world, body_of(kSquare4cm, {0.22F, 0.1F}));
        EXPECT_EQ(world->fill({{0, 0}, {0.12F, 0.14F}}, &particles), Status::ok);
    }
    static WorldDef def(Pressure pressure) {
        WorldDef def = small_def();
        def.pressure = pressure;
        return def;
    }
    void expect_whole(const StepReport& report) const {
        EXPECT_EQ(report.particles, particles);
        EXPECT_EQ(world->particle_positions().size, particles);
        EXPECT_TRUE(all_inside(*world));
        EXPECT_TRUE(std::isfinite(report.max_speed_mps));
        EXPECT_TRUE(std::isfinite(report.dt_s));
        EXPECT_GE(report.dt_s, 0.0F);
        const FieldView<float> pressure = world->pressure();
        for (std::int32_t j = 0; j < pressure.rows; ++j) {
            for (std::int32_t i = 0; i < pressure.columns; ++i) {
                ASSERT_TRUE(std::isfinite(pressure.at(i, j))) << i << ", " << j;
            }
        }
    }
    /// Goes on after the bad input; at the end the liquid is calm enough to be liquid.
    void expect_recovers() {
        for (int step = 0; step < 300; ++step) {
            expect_whole(world->step(kFrame));
            ASSERT_FALSE(::testing::Test::HasFailure()) << "step " << step;
        }
        const StepReport last = world->step(kFrame);
        EXPECT_EQ(last.particles_reset, 0);
        EXPECT_LT(last.max_speed_mps, 2.5F) << "twice a fall through the tank";
    }
};

TEST(StepInput, GoodStepsReportNothing) {
    Pool pool;
    const StepReport report = pool.world->step(kFrame);
    EXPECT_EQ(report.clamped, 0U);
    EXPECT_GE(report.substeps, 1);
    EXPECT_FLOAT_EQ(report.dt_s, kFrame);
    pool.expect_whole(report);
    pool.expect_recovers();
}

TEST(StepInput, NoTimePasses) {
    for (const float dt : {0.0F, -0.0F, -1.0F, -kFrame, kNan, kInf, -kInf}) {
        SCOPED_TRACE(dt);
        Pool pool;
        pool.world->step(kFrame);
        const std::uint64_t before = pool.world->state_hash();
        const StepReport report = pool.world->step(dt);
        EXPECT_EQ(report.has(Clamped::time_step), dt != 0.0F) << "a pause is asked for as it is";
        EXPECT_EQ(report.substeps, 0);
        EXPECT_EQ(report.dt_s, 0.0F);
        EXPECT_EQ(pool.world->state_hash(), before);
        pool.expect_whole(report);
        EXPECT_EQ(pool.world->step(kFrame).clamped, 0U) << "the bit is not repeated";
    }
}

TEST(StepInput, WhatGravityAloneTakesOfSubsteps) {
    TestWorld<float> world(small_def());
    EXPECT_EQ(world->step(1.0F / 64).substeps, 1) << "0.1197 cells";
    EXPECT_EQ(world->step(1.0F / 60).substeps, 2) << "0.136 cells";
}

TEST(StepInput, LongTimeIsCut) {
    for (const float dt : {kFrame * 1000.0F, 1.0e30F, std::numeric_limits<float>::max()}) {
        SCOPED_TRACE(dt);
        Pool pool;
        for (int k = 0; k < 5; ++k) {
            const StepReport report = pool.world->step(dt);
            EXPECT_TRUE(report.has(Clamped::time_step));
            EXPECT_LT(report.dt_s, dt);
            EXPECT_GT(report.dt_s, 0.0F);
            EXPECT_LE(report.substeps, Pool::def(Pressure::projection).max_substeps);
            pool.expect_whole(report);
        }
        pool.expect_recovers();
    }
}

TEST(StepInput, ShortTimesAndUnequalTimes) {
    for (const float dt : {1.0e-3F, 1.0e-4F, 1.0e-6F, 1.0e-10F, 1.0e-20F, 1.0e-30F, 1.0e-37F,
                           1.0e-40F, std::numeric_limits<float>::denorm_min()}) {
        SCOPED_TRACE(dt);
        Pool pool;
        for (int k = 0; k < 50; ++k) {
            pool.expect_whole(pool.world->step(k % 2 == 0 ? kFrame : dt));
            ASSERT_FALSE(::testing::Test::HasFailure()) << "step " << k;
        }
        pool.expect_recovers();
    }
}

TEST(StepInput, EquationOfStateTakesTheSame) {
    for (const float dt : {0.0F, kNan, kFrame * 1000.0F, 1.0e-30F}) {
        SCOPED_TRACE(dt);
        Pool pool(Pressure::equation_of_state);
        for (int k = 0; k < 20; ++k) {
            pool.expect_whole(pool.world->step(k % 2 == 0 ? kFrame : dt));
        }
        pool.expect_recovers();
    }
}

TEST(StepInput, SoundThatDoesNotFitIsSoftened) {
    WorldDef def = Pool::def(Pressure::equation_of_state);
    def.sound_speed_mps = 1500.0F;
    TestWorld<float> world(def);
    ASSERT_EQ(world->fill({{0, 0}, {0.12F, 0.14F}}), Status::ok);
    for (int k = 0; k < 100; ++k) {
        EXPECT_TRUE(world->step(kFrame).has(Clamped::sound_speed));
    }
    EXPECT_TRUE(all_inside(*world));
}

TEST(StepInput, GravityThatIsNoNumberKeepsTheLast) {
    for (const Vec2f gravity : {Vec2f{kNan, 0}, Vec2f{0, kNan}, Vec2f{kInf, 0}, Vec2f{0, -kInf}}) {
        Pool pool;
        Pool twin;
        EXPECT_EQ(pool.world->set_gravity(gravity), Status::gravity_not_finite);
        const StepReport report = pool.world->step(kFrame);
        EXPECT_TRUE(report.has(Clamped::gravity));
        EXPECT_FALSE(twin.world->step(kFrame).has(Clamped::gravity));
        pool.expect_whole(report);
        EXPECT_EQ(pool.world->state_hash(), twin.world->state_hash());
        EXPECT_EQ(pool.world->step(kFrame).clamped, 0U);
    }
}

TEST(StepInput, GravitySpike) {
    for (const Vec2f spike : {Vec2f{0, -1.0e6F}, Vec2f{1.0e6F, 0}, Vec2f{-1.0e6F, 1.0e6F},
                              Vec2f{0, 1.0e30F}}) {
        Pool pool;
        for (int k = 0; k < 10; ++k) {
            pool.world->step(kFrame);
        }
        ASSERT_EQ(pool.world->set_gravity(spike), Status::ok);
        for (int k = 0; k < 5; ++k) {
            const StepReport report = pool.world->step(kFrame);
            EXPECT_EQ(report.has(Clamped::gravity), k == 0);
            pool.expect_whole(report);
        }
        ASSERT_EQ(pool.world->set_gravity({0, -9.81F}), Status::ok);
        pool.expect_recovers();
    }
}

TEST(StepInput, GravityAtItsLimitIsNotClamped) {
    Pool pool;
    ASSERT_EQ(pool.world->set_gravity({-kMaxGravity, kMaxGravity}), Status::ok);
    EXPECT_FALSE(pool.world->step(0.001F).has(Clamped::gravity));
    ASSERT_EQ(pool.world->set_gravity({0, std::nextafter(kMaxGravity, 2000.0F)}), Status::ok);
    EXPECT_TRUE(pool.world->step(0.001F).has(Clamped::gravity));
}

/// A velocity that is no number, by whatever fault of the machine: the pressure may bring it to all
/// others in that step, which are put to rest, told of, and go on.
template <class Real>
void expect_mended() {
    TestWorld<Real> world(small_def());
    expect_ok(world->fill({{0, 0}, {0.12F, 0.14F}}));
    const std::int32_t count = world->particle_positions().size;
    world->step(kFrame);
    const_cast<Vec2<Real>&>(world->particle_velocities()[7]).x =
        std::numeric_limits<Real>::quiet_NaN();
    const StepReport report = world->step(kFrame);
    EXPECT_TRUE(report.has(Clamped::not_finite));
    EXPECT_GT(report.particles_reset, 0);
    EXPECT_EQ(report.particles, count);
    EXPECT_TRUE(all_inside(*world));
    const StepReport next = world->step(kFrame);
    EXPECT_FALSE(next.has(Clamped::not_finite));
    EXPECT_EQ(next.particles_reset, 0);
}

TEST(StepInput, VelocitiesThatAreNoneAreMended) {
    expect_mended<float>();
    expect_mended<double>();
}

TEST(StepInput, BeforeInit) {
    World<float> world;
    const StepReport report = world.step(kFrame);
    EXPECT_EQ(report.clamped, static_cast<std::uint32_t>(Clamped::not_initialised));
    EXPECT_EQ(report.particles, 0);
    EXPECT_EQ(report.substeps, 0);
    EXPECT_EQ(report.dt_s, 0.0F);
    EXPECT_EQ(world.state_hash(), 0U);
    EXPECT_EQ(world.particle_positions().size, 0);
    EXPECT_EQ(world.particle_velocities().size, 0);
    EXPECT_EQ(world.pressure().data, nullptr);
    EXPECT_EQ(world.signed_distance().data, nullptr);
    EXPECT_EQ(world.pressure_scale(), 0.0F);
    EXPECT_EQ(world.cell_m(), 0.0F);
    EXPECT_EQ(world.cells_x(), 0);
    EXPECT_EQ(world.cells_y(), 0);
}

TEST(StepInput, FastestLiquidAndBodies) {
    Pool pool;
    const float fastest = kMaxSpeed * pool.world->cell_m() * 0.999F;
    ASSERT_EQ(pool.world->add_particle({0.05F, 0.3F}, {fastest, fastest}), Status::ok);
    ++pool.particles;
    const StepReport report = pool.world->step(kFrame);
    EXPECT_TRUE(report.has(Clamped::speed));
    EXPECT_GT(report.particles_slowed, 0);
    pool.expect_whole(report);
    Motion motion;
    motion.position_m = {0.1F, 0.1F};
    motion.velocity_mps = {fastest, -fastest};
    motion.spin_radps = 9999.0F;
    ASSERT_EQ(pool.world->set_motion(pool.paddle, motion), Status::ok);
    for (int k = 0; k < 5; ++k) {
        pool.expect_whole(pool.world->step(kFrame));
    }
    motion.velocity_mps = {0, 0};
    ASSERT_EQ(pool.world->set_motion(pool.paddle, motion), Status::ok);
    for (int k = 0; k < 60; ++k) {
        pool.expect_whole(pool.world->step(kFrame));
    }
    motion.spin_radps = 0;
    motion.position_m = {0.22F, 0.1F};
    ASSERT_EQ(pool.world->set_motion(pool.paddle, motion), Status::ok);
    pool.expect_recovers();
}

/// A body dropped into the liquid, over and over: nothing is lost, and it comes out of the body.
TEST(StepInput, BodyDroppedIntoTheLiquid) {
    Pool pool;
    Motion motion;
    for (int k = 0; k < 60; ++k) {
        motion.position_m = {0.02F + 0.004F * static_cast<float>(k % 20), 0.05F};
        ASSERT_EQ(pool.world->set_motion(pool.paddle, motion), Status::ok);
        pool.expect_whole(pool.world->step(kFrame));
    }
    pool.expect_recovers();
}

TEST(StepInput, TicksAreOptionalAndAddUp) {
    static std::uint64_t now = 0;
    WorldDef def = small_def();
    def.ticks = [] { return ++now; };
    TestWorld<float> world(def);
    ASSERT_EQ(world->fill({{0, 0}, {0.12F, 0.14F}}), Status::ok);
    const StepReport report = world->step(kFrame);
    std::uint64_t sum = 0;
    for (const std::uint64_t ticks : report.ticks) {
        sum += ticks;
    }
    EXPECT_GT(sum, 0U);
    EXPECT_LE(sum, now);
    EXPECT_EQ(report.ticks[static_cast<int>(weir::Stage::contour)], 0U) << "no body, no contour";
    EXPECT_EQ(report.ticks[static_cast<int>(weir::Stage::collide)], 0U);
}

/// Figures of a 10 × 10 world on which the same calls are made, once changed.
std::uint64_t hash_after(int changed) {
    TestWorld<float> world(small_def());
    EXPECT_EQ(world->fill({{0, 0}, {0.1F, 0.1F}}), Status::ok);
    const float nudge = changed == 1 ? 1.0e-6F : 0.0F;
    EXPECT_EQ(world->add_particle({0.2F + nudge, 0.2F}, {0.1F, 0.0F}), Status::ok);
    EXPECT_EQ(world->add_particle({0.25F, 0.2F}, {changed == 2 ? 0.1F : 0.0F, 0.0F}), Status::ok);
    if (changed == 3) {
        EXPECT_EQ(world->remove_particle(3), Status::ok);
    }
    return world->state_hash();
}

TEST(StateHash, EqualForEqualCallsAndDifferentForOneParticle) {
    EXPECT_EQ(hash_after(0), hash_after(0));
    for (int changed = 1; changed <= 3; ++changed) {
        EXPECT_NE(hash_after(0), hash_after(changed)) << changed;
    }
}

TEST(StateHash, EqualAfterEqualStepsAndDifferentForOneBody) {
    Pool a;
    Pool b;
    for (int step = 0; step < 20; ++step) {
        a.world->step(kFrame);
        b.world->step(kFrame);
        ASSERT_EQ(a.world->state_hash(), b.world->state_hash());
    }
    Motion motion;
    ASSERT_EQ(b.world->motion(b.paddle, &motion), Status::ok);
    EXPECT_EQ(a.world->state_hash(), b.world->state_hash()) << "a question changes nothing";
    motion.spin_radps = 1.0e-3F;
    ASSERT_EQ(b.world->set_motion(b.paddle, motion), Status::ok);
    EXPECT_NE(a.world->state_hash(), b.world->state_hash());
}

}  // namespace
}  // namespace weir
