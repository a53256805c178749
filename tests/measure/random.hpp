// Random numbers that are the same everywhere.
#pragma once

#include <cstdint>

namespace measure {

/// SplitMix64 (Steele, Lea & Flood 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }
    /// From low to high.
    float uniform(float low, float high) {
        const auto unit = static_cast<float>(bits() >> 40U) * (1.0F / 16777216.0F);
        return low + unit * (high - low);
    }
    /// 0 … end − 1.
    std::int32_t below(std::int32_t end) {
        return static_cast<std::int32_t>(bits() % static_cast<std::uint64_t>(end));
    }
    /// low … high, both included.
    std::int32_t integer(std::int32_t low, std::int32_t high) {
        return low + below(high - low + 1);
    }
    bool chance(float probability) { return uniform(0.0F, 1.0F) < probability; }
    template <class T, int Count>
    T one_of(const T (&choices)[Count]) {
        return choices[below(Count)];
    }

private:
    std::uint64_t state_;
};

}  // namespace measure
