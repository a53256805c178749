// Two components, and the few products that geometry needs.
#pragma once

#include "math/scalar.hpp"
#include "weir/types.hpp"

namespace weir {

template <class Real>
constexpr Vec2<Real> operator+(Vec2<Real> a, Vec2<Real> b) {
    return {a.x + b.x, a.y + b.y};
}
template <class Real>
constexpr Vec2<Real> operator-(Vec2<Real> a, Vec2<Real> b) {
    return {a.x - b.x, a.y - b.y};
}
template <class Scale, class Real>
constexpr Vec2<Real> operator*(Scale s, Vec2<Real> a) {
    return {s * a.x, s * a.y};
}
template <class Real>
constexpr Product<Real> dot(Vec2<Real> a, Vec2<Real> b) {
    return product(a.x, b.x) + product(a.y, b.y);
}
/// z of the cross product: positive where b turns left from a.
template <class Real>
constexpr Product<Real> cross(Vec2<Real> a, Vec2<Real> b) {
    return product(a.x, b.y) - product(a.y, b.x);
}
template <class Real>
Real length(Vec2<Real> a) {
    return square_root(dot(a, a));
}
/// Size of the larger component.
template <class Real>
constexpr Real larger_part(Vec2<Real> a) {
    return maximum(absolute(a.x), absolute(a.y));
}
template <class Real>
bool is_finite(Vec2<Real> a) {
    return is_finite(a.x) && is_finite(a.y);
}
/// v × (spin about z): the velocity that a spin lends to a point at `arm` from the centre.
template <class Real>
constexpr Vec2<Real> spin_velocity(Real spin, Vec2<Real> arm) {
    return {-spin * arm.y, spin * arm.x};
}
template <class To, class From>
constexpr Vec2<To> convert(Vec2<From> a) {
    return {static_cast<To>(a.x), static_cast<To>(a.y)};
}

}  // namespace weir
