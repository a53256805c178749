// The arithmetic that the library is allowed: + − × ÷ √ and comparisons, the same bits on every
// machine. Everything else (rotation, floor) is built from these.
#pragma once

#include <cstdint>

#include "base/compiler.hpp"
#include "math/fixed.hpp"
#include "math/packed.hpp"

// With these options bits are not everyone's, and nothing else would say so. Parts of fast-math
// have names of their own.
#if defined(__FAST_MATH__) || __FINITE_MATH_ONLY__ || defined(__ASSOCIATIVE_MATH__) || \
    defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) || defined(_M_FP_FAST)
#error "weir needs strict floating point: remove -ffast-math, -Ofast, /fp:fast or their like for it"
#endif
// No macro tells whether g++ fuses a*b+c, which it does unasked: who turns that off says so.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#elif defined(__FP_FAST_FMAF) && !defined(WEIR_FP_CONTRACT_OFF)
#error "weir rounds a*b+c twice: compile with -ffp-contract=off -DWEIR_FP_CONTRACT_OFF"
#endif
#if __FLT_EVAL_METHOD__ == 2 || (defined(_M_IX86_FP) && _M_IX86_FP < 2)
#error "weir needs floats that are rounded as floats, on x86: -msse2 -mfpmath=sse, /arch:SSE2"
#endif

/// Boards leave World<double> out: none computes in it.
#if WEIR_WITHOUT_DOUBLE
#define WEIR_FOR_DOUBLE(DO)
#else
#define WEIR_FOR_DOUBLE(DO) DO(double)
#endif
/// Where packed worlds are compiled for size, their sources are compiled once for them, and once
/// for all others.
#if WEIR_WITHOUT_PACKED
#define WEIR_FOR_PACKED(DO)
#else
#define WEIR_FOR_PACKED(DO) DO(SmallFixed)
#endif
#if WEIR_ONLY_PACKED
#define WEIR_FOR_EACH_ROOMY_SCALAR(DO)
#else
#define WEIR_FOR_EACH_ROOMY_SCALAR(DO) DO(float) WEIR_FOR_DOUBLE(DO) DO(Fixed)
#endif

/// Does it for each scalar that is not packed; for each that worlds come in; and for each that
/// there is: outlines are checked in double everywhere.
#define WEIR_FOR_EACH_SCALAR(DO) WEIR_FOR_EACH_ROOMY_SCALAR(DO) WEIR_FOR_PACKED(DO)
#define WEIR_FOR_EACH_NUMBER(DO) DO(float) DO(double) DO(Fixed) DO(SmallFixed)

