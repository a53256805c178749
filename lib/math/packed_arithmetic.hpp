// Whole-number arithmetic that the packed stages share: products of 32 bits, shifts, no division.
#pragma once

#include "math/scalar.hpp"

/// Loops in assembly want all registers of a Cortex-M0. Compilers keep some of them without
/// optimisation, for small code (the upper ones) and for code that may stand anywhere: there plain
/// loops make the same bits.
#if defined(__ARM_ARCH_6M__) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && \
    !defined(__PIC__) && !defined(__clang__) && !defined(WEIR_PLAIN_LOOPS)
#define WEIR_LOOPS_OF_M0
#endif

namespace weir {

/// value · 2^−shift, rounded to nearest, ties away from zero: mirrored scenes stay mirrored.
inline std::int32_t rounded_shift(std::int32_t value, int shift) {
    return (value + (1 << (shift - 1)) + (value >> 31)) >> shift;
}

/// A number that stays in a register, for processors that make it in several instructions.
template <class Number>
inline Number kept(Number number) {
#if defined(__ARM_ARCH_6M__)
    return whole(number);
#else
    return number;
#endif
}

/// A number that is added to a product, for processors that do so in one instruction.
inline std::int32_t beside_product(std::int32_t number) {
#if defined(__ARM_ARCH_6M__)
    return number;
#else
    return whole(number);
#endif
}

/// Adds to a sum that stays in one of those registers of a Cortex-M0 that can only be added to.
template <class Number>
inline void add_aside(Number& sum, Number term) {
#if defined(__ARM_ARCH_6M__)
    __asm__("add %0, %1" : "+h"(sum) : "r"(term));
#else
    sum += term;
#endif
}

/// As a number of so many bits.
template <int Bits>
inline std::int32_t saturated(std::int32_t value) {
#if defined(__ARM_FEATURE_SAT)
    return __builtin_arm_ssat(value, Bits);
#else
    const std::uint32_t shifted = static_cast<std::uint32_t>(value) << (32 - Bits);
    const std::int32_t cut = Bits == 16 ? static_cast<std::int16_t>(value)
                                        : static_cast<std::int32_t>(shifted) >> (32 - Bits);
    if (WEIR_SELDOM(cut != value)) {  // most are one
        return (value >> 31) ^ ((1 << (Bits - 1)) - 1);
    }
    return value;
#endif
}
inline std::int16_t short_of(std::int32_t value) {
    return static_cast<std::int16_t>(saturated<16>(value));
}

/// Factor, in 128ths, times value; |factor| < 2^15. In two halves where the product is too long.
inline std::int32_t scaled(std::int32_t factor, std::int32_t value) {
    const std::int32_t high = clamp(value >> 14, -0xFFFF, 0xFFFF);
    const std::int32_t low = value & 0x3FFF;
    const std::int32_t most = (0x7FFFFFFF >> 7) - 0x8000;
    const std::int32_t part = clamp(high * factor, -most, most);
    return part * 128 + ((low * factor) >> 7);
}

/// Adds to two numbers side by side. Told what is in registers together, compilers see that a
/// processor that can loads and stores both at once.
inline void add_two(SmallFixed* at, std::int32_t first, std::int32_t second) {
#if defined(__thumb2__)
    at = whole(at);
    std::int32_t sum = at[0].raw;
    std::int32_t next = at[1].raw;
    __asm__("" : "+r"(sum), "+r"(next));
    sum += first;
    next += second;
    __asm__("" : "+r"(sum), "+r"(next));
    at[0].raw = sum;
    at[1].raw = next;
#else
    at[0].raw += first;
    at[1].raw += second;
#endif
}

/// The lowest byte. (Compilers for the Cortex-M0 make a mask of two instructions first.)
inline std::int32_t low_byte(std::uint32_t word) {
#if defined(__ARM_ARCH_6M__)
    std::int32_t byte;
    __asm__("uxtb %0, %1" : "=l"(byte) : "l"(word));
    return byte;
#else
    return static_cast<std::uint8_t>(word);
#endif
}

/// Two numbers of 16 bits side by side, as a word: of a place, x below.
inline std::uint32_t word_at(const void* place) {
    std::uint32_t word = 0;
    WEIR_COPY_BYTES(&word, aligned_to_four(place), sizeof word);
    return word;
}
inline void put_word(void* place, std::uint32_t word) {
    WEIR_COPY_BYTES(aligned_to_four(place), &word, sizeof word);
}

/// Of the golden ratio: a product with it shows in all places.
inline constexpr std::uint32_t kChance = 0x9E3779B1U;

/// So many bits that are as good as random, out of a number whose last places change all the time:
/// added before digits are cut off, they make what is rounded right on average. Rounded to the
/// nearest, everything below half a unit a step would stand still. What stands still stays so.
inline std::int32_t chance(std::int32_t number, int bits) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(number) * kept(kChance) >>
                                     (32 - bits));
}

}  // namespace weir
