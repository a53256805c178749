// Liquid that all goes round a periodic tank goes on for ever.
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

template <class Real>
double mean_speed(const World<Real>& world, bool along_y) {
    double sum = 0.0;
    const auto velocities = world.particle_velocities();
    for (const auto& velocity : velocities) {
        sum += static_cast<double>(static_cast<float>(along_y ? velocity.y : velocity.x));
    }
    return sum / static_cast<double>(velocities.size) *
           static_cast<double>(world.velocity_scale());
}

/// What is left of a current of 5 cells/s after 75 s, in 32 × 10 cells of water. Part of it begins
/// at half its speed, as what fell in would leave it.
template <class Real>
double current_left(bool along_y) {
    const auto turned = [&](float along, float up) {
        return along_y ? Vec2f{up, along} : Vec2f{along, up};
    };
    WorldDef def = along_y ? tank_def(20, 32, 1280) : tank_def(32, 20, 1280);
    def.periodic_x = !along_y;
    def.periodic_y = along_y;
    def.gravity_mps2 = turned(0.0F, -9.81F);
    TestWorld<Real> world{def};
    const Box all{{0.0F, 0.0F}, turned(0.64F, 0.2F)};
    expect_ok(world->fill(all));
    expect_ok(world->stir(all, turned(0.1F, 0.0F), 1.0F));
    expect_ok(world->stir({turned(0.4F, 0.05F), turned(0.5F, 0.15F)}, {}, 0.5F));
    const double before = mean_speed(*world, along_y);
    for (int step = 0; step < 4500; ++step) {
        world->step(1.0F / 60.0F);
    }
    return mean_speed(*world, along_y) / before;
}

WEIR_SUITE(Current, EveryScalar);

/// What the drift lifts was paid out of the current, which came to a stop.
TYPED_TEST(Current, GoesOn) {
    EXPECT_NEAR(current_left<TypeParam>(false), 1.0, 0.1);
}

TEST(CurrentUpwards, GoesOnAlongTheOtherAxis) {
    EXPECT_NEAR(current_left<float>(true), 1.0, 0.1);
}

}  // namespace
}  // namespace weir
