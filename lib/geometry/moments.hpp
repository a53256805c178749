// Area, centroid and moment of inertia of an outline, evenly filled.
#pragma once

#include "geometry/outline.hpp"

namespace weir {

template <class Real>
struct Moments {
    Face<Real> area = Face<Real>(0);
    Vec2<Face<Real>> centroid;
    Face<Real> inertia = Face<Real>(0);  ///< about the centroid: area × length²
};

/// Of the first ring without the others; either winding. Rings enclose area.
template <class Real>
Moments<Real> moments_of(const Outline<Real>& outline);

}  // namespace weir
