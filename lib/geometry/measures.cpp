// Area, centre and inside test of polygons as callers give them, in double.
#include "geometry/polygon.hpp"
#include "geometry/rings.hpp"

namespace weir {

namespace {

/// Area and first moments about the outer ring's first vertex.
struct Moments {
    double twice_area = 0.0;
    Vec2<double> six_moment;
};

void add_ring(View<Vec2f> ring, Vec2<double> origin, bool hole, Moments& sum) {
    Moments own;
    for (std::int32_t i = 0; i < ring.size; ++i) {
        const Vec2<double> a = convert<double>(ring[i]) - origin;
        const Vec2<double> b = convert<double>(ring[i + 1 < ring.size ? i + 1 : 0]) - origin;
        const double part = cross(a, b);
        own.twice_area += part;
        own.six_moment = own.six_moment + part * (a + b);
    }
    const double sign = (own.twice_area < 0.0) != hole ? -1.0 : 1.0;
    sum.twice_area += sign * own.twice_area;
    sum.six_moment = sum.six_moment + sign * own.six_moment;
}

Moments moments_of(const PolygonRings& rings) {
    Moments sum;
    for (std::int32_t ring = 0; rings.outer.size > 0 && ring < rings.count(); ++ring) {
        add_ring(rings[ring], convert<double>(rings.outer[0]), ring > 0, sum);
    }
    return sum;
}

}  // namespace

float polygon_area(View<Vec2f> polygon, View<View<Vec2f>> holes) {
    return static_cast<float>(0.5 * moments_of({polygon, holes}).twice_area);
}

Vec2f polygon_centroid(View<Vec2f> polygon, View<View<Vec2f>> holes) {
    if (polygon.size <= 0) {
        return {};
    }
    const Moments moments = moments_of({polygon, holes});
    const Vec2<double> origin = convert<double>(polygon[0]);
    return moments.twice_area > 0.0
               ? convert<float>(origin + (1.0 / (3.0 * moments.twice_area)) * moments.six_moment)
               : polygon[0];
}

bool polygon_contains(View<Vec2f> polygon, View<View<Vec2f>> holes, Vec2f point) {
    const PolygonRings rings{polygon, holes};
    bool inside = false;
    for (std::int32_t ring = 0; ring < rings.count(); ++ring) {
        inside = within_ring(rings[ring], point) != inside;
    }
    return inside;
}

}  // namespace weir
