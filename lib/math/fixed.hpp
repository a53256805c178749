// Arithmetic of fixed-point numbers: 32 bits, rounded to nearest with ties away from zero (so that
// mirrored scenes stay mirrored to the bit), saturating. Nothing here divides 64 bits by anything,
// and no result depends on the processor.
#pragma once

#include "base/compiler.hpp"
#include "weir/fixed.hpp"

namespace weir {

/// A number below 2: seconds of a step, to a billionth. And one below 128, to 6e-8: reciprocals.
template <class S>
using FixedSeconds = FixedPoint<30, S>;
template <class S>
using FixedRatio = FixedPoint<24, S>;

namespace fixed {

#if defined(__ARM_FEATURE_DSP)
/// In one instruction.
WEIR_ALWAYS_INLINE std::int32_t add(std::int32_t a, std::int32_t b) {
    return __builtin_arm_qadd(a, b);
}
WEIR_ALWAYS_INLINE std::int32_t subtract(std::int32_t a, std::int32_t b) {
    return __builtin_arm_qsub(a, b);
}
#else
inline std::int32_t add(std::int32_t a, std::int32_t b) {
    std::int32_t sum = 0;
    return add_overflows(a, b, &sum) ? (a < 0 ? kLeastRaw : kMostRaw) : sum;
}
inline std::int32_t subtract(std::int32_t a, std::int32_t b) {
    std::int32_t difference = 0;
    return subtract_overflows(a, b, &difference) ? (a < 0 ? kLeastRaw : kMostRaw)
                                                     : difference;
}
#endif
#if defined(WEIR_SHORT_PRODUCTS)
/// No product of 64 bits on this processor: out of four of 32, and not inlined.
std::int32_t multiply(std::int32_t a, std::int32_t b, int shift);
#else
/// The sign is known before the product is, to which a processor can add it.
inline std::int32_t multiply(std::int32_t a, std::int32_t b, int shift) {
    const std::int32_t half = (1 << (shift - 1)) + ((a ^ b) >> 31);
    return saturate((static_cast<std::int64_t>(a) * b + half) >> shift);
}
#endif
inline std::uint32_t magnitude(std::int32_t a) {
    return a < 0 ? 0U - static_cast<std::uint32_t>(a) : static_cast<std::uint32_t>(a);
}

/// numerator / divisor rounded to nearest, saturating; division by 0 saturates too. Done in steps
/// of 32 by 16 bits (Knuth, The Art of Computer Programming vol. 2, 4.3.1, algorithm D).
std::uint32_t divide(std::uint64_t numerator, std::uint32_t divisor);

/// a · b, all 64 bits.
#if defined(WEIR_SHORT_PRODUCTS)
std::int64_t wide_product(std::int32_t a, std::int32_t b);
#else
constexpr std::int64_t wide_product(std::int32_t a, std::int32_t b) {
    return static_cast<std::int64_t>(a) * b;
}
#endif

/// a · 2^shift / b.
std::int32_t quotient(std::int32_t a, std::int32_t b, int shift);

/// The inverse of a positive number of 16 fractional bits, as 25 digits and, in the lowest five
/// bits, how far they are shifted to the right beyond eight places.
std::int32_t stored_inverse(std::int32_t raw);
/// That of 4.
inline constexpr std::int32_t kQuarter = (1 << 30) + (27 - 8);
/// a times what is stored so.
inline std::int32_t times_inverse(std::int32_t a, std::int32_t stored) {
    return saturate(shifted(wide_product(a, stored >> 5), 8 + (stored & 31)));
}
/// What was inverted, if that was less than 256.
std::int32_t inverted(std::int32_t stored);

/// Root rounded down, and what its square leaves.
struct Root {
    std::uint32_t root;
    std::uint32_t rest;
};
Root root_below(std::uint32_t value);

/// Square root rounded to nearest.
std::uint32_t square_root(std::uint64_t value);

}  // namespace fixed

template <int F, class S>
inline FixedPoint<F, S> operator+(FixedPoint<F, S> a, FixedPoint<F, S> b) {
    return FixedPoint<F, S>::of_raw(fixed::add(a.raw, b.raw));
}
template <int F, class S>
inline FixedPoint<F, S> operator-(FixedPoint<F, S> a, FixedPoint<F, S> b) {
    return FixedPoint<F, S>::of_raw(fixed::subtract(a.raw, b.raw));
}
template <int F, class S>
inline FixedPoint<F, S> operator-(FixedPoint<F, S> a) {
    return FixedPoint<F, S>::of_raw(fixed::subtract(0, a.raw));
}
/// Of two kinds of numbers the product and the quotient are of the coarser kind.
template <int F, int G, class S>
inline FixedPoint<(F < G ? F : G), S> operator*(FixedPoint<F, S> a, FixedPoint<G, S> b) {
    return FixedPoint<(F < G ? F : G), S>::of_raw(fixed::multiply(a.raw, b.raw, F < G ? G : F));
}
template <int F, int G, class S>
inline FixedPoint<(F < G ? F : G), S> operator/(FixedPoint<F, S> a, FixedPoint<G, S> b) {
    // raw / raw has F − G fractional bits.
    return FixedPoint<(F < G ? F : G), S>::of_raw(
        fixed::quotient(a.raw, b.raw, (F < G ? F : G) - F + G));
}
template <int F, class S>
inline FixedPoint<F, S>& operator+=(FixedPoint<F, S>& a, FixedPoint<F, S> b) {
    return a = a + b;
}
template <int F, class S>
inline FixedPoint<F, S>& operator-=(FixedPoint<F, S>& a, FixedPoint<F, S> b) {
    return a = a - b;
}

#define WEIR_COMPARE(op)                                                  \
    template <int F, class S>                                             \
    WEIR_ALWAYS_INLINE constexpr bool operator op(FixedPoint<F, S> a, \
                                                  FixedPoint<F, S> b) { \
        return a.raw op b.raw;                                            \
    }
WEIR_COMPARE(==)
WEIR_COMPARE(!=)
WEIR_COMPARE(<)
WEIR_COMPARE(<=)
WEIR_COMPARE(>)
WEIR_COMPARE(>=)
#undef WEIR_COMPARE

/// Every bit pattern is a number.
template <int F, class S>
constexpr bool is_finite(FixedPoint<F, S>) {
    return true;
}

template <int F, class S>
constexpr std::int32_t floor_to_int(FixedPoint<F, S> value) {
    return value.raw >> F;
}

/// How many times one time is the other.
template <class S>
inline FixedPoint<16, S> operator/(FixedSeconds<S> a, FixedSeconds<S> b) {
    return FixedPoint<16, S>::of_raw(fixed::quotient(a.raw, b.raw, 16));
}
/// An equal part of a time.
template <class S>
inline FixedSeconds<S> part_of(FixedSeconds<S> whole, std::int32_t parts) {
    return FixedSeconds<S>::of_raw(fixed::quotient(whole.raw, parts, 0));
}

/// The square root of a number that is not negative, rounded to nearest.
template <class S>
inline FixedPoint<16, S> square_root(FixedPoint<16, S> value) {
    const std::uint64_t widened = static_cast<std::uint64_t>(value.raw) << 16U;
    return FixedPoint<16, S>::of_raw(static_cast<std::int32_t>(fixed::square_root(widened)));
}

/// A sum of products at full width: squares of lengths across the tank.
template <class S>
struct WideFixed {
    std::int64_t raw = 0;  ///< Q31.32

