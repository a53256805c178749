// Filling a box with particles at rest, on a lattice that is aligned with the grid.
#pragma once

#include "fluid/particles.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Calls visit(position) for each lattice point in [low, high) that is not inside a solid, row by
/// row from below. `per_axis` points a cell along each axis. Returns their number.
template <class Real, class Visit>
std::int32_t for_each_seed(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> low,
                           Vec2<Real> high, std::int32_t per_axis, Visit visit) {
    const Real spacing = Real(1) / static_cast<Real>(per_axis);
    const auto first = [&](Real from) {
        return maximum(0, ceil_to_int(from * static_cast<Real>(per_axis) - Real(0.5)));
    };
    const auto end = [&](Real to, std::int32_t cells) {
        return minimum(cells * per_axis,
                       ceil_to_int(to * static_cast<Real>(per_axis) - Real(0.5)));
    };
    std::int32_t seeds = 0;
    for (std::int32_t b = first(low.y); b < end(high.y, shape.ny); ++b) {
        for (std::int32_t a = first(low.x); a < end(high.x, shape.nx); ++a) {
            const Vec2<Real> at{(static_cast<Real>(a) + Real(0.5)) * spacing,
                                (static_cast<Real>(b) + Real(0.5)) * spacing};
            if (!walls.active || !inside_solid(shape, walls, at)) {
                visit(at);
                ++seeds;
            }
        }
    }
    return seeds;
}

}  // namespace weir
