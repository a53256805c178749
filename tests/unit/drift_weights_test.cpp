// What a patch pays for its drift in fixed point: small numbers that decide what waves lose.
#include <gtest/gtest.h>

#include "pressure/patch_drift.hpp"

namespace weir {
namespace {

TEST(DriftWeights, ASlowDriftDoesTheWorkOfASlowDrift) {
    const Fixed pressure(-1.75);
    const std::int64_t sixteenfold = summand(Fixed::of_raw(112), pressure);
    const std::int64_t up = summand(Fixed::of_raw(7), pressure);
    const std::int64_t down = summand(Fixed::of_raw(-7), pressure);
    EXPECT_NE(sixteenfold, 0);
    EXPECT_NEAR(static_cast<double>(16 * up), static_cast<double>(sixteenfold), 16.0);
    EXPECT_NEAR(static_cast<double>(up + down), 0.0, 1.0);
}

TEST(DriftWeights, APriceHasItsDigits) {
    Weights<Fixed> weights;
    weights.moving[0] = Fixed(16);
    weights.disorder[0] = kStirred<Fixed>;
    for (const double work : {-0.0005, 0.0005}) {
        weights.raised[0] = Fixed(work);
        const double given = static_cast<double>(weights.raised[0]);
        EXPECT_NEAR(static_cast<double>(price_of(weights, Fixed(152))), given / 16.0, 2.0e-7);
    }
}

/// 0.0125 of excess in each of 16 cells: a quarter of what counts as stirred, in full digits.
TEST(DriftWeights, DisorderHasItsDigits) {
    const Fixed excess(0.0125);
    Weights<std::int64_t> sums;
    for (std::int64_t& column : sums.disorder) {
        column = 4 * summand(excess, excess);
    }
    const double told = static_cast<double>(in_turn(weights_of<Fixed>(sums).disorder));
    const double given = static_cast<double>(excess);
    EXPECT_NEAR(told / kOfDisorder<Fixed>, 16.0 * given * given, 1.0e-6);
}

/// A torn patch that is not pressed makes as much of its drift as it can pay for; in order, or let
/// down, or pressed, all of it.
TEST(DriftWeights, WhatIsTornIsDrawnUpAsFarAsItPays) {
    Weights<float> weights;
    weights.moving[0] = 32.0F;
    weights.raised[0] = 3.0F;
    weights.disorder[0] = kTorn<float> + kStirred<float>;
    EXPECT_FLOAT_EQ(share_of_drift(weights, false), 0.25F);
    EXPECT_EQ(share_of_drift(weights, true), 1.0F);
    weights.disorder[0] = kTorn<float> + 0.5F * kStirred<float>;
    EXPECT_FLOAT_EQ(share_of_drift(weights, false), 0.4F);
    weights.disorder[0] = kTorn<float>;
    EXPECT_EQ(share_of_drift(weights, false), 1.0F);
    weights.disorder[0] = 1.0F;
    weights.raised[0] = -3.0F;
    EXPECT_EQ(share_of_drift(weights, false), 1.0F);
}

/// Of a current along a floor a patch pays nothing, whatever gravity's unit is.
TEST(DriftWeights, OnlyWhatRisesOrFallsPays) {
    for (const double fall : {-9.81, 0.01, 5.0e-4}) {
        const Vec2<Fixed> upright = share_of_falling(Vec2<Fixed>{Fixed(0), Fixed(fall)});
        EXPECT_EQ(upright.x, Fixed(0)) << fall;
        EXPECT_EQ(upright.y, Fixed(1)) << fall;
    }
    const Vec2<float> leaning = share_of_falling(Vec2<float>{-3.0F, 4.0F});
    EXPECT_NEAR(leaning.x, 0.36F, 1.0e-6F);
    EXPECT_NEAR(leaning.y, 0.64F, 1.0e-6F);
    const Vec2<float> nowhere = share_of_falling(Vec2<float>{});
    EXPECT_EQ(nowhere.x + nowhere.y, 0.0F);
}

}  // namespace
}  // namespace weir
