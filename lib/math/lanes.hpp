// Four floats side by side, where the processor has registers for them (SSE2, NEON, WebAssembly).
// Lane by lane + − × are the plain ones, so that a loop in lanes gives the plain loop's bits. NEON
// of 32-bit Arm flushes denormals: not there.
#pragma once

#include "math/scalar.hpp"

#if (defined(__SSE2__) || defined(__aarch64__) || defined(__wasm_simd128__)) && \
    !defined(WEIR_PLAIN_LOOPS) && WEIR_GNU_COMPILER && (defined(__clang__) || __GNUC__ >= 12)
#define WEIR_HAS_LANES 1
#else
#define WEIR_HAS_LANES 0
#endif

namespace weir {

/// Whether loops over this scalar have a version in lanes.
template <class Real>
inline constexpr bool kHasLanes = false;

#if WEIR_HAS_LANES
template <>
inline constexpr bool kHasLanes<float> = true;

using Lanes = float __attribute__((vector_size(16)));
using LaneMask = std::int32_t __attribute__((vector_size(16)));

/// From any address, in order.
inline Lanes load_lanes(const float* from) {
    Lanes lanes;
    __builtin_memcpy(&lanes, from, sizeof lanes);
    return lanes;
}
inline void store_lanes(float* to, Lanes lanes) {
    __builtin_memcpy(to, &lanes, sizeof lanes);
}
/// Two floats, lanes 0 and 1.
inline Lanes load_pair(const float* from) {
    using Halves = double __attribute__((vector_size(16)));
    double both;
    __builtin_memcpy(&both, from, sizeof both);
    return reinterpret_cast<Lanes>(Halves{both, 0.0});
}
inline Lanes all_lanes(float value) {
    return Lanes{value, value, value, value};
}
/// Lanes chosen from a (0 … 3) and b (4 … 7).
template <int I, int J, int K, int L>
inline Lanes shuffle(Lanes a, Lanes b) {
    return __builtin_shufflevector(a, b, I, J, K, L);
}

/// Every second of eight numbers, from the first one on and from the second one on.
struct EvenOdd {
    Lanes even;
    Lanes odd;
};
inline EvenOdd load_eight(const float* from) {
    const Lanes a = load_lanes(from);
    const Lanes b = load_lanes(from + 4);
    return {shuffle<0, 2, 4, 6>(a, b), shuffle<1, 3, 5, 7>(a, b)};
}

/// Two times two numbers at each of four places.
struct Squares {
    Lanes low_left;
    Lanes low_right;
    Lanes high_left;
    Lanes high_right;
};
/// From two rows, of which either may lie anywhere.
template <class Place>
inline Squares squares_at(const float* low, const float* high, const Place* at) {
    const auto both = [&](std::int32_t k) {
        return shuffle<0, 1, 4, 5>(load_pair(low + at[k]), load_pair(high + at[k]));
    };
    const Lanes a = shuffle<0, 4, 1, 5>(both(0), both(1));
    const Lanes b = shuffle<2, 6, 3, 7>(both(0), both(1));
    const Lanes c = shuffle<0, 4, 1, 5>(both(2), both(3));
    const Lanes d = shuffle<2, 6, 3, 7>(both(2), both(3));
    return {shuffle<0, 1, 4, 5>(a, c), shuffle<2, 3, 6, 7>(a, c), shuffle<0, 1, 4, 5>(b, d),
            shuffle<2, 3, 6, 7>(b, d)};
}

inline bool all_true(LaneMask mask) {
#if defined(__SSE2__)
    Lanes signs;
    __builtin_memcpy(&signs, &mask, sizeof signs);
    return __builtin_ia32_movmskps(signs) == 0xF;
#else
    return (mask[0] & mask[1] & mask[2] & mask[3]) != 0;
#endif
}
inline bool any_true(LaneMask mask) {
#if defined(__SSE2__)
    Lanes signs;
    __builtin_memcpy(&signs, &mask, sizeof signs);
    return __builtin_ia32_movmskps(signs) != 0;
#else
    return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}
/// A bit for each lane that is true, the lowest for lane 0.
inline std::uint32_t bits_of(LaneMask mask) {
#if defined(__SSE2__)
    Lanes signs;
    __builtin_memcpy(&signs, &mask, sizeof signs);
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps(signs));
#else
    return (static_cast<std::uint32_t>(mask[0]) & 1U) | (static_cast<std::uint32_t>(mask[1]) & 2U) |
           (static_cast<std::uint32_t>(mask[2]) & 4U) | (static_cast<std::uint32_t>(mask[3]) & 8U);
#endif
}
/// Whether any lane has its sign set; a negative zero may count as one.
inline bool any_negative(Lanes a) {
#if defined(__SSE2__)
    return __builtin_ia32_movmskps(a) != 0;
#else
    return a[0] < 0.0F || a[1] < 0.0F || a[2] < 0.0F || a[3] < 0.0F;
#endif
}
inline Lanes maximum(Lanes a, Lanes b) {
    return a < b ? b : a;
}
inline Lanes minimum(Lanes a, Lanes b) {
    return b < a ? b : a;
}
inline Lanes clamp(Lanes value, Lanes low, Lanes high) {
    return value < low ? low : (high < value ? high : value);
}
inline Lanes square_root(Lanes a) {
#if defined(__SSE2__)
    return __builtin_ia32_sqrtps(a);
#else
    return Lanes{square_root(a[0]), square_root(a[1]), square_root(a[2]), square_root(a[3])};
#endif
}
inline Lanes absolute(Lanes a) {
    LaneMask bits;
    __builtin_memcpy(&bits, &a, sizeof bits);
    bits &= LaneMask{0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF};
    __builtin_memcpy(&a, &bits, sizeof a);
    return a;
}
#endif

}  // namespace weir
