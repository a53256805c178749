// Lowest and highest places of particles, two a group of four lanes.
#pragma once

#include <cstdint>

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Of places in each group of lanes: x, y, x, y. `particles` is a multiple of 4 · kGroups, and not
/// 0. Two of each kind: one waits for itself.
template <class L>
inline void find_extremes(const float* position, std::int32_t particles, float* low,
                          float* high) {
    constexpr std::int32_t kStep = 4 * L::kGroups;
    auto low_a = L::load(position);
    auto low_b = low_a;
    auto high_a = low_a;
    auto high_b = low_a;
    for (std::int32_t k = 0; k < particles; k += kStep) {
        const auto a = L::load(position + 2 * k);
        const auto b = L::load(position + 2 * k + kStep);
        low_a = L::minimum(low_a, a);
        low_b = L::minimum(low_b, b);
        high_a = L::maximum(high_a, a);
        high_b = L::maximum(high_b, b);
    }
    L::store(low, L::minimum(low_a, low_b));
    L::store(high, L::maximum(high_a, high_b));
}

#if WEIR_HAS_WIDE_LANES
void find_extremes_wide(const float* position, std::int32_t particles, float* low, float* high);
#endif

#endif

}  // namespace weir
