// What compilers have beside standard C++17, under one name each: g++ and clang++ make an
// instruction of it, and for all others (MSVC) it is written out. -DWEIR_PLAIN_COMPILER takes a g++
// or clang++ for one of those others: so the tests run what these get.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "weir/inline.hpp"

#if (defined(__GNUC__) || defined(__clang__)) && !defined(WEIR_PLAIN_COMPILER)
#define WEIR_GNU_COMPILER 1
#else
#define WEIR_GNU_COMPILER 0
#endif

/// Whether square roots are asked for as Intel's manual names them.
#if !WEIR_GNU_COMPILER && (defined(_M_X64) || defined(__x86_64__)) && !defined(_M_ARM64EC)
#include <emmintrin.h>
#define WEIR_INTRINSIC_ROOTS 1
#else
#define WEIR_INTRINSIC_ROOTS 0
#endif

/// A member that takes no room if it is empty. Microsoft's have another attribute for it, which
/// older ones of them and of clang do not know: there it takes some.
#if defined(_MSC_VER)
#define WEIR_NO_UNIQUE_ADDRESS
#else
#define WEIR_NO_UNIQUE_ADDRESS [[no_unique_address]]
#endif

/// Copies and compares bytes in place: a freestanding std::memcpy is a call.
#if WEIR_GNU_COMPILER
#define WEIR_COPY_BYTES __builtin_memcpy
#define WEIR_COMPARE_BYTES __builtin_memcmp
#else
#define WEIR_COPY_BYTES std::memcpy
#define WEIR_COMPARE_BYTES std::memcmp
#endif

/// Zeros above the highest and below the lowest bit of a number that is not 0.
#if WEIR_GNU_COMPILER
#define WEIR_LEADING_ZEROS __builtin_clz
#define WEIR_TRAILING_ZEROS __builtin_ctz
#else
#define WEIR_LEADING_ZEROS weir::leading_zeros
#define WEIR_TRAILING_ZEROS weir::trailing_zeros
#endif

/// Processors that multiply into 32 bits and divide in software: a Cortex-M0, and an LX106.
/// (Xtensas whose calls have windows make 64, and divide.)
#if defined(__ARM_ARCH_6M__) || defined(__XTENSA_CALL0_ABI__)
#define WEIR_SHORT_PRODUCTS
#endif

/// A condition that seldom holds.
#if WEIR_GNU_COMPILER
#define WEIR_SELDOM(condition) __builtin_expect(condition, 0)
#else
#define WEIR_SELDOM(condition) (condition)
#endif

namespace weir {

/// The order of bytes in words: Windows has no other.
#if defined(__BYTE_ORDER__)
inline constexpr bool kLittleEndian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
#elif defined(_MSC_VER)
inline constexpr bool kLittleEndian = true;
#else
#error "weir does not know this compiler's order of bytes: say it here"
#endif

#if WEIR_GNU_COMPILER

/// The sum or difference as far as it fits; true if it does not.
template <class Whole>
WEIR_ALWAYS_INLINE bool add_overflows(Whole a, Whole b, Whole* sum) {
    return __builtin_add_overflow(a, b, sum);
}
template <class Whole>
WEIR_ALWAYS_INLINE bool subtract_overflows(Whole a, Whole b, Whole* difference) {
    return __builtin_sub_overflow(a, b, difference);
}

inline float magnitude_of(float value) {
    return __builtin_fabsf(value);
}
inline double magnitude_of(double value) {
    return __builtin_fabs(value);
}

/// A pointer, or a number that counts, which the compiler knows nothing about: it can neither be
/// taken apart nor replaced by others that count along with it.
template <class Number>
inline Number whole(Number number) {
    __asm__("" : "+r"(number));
    return number;
}

/// Told that two numbers are in registers together, compilers see that a processor that can loads
/// or stores both at once.
template <class Number>
inline void together(Number& one, Number& other) {
    __asm__("" : "+r"(one), "+r"(other));
}

/// A place whose address is a multiple of four.
WEIR_ALWAYS_INLINE const void* aligned_to_four(const void* place) {
    return __builtin_assume_aligned(place, 4);
}
WEIR_ALWAYS_INLINE void* aligned_to_four(void* place) {
    return __builtin_assume_aligned(place, 4);
}

#else

constexpr int leading_zeros(std::uint32_t number) {
    int zeros = 31;
    for (unsigned step = 16; step != 0; step /= 2) {
        const std::uint32_t upper = number >> step;
        zeros -= upper != 0 ? static_cast<int>(step) : 0;
        number = upper != 0 ? upper : number;
    }
    return zeros;
}
constexpr int trailing_zeros(std::uint32_t number) {
    return 31 - leading_zeros(number & (0U - number));
}

// Signs tell: of a sum where it differs from both, of a difference where it differs from the first
// number's and that from the second's.
template <class Whole>
constexpr bool add_overflows(Whole a, Whole b, Whole* sum) {
    using Bits = std::make_unsigned_t<Whole>;
    *sum = static_cast<Whole>(static_cast<Bits>(a) + static_cast<Bits>(b));
    if constexpr (std::is_signed<Whole>::value) {
        return ((a ^ *sum) & (b ^ *sum)) < 0;
    } else {
        return *sum < a;
    }
}
template <class Whole>
constexpr bool subtract_overflows(Whole a, Whole b, Whole* difference) {
    using Bits = std::make_unsigned_t<Whole>;
    static_assert(std::is_signed<Whole>::value);
    *difference = static_cast<Whole>(static_cast<Bits>(a) - static_cast<Bits>(b));
    return ((a ^ b) & (a ^ *difference)) < 0;
}

// Without a branch; of −0 it is 0.
template <class Bits, class Number>
inline Number without_sign(Number value) {
    Bits bits = 0;
    std::memcpy(&bits, &value, sizeof value);
    bits &= static_cast<Bits>(-1) >> 1U;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}
inline float magnitude_of(float value) {
    return without_sign<std::uint32_t>(value);
}
inline double magnitude_of(double value) {
    return without_sign<std::uint64_t>(value);
}

template <class Number>
inline Number whole(Number number) {
    return number;
}
template <class Number>
inline void together(Number&, Number&) {}
inline const void* aligned_to_four(const void* place) {
    return place;
}
inline void* aligned_to_four(void* place) {
    return place;
}

#endif

}  // namespace weir
