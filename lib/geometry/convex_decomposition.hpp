// A polygon, with holes or without, as a few convex pieces: ear clipping (Eberly 2002,
// "Triangulation by ear clipping"), then dropping the diagonals that no reflex corner needs
// (Hertel & Mehlhorn 1983, "Fast triangulation of simple polygons").
#pragma once

#include <cstdint>

#include "base/array_view.hpp"
#include "geometry/outline.hpp"
#include "weir/memory.hpp"

namespace weir {

/// Places in the pools that a body takes: a hole joins the outer ring by a bridge, which doubles
/// two corners, and one more keeps its end.
constexpr std::int32_t places_for(std::int32_t vertices, std::int32_t holes) {
    return vertices + kPlacesPerHole * holes;
}

/// Set-up: writes the polygon's convex pieces, each as its number of vertices, then those vertices'
/// numbers counter-clockwise. A convex ring gives one piece; vertices on a straight edge are fine.
/// Cost: `clip_ear`'s, and holes × corners for the bridges.
/// @param outline as `check_polygon` lets pass, turned so that the solid is to the left of every
///                edge; corners together at most kMaxBodyVertices. Where rounding has made it touch
///                itself, its flattest corners are cut off.
/// @param scratch kScratchPerVertex a place. @param pieces kPieceIndicesPerVertex · (corners - 2),
///                where a hole adds two corners to its own.
/// @return how much of `pieces` is used, or -1 if the outline encloses nothing on its left.
template <class Real>
std::int32_t decompose(const Outline<Real>& outline, ArrayView<std::uint16_t> scratch,
                       ArrayView<std::uint16_t> pieces);

/// Whether a list of that length, `at(k)` its entries, is one of pieces of an outline of that
/// many vertices, so that it can be gone through without leaving either.
template <class At>
bool pieces_fit(At at, std::int32_t length, std::int32_t vertices) {
    std::int32_t next = 0;
    while (next < length) {
        const std::int32_t end = next + 1 + at(next);
        if (end < next + 4 || end > length) {
            return false;
        }
        for (std::int32_t k = next + 1; k < end; ++k) {
            if (at(k) >= vertices) {
                return false;
            }
        }
        next = end;
    }
    return true;
}

}  // namespace weir