    constexpr WideFixed() = default;
    constexpr explicit WideFixed(std::int32_t whole) : raw(std::int64_t{whole} * 4294967296) {}
    static constexpr WideFixed of_raw(std::int64_t bits) {
        WideFixed value;
        value.raw = bits;
        return value;
    }
    operator FixedPoint<16, S>() const {
        return FixedPoint<16, S>::of_raw(fixed::saturate(fixed::shifted(raw, 16)));
    }
    constexpr explicit operator double() const { return static_cast<double>(raw) / 4294967296.0; }
};
template <class S>
inline WideFixed<S> operator+(WideFixed<S> a, WideFixed<S> b) {
    std::int64_t sum = 0;
    const bool over = add_overflows(a.raw, b.raw, &sum);
    return WideFixed<S>::of_raw(over ? (a.raw < 0 ? INT64_MIN : INT64_MAX) : sum);
}
template <class S>
inline WideFixed<S> operator-(WideFixed<S> a, WideFixed<S> b) {
    std::int64_t difference = 0;
    const bool over = subtract_overflows(a.raw, b.raw, &difference);
    return WideFixed<S>::of_raw(over ? (a.raw < 0 ? INT64_MIN : INT64_MAX) : difference);
}
template <class S>
inline WideFixed<S> operator-(WideFixed<S> a) { return WideFixed<S>{} - a; }
template <class S>
constexpr bool operator<(WideFixed<S> a, WideFixed<S> b) { return a.raw < b.raw; }
template <class S>
constexpr bool operator<=(WideFixed<S> a, WideFixed<S> b) { return a.raw <= b.raw; }
template <class S>
constexpr bool operator>(WideFixed<S> a, WideFixed<S> b) { return a.raw > b.raw; }
template <class S>
constexpr bool operator>=(WideFixed<S> a, WideFixed<S> b) { return a.raw >= b.raw; }

/// Not negative, as a sum of squares is.
template <class S>
inline FixedPoint<16, S> square_root(WideFixed<S> value) {
    const std::uint32_t root = fixed::square_root(static_cast<std::uint64_t>(value.raw));
    return FixedPoint<16, S>::of_raw(root > 0x7FFFFFFFU ? kMostRaw
                                                        : static_cast<std::int32_t>(root));
}
template <class S>
inline FixedPoint<16, S> operator/(WideFixed<S> a, FixedPoint<16, S> b) {
    const bool negative = (a.raw < 0) != (b.raw < 0);
    const std::uint64_t size = a.raw < 0 ? 0U - static_cast<std::uint64_t>(a.raw)
                                         : static_cast<std::uint64_t>(a.raw);
    const std::uint32_t ratio = fixed::divide(size, fixed::magnitude(b.raw));
    const std::int32_t limited = ratio > 0x7FFFFFFFU ? kMostRaw : static_cast<std::int32_t>(ratio);
    return FixedPoint<16, S>::of_raw(negative ? -limited : limited);
}

}  // namespace weir
