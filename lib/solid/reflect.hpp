// How a surface answers a particle that hits it.
#pragma once

#include "grid/surface_law.hpp"

namespace weir {

/// Velocity of a body's surface where its material moves with `wall`; `normal` points into the
/// liquid.
template <class Real>
inline Vec2<Real> surface_velocity(const SurfaceLaw<Real>& law, Vec2<Real> wall,
                                   Vec2<Real> normal) {
    return law.conveyor == Real(0)
               ? wall
               : wall + law.conveyor * Vec2<Real>{-normal.y, normal.x};
}

/// Velocity after a blow against a surface that moves with `surface`: the normal part is turned
/// round and multiplied by the restitution, the part along the surface loses at most friction
/// times what the normal part changed by (Coulomb), and never more than brings it to rest on the
/// surface. A particle that leaves is left alone. `normal` is of length 1 and points into the
/// liquid. What the body receives is particle mass × (velocity before − after).
template <class Real>
inline Vec2<Real> reflect(const SurfaceLaw<Real>& law, Vec2<Real> surface, Vec2<Real> velocity,
                          Vec2<Real> normal) {
    const Vec2<Real> relative = velocity - surface;
    const Real approach = dot(relative, normal);
    if (!(approach < Real(0))) {
        return velocity;
    }
    const Real blow = (Real(1) + law.restitution) * approach;
    const Vec2<Real> after = velocity - blow * normal;
    if (law.friction == Real(0)) {
        return after;
    }
    const Vec2<Real> tangent{-normal.y, normal.x};
    const Real most = -law.friction * blow;
    const Real slip = dot(relative, tangent);
    return after - clamp(slip, -most, most) * tangent;
}

}  // namespace weir
