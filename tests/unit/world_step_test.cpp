// What calls and steps leave inside a world, and what a report says of it.
#include <gtest/gtest.h>

#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kFrame = 1.0F / 60.0F;

bool has(const StepReport& report, Clamped what) {
    return (report.clamped & static_cast<std::uint32_t>(what)) != 0;
}

/// What is left of `share` of the pressure when gravity changes.
float rescaled(TestWorld<float>& world, Vec2f from, Vec2f to, float share = 1.0F) {
    expect_ok(world->set_gravity(from));
    float& change = state_of(world).simulation.pressure.change;
    change = share;
    expect_ok(world->set_gravity(to));
    return change;
}

/// At most twice as much at once: what a blow built up must not act after it.
TEST(WorldStep, PressureGoesWithGravity) {
    TestWorld<float> world(small_def());
    EXPECT_NEAR(rescaled(world, {0, -10}, {0, -15}), 1.5F, 1.0e-5F);
    EXPECT_NEAR(rescaled(world, {0, -10}, {0, -2}), 0.2F, 1.0e-5F);
    EXPECT_NEAR(rescaled(world, {0, -10}, {10, 0}), 1.0F, 1.0e-5F) << "whatever the direction";
    EXPECT_NEAR(rescaled(world, {0, -10}, {0, -50}), 2.0F, 1.0e-5F);
    EXPECT_NEAR(rescaled(world, {0, -10}, {0, -50}, 10.0F), 16.0F, 1.0e-5F);
    EXPECT_EQ(rescaled(world, {0, -10}, {0, 0}), 0.0F);
    EXPECT_EQ(rescaled(world, {0, 0}, {0, -10}), 1.0F);
}

/// What elastic liquid has stored does not grow with gravity, and is not turned with it.
TEST(WorldStep, StoredPressureIsWhatGravityStillBears) {
    WorldDef def = small_def();
    def.pressure = Pressure::equation_of_state;
    TestWorld<float> world(def);
    EXPECT_NEAR(rescaled(world, {0, -10}, {0, -5}), 0.5F, 1.0e-5F);
    EXPECT_NEAR(rescaled(world, {0, -10}, {0, -15}), 1.0F, 1.0e-5F);
    EXPECT_NEAR(rescaled(world, {0, -10}, {6, -8}), 0.8F, 1.0e-5F);
    EXPECT_EQ(rescaled(world, {0, -10}, {0, 10}), 0.0F);
    EXPECT_EQ(rescaled(world, {0, 0}, {0, -10}), 1.0F);
}

/// Gravity trembles about that of who sleeps. All of its particles are told to.
TEST(WorldStep, AsleepNothingIsRescaled) {
    WorldDef def = small_def();
    def.sleep = {0.05F, 0.2F, 0.5F};
    TestWorld<float> world(def);
    expect_ok(world->fill({{0, 0}, {0.32F, 0.06F}}));
    StepReport report;
    for (int step = 0; step < 2000 && !report.asleep; ++step) {
        report = world->step(kFrame);
    }
    ASSERT_TRUE(report.asleep);
    EXPECT_EQ(report.particles_asleep, report.particles);
    EXPECT_GT(report.particles, 0);
    state_of(world).simulation.pressure.change = 1.0F;
    expect_ok(world->set_gravity({0.0F, -9.6F}));
    report = world->step(kFrame);
    EXPECT_TRUE(report.asleep);
    EXPECT_NEAR(report.dt_s, kFrame, 1.0e-6F);
    EXPECT_EQ(report.substeps, 0);
    EXPECT_EQ(state_of(world).simulation.pressure.change, 1.0F);
}

/// Whatever a caller's report was filled with.
TEST(WorldStep, BeginsItsReportAnew) {
    WorldDef def = small_def();
    TestWorld<float> world(def);
    StepReport report;
    report.clamped = 0xFFFFFFFFU;
    report.particles_slowed = report.bodies_slowed = report.particles_reset = 7;
    report.particles_stuck = report.nodes_rasterized = 7;
    report.asleep = report.walls_held = true;
    expect_ok(world->begin_step(kFrame, &report));
    while (!world->advance(100)) {
    }
    EXPECT_EQ(report.clamped, 0U);
    EXPECT_EQ(report.particles_slowed + report.bodies_slowed + report.particles_reset, 0);
    EXPECT_EQ(report.particles_stuck + report.nodes_rasterized, 0);
    EXPECT_FALSE(report.asleep || report.walls_held);
}

