// Stage: collide, for walls thinner than a cell: particles keep their side.
#pragma once

#include "solid/thin_sight.hpp"

namespace weir {

inline constexpr std::int32_t kMostHits = 6;

/// Where a particle stops or slides to, and the walls that it met on its way.
template <class Real>
struct ThinStop {
    Vec2<Real> place;
    std::uint16_t slot[kMostHits] = {};
    Vec2<Real> normal[kMostHits];  ///< of length 1, to the particle's side
    std::int32_t count = 0;
};

/// Follows a particle's way, seen from each body that has thin walls: so a wall that moves takes
/// along what it meets, however fast it is. At a wall the way goes on along it. `follow` false: no
/// body moved meanwhile. Of closed polygons only the way in is closed. False: walls that move
/// against each other leave the particle no place that it can reach.
/// Cost: a look at each cell between the ends of the way; an edge there costs 10 to 40 operations.
template <class Real>
bool keep_side(const ThinWalls<Real>& thin, const GridShape& shape, const Body<Real>* bodies,
               Vec2<Real> before, Vec2<Real> after, bool follow, ThinStop<Real>& stop);

/// A place inside a closed polygon where it is thin: the nearest one outside. False: the place is
/// not inside.
template <class Real>
bool way_out_of_thin(const ThinWalls<Real>& thin, const GridShape& shape,
                     const Body<Real>* bodies, Vec2<Real> place, ThinStop<Real>& stop);

}  // namespace weir
