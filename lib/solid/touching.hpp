// Static bodies that touch or overlap: how deep their union is.
#pragma once

#include "grid/staggered_grid.hpp"
#include "solid/drawn_bodies.hpp"
#include "weir/features.hpp"

namespace weir {

/// A node knows the smallest of all bodies' distances, which inside of a union is that of the body
/// it is deepest in. Where bodies touch, as tiles do, the nodes at their seam are near an edge that
/// the other body covers: the contour took them for near the surface, and floors had a notch there,
/// up to half a cell deep. Nodes of a box that two static bodies have drawn, and that are less than
/// a cell inside, get their distance to the nearest point of an edge that no static body covers.
/// It depends on the poses of static bodies alone, not on their order nor on the box, and a body
/// more only makes nodes deeper.
/// Cost: for each such node, a look at each edge of the bodies that drew it.
template <class Real>
void deepen_where_bodies_touch(const GridShape& tank, const DrawnBodies<Real>& all,
                               const NodeBox& box, const NodeField<Real>& field);

/// By itself: bodies touch where there is room for several.
template <class Real>
struct detail::Touching {
    decltype(&deepen_where_bodies_touch<Real>) deepen;
};

}  // namespace weir
