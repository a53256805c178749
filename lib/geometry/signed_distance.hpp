// Distance from a point to a polygon's edges, exact up to rounding, and whether it is inside.
// Coordinates are cells, |x| ≤ 1e6.
#pragma once

#include "geometry/outline.hpp"
#include "geometry/polygon.hpp"
#include "math/vec2.hpp"

namespace weir {

/// The tank. Edges that lie on its border or beyond are no walls: a solid that ends there goes on
/// outside, and what is inside it has no way out there. The default has no border.
template <class Real>
struct Bounds {
    Vec2<Real> low{Real(-1.0e9), Real(-1.0e9)};
    Vec2<Real> high{Real(1.0e9), Real(1.0e9)};
};

template <class Real>
inline constexpr Real kHairOfBorder = Real(1.0 / 16384.0);

/// Edges that lie there or beyond lie on the border or beyond it, by rounding or clearly.
template <class Real>
Bounds<Real> walls_of(const Bounds<Real>& bounds) {
    constexpr Real kHair = kHairOfBorder<Real>;
    return {{bounds.low.x + kHair, bounds.low.y + kHair},
            {bounds.high.x - kHair, bounds.high.y - kHair}};
}

/// Whether an edge does.
template <class Real>
bool beyond(const Bounds<Real>& bounds, Vec2<Real> a, Vec2<Real> b) {
    constexpr Real kHair = kHairOfBorder<Real>;
    return maximum(a.x, b.x) <= bounds.low.x + kHair ||
           minimum(a.x, b.x) >= bounds.high.x - kHair ||
           maximum(a.y, b.y) <= bounds.low.y + kHair || minimum(a.y, b.y) >= bounds.high.y - kHair;
}

/// A solid that ends on the tank's border covers the nodes there, whatever rounding says.
template <class Real>
Vec2<Real> off_the_border(const Bounds<Real>& bounds, Vec2<Real> p) {
    constexpr Real kNudge = Real(1.0 / 1024.0);
    return {clamp(p.x, bounds.low.x + kNudge, bounds.high.x - kNudge),
            clamp(p.y, bounds.low.y + kNudge, bounds.high.y - kNudge)};
}

/// Distance to the segment a b, never negative; exactly 0 for a point that rounding sees on it.
template <class Real>
Real distance_to_segment(Vec2<Real> p, Vec2<Real> a, Vec2<Real> b);

/// Distance to the nearest edge of an outline, inside or outside, at most `far`.
/// Cost: a box test an edge, and a square root and a division for those that come nearer.
template <class Real>
Real distance_to_outline(const Outline<Real>& outline, Vec2<Real> p, Real far,
                         const Bounds<Real>& bounds = {});

/// Whether a point is inside an outline, or on it, told by how often a ray from it meets the rings.
template <class Real>
bool covers(const Outline<Real>& outline, Vec2<Real> p);

}  // namespace weir
