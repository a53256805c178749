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
/// Looked at on a grid on which the furthest coordinate is 2^28 … 2^29 steps, finer than floats of
/// its size: vertices that are no step apart are one, and none is known below 1e-36 m.
/// Cost for n edges: of the order of n^1.5 box tests, n² if most edges are as long as the polygon;
/// holes × n for holes.
Status check_polygon(View<Vec2f> polygon, View<View<Vec2f>> holes = {});
/// @param fault may be null.
Status check_polygon(View<Vec2f> polygon, View<View<Vec2f>> holes, PolygonFault* fault);

/// Pieces that a curve is cut into at most.
inline constexpr std::int32_t kMaxCurvePieces = 4096;

/// A Bézier curve of degree 2 or 3 as a polyline whose distance from the curve is at most
/// `tolerance_m`: equal steps of its parameter, as many as Wang's formula asks for (Wang 1984).
/// Writes their ends, so not p0 but the curve's last point, up to `capacity` of them.
/// @return how many there are, also if that is more than `capacity`; 0 if a number is not finite,
///         the tolerance not positive, or so small that kMaxCurvePieces would not do.
std::int32_t flatten_quadratic(Vec2f p0, Vec2f p1, Vec2f p2, float tolerance_m, Vec2f* out,
                               std::int32_t capacity);
std::int32_t flatten_cubic(Vec2f p0, Vec2f p1, Vec2f p2, Vec2f p3, float tolerance_m, Vec2f* out,
                           std::int32_t capacity);
/// The same for an arc of a circle from `start_rad` over `sweep_rad`, −2π … 2π, counter-clockwise
/// if positive. Vertices lie on the arc; its first point is not written. 0, too, if the radius is
/// negative, the sweep longer, or `start_rad` beyond ±1e4.
std::int32_t flatten_arc(Vec2f centre_m, float radius_m, float start_rad, float sweep_rad,
                         float tolerance_m, Vec2f* out, std::int32_t capacity);

/// A ring with fewer vertices, all of them its own, so that each one left out is at most
/// `tolerance_m` from the edge that replaces it (Douglas & Peucker 1973), and the new ring does not
/// cross or touch itself: where it would, vertices stay. No recursion. Cost: vertices × passes,
/// of which there are about log n, at worst n; a `check_polygon` for each crossing.
/// @param tolerance_m ≥ 0. @param keep scratch, one a vertex. @param out room for all vertices.
/// @param count how many were written.
/// @return what `check_polygon` says of the ring; nothing is written unless it is ok.
Status simplify_ring(View<Vec2f> ring, float tolerance_m, std::uint8_t* keep, Vec2f* out,
                     std::int32_t* count);

/// Area between the rings, m²; 0 for less than 3 vertices.
float polygon_area(View<Vec2f> polygon, View<View<Vec2f>> holes = {});
/// Centre of that area; the first vertex if there is no area, the origin if there is no vertex.
Vec2f polygon_centroid(View<Vec2f> polygon, View<View<Vec2f>> holes = {});
/// Whether a point is between the rings: a ray from it meets them an odd number of times. On an
/// edge the answer may be either.
bool polygon_contains(View<Vec2f> polygon, View<View<Vec2f>> holes, Vec2f point);

/// Exact share of every cell that a polygon covers, 0 … 1, up to rounding: for drawing solids
/// without steps, and for measuring them. What is off the grid is cut off. `check_polygon` names
/// what is refused; output_missing.
/// Cost: rows × edges, and the cells that the edges cross.
/// @param polygon in cells: metres over cell_m.
/// @param share columns · rows numbers, row after row, overwritten.
Status cover_cells(View<Vec2f> polygon, View<View<Vec2f>> holes, std::int32_t columns,
                   std::int32_t rows, float* share);

}  // namespace weir
