// How a surface answers liquid, in cells and seconds.
#pragma once

#include "math/vec2.hpp"
#include "weir/config.hpp"

namespace weir {

/// The public face's Surface; the tank's walls have one each, and every body.
template <class Real>
struct SurfaceLaw {
    Real restitution = Real(0);
    Real friction = Real(0);
    Real conveyor = Real(0);  ///< cells/s, counter-clockwise about the body or the tank
    bool no_slip = false;
};

/// `pace`: of 1 m/s.
template <class Real>
SurfaceLaw<Real> surface_law(const Surface& surface, Face<Real> pace) {
    return {static_cast<Real>(surface.restitution), static_cast<Real>(surface.friction),
            static_cast<Real>(pace * static_cast<Face<Real>>(surface.conveyor_mps)),
            surface.no_slip};
}

template <class Real>
bool alike(const SurfaceLaw<Real>& a, const SurfaceLaw<Real>& b) {
    return a.restitution == b.restitution && a.friction == b.friction &&
           a.conveyor == b.conveyor && a.no_slip == b.no_slip;
}

}  // namespace weir
