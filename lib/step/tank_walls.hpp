// The end of grid-to-particle: a particle's way, kept within what is allowed and within the tank.
#pragma once

#include "step/grid_to_particle.hpp"

namespace weir {

/// What `limited` does to the few that are too fast or broken.
template <class Real>
Vec2<Real> refused(Vec2<Real> v, Real limit, TransferResult<Real>& count) {
    if (!is_finite(v)) {
        ++count.reset;
        return {};
    }
    ++count.slowed;
    return {clamp(v.x, -limit, limit), clamp(v.y, -limit, limit)};
}

/// Written so that a NaN is refused.
template <class Real>
inline Vec2<Real> limited(Vec2<Real> v, Real limit, TransferResult<Real>& count) {
    return absolute(v.x) <= limit && absolute(v.y) <= limit ? v : refused(v, limit, count);
}

/// One axis at the tank's walls: back to the wall, and the velocity towards it given back.
template <class Real>
inline void keep_inside(Real& x, Real& v, Real size, Real restitution) {
    if (x < kWallGap<Real>) {
        x = kWallGap<Real>;
        v = v < Real(0) ? -restitution * v : v;
    } else if (x > size - kWallGap<Real>) {
        x = size - kWallGap<Real>;
        v = v > Real(0) ? -restitution * v : v;
    }
}

/// One axis across a seam. A step is far shorter than the tank, so once is enough; the last line
/// is for a number so small below zero that adding the size rounds it to the size.
template <class Real>
inline void wrap_around(Real& x, Real size) {
    if (x < Real(0)) {
        x += size;
    }
    if (!(x < size)) {
        x -= size;
    }
}

/// Limits the new velocity v, moves x with the velocity `along` and meets the walls of a tank of
/// that size.
template <class Real>
inline void advect(Vec2<Real> size, const Transfer<Real>& transfer, Vec2<Real> along,
                   Vec2<Real>& x, Vec2<Real>& v, TransferResult<Real>& result) {
    TransferResult<Real> unused;
    v = limited(v, transfer.limit, result);
    x = x + transfer.dt_s * limited(along, transfer.limit, unused);
    if (transfer.wrap_x) {
        wrap_around(x.x, size.x);
    } else {
        keep_inside(x.x, v.x, size.x, transfer.wall_restitution);
    }
    if (transfer.wrap_y) {
        wrap_around(x.y, size.y);
    } else {
        keep_inside(x.y, v.y, size.y, transfer.wall_restitution);
    }
    result.max_speed = maximum(result.max_speed, maximum(absolute(v.x), absolute(v.y)));
}

}  // namespace weir
