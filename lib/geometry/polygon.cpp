// Outline checks in double: products of floats are exact there and their squares cannot overflow,
// so a touch is told from a near miss and no finite input misbehaves.
#include "geometry/polygon.hpp"

#include "weir/config.hpp"

namespace weir {

namespace {

struct Box2 {
    Vec2f low;
    Vec2f high;
};

Box2 box_of(Vec2f a, Vec2f b) {
    return {{minimum(a.x, b.x), minimum(a.y, b.y)}, {maximum(a.x, b.x), maximum(a.y, b.y)}};
}

bool overlap(const Box2& a, const Box2& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
           b.low.y <= a.high.y;
}

int sign_of_turn(Vec2f a, Vec2f b, Vec2f c) {
    const double t = turn(convert<double>(a), convert<double>(b), convert<double>(c));
    return t > 0.0 ? 1 : (t < 0.0 ? -1 : 0);
}

enum class Meeting { crossing, touching };

/// Whether two segments whose boxes overlap cross, or at least share a point. Segments on one
/// line whose boxes overlap do share one, which is the case of four zeros.
bool segments_meet(Vec2f a, Vec2f b, Vec2f c, Vec2f d, Meeting meeting) {
    const int most = meeting == Meeting::touching ? 0 : -1;
    return sign_of_turn(a, b, c) * sign_of_turn(a, b, d) <= most &&
           sign_of_turn(c, d, a) * sign_of_turn(c, d, b) <= most;
}

/// Looks at edges that are not neighbours. That finds spikes too: an edge that goes back over the
/// one before it ends on that one, or reaches the one before that.
bool meets_itself(View<Vec2f> polygon, Meeting meeting) {
    const std::int32_t count = polygon.size;
    const auto vertex = [&](std::int32_t i) { return polygon[i < count ? i : i - count]; };
    for (std::int32_t i = 0; i < count; ++i) {
        const Vec2f a = vertex(i);
        const Vec2f b = vertex(i + 1);
        const Box2 box = box_of(a, b);
        const std::int32_t end = i == 0 ? count - 1 : count;  // the last edge meets the first
        for (std::int32_t j = i + 2; j < end; ++j) {
            const Vec2f c = vertex(j);
            const Vec2f d = vertex(j + 1);
            if (overlap(box, box_of(c, d)) && segments_meet(a, b, c, d, meeting)) {
                return true;
            }
        }
    }
    return false;
}

double twice_area_in_double(View<Vec2f> polygon) {
    const Vec2<double> origin = convert<double>(polygon[0]);
    double sum = 0.0;
    for (std::int32_t i = 2; i < polygon.size; ++i) {
        sum += turn(origin, convert<double>(polygon[i - 1]), convert<double>(polygon[i]));
    }
    return sum;
}

double squared_diagonal(View<Vec2f> polygon) {
    Box2 box{polygon[0], polygon[0]};
    for (const Vec2f v : polygon) {
        const Box2 grown = box_of(box.low, v);
        box = {grown.low, box_of(box.high, v).high};
    }
    const Vec2<double> diagonal = convert<double>(box.high) - convert<double>(box.low);
    return dot(diagonal, diagonal);
}

}  // namespace

Status check_polygon(View<Vec2f> polygon) {
    if (polygon.data == nullptr) {
        return Status::polygon_missing;
    }
    if (polygon.size < 3) {
        return Status::polygon_too_few_vertices;
    }
    if (polygon.size > kMaxBodyVertices) {
        return Status::polygon_too_many_vertices;
    }
    for (const Vec2f v : polygon) {
        if (!is_finite(v)) {
            return Status::polygon_not_finite;
        }
    }
    Vec2f last = polygon[polygon.size - 1];
    for (const Vec2f v : polygon) {
        if (v.x == last.x && v.y == last.y) {
            return Status::polygon_repeats_a_vertex;
        }
        last = v;
    }
    const double twice_area = twice_area_in_double(polygon);
    if (absolute(twice_area) <= 2.0 * kMinRelativeArea * squared_diagonal(polygon)) {
        // The halves of a bow tie cancel; flatness is not what its author has to mend.
        return meets_itself(polygon, Meeting::crossing) ? Status::polygon_crosses_itself
                                                        : Status::polygon_zero_area;
    }
    if (meets_itself(polygon, Meeting::touching)) {
        return Status::polygon_crosses_itself;
    }
    return twice_area < 0.0 ? Status::polygon_clockwise : Status::ok;
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
bool inside_convex(const Vec2<Real>* ring, const std::uint16_t* piece, std::int32_t count,
                   Vec2<Real> point) {
    bool off_an_edge = false;
    std::uint16_t from = piece[count - 1];
    for (std::int32_t k = 0; k < count; ++k) {
        const std::uint16_t to = piece[k];
        // Two pieces walk their common edge in opposite ways. Both must compute the same number,
        // or rounding opens a crack along it that belongs to neither.
        const Product<Real> side = from < to ? turn(ring[from], ring[to], point)
                                    : -turn(ring[to], ring[from], point);
        if (side < Product<Real>(0)) {
            return false;
        }
        off_an_edge = off_an_edge || side > Product<Real>(0);
        from = to;
    }
    // Left of nothing: the piece is a line, and the point is somewhere along it.
    return off_an_edge;
}

template float twice_signed_area(const Vec2<float>*, std::int32_t);
template double twice_signed_area(const Vec2<double>*, std::int32_t);
template Fixed twice_signed_area(const Vec2<Fixed>*, std::int32_t);
template bool inside_convex(const Vec2<float>*, const std::uint16_t*, std::int32_t, Vec2<float>);
template bool inside_convex(const Vec2<double>*, const std::uint16_t*, std::int32_t,
                            Vec2<double>);
template bool inside_convex(const Vec2<Fixed>*, const std::uint16_t*, std::int32_t,
                            Vec2<Fixed>);

}  // namespace weir
