// What gravity gives in a substep where velocities are known in units: what is owed is given in time,
// and nobody is owed a fall the other way; viscous liquid in Fixed gets parts of units in turn.
#include "step/fall.hpp"

#include <gtest/gtest.h>

#include "step/settings.hpp"
#include "test_world.hpp"
#include "weir/storage.hpp"

namespace weir {
namespace {

/// Velocities of a packed world: 128 units a cell and second.
constexpr double kUnit = 1.0 / 128.0;
constexpr SmallFixed kMost = SmallFixed(1.0);

double given(Fall<SmallFixed>& fall, double exact) {
    const Vec2<SmallFixed> one{SmallFixed(0.0), SmallFixed(exact)};
    const auto y = static_cast<double>(fall.of(one, kMost).y);
    fall.give(one, kMost);
    return y;
}

TEST(Fall, IsGivenInWholeUnitsAndInTime) {
    Fall<SmallFixed> fall;
    double sum = 0.0;
    for (int k = 1; k <= 1000; ++k) {
        const double one = given(fall, -0.3 * kUnit);
        EXPECT_TRUE(one == 0.0 || one == -kUnit) << one;
        sum += one;
        EXPECT_NEAR(sum, -0.3 * kUnit * k, 1.01 * kUnit + 2e-5 * k);
    }
}

TEST(Fall, OwesNobodyAFallTheOtherWay) {
    Fall<SmallFixed> fall;
    EXPECT_EQ(given(fall, -0.75 * kUnit), 0.0);
    Fall<SmallFixed> fresh;
    for (int k = 0; k < 8; ++k) {
        EXPECT_EQ(given(fall, 0.5 * kUnit), given(fresh, 0.5 * kUnit)) << k;
    }
}

TEST(Fall, OfMuchIsAlwaysTheSame) {
    Fall<SmallFixed> fall;
    given(fall, -0.75 * kUnit);
    const double first = given(fall, -1.3);
    EXPECT_NEAR(first, -1.3, 0.5 * kUnit);
    given(fall, -0.75 * kUnit);
    EXPECT_EQ(given(fall, -1.3), first);
}

TEST(Fall, InFourTurnsIsExactToAnEighthOfAUnit) {
    constexpr double kRaw = 65536.0;
    const Seconds<Fixed> dt(0.004F);
    for (const double gravity : {9.8, 10.03, 10.17, 33.335, 499.99}) {
        const Vec2<Fixed> pull{Fixed(gravity), Fixed(-gravity)};
        const double exact = static_cast<double>(dt) * static_cast<double>(pull.x) * kRaw;
        double sum = 0.0;
        for (std::uint32_t turn = 0; turn < 4; ++turn) {
            const Vec2<Fixed> fall = fall_in_turn<Fixed>(dt, pull, turn);
            EXPECT_EQ(fall.x.raw, -fall.y.raw);
            EXPECT_LT(std::fabs(fall.x.raw - exact), 1.0);
            EXPECT_EQ(fall_in_turn<Fixed>(dt, pull, turn + 4).x.raw, fall.x.raw);
            sum += fall.x.raw;
        }
        EXPECT_LE(std::fabs(sum / 4 - exact), 0.125) << gravity;
        Settings<Fixed> settings{};
        settings.gravity = pull;
        EXPECT_LE(std::fabs(settings.fall_in(dt).x.raw - exact), 0.5) << gravity;
    }
}

/// A unit is 2^-16 cells/s: rounded to the nearest they would be a fifth of one too slow in each step.
TEST(Fall, OfViscousLiquidTakesTurnsAlsoBesideThinWalls) {
    constexpr int kSteps = 40;
    for (const bool thin : {false, true}) {
        WorldDef def = tank_def(32, 32, 1000, 2, 8);
        def.viscosity_m2ps = 1e-4F;
        def.capacity.wall_edges = 100;
        TestWorld<Fixed> world(def);
        const Ring ring = {{0.1F, 0.02F}, {0.2F, 0.03F}};
        BodyDef line = body_of(ring, {0, 0});
        line.open = true;
        if (thin) {
            put_static(*world, line);
        }
        expect_ok(world->fill({{0.2F, 0.4F}, {0.36F, 0.56F}}));
        for (int step = 0; step < kSteps; ++step) {
            ASSERT_EQ(world->step(1.0F / 240.0F).substeps, 1);
        }
        double sum = 0.0;
        const auto velocities = world->particle_velocities();
        for (std::int32_t k = 0; k < velocities.size; ++k) {
            sum += velocities[k].y.raw;
        }
        const double exact = -9.81 / 0.02 * 65536.0 * kSteps / 240.0;
        EXPECT_NEAR(sum / velocities.size, exact, 2.0) << thin;
    }
}

}  // namespace
}  // namespace weir
