// Stage: collide, late in the step. Reads the contour matrix; corrects particles.
#pragma once

#include "fluid/particles.hpp"
#include "solid/walls.hpp"

namespace weir {

template <class Real>
struct CollideResult {
    std::int32_t tested = 0;     ///< particles in a cell with a contour line, or inside a solid
    std::int32_t reflected = 0;  ///< particles behind a line
    Real max_speed = Real(0);    ///< of these, along an axis, cells/s
};

/// Tests each particle against the contour line of its cell. One that is behind it is set back to
/// the line, and its velocity relative to the wall is reflected, v' = v − (1 + e)(v·n)n when it
/// points into the solid: e = 1 is the paper's mirror v' = v − 2(v·n)n, e = 0 slides along.
/// A particle in a cell that is solid all over goes out along the gradient of the distance, at
/// most one cell a substep. Cost: one table look-up a particle, about 60 operations near walls.
template <class Real>
CollideResult<Real> collide(const GridShape& shape, const Walls<Real>& walls,
                            Particles<Real>& particles);

/// Whether a point of the tank lies behind the contour.
template <class Real>
bool inside_solid(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> point);

}  // namespace weir
