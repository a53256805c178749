// Which neighbouring faces a thin wall parts.
#pragma once

#include "solid/thin_walls.hpp"

namespace weir {

/// Whether a thin wall stands between two neighbouring faces of a kind: one of the faces between
/// their cells is closed, or, one behind the other, one of them is hidden from the cell between.
template <class Real>
inline bool separated(const ThinWalls<Real>& thin, const GridShape& s, std::int32_t face,
                      std::int32_t neighbour, bool on_u) {
    const std::int32_t low = minimum(face, neighbour);
    const std::int32_t high = maximum(face, neighbour);
    const bool in_row = high - low == 1;
    if (in_row == on_u) {
        const std::uint32_t hidden = on_u ? kLeftUnseen : kLowerUnseen;
        const std::uint32_t hidden_before = on_u ? kLeftUnseenBefore : kLowerUnseenBefore;
        return (thin.mark[low] & hidden) != 0 || (thin.mark[high] & hidden_before) != 0;
    }
    const std::uint32_t closed = on_u ? kLowerClosed : kLeftClosed;
    const std::int32_t before = on_u ? 1 : s.stride;
    return ((thin.mark[high] | thin.mark[high - before]) & closed) != 0;
}

}  // namespace weir
