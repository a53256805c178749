// Whole-number arithmetic that the packed stages share: products of 32 bits, shifts, no division.
#pragma once

#include "math/scalar.hpp"

namespace weir {

/// value · 2^−shift, rounded to nearest, ties away from zero: mirrored scenes stay mirrored.
inline std::int32_t rounded_shift(std::int32_t value, int shift) {
    return (value + (1 << (shift - 1)) + (value >> 31)) >> shift;
}

/// As a number of so many bits.
template <int Bits>
inline std::int32_t saturated(std::int32_t value) {
#if defined(__ARM_FEATURE_SAT)
    return __builtin_arm_ssat(value, Bits);
#else
    const std::int32_t sign = value >> 31;
    return value >> (Bits - 1) == sign ? value : sign ^ ((1 << (Bits - 1)) - 1);
#endif
}
inline std::int16_t short_of(std::int32_t value) {
    return static_cast<std::int16_t>(saturated<16>(value));
}

/// Factor, in 128ths, times value; |factor| < 2^15. In two halves where the product is too long.
inline std::int32_t scaled(std::int32_t factor, std::int32_t value) {
    const std::int32_t high = value >> 14;
    const std::int32_t low = value & 0x3FFF;
    const std::int32_t most = 0x7FFFFFFF >> 7;
    const std::int32_t part = clamp(high * factor, -most, most - 0x4000);
    return part * 128 + ((low * factor) >> 7);
}

/// So many bits that are as good as random, out of a number whose last places change all the time:
/// added before digits are cut off, they make what is rounded right on average. Rounded to the
/// nearest, everything below half a unit a step would stand still. What stands still stays so.
inline std::int32_t chance(std::int32_t number, int bits) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(number) * 0x9E3779B1U >>
                                     (32 - bits));
}

}  // namespace weir
