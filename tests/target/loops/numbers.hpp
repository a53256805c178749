// The same numbers on every machine.
#pragma once

#include <cstdint>

/// Of all sizes up to so many bits (xorshift, Marsaglia 2003).
class Numbers {
public:
    std::uint32_t word() {
        state_ ^= state_ << 13U;
        state_ ^= state_ >> 17U;
        state_ ^= state_ << 5U;
        return state_;
    }
    std::int32_t size(std::uint32_t bits) {
        const std::uint32_t mask = (1U << (1U + word() % bits)) - 1U;
        return static_cast<std::int32_t>(word() & mask);
    }
    std::int32_t either(std::uint32_t bits) {
        const std::int32_t value = size(bits);
        return word() % 2U == 0 ? value : -1 - value;
    }

private:
    std::uint32_t state_ = 2463534242U;
};
