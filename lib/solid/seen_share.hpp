// How much of its kernel a face sees past thin walls.
#pragma once

#include "solid/thin_sight.hpp"

namespace weir {

/// Share of the mass that a face would get in a full tank which gets there past thin walls. Beyond
/// the tank's own walls liquid and walls are mirrored. Exact, but for rounding and where shadows of
/// edges fall on other edges.
template <class Real>
Real seen_share(const ThinWalls<Real>& thin, const GridShape& shape, Vec2<Real> face);

}  // namespace weir
