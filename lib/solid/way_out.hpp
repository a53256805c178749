// Stage: collide, for particles that a body was placed or moved onto: where the nearest place
// outside solids is.
#pragma once

#include "solid/walls.hpp"

namespace weir {

/// A particle deeper than this has no way out, cells.
inline constexpr std::int32_t kLongestWayOut = 32;

/// Nearest place outside all solids, among nine places of each cell, at most `reach` cells (along
/// an axis) away from the point's own cell. Places are fixed, so that who walks towards the one
/// that is found comes nearer with each step, whatever the solid's shape. False: there is none.
/// Cost: a look-up for each cell that is nearer, and at most nine inside tests where a contour is.
template <class Real>
bool nearest_free_place(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> point,
                        std::int32_t reach, Vec2<Real>& place);

}  // namespace weir
