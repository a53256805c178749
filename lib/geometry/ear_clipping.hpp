// Stage of the decomposition: ears of a ring of corners, one after the other (Eberly 2002,
// "Triangulation by ear clipping"). Only hollow corners can lie in an ear's triangle; they wait in
// the cells of a grid, so that a test looks at the few near it.
#pragma once

#include "geometry/corner_ring.hpp"

namespace weir {

/// A triangle that was cut off: previous, tip, next.
struct Ear {
    std::int32_t a;
    std::int32_t tip;
    std::int32_t c;
    /// It turns left and holds no other corner. False where rounding has made the ring touch or
    /// cross itself and the flattest corner was cut off: it is no part of the polygon then.
    bool has_area;
};

template <class Real>
struct EarClipper {
    CornerRing<Real> ring;
    CornerLinks links;                ///< marked: known to be no ear until a neighbour goes
    ArrayView<std::uint16_t> shelf;   ///< of a hollow corner: the next one in its cell
    ArrayView<std::uint16_t> cells;   ///< first hollow corner of each cell
    Vec2<double> low;                 ///< of the grid
    Vec2<double> cells_per_length;
    std::int32_t columns = 1;
    std::int32_t rows = 1;
    std::int32_t left = 0;            ///< corners that are left
    std::int32_t start = 0;           ///< where the search goes on
};

/// @param links 2 a corner. @param shelf one a corner; free again once a corner has been cut off.
/// @param cells as many as there are, at least one; the more, up to one a corner, the faster.
template <class Real>
EarClipper<Real> start_clipping(const CornerRing<Real>& ring, CornerLinks links,
                                ArrayView<std::uint16_t> shelf, ArrayView<std::uint16_t> cells);

/// Cuts off the next ear; `left` is at least 3. The links of its tip stay as they were.
/// Cost: for n corners together of the order of n tests of a few corners each if the polygon fills
/// its bounding box; n² corners at worst, n³ for a ring that touches itself all over.
template <class Real>
Ear clip_ear(EarClipper<Real>& clipper);

}  // namespace weir
