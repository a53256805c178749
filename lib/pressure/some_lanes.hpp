// Some lanes of a group: the others lie beyond an end of a row, or are done.
#pragma once

#include "math/four_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// 1 for the second sixteen. Not inline: a file compiled for more lanes gives others nothing.
constexpr float kSecondHalf[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

/// Lanes from the `k`-th on, of sixteen at most.
template <class L>
inline auto lanes_from(std::int32_t k) {
    return L::load(kSecondHalf + 16 - k) > L::all(0.0F);
}

/// Seventeen faces of which the first, or the last, is a wall. Not inline, as above.
constexpr float kFirstClosed[] = {0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
constexpr float kLastClosed[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0};

/// 1 for each face before some cells within the tank, and 0 if the first one is its wall.
template <class L>
inline auto open_before(bool wall) {
    return L::load(kFirstClosed + (wall ? 0 : 1));
}

/// The same for the faces behind them; the last one may be a wall.
template <class L>
inline auto open_behind(bool wall) {
    return L::load(kLastClosed + (wall ? 17 - L::kLanes : 0));
}

#endif

}  // namespace weir
