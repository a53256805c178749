// Stage of the decomposition: joins holes to the outer ring, after Eberly 2002, "Triangulation by
// ear clipping", section 5.
#pragma once

#include "geometry/corner_ring.hpp"

namespace weir {

/// Corners of an outline once its holes are joined: two more for each bridge.
template <class Real>
std::int32_t corner_count(const Outline<Real>& outline) {
    return outline.count + 2 * (outline.rings - 1);
}

/// Writes the corners' sequence. Cost: holes × corners.
/// @param links scratch, 2 a corner.
/// @param scratch 3 a hole.
/// @param sequence one a corner.
/// @return false if a hole sees nothing to be joined to: it is not inside.
template <class Real>
bool join_holes(const Outline<Real>& outline, CornerLinks links, ArrayView<std::uint16_t> scratch,
                ArrayView<std::uint16_t> sequence);

}  // namespace weir
