// Sums of products of 32 bits.
#pragma once

#include "math/packed_arithmetic.hpp"

namespace weir {

/// A sum of up to 2^16 products of 32 bits.
#if defined(WEIR_SHORT_PRODUCTS)
/// In two halves: a Cortex-M0 adds 64 bits out of its memory.
struct SumOfProducts {
    std::int32_t high = 0;
    std::uint32_t low = 0;

    void add(std::int32_t a, std::int32_t b) {
        const std::int32_t product = a * b;
        add_aside(high, product >> 16);
        add_aside<std::uint32_t>(low, static_cast<std::uint16_t>(product));
    }
    std::int64_t whole() const { return std::int64_t{high} * 0x10000 + low; }
};
#else
struct SumOfProducts {
    std::int64_t sum = 0;

    void add(std::int32_t a, std::int32_t b) { sum += std::int64_t{a} * b; }
    std::int64_t whole() const { return sum; }
};
#endif

}  // namespace weir
