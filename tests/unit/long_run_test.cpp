// What a device that is worn for hours must not do: liquid that leans comes to rest, and particles
// stay apart.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr std::int32_t kSide = 16;

WorldDef half_full(float cell_m) {
    WorldDef def = small_def();
    def.capacity.cells_x = def.capacity.cells_y = kSide;
    def.capacity.particles = 2 * kSide * kSide;
    def.cell_m = cell_m;
    return def;
}

/// Gravity that leans to the right by so much.
Vec2f leaning(double tilt) {
    return {static_cast<float>(9.81 * std::sin(tilt)), static_cast<float>(-9.81 * std::cos(tilt))};
}

/// Mean way a particle goes in a second, over what √(gh) would take it, after 2,000 steps.
double restless(double tilt) {
    const WorldDef def = half_full(0.005F);
    TestWorld<SmallFixed> world(def);
    const float side = def.cell_m * kSide;
    expect_ok(world->fill({{0.0F, 0.0F}, {side, side / 2}}));
    expect_ok(world->set_gravity(leaning(tilt)));
    for (int step = 0; step < 2000; ++step) {
        world->step(1.0F / 60.0F);
    }
    double sum = 0.0;
    for (int step = 0; step < 50; ++step) {
        world->step(1.0F / 60.0F);
        for (const auto& v : world->particle_velocities()) {
            sum += std::hypot(static_cast<double>(v.x), static_cast<double>(v.y));
        }
    }
    const double cells = sum / (50 * world->particle_velocities().size);
    const double cell_m = static_cast<double>(def.cell_m);
    return cells / std::sqrt(9.81 * kSide / 2 / cell_m);
}

/// It was 4 % as long as packed worlds neither quieted leaning surfaces nor paid for their drift.
TEST(LongRun, PackedLiquidThatLeansComesToRest) {
    double mean = 0.0;
    for (const double tilt : {0.26, 0.61, 0.96, 1.31}) {
        mean += 0.25 * restless(tilt);
    }
    EXPECT_LT(mean, 0.01);
}

template <class Real>
class LongRunOf : public testing::Test {};
using Scalars = testing::Types<float, double, Fixed, SmallFixed>;
TYPED_TEST_SUITE(LongRunOf, Scalars, );

/// Those at one place are carried alike from then on.
TYPED_TEST(LongRunOf, ParticlesStayApartWhileATankIsTurned) {
    using Real = TypeParam;
    const WorldDef def = half_full(0.02F);
    TestWorld<Real> world(def);
    const float side = def.cell_m * kSide;
    expect_ok(world->fill({{0.0F, 0.0F}, {side, side / 2}}));
    std::mt19937 random(5);
    for (int turn = 0; turn < 100; ++turn) {
        expect_ok(world->set_gravity(leaning(6.28e-3 * static_cast<double>(random() % 1000U))));
        for (int step = 0; step < 60; ++step) {
            world->step(1.0F / 64.0F);
        }
    }
    std::set<std::pair<double, double>> places;
    for (const auto& x : world->particle_positions()) {
        places.insert({static_cast<double>(x.x), static_cast<double>(x.y)});
    }
    EXPECT_GE(static_cast<std::int32_t>(places.size()), def.capacity.particles - 2);
}

}  // namespace
}  // namespace weir
