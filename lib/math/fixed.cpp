#include "math/fixed.hpp"

#include <cstring>

namespace weir {

template <int Fraction, class Storage>
FixedPoint<Fraction, Storage>::FixedPoint(float value) {
    std::uint32_t bits = 0;
    WEIR_COPY_BYTES(&bits, &value, sizeof bits);
    const std::int32_t exponent = static_cast<std::int32_t>((bits >> 23U) & 0xFFU);
    const std::uint32_t mantissa = (bits & 0x7FFFFFU) | 0x800000U;
    // value = mantissa · 2^(exponent − 150), subnormals apart, which round to 0 anyway.
    const std::int32_t shift = exponent - 150 + Fraction;
    std::uint32_t size = 0;
    if (exponent == 0xFF && (bits & 0x7FFFFFU) != 0) {
        size = 0;  // no number
    } else if (shift > 7) {
        size = 0x80000000U;
    } else if (shift >= 0) {
        size = mantissa << static_cast<unsigned>(shift);
    } else if (shift >= -25) {
        size = (mantissa + (1U << static_cast<unsigned>(-shift - 1))) >>
               static_cast<unsigned>(-shift);
    }
    const bool negative = (bits >> 31U) != 0;
    if (size > 0x7FFFFFFFU) {
        raw = negative ? kLeastRaw : kMostRaw;
    } else {
        raw = negative ? -static_cast<std::int32_t>(size) : static_cast<std::int32_t>(size);
    }
}

template FixedPoint<16>::FixedPoint(float);
template FixedPoint<30>::FixedPoint(float);
template FixedPoint<16, PackedStorage>::FixedPoint(float);
template FixedPoint<30, PackedStorage>::FixedPoint(float);

namespace fixed {

namespace {

/// One digit of 16 bits: (high · 2^16 + next) / divisor, both halves of the divisor known and its
/// top bit set. The estimate from the upper half is at most two too large.
struct Digit {
    std::uint32_t quotient;
    std::uint32_t remainder;
};

WEIR_ALWAYS_INLINE Digit next_digit(std::uint32_t high, std::uint32_t next,
                                    std::uint32_t divisor) {
    const std::uint32_t upper = divisor >> 16U;
    const std::uint32_t lower = divisor & 0xFFFFU;
    std::uint32_t q = high / upper;
    std::uint32_t rest = high - q * upper;
    while (q > 0xFFFFU || q * lower > ((rest << 16U) | next)) {
        --q;
        rest += upper;
        if (rest > 0xFFFFU) {
            break;
        }
    }
    return {q, (high << 16U) + next - q * divisor};
}

}  // namespace

#if defined(WEIR_SHORT_PRODUCTS)
// Upper halves with their signs: only the lower ones' product fills a word.
std::int64_t wide_product(std::int32_t a, std::int32_t b) {
    const auto a_low = static_cast<std::int32_t>(a & 0xFFFF);
    const auto b_low = static_cast<std::int32_t>(b & 0xFFFF);
    const std::int32_t a_high = a >> 16;
    const std::int32_t b_high = b >> 16;
    const auto low = static_cast<std::uint32_t>(a_low) * static_cast<std::uint32_t>(b_low);
    const std::int32_t one = a_high * b_low;
    const std::int32_t other = a_low * b_high;
    // No more than 2^31 − 2^16 by size, each: their sum is taken in halves.
    const auto middle = static_cast<std::int32_t>(low >> 16U) + (one & 0xFFFF) + (other & 0xFFFF);
    const std::int32_t high = a_high * b_high + (one >> 16) + (other >> 16) + (middle >> 16);
    const std::uint32_t lowest = (static_cast<std::uint32_t>(middle) << 16U) | (low & 0xFFFFU);
    return static_cast<std::int64_t>(
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(high)) << 32U) | lowest);
}

namespace {

std::int32_t signed_of(std::uint32_t size, bool negative) {
    if (negative) {
        return size >= 0x80000000U ? kLeastRaw : -static_cast<std::int32_t>(size);
    }
    return size > 0x7FFFFFFFU ? kMostRaw : static_cast<std::int32_t>(size);
}

/// By itself: it wants more registers.
[[gnu::noinline]] std::int32_t multiply_seldom(std::int32_t a, std::int32_t b, int shift) {
    const std::int64_t product = wide_product(a, b);
    const std::uint64_t whole = product < 0 ? 0U - static_cast<std::uint64_t>(product)
                                            : static_cast<std::uint64_t>(product);
    const auto places = static_cast<unsigned>(shift);
    const std::uint64_t result = (whole + (std::uint64_t{1} << (places - 1U))) >> places;
    return signed_of(result > 0xFFFFFFFFU ? 0xFFFFFFFFU : static_cast<std::uint32_t>(result),
                     product < 0);
}

}  // namespace

std::int32_t multiply(std::int32_t a, std::int32_t b, int shift) {
    if (shift != 16) {
        return multiply_seldom(a, b, shift);
    }
    const std::uint32_t x = magnitude(a);
    const std::uint32_t y = magnitude(b);
    const std::uint32_t high = (x >> 16U) * (y >> 16U);
    if (WEIR_SELDOM(high > 0x7FFFU)) {
        return signed_of(0xFFFFFFFFU, (a ^ b) < 0);
    }
    const std::uint32_t low = (x & 0xFFFFU) * (y & 0xFFFFU);
    const std::uint32_t middle = (x >> 16U) * (y & 0xFFFFU) + (x & 0xFFFFU) * (y >> 16U);
    std::uint32_t size = 0;
    const bool over =
        add_overflows(middle, (low >> 16U) + ((low >> 15U) & 1U), &size) ||
        add_overflows(size, high << 16U, &size);
    return signed_of(over ? 0xFFFFFFFFU : size, (a ^ b) < 0);
}
#endif

