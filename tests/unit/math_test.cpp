// Square root, rotation, floor and hash against the host's own libm and published vectors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "base/hash.hpp"
#include "math/rotation.hpp"
#include "math/scalar.hpp"

namespace weir {
namespace {

std::uint32_t bits_of(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

std::uint64_t bits_of(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

float float_of(std::uint32_t bits) {
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

double double_of(std::uint64_t bits) {
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

TEST(SquareRoot, EqualsTheHostsOverAllExponentsOfFloat) {
    // 997 is prime to 2^31: the walk meets every exponent, subnormals included, 2.1 million times.
    for (std::uint32_t bits = 0; bits < 0x7F800000U; bits += 997) {
        const float value = float_of(bits);
        ASSERT_EQ(bits_of(square_root_in_integers(value)), bits_of(std::sqrt(value))) << bits;
    }
}

TEST(SquareRoot, EqualsTheHostsForSmallestAndLargestSubnormals) {
    for (std::uint32_t bits = 0; bits < 200'000; ++bits) {
        for (const std::uint32_t end : {bits, 0x00800000U - 1U - bits, 0x00800000U + bits}) {
            const float value = float_of(end);
            ASSERT_EQ(bits_of(square_root_in_integers(value)), bits_of(std::sqrt(value))) << end;
        }
    }
}

TEST(SquareRoot, EqualsTheHostsForSquaresAndTheirNeighbours) {
    for (std::uint32_t root = 1; root < 300'000; ++root) {
        const auto square = static_cast<float>(root) * static_cast<float>(root);
        for (const float value : {square, std::nextafter(square, 0.0F),
                                  std::nextafter(square, std::numeric_limits<float>::max())}) {
            ASSERT_EQ(bits_of(square_root_in_integers(value)), bits_of(std::sqrt(value))) << root;
        }
    }
}

TEST(SquareRoot, EqualsTheHostsForDoubles) {
    std::mt19937_64 random(1);
    for (int k = 0; k < 2'000'000; ++k) {
        const std::uint64_t bits = random() % 0x7FF0000000000000ULL;
        const double value = double_of(bits);
        ASSERT_EQ(bits_of(square_root_in_integers(value)), bits_of(std::sqrt(value))) << bits;
    }
    constexpr std::uint64_t kNormal = 0x0010000000000000ULL;
    for (std::uint64_t bits = 0; bits < 100'000; ++bits) {
        const std::uint64_t ends[] = {bits, kNormal - 1 - bits, kNormal + bits};
        for (const std::uint64_t end : ends) {
            const double value = double_of(end);
            ASSERT_EQ(bits_of(square_root_in_integers(value)), bits_of(std::sqrt(value))) << end;
        }
    }
}

TEST(SquareRoot, KeepsZeroAndInfinity) {
    EXPECT_EQ(bits_of(square_root_in_integers(0.0F)), 0U);
    EXPECT_EQ(square_root_in_integers(std::numeric_limits<float>::infinity()),
              std::numeric_limits<float>::infinity());
    EXPECT_EQ(square_root_in_integers(0.0), 0.0);
}

TEST(SquareRoot, TheOneInUseIsTheSame) {
    std::mt19937 random(2);
    for (int k = 0; k < 100'000; ++k) {
        const float value = float_of(static_cast<std::uint32_t>(random() % 0x7F800000U));
        ASSERT_EQ(bits_of(square_root(value)), bits_of(square_root_in_integers(value)));
    }
}

/// Largest error of sine and cosine over angles in ±limit.
template <class Real>
double rotation_error(double limit, int samples) {
    double worst = 0.0;
    for (int k = 0; k <= samples; ++k) {
        const auto angle = static_cast<Real>(-limit + 2.0 * limit * k / samples);
        const Rotation<Real> turn = rotation(angle);
        const auto exact = static_cast<long double>(angle);
        worst = std::max({worst,
                          std::abs(static_cast<double>(std::sin(exact) -
                                                       static_cast<long double>(turn.sine))),
                          std::abs(static_cast<double>(std::cos(exact) -
                                                       static_cast<long double>(turn.cosine)))});
    }
    return worst;
}

// Bounds: 2 units in the last place of 1 for a float within two turns, where wrapped_angle keeps a
// body; a double is as good as its series, r^15 / 15! at π/4. Beyond that a float loses what three
// parts of π/2 do not hold: 1e-5 at the largest angle a caller may set.
TEST(RotationTest, BoundedWithinTwoTurns) {
    EXPECT_LE(rotation_error<float>(2.0 * 6.2831853, 2'000'000), 1.2e-7);
    EXPECT_LE(rotation_error<double>(2.0 * 6.2831853, 1'000'000), 2.1e-14);
}

TEST(RotationTest, WithinOneHundredThousandthAtTheLargestAngles) {
    EXPECT_LE(rotation_error<float>(1.0e4, 1'000'000), 1.0e-5);
    EXPECT_LE(rotation_error<double>(1.0e5, 1'000'000), 1.0e-13);
}

TEST(RotationTest, QuarterTurns) {
    const Rotation<float> none = rotation(0.0F);
    EXPECT_EQ(none.cosine, 1.0F);
    EXPECT_EQ(none.sine, 0.0F);
    const Rotation<float> quarter = rotation(1.57079637F);
    EXPECT_NEAR(quarter.cosine, 0.0F, 1.0e-7F);
    EXPECT_EQ(quarter.sine, 1.0F);
    const Vec2<float> up = quarter.apply({2.0F, 0.0F});
    EXPECT_NEAR(up.x, 0.0F, 2.0e-7F);
    EXPECT_EQ(up.y, 2.0F);  // counter-clockwise
}

TEST(RotationTest, WrappedAngleIsTheSameDirection) {
    for (double angle = -2000.0; angle <= 2000.0; angle += 0.37) {
        const double wrapped = wrapped_angle(angle);
        EXPECT_LE(std::abs(wrapped), 6.2831853071795872);
        EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1.0e-12);
        EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1.0e-12);
    }
    EXPECT_EQ(wrapped_angle(3.0F), 3.0F);
    EXPECT_EQ(wrapped_angle(-6.0F), -6.0F);
}

TEST(Scalar, FloorAndCeil) {
    std::mt19937 random(3);
    for (int k = 0; k < 1'000'000; ++k) {
        const float value = float_of(static_cast<std::uint32_t>(random()));
        if (!(std::abs(value) < 2147483648.0F)) {
            continue;
        }
        ASSERT_EQ(floor_to_int(value), static_cast<std::int32_t>(std::floor(value))) << value;
        if (value > -2147483648.0F) {
            ASSERT_EQ(ceil_to_int(value), static_cast<std::int32_t>(std::ceil(value))) << value;
        }
    }
    EXPECT_EQ(floor_to_int(-0.5F), -1);
    EXPECT_EQ(floor_to_int(-1.0F), -1);
    EXPECT_EQ(ceil_to_int(-0.5F), 0);
    EXPECT_EQ(ceil_to_int(1.0F), 1);
    EXPECT_EQ(floor_to_int(-2147483647.5), -2147483647 - 1);
}

TEST(Scalar, IsFinite) {
    for (std::uint32_t exponent = 0; exponent < 512; ++exponent) {
        for (const std::uint32_t fraction : {0U, 1U, 0x400000U, 0x7FFFFFU}) {
            const std::uint32_t bits = (exponent << 23U) | fraction;
            EXPECT_EQ(is_finite(float_of(bits)), (exponent & 0xFFU) != 0xFFU) << bits;
        }
    }
    EXPECT_TRUE(is_finite(std::numeric_limits<double>::max()));
    EXPECT_TRUE(is_finite(std::numeric_limits<double>::denorm_min()));
    EXPECT_FALSE(is_finite(-std::numeric_limits<double>::infinity()));
    EXPECT_FALSE(is_finite(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(is_finite(std::numeric_limits<double>::signaling_NaN()));
}

TEST(Scalar, MinimumMaximumClampAbsolute) {
    EXPECT_EQ(minimum(2, 1), 1);
    EXPECT_EQ(maximum(2, 1), 2);
    EXPECT_EQ(clamp(-3.0F, -1.0F, 1.0F), -1.0F);
    EXPECT_EQ(clamp(3.0F, -1.0F, 1.0F), 1.0F);
    EXPECT_EQ(clamp(0.5F, -1.0F, 1.0F), 0.5F);
    EXPECT_EQ(absolute(-2.5F), 2.5F);
}

std::uint64_t hash_of_text(const char* text) {
    Hash hash;
    for (; *text != '\0'; text += 4) {
        std::uint32_t word = 0;
        for (unsigned byte = 0; byte < 4; ++byte) {
            word |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[byte])) << 8U * byte;
        }
        hash.add(word);
    }
    return hash.value();
}

/// The published algorithm, over bytes, with the published constants in decimal.
std::uint64_t fnv1a(const char* text) {
    std::uint64_t hash = 14695981039346656037ULL;
    for (; *text != '\0'; ++text) {
        hash = (hash ^ static_cast<unsigned char>(*text)) * 1099511628211ULL;
    }
    return hash;
}

// Landon Curt Noll's list of test vectors has the offset basis for "", and 85944171f73967e8 for
// "foobar"; words of four letters are checked against the algorithm, which is checked on that.
TEST(HashTest, KnownVectors) {
    EXPECT_EQ(Hash().value(), 0xCBF29CE484222325ULL);
    EXPECT_EQ(fnv1a("foobar"), 0x85944171F73967E8ULL);
    EXPECT_EQ(hash_of_text("chongo w"), fnv1a("chongo w"));
    EXPECT_EQ(hash_of_text("abcd"), fnv1a("abcd"));
    EXPECT_EQ(hash_of_text("The quick brown fox."), fnv1a("The quick brown fox."));
}

TEST(HashTest, ZerosOfBothSignsAreEqual) {
    const auto hash_of = [](auto number) {
        Hash hash;
        hash.add(number);
        return hash.value();
    };
    EXPECT_EQ(hash_of(-0.0F), hash_of(0.0F));
    EXPECT_EQ(hash_of(-0.0), hash_of(0.0));
    EXPECT_NE(hash_of(1.0F), hash_of(-1.0F));
    EXPECT_NE(hash_of(float_of(1)), hash_of(0.0F));  // the smallest subnormal is not 0
    EXPECT_EQ(hash_of(std::int32_t{-1}), hash_of(std::uint32_t{0xFFFFFFFFU}));
}

TEST(HashTest, OrderMatters) {
    Hash a;
    a.add(1.0F);
    a.add(2.0F);
    Hash b;
    b.add(2.0F);
    b.add(1.0F);
    EXPECT_NE(a.value(), b.value());
}

}  // namespace
}  // namespace weir
