// The lattice on which liquid starts: aligned with the grid, at rest density.
#pragma once

#include "grid/staggered_grid.hpp"

namespace weir {

/// Calls visit(point) for each lattice point in [low, high), row by row from below, with
/// `per_axis` points a cell along each axis. Points are cells; the box is cut to the tank.
template <class Real, class Visit>
void for_each_seed(const GridShape& shape, Vec2<Real> low, Vec2<Real> high, std::int32_t per_axis,
                   Visit visit) {
    const Real density = static_cast<Real>(per_axis);
    const auto first = [&](Real from) {
        return maximum(0, ceil_to_int(from * density - Real(0.5)));
    };
    const auto end = [&](Real to, std::int32_t cells) {
        return minimum(cells * per_axis, ceil_to_int(to * density - Real(0.5)));
    };
    for (std::int32_t b = first(low.y); b < end(high.y, shape.ny); ++b) {
        for (std::int32_t a = first(low.x); a < end(high.x, shape.nx); ++a) {
            visit(Vec2<Real>{(static_cast<Real>(a) + Real(0.5)) / density,
                             (static_cast<Real>(b) + Real(0.5)) / density});
        }
    }
}

}  // namespace weir
