// The fixed-point scalar against exact integers.
#include "math/fixed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/rotation.hpp"
#include "math/scalar.hpp"

namespace weir {

namespace {

__extension__ using Wide = __int128;

/// a / b to the nearest, ties away from zero, within 32 bits.
std::int32_t rounded(Wide a, Wide b) {
    const bool negative = (a < 0) != (b < 0);
    const Wide size = a < 0 ? -a : a;
    const Wide by = b < 0 ? -b : b;
    Wide result = (2 * size + by) / (2 * by);
    result = negative ? -result : result;
    return result > kMostRaw ? kMostRaw
                             : (result < kLeastRaw ? kLeastRaw : static_cast<std::int32_t>(result));
}

/// Numbers of every size, the ends among them.
std::int32_t any(std::mt19937& random) {
    static constexpr std::int32_t kEnds[] = {0, 1, -1, kMostRaw, kLeastRaw, 65536, -65536, 32768};
    const auto bits = static_cast<std::uint32_t>(random());
    return bits % 16 == 0 ? kEnds[(bits >> 8) % 8]
                          : static_cast<std::int32_t>(random()) >> ((bits >> 8) % 31);
}

TEST(FixedPoint, ProductsSumsAndQuotientsAreTheNearest) {
    std::mt19937 random(7);
    for (int k = 0; k < 1'000'000; ++k) {
        const Fixed a = Fixed::of_raw(any(random));
        const Fixed b = Fixed::of_raw(any(random));
        const auto wide_a = static_cast<Wide>(a.raw);
        const auto wide_b = static_cast<Wide>(b.raw);
        ASSERT_EQ((a * b).raw, rounded(wide_a * wide_b, 65536)) << a.raw << " " << b.raw;
        ASSERT_EQ((a + b).raw, rounded(wide_a + wide_b, 1)) << a.raw << " " << b.raw;
        ASSERT_EQ((a - b).raw, rounded(wide_a - wide_b, 1)) << a.raw << " " << b.raw;
        if (b.raw != 0) {
            const std::int32_t exact = rounded(wide_a * 65536, wide_b);
            const std::int32_t least = -kMostRaw;  // quotients saturate alike on both sides
            ASSERT_EQ((a / b).raw, exact < least ? least : exact) << a.raw << " / " << b.raw;
        }
    }
}

TEST(FixedPoint, MirroredNumbersGiveMirroredResults) {
    std::mt19937 random(8);
    for (int k = 0; k < 100'000; ++k) {
        const Fixed a = Fixed::of_raw(any(random) | 1);
        const Fixed b = Fixed::of_raw(any(random) | 1);
        if ((a * b).raw != kMostRaw && (a * b).raw != kLeastRaw) {
            ASSERT_EQ(((-a) * b).raw, -(a * b).raw);
        }
        ASSERT_EQ(((-a) / b).raw, -(a / b).raw);
    }
}

TEST(FixedPoint, RatiosOfSmallNumbersAreTheNearest) {
    for (std::int32_t whole = 1; whole <= 16; ++whole) {
        for (std::int32_t part = 0; part <= whole; ++part) {
            ASSERT_EQ(ratio_of<SmallFixed>(part, whole).raw, ratio_of<Fixed>(part, whole).raw)
                << part << ' ' << whole;
        }
    }
}

/// 25 digits whatever the size, and the way back.
TEST(FixedPoint, InversesKeepTheirDigits) {
    std::mt19937 random(11);
    std::vector<std::int32_t> numbers = {1, 2, 65535, 65536, 65537, 3 << 16, 4 << 16, 0x7FFFFFFF};
    for (int k = 0; k < 20000; ++k) {
        numbers.push_back(static_cast<std::int32_t>((random() | 1U) >> (1U + random() % 31U)) | 1);
    }
    for (const std::int32_t raw : numbers) {
        const Fixed number = Fixed::of_raw(raw);
        const Fixed stored = stored_inverse(number);
        ASSERT_GT(stored.raw, 0) << raw;
        const std::int32_t factor = static_cast<std::int32_t>(random()) / 2;
        const double exact = static_cast<double>(factor) * 65536.0 / raw;
        if (std::fabs(exact) < 2147483647.0) {
            ASSERT_NEAR(times_inverse(Fixed::of_raw(factor), stored).raw, exact,
                        0.5 + std::fabs(exact) / (1 << 25)) << raw;
        }
        if (raw < (256 << 16)) {
            ASSERT_EQ(over_inverse(Fixed(1), stored).raw, raw);
        }
    }
    EXPECT_EQ(stored_inverse(Fixed(4)).raw, stored_quarter<Fixed>().raw);
    EXPECT_EQ(times_inverse(Fixed::of_raw(kMostRaw), stored_inverse(Fixed(0.5))).raw, kMostRaw);
}

TEST(FixedPoint, RootsAreRoundedDown) {
    for (std::uint32_t root = 0; root <= 0xFFFFU; ++root) {
        const std::uint32_t most = root * root + 2U * root;
        for (const std::uint32_t value : {root * root, root * root + root, most}) {
            const fixed::Root found = fixed::root_below(value);
            ASSERT_EQ(found.root, root) << value;
            ASSERT_EQ(found.rest, value - root * root) << value;
        }
    }
}

TEST(FixedPoint, RootsAreTheNearest) {
    std::mt19937 random(9);
    for (int k = 0; k < 200'000; ++k) {
        const Fixed a = Fixed::of_raw(static_cast<std::int32_t>(random() >> 1) >> (k % 31));
        const long double root = std::sqrt(static_cast<long double>(a.raw) * 65536.0L);
        ASSERT_EQ(square_root(a).raw, static_cast<std::int32_t>(std::floor(root + 0.5L))) << a.raw;
    }
    EXPECT_EQ(fixed::square_root(~std::uint64_t{0}), 0xFFFFFFFFU);
}

TEST(FixedPoint, SquareRootsOfAllLengthsAreTheNearest) {
    std::mt19937_64 random(11);
    const auto is_nearest = [](std::uint64_t value) {
        const auto twice = 2 * static_cast<Wide>(fixed::square_root(value));
        const auto four_times = 4 * static_cast<Wide>(value);
        const bool low = twice == 0 || (twice - 1) * (twice - 1) <= four_times;
        return low && four_times <= (twice + 1) * (twice + 1);
    };
    for (int k = 0; k < 400'000; ++k) {
        const std::uint64_t value = random() >> (k % 64);
        ASSERT_TRUE(is_nearest(value)) << value;
        const std::uint64_t root = value >> 32U | 1U;  // squares, and between them
        for (const std::uint64_t near : {root * root, root * root + root, root * root + root + 1}) {
            ASSERT_TRUE(is_nearest(near)) << near;
            ASSERT_TRUE(is_nearest(near - 1)) << near - 1;
        }
    }
}

TEST(FixedPoint, FloatsConvertToTheNearestAndSaturate) {
    std::mt19937 random(10);
    for (int k = 0; k < 200'000; ++k) {
        const float value = std::ldexp(static_cast<float>(static_cast<std::int32_t>(random())),
                                       static_cast<int>(random() % 60) - 50);
        const double scaled = static_cast<double>(value) * 65536.0;
        const double nearest = scaled < 0 ? std::ceil(scaled - 0.5) : std::floor(scaled + 0.5);
        const double limited = std::fmin(std::fmax(nearest, -2147483648.0), 2147483647.0);
        ASSERT_EQ(Fixed(value).raw, static_cast<std::int32_t>(limited)) << value;
        ASSERT_EQ(Fixed(static_cast<double>(value)).raw, Fixed(value).raw) << value;
    }
    EXPECT_EQ(Fixed(std::nanf("")).raw, 0);
    EXPECT_EQ(Fixed(HUGE_VALF).raw, kMostRaw);
    EXPECT_EQ(Fixed(-HUGE_VALF).raw, kLeastRaw);
    EXPECT_EQ(Fixed(1 << 20).raw, kMostRaw);
    EXPECT_EQ(Fixed(-(1 << 20)).raw, kLeastRaw);
    EXPECT_EQ(Fixed(~std::uint64_t{0}).raw, kMostRaw) << "no number of 64 bits with a sign";
    EXPECT_EQ(static_cast<std::int32_t>(Fixed(-1.75)), -1);
    EXPECT_EQ(floor_to_int(Fixed(-1.75)), -2);
    EXPECT_EQ(ceil_to_int(Fixed(-1.75)), -1);
}

TEST(FixedPoint, TimesKeepTheirDigits) {
    const Seconds<Fixed> dt(1.0F / 60.0F);
    EXPECT_NEAR(static_cast<double>(dt), 1.0 / 60.0, 1.0e-9);
    EXPECT_NEAR(static_cast<double>(part_of(dt, 16)), 1.0 / 960.0, 1.0e-9);
    EXPECT_NEAR(static_cast<double>(dt * Fixed(490.5)), 8.175, 1.0e-5);
    EXPECT_NEAR(static_cast<double>(Fixed(2) / dt), 120.0, 1.0e-4);
    EXPECT_EQ((dt / dt).raw, 65536);
}

TEST(FixedPoint, SquaresAcrossATankDoNotOverflow) {
    const Vec2<Fixed> far{Fixed(255), Fixed(-255)};
    EXPECT_NEAR(static_cast<double>(dot(far, far)), 2 * 255.0 * 255.0, 1.0e-6);
    EXPECT_NEAR(static_cast<double>(length(far)), 360.624, 1.0e-3);
    EXPECT_NEAR(static_cast<double>(static_cast<Fixed>(cross(far, far))), 0.0, 0.0);
    EXPECT_NEAR(static_cast<double>(absolute(cross(far, Vec2<Fixed>{far.y, far.x})) / length(far)),
                0.0, 1.0e-4);
}

TEST(FixedPoint, RotationsAreOfLengthOne) {
    for (int k = -7000; k <= 7000; ++k) {
        const double angle = 0.001 * k;
        const Rotation<Fixed> turn = rotation(Fixed(angle));
        EXPECT_NEAR(static_cast<double>(turn.cosine), std::cos(angle), 1.0e-4);
        EXPECT_NEAR(static_cast<double>(turn.sine), std::sin(angle), 1.0e-4);
    }
}

TEST(Packed, RoundsAndSaturates) {
    using Speed = Packed<std::int16_t, 7>;
    using Share = Packed<std::uint8_t, 7>;
    EXPECT_EQ(Speed(SmallFixed(1.0)).raw, 128);
    EXPECT_EQ(Speed(SmallFixed(-1.0)).raw, -128);
    EXPECT_EQ(Speed(SmallFixed(0.5 / 128)).raw, 1);
    EXPECT_EQ(Speed(SmallFixed(-0.5 / 128)).raw, -1);
    EXPECT_EQ(Speed(SmallFixed(1000)).raw, 32767);
    EXPECT_EQ(Speed(SmallFixed(-1000)).raw, -32768);
    EXPECT_EQ(Share(SmallFixed(3)).raw, 255);
    EXPECT_EQ(Share(SmallFixed(-3)).raw, 0);
    for (std::int32_t raw = -32768; raw < 32768; ++raw) {
        const Speed speed = Speed::of_raw(static_cast<std::int16_t>(raw));
        ASSERT_EQ(Speed(static_cast<SmallFixed>(speed)).raw, raw);
    }
}

}  // namespace

}  // namespace weir