namespace weir {

/// The first argument alone decides the type: std::int32_t is not int on every machine.
template <class T>
struct Same {
    using Type = T;
};
template <class T>
using SameAs = typename Same<T>::Type;

template <class T>
constexpr T minimum(T a, SameAs<T> b) {
    return b < a ? b : a;
}
template <class T>
constexpr T maximum(T a, SameAs<T> b) {
    return a < b ? b : a;
}
template <class T>
constexpr T clamp(T value, SameAs<T> low, SameAs<T> high) {
    return value < low ? low : (high < value ? high : value);
}
// A choice of two records is made by address, at least where code is compiled for size: of fixed
// point the numbers in them are chosen.
template <int F, class S>
constexpr FixedPoint<F, S> minimum(FixedPoint<F, S> a, SameAs<FixedPoint<F, S>> b) {
    return FixedPoint<F, S>::of_raw(minimum(a.raw, b.raw));
}
template <int F, class S>
constexpr FixedPoint<F, S> maximum(FixedPoint<F, S> a, SameAs<FixedPoint<F, S>> b) {
    return FixedPoint<F, S>::of_raw(maximum(a.raw, b.raw));
}
template <int F, class S>
constexpr FixedPoint<F, S> clamp(FixedPoint<F, S> value, SameAs<FixedPoint<F, S>> low,
                                 SameAs<FixedPoint<F, S>> high) {
    return FixedPoint<F, S>::of_raw(clamp(value.raw, low.raw, high.raw));
}
template <class T>
constexpr T absolute(T value) {
    return value < T(0) ? -value : value;
}
// Signs of velocities are as good as random: no branch may hang on them.
inline float absolute(float value) {
    return magnitude_of(value);
}
inline double absolute(double value) {
    return magnitude_of(value);
}

/// What goes with an arithmetic: floats serve for everything, fixed point has a kind of number
/// for each range.
template <class Real>
struct Kinds {
    using Seconds = Real;
    using Ratio = Real;
    using Product = Real;
    using Face = Real;
};
template <class S>
struct Kinds<FixedPoint<16, S>> {
    using Seconds = FixedSeconds<S>;
    using Ratio = FixedRatio<S>;
    using Product = WideFixed<S>;
    using Face = float;
};
/// Length of a step, s: at most 1.
template <class Real>
using Seconds = typename Kinds<Real>::Seconds;
/// A reciprocal, at most 100.
template <class Real>
using Ratio = typename Kinds<Real>::Ratio;
/// A sum of two products of coordinates.
template <class Real>
using Product = typename Kinds<Real>::Product;
/// The numbers in which metres become cells.
template <class Real>
using Face = typename Kinds<Real>::Face;

template <class Real>
constexpr Product<Real> product(Real a, Real b) {
    return a * b;
}
template <class S>
inline WideFixed<S> product(FixedPoint<16, S> a, FixedPoint<16, S> b) {
    return WideFixed<S>::of_raw(fixed::wide_product(a.raw, b.raw));
}
template <class Real>
constexpr Real part_of(Real whole, std::int32_t parts) {
    return whole / static_cast<Real>(parts);
}

/// The inverse of a positive number, in the place of a number. Fixed point keeps 25 digits of it,
/// whatever its size, and how far they are shifted: it meets a pressure that is as large as the
/// liquid is deep, and what of a third were rounded off would flow out through every wall.
template <class Real>
inline Real stored_inverse(Real number) {
    if constexpr (std::is_floating_point<Real>::value) {
        return Real(1) / number;
    } else {
        return Real::of_raw(fixed::stored_inverse(number.raw));
    }
}
/// That of 4: of a cell with four open faces.
template <class Real>
inline Real stored_quarter() {
    if constexpr (std::is_floating_point<Real>::value) {
        return Real(0.25);
    } else {
        return Real::of_raw(fixed::kQuarter);
    }
}
/// factor / number, by the stored inverse of the number.
template <class Real>
inline Real times_inverse(Real factor, Real stored) {
    if constexpr (std::is_floating_point<Real>::value) {
        return factor * stored;
    } else {
        return Real::of_raw(fixed::times_inverse(factor.raw, stored.raw));
    }
}
/// factor · number, which fixed point knows to the bit again if it was below 256.
template <class Real>
inline Real over_inverse(Real factor, Real stored) {
    if constexpr (std::is_floating_point<Real>::value) {
        return factor / stored;
    } else {
        return factor * Real::of_raw(fixed::inverted(stored.raw));
    }
}

/// One small whole number over another.
template <class Real>
constexpr Real ratio_of(std::int32_t part, std::int32_t whole) {
    return static_cast<Real>(part) / static_cast<Real>(whole);
}
template <>
constexpr SmallFixed ratio_of(std::int32_t part, std::int32_t whole) {
    return SmallFixed::of_raw(((part << 16) + whole / 2) / whole);
}

/// What has the bits of another that is as long. __builtin: a freestanding std::memcpy is a call.
template <class To, class From>
inline To of_bits(From from) {
    static_assert(sizeof(To) == sizeof(From), "or some are lost");
    To to{};
    WEIR_COPY_BYTES(&to, &from, sizeof to);
    return to;
}

/// Comparing the exponent bits survives every compiler flag, unlike x == x.
inline bool is_finite(float value) {
    return (of_bits<std::uint32_t>(value) & 0x7F800000U) != 0x7F800000U;
}
inline bool is_finite(double value) {
    return (of_bits<std::uint64_t>(value) & 0x7FF0000000000000ULL) != 0x7FF0000000000000ULL;
}

/// Numbers that compare as the values do: as the magnitudes, or as values that are not NaN do with
/// bounds that are not negative. Whole numbers where comparing floats takes another instruction to
/// fetch the answer. Of magnitudes NaN is larger than all numbers.
template <class Real>
inline Real magnitude_key(Real value) {
    return absolute(value);
}
template <class Real>
inline Real magnitude_of_key(Real key) {
    return key;
}
template <class Real>
inline Real bound_key(Real value) {
    return value;
}
inline std::uint32_t magnitude_key(float value) { return of_bits<std::uint32_t>(value) << 1U; }
inline std::uint64_t magnitude_key(double value) { return of_bits<std::uint64_t>(value) << 1U; }
inline float magnitude_of_key(std::uint32_t key) { return of_bits<float>(key >> 1U); }
inline double magnitude_of_key(std::uint64_t key) { return of_bits<double>(key >> 1U); }
inline std::int32_t bound_key(float value) { return of_bits<std::int32_t>(value); }
inline float of_bound_key(std::int32_t key) { return of_bits<float>(key); }

template <class Real>
inline bool is_zero(Real value) {
    return magnitude_key(value) == magnitude_key(Real(0));
}
/// Of numbers that are not NaN.
template <class Real>
inline bool is_positive(Real value) {
    return bound_key(value) > bound_key(Real(0));
}

/// Of a number that is 0, either.
template <class Real>
inline bool have_unlike_signs(Real a, Real b) {
    return (a < Real(0)) != (b < Real(0));
}
inline bool have_unlike_signs(float a, float b) {
    return (bound_key(a) ^ bound_key(b)) < 0;
}

/// Of such keys, low ≤ key ≤ high, where low and high are not negative.
template <class Key>
inline bool is_between(Key key, Key low, Key high) {
    return low <= key && key <= high;
}
inline bool is_between(std::int32_t key, std::int32_t low, std::int32_t high) {
    return static_cast<std::uint32_t>(key) - static_cast<std::uint32_t>(low) <=
           static_cast<std::uint32_t>(high) - static_cast<std::uint32_t>(low);
}

/// Largest integer not above the value; |value| < 2^31.
template <class Real>
inline std::int32_t floor_to_int(Real value) {
    const std::int32_t whole = static_cast<std::int32_t>(value);
    return static_cast<Real>(whole) > value ? whole - 1 : whole;
}

/// Smallest integer not below the value; |value| < 2^31.
template <class Real>
inline std::int32_t ceil_to_int(Real value) {
    return -floor_to_int(-value);
}

/// Correctly rounded square root; the argument is not negative. On processors without one it is
/// computed in integers, to the same bits (square_root.cpp).
float square_root_in_integers(float value);
double square_root_in_integers(double value);

inline float square_root(float value) {
#if WEIR_INTRINSIC_ROOTS
    return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value)));
#elif !WEIR_GNU_COMPILER
    return square_root_in_integers(value);
#elif defined(__SSE2__) || defined(__aarch64__) || defined(__wasm__) || \
    (defined(__ARM_FP) && (__ARM_FP & 4))
    return __builtin_sqrtf(value);
#else
    return square_root_in_integers(value);
#endif
}
inline double square_root(double value) {
#if WEIR_INTRINSIC_ROOTS
    return _mm_cvtsd_f64(_mm_sqrt_sd(_mm_set_sd(0.0), _mm_set_sd(value)));
#elif !WEIR_GNU_COMPILER
    return square_root_in_integers(value);
#elif defined(__SSE2__) || defined(__aarch64__) || defined(__wasm__) || \
    (defined(__ARM_FP) && (__ARM_FP & 8))
    return __builtin_sqrt(value);
#else
    return square_root_in_integers(value);
#endif
}

}  // namespace weir
