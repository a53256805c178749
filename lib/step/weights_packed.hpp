// What the four faces around a packed particle get and give, a component at a time.
#pragma once

#include "step/places_packed.hpp"

namespace weir::packed {

#if defined(__ARM_FEATURE_SIMD32)
/// Two of 16 bits a word, as products want them: those of lower and of upper faces.
struct WeightPairs {
    std::uint32_t lower;
    std::uint32_t upper;
};

inline WeightPairs weights_at(std::uint32_t at) {
    const auto fx = static_cast<std::uint32_t>(low_byte(at));
    const auto fy = static_cast<std::uint32_t>(low_byte(at >> 16U));
    const std::uint32_t both = fx * fy + 128U;  // 256ths of the weight
    std::uint32_t upper;
    __asm__("pkhbt %0, %1, %2, lsl #8" : "=r"(upper) : "r"(fy - (both >> 8U)), "r"(both));
    return {256U + (fx << 16U) - fx - upper, upper};  // all four add up to 256
}
inline std::uint32_t lower_pair(const WeightPairs& w) {
    return w.lower;
}
inline std::uint32_t upper_pair(const WeightPairs& w) {
    return w.upper;
}

/// Of a field in 128ths, 2^−15.
inline std::int32_t weighed(const Speed* low, const Speed* high, const WeightPairs& w) {
    const auto velocities = [](const Speed* at) {
        std::int32_t two = 0;
        WEIR_COPY_BYTES(&two, at, sizeof two);
        return two;
    };
    const std::int32_t below =
        __builtin_arm_smuad(velocities(low), static_cast<std::int32_t>(w.lower));
    return __builtin_arm_smlad(velocities(high), static_cast<std::int32_t>(w.upper), below);
}

/// Adds to the momenta of two faces, 512ths.
inline void add_momenta(Real* at, std::uint32_t weights, std::int32_t velocity) {
    at = whole(at);
    std::int32_t left = at[0].raw;
    std::int32_t right = at[1].raw;
    __asm__("" : "+r"(left), "+r"(right));  // both are loaded and stored at once
    const auto four = static_cast<std::int32_t>(4U * weights);
    left = __builtin_arm_smlabb(four, velocity, left);
    right = __builtin_arm_smlatb(four, velocity, right);
    __asm__("" : "+r"(left), "+r"(right));
    at[0].raw = left;
    at[1].raw = right;
}
inline void add_momenta(Real* low, Real* high, const WeightPairs& w, std::int32_t velocity) {
    add_momenta(low, w.lower, velocity);
    add_momenta(high, w.upper, velocity);
}
#else
inline Weights weights_at(std::uint32_t at) {
    return weights_of(at);
}

inline std::int32_t weighed(const Speed* low, const Speed* high, const Weights& w) {
    std::int32_t sum = w.lower_left * low[0].raw;
    sum += w.lower_right * low[1].raw;
    high = whole(high);
    sum += w.upper_left * high[0].raw;
    sum += w.upper_right * high[1].raw;
    return sum;
}

#if !defined(WEIR_LOOPS_OF_M0)  // which scatters in a loop of its own
inline std::uint32_t lower_pair(const Weights& w) {
    return static_cast<std::uint32_t>(w.lower_left + w.lower_right * 0x10000);
}
inline std::uint32_t upper_pair(const Weights& w) {
    return static_cast<std::uint32_t>(w.upper_left + w.upper_right * 0x10000);
}

inline void add_momenta(Real* low, Real* high, const Weights& w, std::int32_t velocity) {
    const std::int32_t v = velocity * 4;  // 512ths
    add_two(low, w.lower_left * v, w.lower_right * v);
    add_two(high, w.upper_left * v, w.upper_right * v);
}
#endif
#endif

#if !defined(WEIR_LOOPS_OF_M0)
/// Mass of 32 particles: 8 times what a full cell's faces hold.
inline constexpr std::uint32_t kFull = 0x2000;

#if !defined(__ARM_FEATURE_UNALIGNED) || !defined(__ARMEL__)
/// Of a mass, which is not negative. (Of signed numbers a Cortex-M0 loads none at a fixed place.)
inline std::uint32_t raw_of(const Speed& mass) {
    return reinterpret_cast<const std::uint16_t&>(mass.raw);
}
#endif

/// Adds to the masses of four faces. False: one of them is full.
template <class Weighing>
inline bool add_masses(Speed* low, Speed* high, const Weighing& w) {
#if defined(__ARM_FEATURE_UNALIGNED) && defined(__ARMEL__)
    // Two in a word: they are not negative, and the sums have room.
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;
    WEIR_COPY_BYTES(&lower, low, sizeof lower);
    WEIR_COPY_BYTES(&upper, high, sizeof upper);
    if (((lower | upper) & (0x10000U - kFull) * 0x10001U) != 0) {
        return false;
    }
    lower += lower_pair(w);
    upper += upper_pair(w);
    WEIR_COPY_BYTES(static_cast<void*>(low), &lower, sizeof lower);
    WEIR_COPY_BYTES(static_cast<void*>(high), &upper, sizeof upper);
#else
    // Looked at and read again: to keep four wants more registers than there are.
    const auto add = [](Speed& mass, std::int32_t more) {
        mass.raw = static_cast<std::int16_t>(static_cast<std::int32_t>(raw_of(mass)) + more);
    };
    const std::uint32_t lower = raw_of(low[0]) | raw_of(low[1]);
    if ((lower | raw_of(high[0]) | raw_of(high[1])) >= kept(kFull)) {
        return false;
    }
    add(low[0], w.lower_left);
    add(low[1], w.lower_right);
    add(high[0], w.upper_left);
    add(high[1], w.upper_right);
#endif
    return true;
}
#endif

}  // namespace weir::packed
