// Point to polygon by point to segment.
#include "geometry/signed_distance.hpp"

namespace weir {

namespace {

/// How far a coordinate is outside the interval of two others; not positive within it.
template <class Real>
Real gap(Real value, Real end, Real other_end) {
    return end < other_end ? maximum(end - value, value - other_end)
                           : maximum(other_end - value, value - end);
}

}  // namespace

template <class Real>
Real distance_to_segment(Vec2<Real> p, Vec2<Real> a, Vec2<Real> b) {
    const Vec2<Real> edge = b - a;
    const Vec2<Real> arm = p - a;
    const Product<Real> along = dot(arm, edge);
    const Product<Real> squared_length = dot(edge, edge);
    if (along <= Product<Real>(0)) {
        return length(arm);
    }
    if (along >= squared_length) {
        return length(p - b);
    }
    // Not |p - foot|: the foot is rounded, and a point on a wall would be a hair away from it.
    return absolute(cross(edge, arm)) / square_root(squared_length);
}

template <class Real>
Real distance_to_outline(const Outline<Real>& outline, Vec2<Real> p, Real far,
                         const Bounds<Real>& bounds) {
    Real nearest = far;
    for_each_edge(outline, [&](Vec2<Real> from, Vec2<Real> to) {
        if (gap(p.x, from.x, to.x) < nearest && gap(p.y, from.y, to.y) < nearest &&
            !beyond(bounds, from, to)) {
            nearest = minimum(nearest, distance_to_segment(p, from, to));
        }
    });
    return nearest;
}

template <class Real>
bool covers(const Outline<Real>& outline, Vec2<Real> p) {
    bool inside = false;
    bool on_it = false;
    for_each_edge(outline, [&](Vec2<Real> from, Vec2<Real> to) {
        if (gap(p.y, from.y, to.y) > Real(0)) {
            return;
        }
        const Product<Real> side = cross(to - from, p - from);
        const bool left = side > Product<Real>(0);
        const bool right = side < Product<Real>(0);
        on_it = on_it || (!left && !right && gap(p.x, from.x, to.x) <= Real(0));
        const bool low = from.y <= p.y;
        inside = inside != (low != (to.y <= p.y) && (low ? left : right));
    });
    return inside || on_it;
}

#define WEIR_INSTANTIATE(Real)                                                              \
    template bool covers(const Outline<Real>&, Vec2<Real>);                                 \
    template Real distance_to_segment(Vec2<Real>, Vec2<Real>, Vec2<Real>);                  \
    template Real distance_to_outline(const Outline<Real>&, Vec2<Real>, Real,               \
                                       const Bounds<Real>&);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
