#include "geometry/polygon.hpp"

namespace weir {

namespace {

/// In double products of floats are exact, and squares cannot overflow.
double turn_in_double(const Vec2f& a, const Vec2f& b, const Vec2f& c) {
    return turn(convert<double>(a), convert<double>(b), convert<double>(c));
}

}  // namespace

double twice_area_in_double(View<Vec2f> ring) {
    double sum = 0.0;
    for (std::int32_t i = 2; i < ring.size; ++i) {
        sum += turn_in_double(ring[0], ring[i - 1], ring[i]);
    }
    return sum;
}

bool within_ring(View<Vec2f> ring, Vec2f point) {
    bool inside = false;
    for (std::int32_t i = 0; i < ring.size; ++i) {
        const Vec2f from = ring[i];
        const Vec2f to = ring[i + 1 < ring.size ? i + 1 : 0];
        if ((from.y > point.y) != (to.y > point.y)) {
            const double side = turn_in_double(from, to, point);
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

#define WEIR_INSTANTIATE(Real) template Real twice_signed_area(const Vec2<Real>*, std::int32_t);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
