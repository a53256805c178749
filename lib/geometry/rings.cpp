#include "geometry/rings.hpp"

namespace weir {

std::int64_t turn(GridVertex a, GridVertex b, GridVertex c) {
    return cross(way(a, b), way(a, c));
}

RingsOnGrid::RingsOnGrid(const PolygonRings& rings) : PolygonRings(rings) {
    std::uint32_t highest = 0;
    for (std::int32_t ring = 0; ring < count(); ++ring) {
        for (const Vec2f vertex : rings[ring]) {
            highest =
                maximum(highest, maximum(magnitude_key(vertex.x), magnitude_key(vertex.y)));
        }
    }
    // 2^29 over the power of two above it, or the largest power that a float holds.
    const auto exponent = static_cast<std::int32_t>(highest >> 24U);
    steps_per_m = of_bound_key(minimum(282 - exponent, 254) << 23);
}

GridVertex RingsOnGrid::place(Vec2f vertex) const {
    return convert<std::int32_t>(steps_per_m * vertex);
}

std::int64_t twice_area(const RingsOnGrid& rings, std::int32_t ring) {
    const View<Vec2f> vertices = rings[ring];
    const GridVertex first = rings.place(vertices[0]);
    std::uint64_t sum = 0;
    for (std::int32_t i = 2; i < vertices.size; ++i) {
        sum += static_cast<std::uint64_t>(
            turn(first, rings.place(vertices[i - 1]), rings.place(vertices[i])));
    }
    return static_cast<std::int64_t>(sum);
}

}  // namespace weir
