// Point to polygon by point to segment; the sign from the inside test of the convex pieces.
#include "geometry/signed_distance.hpp"

namespace weir {

namespace {

/// Larger than any distance within a tank, cells.
template <class Real>
constexpr Real kDeepest = Real(1.0e6);

/// How far a coordinate is outside the interval of two others; not positive within it.
template <class Real>
Real gap(Real value, Real end, Real other_end) {
    return end < other_end ? maximum(end - value, value - other_end)
                           : maximum(other_end - value, value - end);
}

template <class Real>
bool inside_any_piece(const Vec2<Real>* ring, const std::uint16_t* pieces,
                      std::int32_t piece_length, Vec2<Real> p) {
    std::int32_t at = 0;
    while (at < piece_length) {
        const std::int32_t count = pieces[at];
        if (inside_convex(ring, pieces + at + 1, count, p)) {
            return true;
        }
        at += 1 + count;
    }
    return false;
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
Real signed_distance(const Outline<Real>& outline, const std::uint16_t* pieces,
                     std::int32_t piece_length, Vec2<Real> p, Real far,
                     const Bounds<Real>& bounds) {
    if (inside_any_piece(outline.vertex, pieces, piece_length, off_the_border(bounds, p))) {
        // 0 - d, because -d would make a negative zero on the outline.
        return Real(0) - distance_to_outline(outline, p, kDeepest<Real>, bounds);
    }
    return distance_to_outline(outline, p, far, bounds);
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
                                       const Bounds<Real>&);                                \
    template Real signed_distance(const Outline<Real>&, const std::uint16_t*, std::int32_t, \
                                   Vec2<Real>, Real, const Bounds<Real>&);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
