// Curves as polylines, computed in double and rounded once.
#include "math/rotation.hpp"
#include "math/vec2.hpp"
#include "weir/geometry.hpp"

namespace weir {

namespace {

using Point = Vec2<double>;

constexpr double kPi = 3.14159265358979323846;

/// Pieces of equal parameter: the chord over a step h of a curve with |C''| ≤ bend is within
/// h² bend / 8 of it. 0 if that takes too many, or if a number is not finite.
std::int32_t pieces_for(double bend, float tolerance) {
    if (!is_finite(bend) || !is_finite(tolerance) || !(tolerance > 0.0F)) {
        return 0;
    }
    const double squared = bend / (8.0 * static_cast<double>(tolerance));
    constexpr double kMost = kMaxCurvePieces;
    return squared > kMost * kMost ? 0 : maximum(1, ceil_to_int(square_root(squared)));
}

/// Writes point(k / pieces) for k = 1 … pieces.
template <class PointAt>
std::int32_t write_points(std::int32_t pieces, Vec2f* out, std::int32_t capacity, PointAt point) {
    for (std::int32_t k = 1; k <= minimum(pieces, capacity); ++k) {
        out[k - 1] = convert<float>(point(static_cast<double>(k) / static_cast<double>(pieces)));
    }
    return pieces;
}

Point between(Point a, Point b, double share) { return (1.0 - share) * a + share * b; }

Point second_difference(Vec2f a, Vec2f b, Vec2f c) {
    return convert<double>(a) - 2.0 * convert<double>(b) + convert<double>(c);
}

}  // namespace

std::int32_t flatten_quadratic(Vec2f p0, Vec2f p1, Vec2f p2, float tolerance_m, Vec2f* out,
                               std::int32_t capacity) {
    const double bend = 2.0 * length(second_difference(p0, p1, p2));
    const Point a = convert<double>(p0);
    const Point b = convert<double>(p1);
    const Point c = convert<double>(p2);
    return write_points(pieces_for(bend, tolerance_m), out, capacity, [&](double t) {
        return t < 1.0 ? between(between(a, b, t), between(b, c, t), t) : c;
    });
}

std::int32_t flatten_cubic(Vec2f p0, Vec2f p1, Vec2f p2, Vec2f p3, float tolerance_m, Vec2f* out,
                           std::int32_t capacity) {
    const double first = length(second_difference(p0, p1, p2));
    const double last = length(second_difference(p1, p2, p3));
    const double bend = is_finite(first) && is_finite(last) ? 6.0 * maximum(first, last)
                                                            : first + last;
    const Point a = convert<double>(p0);
    const Point b = convert<double>(p1);
    const Point c = convert<double>(p2);
    const Point d = convert<double>(p3);
    return write_points(pieces_for(bend, tolerance_m), out, capacity, [&](double t) {
        const Point middle = between(b, c, t);
        return t < 1.0 ? between(between(between(a, b, t), middle, t),
                                 between(middle, between(c, d, t), t), t)
                       : d;
    });
}

std::int32_t flatten_arc(Vec2f centre_m, float radius_m, float start_rad, float sweep_rad,
                         float tolerance_m, Vec2f* out, std::int32_t capacity) {
    const auto radius = static_cast<double>(radius_m);
    const auto start = static_cast<double>(start_rad);
    const auto sweep = static_cast<double>(sweep_rad);
    constexpr double kWholeCircle = 2.0 * kPi + 1e-6;
    if (!is_finite(centre_m) || !is_finite(radius_m) || !is_finite(start_rad) ||
        !(absolute(start) <= 1e4) || !(absolute(sweep) <= kWholeCircle) || !(radius >= 0.0)) {
        return 0;
    }
    // At least one a quarter: a coarse tolerance does not make a circle a line.
    const std::int32_t pieces = pieces_for(radius * sweep * sweep, tolerance_m);
    const std::int32_t quarters = ceil_to_int(absolute(sweep) / (0.5 * kPi) - 1e-6);
    const Point centre = convert<double>(centre_m);
    return write_points(pieces == 0 ? 0 : maximum(pieces, quarters), out, capacity, [&](double t) {
        return centre + rotation(wrapped_angle(start + t * sweep)).apply(Point{radius, 0.0});
    });
}

}  // namespace weir