std::uint32_t divide(std::uint64_t numerator, std::uint32_t divisor) {
    const auto high = static_cast<std::uint32_t>(numerator >> 32U);
    if (high >= divisor) {
        return 0xFFFFFFFFU;
    }
    if (high == 0) {  // as shares below 1 are: one division does
        const auto all = static_cast<std::uint32_t>(numerator);
        const std::uint32_t whole = all / divisor;
        const std::uint32_t rest = all - whole * divisor;
        return rest >= divisor - rest ? whole + 1U : whole;
    }
    const auto zeros = static_cast<unsigned>(WEIR_LEADING_ZEROS(divisor));
    const std::uint32_t scaled = divisor << zeros;
    const std::uint64_t top = numerator << zeros;
    const Digit first = next_digit(static_cast<std::uint32_t>(top >> 32U),
                                   static_cast<std::uint32_t>(top >> 16U) & 0xFFFFU, scaled);
    const Digit second =
        next_digit(first.remainder, static_cast<std::uint32_t>(top) & 0xFFFFU, scaled);
    const std::uint32_t whole = (first.quotient << 16U) + second.quotient;
    const bool up = second.remainder >= scaled - second.remainder;
    return up && whole != 0xFFFFFFFFU ? whole + 1U : whole;
}

std::int32_t quotient(std::int32_t a, std::int32_t b, int shift) {
    const bool negative = (a < 0) != (b < 0);
    const std::uint64_t size = static_cast<std::uint64_t>(magnitude(a))
                               << static_cast<unsigned>(shift);
    const std::uint32_t ratio = divide(size, magnitude(b));
    const std::int32_t limited = ratio > 0x7FFFFFFFU ? kMostRaw : static_cast<std::int32_t>(ratio);
    return negative ? -limited : limited;
}

std::int32_t stored_inverse(std::int32_t raw) {
    // 2^(shift + 16) / raw is above 2²⁴, and at most 2²⁵.
    const int shift = 25 + 15 - WEIR_LEADING_ZEROS(static_cast<std::uint32_t>(raw));
    const std::uint32_t digits = divide(std::uint64_t{1} << static_cast<unsigned>(shift + 16),
                                        static_cast<std::uint32_t>(raw));
    return static_cast<std::int32_t>(digits << 5U) + (shift - 8);
}

std::int32_t inverted(std::int32_t stored) {
    const auto shift = 8U + (static_cast<std::uint32_t>(stored) & 31U);
    return static_cast<std::int32_t>(divide(std::uint64_t{1} << (shift + 16U),
                                            static_cast<std::uint32_t>(stored) >> 5U));
}

#if defined(WEIR_SHORT_PRODUCTS)
// Bit by bit: no division on this processor.
Root root_below(std::uint32_t value) {
    std::uint32_t root = 0;
    for (std::uint32_t bit = 1U << 30U; bit != 0; bit >>= 2U) {
        const std::uint32_t trial = root + bit;
        root >>= 1U;
        if (value >= trial) {
            value -= trial;
            root += bit;
        }
    }
    return {root, value};
}
#else
// By Newton's steps from the tangent at the largest number, which lies above: so does each of
// them, rounded down, until the last one is it or one more.
Root root_below(std::uint32_t value) {
    const auto zeros = static_cast<unsigned>(WEIR_LEADING_ZEROS(value | 1U)) & ~1U;
    const std::uint32_t scaled = value << zeros;
    std::uint32_t root = (scaled >> 17U) + (1U << 15U);
    for (std::int32_t step = 0; step < 4; ++step) {
        root = (root + scaled / root) >> 1U;
    }
    root = (root - (root * root > scaled ? 1U : 0U)) >> zeros / 2U;
    return {root, value - root * root};
}
#endif

// The root of the upper half is half of the bits, a division by it gives the others, or one too
// many (Zimmermann, Karatsuba Square Root, INRIA 1999).
std::uint32_t square_root(std::uint64_t value) {
    if (value >> 32U == 0) {
        const Root found = root_below(static_cast<std::uint32_t>(value));
        return found.rest > found.root ? found.root + 1U : found.root;
    }
    const auto zeros =
        static_cast<unsigned>(WEIR_LEADING_ZEROS(static_cast<std::uint32_t>(value >> 32U))) & ~1U;
    const std::uint64_t scaled = value << zeros;
    const Root upper = root_below(static_cast<std::uint32_t>(scaled >> 32U));
    const std::uint32_t next = (upper.rest << 15U) | (static_cast<std::uint32_t>(scaled) >> 17U);
    const std::uint32_t lower = next / upper.root;
    std::uint32_t root = (upper.root << 16U) + (lower < 0xFFFFU ? lower : 0xFFFFU);
    std::uint64_t square = static_cast<std::uint64_t>(root) * root;
    if (square > scaled) {
        --root;
        square -= 2U * static_cast<std::uint64_t>(root) + 1U;
    }
    if (zeros != 0) {
        return (root >> zeros / 2U) + (root >> (zeros / 2U - 1U) & 1U);
    }
    return scaled - square > root && root != 0xFFFFFFFFU ? root + 1U : root;
}

}  // namespace fixed

}  // namespace weir
