// What packed stages compute in fewer instructions is what the general arithmetic computes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "contour/marching_squares.hpp"
#include "math/quotient_packed.hpp"
#include "pressure/build_packed.hpp"
#include "pressure/projection.hpp"
#include "step/extrapolate_packed.hpp"

namespace weir {
namespace {

constexpr int kCases = 200000;

class Numbers {
public:
    /// Of all sizes up to so many bits.
    std::uint32_t size(unsigned bits) {
        return static_cast<std::uint32_t>(random_()) & ((1U << (random_() % bits + 1U)) - 1U);
    }
    std::int32_t either(unsigned bits) {
        const auto value = static_cast<std::int32_t>(size(bits));
        return random_() % 2U == 0 ? value : -value;
    }

private:
    std::mt19937 random_{7};
};

TEST(PackedArithmetic, ShortQuotientsAreQuotients) {
    Numbers any;
    for (int k = 0; k < kCases; ++k) {
        const std::uint32_t divisor = any.size(16) | 1U;
        const std::uint32_t size = any.size(31) % (divisor << 15U);
        ASSERT_EQ(short_quotient(size, divisor), size / divisor) << size << " / " << divisor;
        ASSERT_EQ(quotient_of(size, divisor), size / divisor);
    }
}

TEST(PackedArithmetic, SmallQuotientsAreQuotients) {
    for (std::uint32_t divisor = 1; divisor <= 128; ++divisor) {
        for (std::uint32_t size = 0; size <= 1U << 15U; ++size) {
            ASSERT_EQ(small_quotient(size, divisor), size / divisor) << size << " / " << divisor;
            ASSERT_EQ(small_quotient_of(size, divisor), size / divisor);
        }
    }
}

TEST(PackedArithmetic, PressuresAreRescaledAsMultiplied) {
    Numbers any;
    for (int k = 0; k < kCases; ++k) {
        const SmallFixed last = SmallFixed::of_raw(any.either(29));
        const SmallFixed share = SmallFixed::of_raw(static_cast<std::int32_t>(any.size(17)));
        const std::int64_t half = last.raw < 0 ? -0x8000 : 0x8000;
        const auto wanted = (std::int64_t{last.raw} * share.raw + half) / 0x10000;
        const SmallFixed most = SmallFixed::of_raw(static_cast<std::int32_t>(
            std::min<std::int64_t>(std::max<std::int64_t>(wanted, kLeastRaw), kMostRaw)));
        ASSERT_EQ(rescaled(last, share).raw, share.raw == 1 << 16 ? last.raw : bounded(most).raw)
            << last.raw << " x " << share.raw;
    }
}

TEST(PackedArithmetic, WhatADiagonalTakesIsWhatItMultiplies) {
    Numbers any;
    for (int k = 0; k < kCases; ++k) {
        const std::int32_t from = any.either(31);
        const std::int32_t pressure = any.either(29);
        const auto diagonal = static_cast<std::int32_t>(any.size(14)) + 1;
        const std::int32_t wanted = fixed::subtract(from, times_diagonal(diagonal, pressure));
        // Sums of four pressures are that small.
        if (from > -(1 << 30) && from < 1 << 30) {
            ASSERT_EQ(less_diagonal(from, diagonal, pressure), wanted) << diagonal;
        }
        const std::int32_t open = diagonal & 127;
        ASSERT_EQ(through(open, pressure), scaled(open, pressure)) << open << " of " << pressure;
        ASSERT_EQ(through(128, pressure), pressure);
    }
}

TEST(PackedArithmetic, MeansOfOneToFourAreRoundedAwayFromZero) {
    for (std::int32_t sum = -60; sum <= 60; ++sum) {
        for (std::int32_t count = 1; count <= 4; ++count) {
            ASSERT_EQ(packed::mean_of(sum, count),
                      static_cast<std::int32_t>(std::lround(static_cast<double>(sum) / count)))
                << sum << " / " << count;
        }
    }
}

TEST(PackedArithmetic, ContourNormalsAreThoseOfDoubleWithin2To13) {
    Numbers any;
    for (int k = 0; k < kCases / 10; ++k) {
        SmallFixed corner[4];
        double wide[4];
        for (int node = 0; node < 4; ++node) {
            corner[node] = SmallFixed::of_raw(256 * any.either(8));
            wide[node] = static_cast<double>(corner[node]);
        }
        const int solid = (wide[0] <= 0) + (wide[1] <= 0) + (wide[2] <= 0) + (wide[3] <= 0);
        if (solid != 1 && solid != 3) {
            continue;  // other lines go through crossings, which are rounded first
        }
        const auto found = contour_hit(corner, Vec2<SmallFixed>{SmallFixed(0.5), SmallFixed(0.5)});
        const auto wanted = contour_hit(wide, Vec2<double>{0.5, 0.5});
        ASSERT_NEAR(static_cast<double>(found.normal.x), wanted.normal.x, 1.0 / 8192.0);
        ASSERT_NEAR(static_cast<double>(found.normal.y), wanted.normal.y, 1.0 / 8192.0);
    }
}

}  // namespace
}  // namespace weir
