// What gravity gives in a substep where velocities are known in units: what is owed is given in time,
// and nobody is owed a fall the other way.
#include "step/fall.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace weir
