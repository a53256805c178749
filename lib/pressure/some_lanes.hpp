// Some lanes of a group: the others lie beyond an end of a row, or are done.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// 1 from the ninth on. Not inline: a file compiled for AVX2 gives others nothing.
constexpr float kFromNinth[] = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F,
                                1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};

/// Lanes from the `k`-th of eight on.
template <class L>
inline auto lanes_from(std::int32_t k) {
    return L::load(kFromNinth + 8 - k) > L::all(0.0F);
}

/// Nine faces of which the first, or the last, is a wall. Not inline: a file compiled for AVX2
/// gives others nothing.
constexpr float kFirstClosed[] = {0.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
constexpr float kLastClosed[] = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 0.0F};

/// 1 for each face before some cells within the tank, and 0 if the first one is its wall.
template <class L>
inline auto open_before(bool wall) {
    return L::load(kFirstClosed + (wall ? 0 : 1));
}

/// The same for the faces behind them; the last one may be a wall.
template <class L>
inline auto open_behind(bool wall) {
    return L::load(kLastClosed + (wall ? 9 - L::kLanes : 0));
}

#endif

}  // namespace weir
