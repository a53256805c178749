#include "contour/raster.hpp"

namespace weir {

namespace {

/// A node this near to the outline lies on it, cells: a body that ends on a grid line, or on the
/// tank's wall, leaves no crack there by rounding.
template <class Real>
constexpr Real kOnTheOutline = Real(1.0 / 16384.0);

}  // namespace

template <class Real>
NodeBox nodes_near(const Vec2<Real>* ring, std::int32_t count, Real margin, std::int32_t last_i,
                   std::int32_t last_j) {
    Vec2<Real> low = ring[0];
    Vec2<Real> high = ring[0];
    for (std::int32_t k = 1; k < count; ++k) {
        low = {minimum(low.x, ring[k].x), minimum(low.y, ring[k].y)};
        high = {maximum(high.x, ring[k].x), maximum(high.y, ring[k].y)};
    }
    // Limited to the grid before the conversion: a body may be far outside.
    const auto node = [](Real value, std::int32_t last) {
        return floor_to_int(clamp(value, Real(-1), static_cast<Real>(last + 1)));
    };
    return {maximum(0, node(low.x - margin, last_i) + 1),
            maximum(0, node(low.y - margin, last_j) + 1),
            minimum(last_i, node(high.x + margin, last_i)),
            minimum(last_j, node(high.y + margin, last_j))};
}

template <class Real>
std::int32_t rasterize(const RasterPolygon<Real>& polygon, const NodeBox& box, bool binary,
                       Real far, const NodeField<Real>& field) {
    std::int32_t nodes = 0;
    for (std::int32_t j = box.j0; j <= box.j1; ++j) {
        for (std::int32_t i = box.i0; i <= box.i1; ++i) {
            const Vec2<Real> point{static_cast<Real>(i), static_cast<Real>(j)};
            Real distance = signed_distance(polygon.outline, polygon.pieces, polygon.piece_length,
                                            point, far, polygon.tank);
            if (distance < kOnTheOutline<Real>) {
                distance = minimum(distance, Real(0));
            }
            if (binary) {
                distance = distance <= Real(0) ? Real(-0.5) : Real(0.5);
            }
            const std::int32_t node = field.origin + j * field.stride + i;
            if (distance < field.distance[node]) {
                field.distance[node] = distance;
                field.nearest[node] = polygon.name;
            }
            ++nodes;
        }
    }
    return nodes;
}

#define WEIR_INSTANTIATE(Real)                                                              \
    template NodeBox nodes_near(const Vec2<Real>*, std::int32_t, Real, std::int32_t,        \
                                std::int32_t);                                              \
    template std::int32_t rasterize(const RasterPolygon<Real>&, const NodeBox&, bool, Real, \
                                    const NodeField<Real>&);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
WEIR_INSTANTIATE(Fixed)
#undef WEIR_INSTANTIATE

}  // namespace weir
