// Quotients for processors that divide in eighty instructions.
#pragma once

#include <cstdint>

namespace weir {

/// 2^16 / n, cut off, for n = 129 … 256.
struct ShortInverses {
    constexpr ShortInverses() {
        for (std::uint32_t n = 129; n <= 256; ++n) {
            of[n - 129] = static_cast<std::uint16_t>(0x10000U / n);
        }
    }
    std::uint16_t of[128] = {};
};
inline constexpr ShortInverses kShortInverses;

/// `size` / `divisor`, cut off, for divisors below 2^16 and quotients below 2^15: seven digits at
/// once, twice, and what is then missing, at most three.
inline std::uint32_t short_quotient(std::uint32_t size, std::uint32_t divisor) {
    for (; divisor < 0x400U; divisor <<= 6U) {
        size <<= 6U;
    }
    if (divisor < 0x2000U) {
        size <<= 3U;
        divisor <<= 3U;
    }
    for (; divisor < 0x8000U; divisor <<= 1U) {
        size <<= 1U;
    }
    const std::uint32_t inverse = kShortInverses.of[(divisor >> 8U) - 128U];
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

/// The same on any processor, of any quotient.
inline std::uint32_t quotient_of(std::uint32_t size, std::uint32_t divisor) {
#if defined(__ARM_ARCH_6M__)
    if (divisor < 0x10000U && (size >> 15U) < divisor) {
        return short_quotient(size, divisor);
    }
#endif
    return size / divisor;
}

}  // namespace weir