/// Packed particles that have met are looked for as long as something stirs them: gravity that
/// changes along either axis, or a wall that drags.
TEST(WorldStep, PackedParticlesAreLookedForWhenStirred) {
    WorldDef def = small_def();
    def.sleep = {0.05F, 0.2F, 0.5F};
    TestWorld<SmallFixed> world(def);
    expect_ok(world->set_gravity({1.0F, -9.0F}));
    std::uint32_t& left = state_of(world).simulation.look.substeps_left;
    for (const Vec2f gravity : {Vec2f{1.3F, -9.0F}, Vec2f{1.3F, -8.7F}}) {  // nobody would wake
        left = 0;
        expect_ok(world->set_gravity(gravity));
        EXPECT_GT(left, 0U);
        left = 0;
        expect_ok(world->set_gravity(gravity));
        EXPECT_EQ(left, 0U);
    }
    def.viscosity_m2ps = 2.0e-3F;
    def.walls.bottom = {0.0F, 0.0F, true, 0.1F};
    TestWorld<SmallFixed> dragging(def);
    StepReport report;
    state_of(dragging).simulation.look.substeps_left = 0;
    expect_ok(dragging->begin_step(kFrame, &report));
    EXPECT_GT(state_of(dragging).simulation.look.substeps_left, 0U);
}

/// A step that `restore` has broken off is not gone on with; in the next one densities are new.
TEST(WorldStep, LeavesNothingOfAStepThatWasBrokenOff) {
    const WorldDef def = small_def();
    TestWorld<float> world(def);
    expect_ok(world->fill({{0.1F, 0.1F}, {0.2F, 0.2F}}));
    world->step(kFrame);
    const std::vector<std::byte> bytes = saved(*world, def.capacity);
    StepReport report;
    expect_ok(world->begin_step(8.0F * kFrame, &report));
    EXPECT_FALSE(world->advance(1));
    expect_ok(world->restore(bytes.data(), bytes.size()));
    const std::uint64_t hash = world->state_hash();
    EXPECT_EQ(world->step(0.0F).substeps, 0);
    EXPECT_EQ(world->state_hash(), hash);
    EXPECT_TRUE(state_of(world).density_stale);
    world->step(kFrame);
    EXPECT_FALSE(state_of(world).density_stale);
}

TEST(WorldStep, SaysWhatItsSubstepsDoNotBear) {
    WorldDef def = small_def();
    def.max_substeps = 1;
    def.viscosity_m2ps = 0.1F;
    EXPECT_TRUE(has(TestWorld<float>(def)->step(kFrame), Clamped::viscosity));
    def.viscosity_m2ps = 1.0e-4F;
    EXPECT_FALSE(has(TestWorld<float>(def)->step(kFrame), Clamped::viscosity));
    def.viscosity_m2ps = 0.0F;
    def.surface_tension_m3ps2 = 0.1F;
    EXPECT_TRUE(has(TestWorld<float>(def)->step(kFrame), Clamped::surface_tension));
    def.surface_tension_m3ps2 = 1.0e-4F;
    EXPECT_FALSE(has(TestWorld<float>(def)->step(kFrame), Clamped::surface_tension));
}

TEST(WorldStep, SaysThatABodyWasTooFast) {
    WorldDef def = small_def();
    def.capacity.two_way = true;
    TestWorld<float> world(def);
    const BodyId id = put_free(*world, body_of(kSquare4cm, {0.16F, 0.2F}));
    EXPECT_FALSE(has(world->step(kFrame), Clamped::body_speed));
    state_of(world).simulation.bodies.load[id.slot].blows.linear = {1.0e6F, 0.0F};
    const StepReport report = world->step(kFrame);
    EXPECT_GT(report.bodies_slowed, 0);
    EXPECT_TRUE(has(report, Clamped::body_speed));
}

}  // namespace
}  // namespace weir
