// Polygons before they become solids: what is wrong with one, curves to polylines, fewer vertices,
// measures. Set-up helpers without a world: they keep nothing and write to the caller's buffers.
#pragma once

#include <cstdint>

#include "weir/status.hpp"
#include "weir/types.hpp"

namespace weir {

/// Where a polygon is at fault. Ring 0 is the outer one, ring k is holes[k - 1]; edge i goes from
/// the ring's vertex i to the next.
struct PolygonFault {
    Vec2f place_m;                     ///< of the crossing or the vertex; the origin if nowhere
    std::int32_t ring_a = -1;          ///< −1: no ring is to blame
    std::int32_t edge_a = -1;          ///< −1: the ring as a whole
    std::int32_t ring_b = -1;          ///< of the edge that is met, or −1
    std::int32_t edge_b = -1;
    std::int32_t vertices_needed = 0;  ///< what it takes of Capacity::vertices; also if all is well
};

/// Whether a polygon can be a body. Total for every bit pattern of its floats. Names the first
/// defect in this order: polygon_missing, _too_few_vertices, _too_many_vertices, _not_finite; ring
/// by ring polygon_crosses_itself if its crossing halves cancel, else _zero_area (relative to its
/// bounding box); polygon_crosses_itself (also touches itself, or goes back over its own edge),
/// polygon_hole_crosses (two rings cross or touch), polygon_hole_outside (of the outer ring, or in
/// another hole). Rings may turn either way and have repeated vertices and straight corners.
/// Cost for n edges: of the order of n^1.5 box tests, n² if most edges are as long as the polygon;
/// holes × n for holes.
/// @param fault may be null.
Status check_polygon(View<Vec2f> polygon, View<View<Vec2f>> holes = {},
                     PolygonFault* fault = nullptr);

}  // namespace weir
