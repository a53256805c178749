// How many substeps a step is cut into, and what they can bear.
#include <gtest/gtest.h>

#include "pressure/projection.hpp"
#include "step/time_step_limit.hpp"
#include "step/two_way.hpp"

namespace weir {
namespace {

/// Liquid at 50 cells/s, in which sound goes 100.
Simulation<float> loud() {
    Simulation<float> simulation;
    simulation.settings.sound_speed = 100.0F;
    simulation.pressure.elasticity = &detail::elasticity<float>();
    simulation.max_speed = 50.0F;
    return simulation;
}

TEST(StepPlan, LiquidCarriesSoundAlong) {
    EXPECT_EQ(plan_substeps(loud(), 0.02F).substeps, 8) << "3 cells, 0.4 each";
}

/// Sound that four substeps are too few for goes 0.4 cells in each; what is faster piles up.
TEST(StepPlan, SoundGivesWayToWhatIsFaster) {
    Simulation<float> simulation = loud();
    simulation.settings.max_substeps = 4;
    EXPECT_FLOAT_EQ(plan_substeps(simulation, 0.02F).sound_speed, 80.0F);
    simulation.max_speed = 160.0F;
    EXPECT_FLOAT_EQ(plan_substeps(simulation, 0.02F).sound_speed, 40.0F);
    simulation.max_speed = 60.0F;
    simulation.settings.gravity = {0.0F, -5000.0F};
    EXPECT_FLOAT_EQ(plan_substeps(simulation, 0.02F).sound_speed, 40.0F) << "at the step's end";
}

/// What liquid at rest loses where it settles would be missing where forces are counted.
TEST(StepPlan, NothingSettlesWhereForcesAreCounted) {
    const detail::TwoWay<Fixed> two_way{};
    Simulation<Fixed> simulation;
    simulation.settings.gravity = {Fixed(0.0F), Fixed(-500.0F)};
    simulation.pressure.last_dt = Seconds<Fixed>(0.01F);
    EXPECT_TRUE(plan_substeps(simulation, Seconds<Fixed>(0.01F)).settling);
    simulation.two_way = &two_way;
    EXPECT_FALSE(plan_substeps(simulation, Seconds<Fixed>(0.01F)).settling);
}

TEST(StepPlan, SubstepsFollowTheFastestBody) {
    Simulation<float> simulation;
    Body<float> body;
    body.kind = BodyKind::moving;
    body.velocity = {300.0F, 0.0F};
    simulation.bodies.body = &body;
    simulation.bodies.capacity = 1;
    simulation.bodies.movable = {0, 1};
    simulation.settings.cfl = 1.0F;
    simulation.settings.max_substeps = 16;
    const std::int32_t substeps = plan_substeps(simulation, 0.02F).substeps;
    EXPECT_GE(substeps, 6) << "6 cells";
    EXPECT_LE(substeps, 7);
}

/// Four substeps of 5 ms bear ν dt = ¼ cell² and σ/ρ dt² = 1/2π cells³, ρ the lighter liquid's.
TEST(StepPlan, ViscosityAndTensionAreWhatTheSubstepsBear) {
    const detail::SecondLiquid<float> second{};
    Simulation<float> simulation;
    simulation.settings.max_substeps = 4;
    simulation.settings.viscosity = 1000.0F;
    EXPECT_FLOAT_EQ(plan_substeps(simulation, 0.02F).viscosity, 50.0F);
    simulation.settings.surface_tension = 1.0e6F;
    const float most = plan_substeps(simulation, 0.02F).surface_tension;
    EXPECT_NEAR(most, 0.15915F / (0.005F * 0.005F), 1.0F);
    simulation.settings.second_density = 0.25F;
    simulation.pressure.second_liquid = &second;
    EXPECT_FLOAT_EQ(plan_substeps(simulation, 0.02F).surface_tension, 0.25F * most);
}

}  // namespace
}  // namespace weir
