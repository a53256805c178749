#include "geometry/polygon.hpp"

namespace weir {

double twice_area_in_double(View<Vec2f> ring) {
    const Vec2<double> origin = convert<double>(ring[0]);
    double sum = 0.0;
    for (std::int32_t i = 2; i < ring.size; ++i) {
        sum += turn(origin, convert<double>(ring[i - 1]), convert<double>(ring[i]));
    }
    return sum;
}

bool within_ring(View<Vec2f> ring, Vec2f point) {
    bool inside = false;
    for (std::int32_t i = 0; i < ring.size; ++i) {
        const Vec2f from = ring[i];
        const Vec2f to = ring[i + 1 < ring.size ? i + 1 : 0];
        if ((from.y > point.y) != (to.y > point.y)) {
            const double side = turn(convert<double>(from), convert<double>(to),
                                     convert<double>(point));
            inside = (to.y > from.y ? side > 0.0 : side < 0.0) != inside;
        }
    }
    return inside;
}

template <class Real>
Real twice_signed_area(const Vec2<Real>* ring, std::int32_t count) {
    // Seen from a vertex, not from the origin: a small body far out keeps its digits.
    auto sum = Product<Real>(0);
    for (std::int32_t i = 2; i < count; ++i) {
        sum = sum + turn(ring[0], ring[i - 1], ring[i]);
    }
    return sum;
}

template <class Real>
bool inside_convex(const Vec2<Real>* vertices, const std::uint16_t* piece, std::int32_t count,
                   Vec2<Real> point) {
    bool off_an_edge = false;
    std::uint16_t from = piece[count - 1];
    for (std::int32_t k = 0; k < count; ++k) {
        const std::uint16_t to = piece[k];
        // Two pieces walk their common edge in opposite ways. Both must compute the same number,
        // or rounding opens a crack along it that belongs to neither.
        const Product<Real> side = from < to ? turn(vertices[from], vertices[to], point)
                                    : -turn(vertices[to], vertices[from], point);
        if (side < Product<Real>(0)) {
            return false;
        }
        off_an_edge = off_an_edge || side > Product<Real>(0);
        from = to;
    }
    // Left of nothing: the piece is a line, and the point is somewhere along it.
    return off_an_edge;
}

#define WEIR_INSTANTIATE(Real)                                                         \
    template Real twice_signed_area(const Vec2<Real>*, std::int32_t);                  \
    template bool inside_convex(const Vec2<Real>*, const std::uint16_t*, std::int32_t, \
                                Vec2<Real>);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
