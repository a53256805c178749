// Quotients for processors that divide in eighty instructions.
#pragma once

#include <cstdint>

#include "base/compiler.hpp"

namespace weir {

/// By the upper byte of a divisor of 16 bits: 2^16 / (byte + 1), cut off, where its top bit is set,
/// and elsewhere how many digits it is too short.
struct ShortInverses {
    constexpr ShortInverses() {
        for (std::uint32_t n = 128; n < 256; ++n) {
            of[n] = static_cast<std::uint16_t>(0x10000U / (n + 1));
        }
        for (std::uint32_t n = 127; n > 0; --n) {
            of[n] = static_cast<std::uint16_t>(n < 64 ? of[2 * n] + 1 : 1);
        }
    }
    std::uint16_t of[256] = {};
};
inline constexpr ShortInverses kShortInverses;

/// 2^16 / n, cut off, for n = 1 … 128.
struct SmallInverses {
    constexpr SmallInverses() {
        for (std::uint32_t n = 1; n <= 128; ++n) {
            of[n] = static_cast<std::uint16_t>(n == 1 ? 0xFFFFU : 0x10000U / n);
        }
    }
    std::uint16_t of[129] = {};
};
inline constexpr SmallInverses kSmallInverses;

/// `size` / `divisor`, cut off, for sizes up to 2^15 and divisors of 1 … 128.
inline std::uint32_t small_quotient(std::uint32_t size, std::uint32_t divisor) {
    const std::uint32_t quotient = (size * kSmallInverses.of[divisor]) >> 16U;  // or one too small
    return quotient + (size - quotient * divisor >= divisor ? 1U : 0U);
}

/// The same on any processor.
inline std::uint32_t small_quotient_of(std::uint32_t size, std::uint32_t divisor) {
#if defined(WEIR_SHORT_PRODUCTS)
    return small_quotient(size, divisor);
#else
    return size / divisor;
#endif
}

/// `size` / `divisor`, cut off, for divisors below 2^16 and quotients below 2^15: seven digits at
/// once, twice, and what is then missing, at most three.
inline std::uint32_t short_quotient(std::uint32_t size, std::uint32_t divisor) {
    if (divisor < 0x100U) {
        size <<= 8U;
        divisor <<= 8U;
    }
    std::uint32_t inverse = kShortInverses.of[divisor >> 8U];
    if (divisor < 0x8000U) {
        size <<= inverse;
        divisor <<= inverse;
        inverse = kShortInverses.of[divisor >> 8U];
    }
    std::uint32_t quotient = ((size >> 16U) * inverse) >> 8U;
    std::uint32_t rest = size - quotient * divisor;
    const std::uint32_t more = ((rest >> 8U) * inverse) >> 16U;
    quotient += more;
    rest -= more * divisor;
    for (; rest >= divisor; rest -= divisor) {
        ++quotient;
    }
    return quotient;
}

/// Whether that is so.
inline bool is_short(std::uint32_t size, std::uint32_t divisor) {
    return divisor < 0x10000U && (size >> 15U) < divisor;
}

/// The same on any processor, of any quotient.
inline std::uint32_t quotient_of(std::uint32_t size, std::uint32_t divisor) {
#if defined(WEIR_SHORT_PRODUCTS)
    if (is_short(size, divisor)) {
        return short_quotient(size, divisor);
    }
#endif
    return size / divisor;
}

}  // namespace weir
