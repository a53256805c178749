// Lowest and highest of particles' places, two a group of four lanes.
#pragma once

#include "fluid/particles.hpp"
#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Two of each kind: one waits for itself.
template <class L>
inline Extent<float> extent_in_lanes(const Vec2<float>* places, std::int32_t count) {
    constexpr std::int32_t kTwice = 4 * L::kGroups;  // places in two loads
    const auto at = [&](std::int32_t k) { return L::load(&places->x + 2 * k); };
    const auto alone = [&](std::int32_t k) {
        return L::repeat(places[k].x, places[k].y, places[k].x, places[k].y);
    };
    auto low_a = alone(0);
    auto low_b = low_a;
    auto high_a = low_a;
    auto high_b = low_a;
    std::int32_t k = 0;
    for (; k + kTwice <= count; k += kTwice) {
        const auto a = at(k);
        const auto b = at(k + kTwice / 2);
        low_a = L::minimum(low_a, a);
        low_b = L::minimum(low_b, b);
        high_a = L::maximum(high_a, a);
        high_b = L::maximum(high_b, b);
    }
    for (; k < count; ++k) {
        low_a = L::minimum(low_a, alone(k));
        high_a = L::maximum(high_a, alone(k));
    }
    low_a = L::minimum(low_a, low_b);
    high_a = L::maximum(high_a, high_b);
    auto low = L::template group<0>(low_a);
    auto high = L::template group<0>(high_a);
    const auto add = [&](auto lower, auto higher) {
        low = lower < low ? lower : low;
        high = high < higher ? higher : high;
    };
    L::each_group([&](auto group) {
        add(L::template group<group>(low_a), L::template group<group>(high_a));
    });
    add(__builtin_shufflevector(low, low, 2, 3, 2, 3),
        __builtin_shufflevector(high, high, 2, 3, 2, 3));
    return {{low[0], low[1]}, {high[0], high[1]}};
}

#if WEIR_HAS_WIDE_LANES
Extent<float> extent_in_wide_lanes(const Vec2<float>* places, std::int32_t count);
#endif

/// Of one place at least.
inline Extent<float> extent_of_places(const Vec2<float>* places, std::int32_t count) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        return extent_in_wide_lanes(places, count);
    }
#endif
    return extent_in_lanes<FourLanes>(places, count);
}

#endif

}  // namespace weir
