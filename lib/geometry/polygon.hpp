// Polygons: area, and inside tests; the checks of outlines are in
// weir/geometry.hpp. A ring is the list of a polygon's vertices; its last edge closes it.
#pragma once

#include <cstdint>

#include "math/vec2.hpp"
#include "weir/geometry.hpp"

namespace weir {

/// Twice the area of the triangle a b c: positive where the way a → b → c turns left.
template <class Real>
constexpr Product<Real> turn(Vec2<Real> a, Vec2<Real> b, Vec2<Real> c) {
    return cross(b - a, c - a);
}

/// Whether a point is in a triangle that turns left, or on its rim.
inline bool in_triangle(Vec2<double> a, Vec2<double> b, Vec2<double> c, Vec2<double> p) {
    return turn(c, a, p) >= 0.0 && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0;
}

/// Twice the enclosed area, in squares of the ring's unit; positive if counter-clockwise.
template <class Real>
Real twice_signed_area(const Vec2<Real>* ring, std::int32_t count);
double twice_area_in_double(View<Vec2f> ring);

/// Whether a point is within a ring, either way round: how often a ray from it meets the ring. On
/// an edge the answer may be either.
bool within_ring(View<Vec2f> ring, Vec2f point);

}  // namespace weir
