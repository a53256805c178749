// What counts as rest before a world sleeps, and what does not.
#include <gtest/gtest.h>

#include <limits>

#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;

/// It goes a cell a substep, with no velocity of its own.
TEST(Rest, NotWhileAnybodyIsOnTheWayOutOfASolid) {
    WorldDef def = tank_def(48, 48, 4, 1, 4);
    def.gravity_mps2 = {};
    def.sleep = {0.02F, 0.1F, 0.0F};
    TestWorld<float> world(def);
    expect_ok(world->add_particle({0.48F, 0.5F}, {}));
    put_static(*world, body_of(rectangle(0.6F, 0.6F), {0.48F, 0.48F}));
    std::int32_t steps = 0;
    for (StepReport report = world->step(kDt); report.particles_stuck > 0 && steps < 40; ++steps) {
        EXPECT_FALSE(report.asleep);
        report = world->step(kDt);
    }
    EXPECT_GT(steps, 8) << "longer than it takes to fall asleep";
    EXPECT_LT(steps, 40);
}

/// Nor while numbers are mended, each of which stops a particle.
TEST(Rest, NotWhileNumbersAreMended) {
    WorldDef def = small_def();
    def.gravity_mps2 = {};
    def.sleep = {0.02F, 0.1F, 0.0F};
    TestWorld<float> world(def);
    expect_ok(world->add_particle({0.1F, 0.1F}, {}));
    for (int step = 0; step < 30; ++step) {
        const_cast<Vec2<float>&>(world->particle_velocities()[0]).x =
            std::numeric_limits<float>::quiet_NaN();
        const StepReport report = world->step(kDt);
        ASSERT_EQ(report.particles_reset, 1) << step;
        ASSERT_FALSE(report.asleep);
    }
    for (int step = 0; step < 7; ++step) {
        world->step(kDt);
    }
    EXPECT_TRUE(world->step(kDt).asleep);
}

WEIR_SUITE(RestOf, EveryScalar);

template <class Real>
std::int32_t steps_awake(World<Real>& world) {
    std::int32_t steps = 1;
    while (!world.step(kDt).asleep && steps < 600) {
        ++steps;
    }
    return steps;
}

/// Nor in a step that took somebody out of the world, who had no way out of a solid.
TEST(Rest, NotWhileAnybodyIsRemoved) {
    const auto steps = [](bool within) {
        WorldDef def = tank_def(100, 100, 4, 1, 4);
        def.gravity_mps2 = {};
        def.sleep = {0.02F, 0.1F, 0.0F};
        TestWorld<float> world(def);
        expect_ok(world->add_particle({1.0F, within ? 1.0F : 1.95F}, {}));
        expect_ok(world->add_particle({0.9F, 1.95F}, {}));
        put_static(*world, body_of(rectangle(1.8F, 1.8F), {1.0F, 1.0F}));
        const std::int32_t awake = steps_awake(*world);
        EXPECT_EQ(world->particle_positions().size, within ? 1 : 2);
        return awake;
    };
    EXPECT_EQ(steps(true), steps(false) + 1);
}

/// Liquid with an equation of state is a little too dense wherever it is pressed at all.
TEST(Rest, ElasticLiquidBearsItself) {
    WorldDef def = tank_def(16, 20, 1300);
    def.pressure = Pressure::equation_of_state;
    def.sleep = {0.05F, 0.5F, 0.0F};
    TestWorld<float> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.32F, 0.3F}}));
    EXPECT_LT(steps_awake(*world), 200);
}

/// A solid that holds whole patches of cells presses nothing together: beside it liquid falls
/// asleep as soon as it has been at rest for long enough.
TYPED_TEST(RestOf, LargeSolidsAreNoPressedLiquid) {
    WorldDef def = tank_def(48, 16, 1200, 1, 4);
    def.gravity_mps2 = {};
    def.sleep = {0.02F, 0.2F, 0.0F};
    TestWorld<TypeParam> world(def);
    const Ring block = rectangle(0.4F, 0.32F);
    put_static(*world, body_of(block, {0.48F, 0.16F}));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.2F, 0.1F}}));
    expect_ok(world->fill({{0.76F, 0.0F}, {0.96F, 0.1F}}));
    EXPECT_LT(steps_awake(*world), 20);
}

/// What is pressed together comes apart with no velocity of its own: meanwhile its time at rest
/// counts by a share.
TYPED_TEST(RestOf, WhatIsPressedTogetherFallsAsleepLater) {
    const auto steps = [](float volume_gain) {
        WorldDef def = tank_def(32, 32, 4000);
        def.gravity_mps2 = {};
        def.volume_gain = volume_gain;
        def.sleep = {0.05F, 0.2F, 0.0F};
        TestWorld<TypeParam> world(def);
        for (int k = 0; k < 3; ++k) {
            expect_ok(world->fill({{0.16F, 0.16F}, {0.48F, 0.48F}}));
        }
        return steps_awake(*world);
    };
    EXPECT_LT(steps(0.0F), 15);
    EXPECT_GT(steps(WorldDef{}.volume_gain), 30);
}

/// Where nothing is done about volume nobody waits for it, whatever a deep tank's pressure left
/// where excess would be.
TYPED_TEST(RestOf, WithoutVolumeGainNothingIsPressed) {
    WorldDef def = tank_def(16, 96, 6000);
    def.volume_gain = 0.0F;
    def.sleep = {0.05F, 0.5F, 0.0F};
    TestWorld<TypeParam> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.32F, 1.6F}}));
    EXPECT_LT(steps_awake(*world), 60);
}

/// A pause tells nothing of who rests: a world that was just restored has not drawn its solids, and
/// took what lay on them for what falls.
TYPED_TEST(RestOf, APauseIsTheSameAfterARestore) {
    WorldDef def = small_def();
    def.sleep.speed_mps = 0.02F;
    TestWorld<TypeParam> world{def};
    TestWorld<TypeParam> other{def};
    put_static(*world, body_of(rectangle(0.2F, 0.1F), {0.16F, 0.05F}));
    expect_ok(world->add_particle({0.151F, 0.101F}, {}));
    for (int step = 0; step < 30; ++step) {
        world->step(1.0F / 60.0F);
        const std::vector<std::byte> bytes = saved(*world, def.capacity);
        expect_ok(other->restore(bytes.data(), bytes.size()));
        world->step(0.0F);
        other->step(0.0F);
        ASSERT_EQ(other->state_hash(), world->state_hash()) << "step " << step;
    }
}

}  // namespace
}  // namespace weir
