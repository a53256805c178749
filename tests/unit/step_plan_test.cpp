// How many substeps a step is cut into, and what they can bear.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace weir
