// Polygon rasterization: which grid nodes lie inside a polygon, and how far they are from it.
#pragma once

#include "geometry/signed_distance.hpp"

namespace weir {

/// Grid nodes i0 … i1, j0 … j1, ends included; empty when i1 < i0 or j1 < j0.
struct NodeBox {
    std::int32_t i0 = 0;
    std::int32_t j0 = 0;
    std::int32_t i1 = -1;
    std::int32_t j1 = -1;

    bool empty() const { return i1 < i0 || j1 < j0; }
    bool operator==(const NodeBox& other) const {
        return i0 == other.i0 && j0 == other.j0 && i1 == other.i1 && j1 == other.j1;
    }
};

/// The smallest box that holds both.
inline NodeBox unite(const NodeBox& a, const NodeBox& b) {
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    return {minimum(a.i0, b.i0), minimum(a.j0, b.j0), maximum(a.i1, b.i1), maximum(a.j1, b.j1)};
}

/// The nodes of both.
inline NodeBox common(const NodeBox& a, const NodeBox& b) {
    return {maximum(a.i0, b.i0), maximum(a.j0, b.j0), minimum(a.i1, b.i1), minimum(a.j1, b.j1)};
}

inline bool overlap(const NodeBox& a, const NodeBox& b) {
    return a.i0 <= b.i1 && b.i0 <= a.i1 && a.j0 <= b.j1 && b.j0 <= a.j1;
}

/// Whether all of another box's nodes are in a box.
inline bool holds(const NodeBox& box, const NodeBox& other) {
    return box.i0 <= other.i0 && other.i1 <= box.i1 && box.j0 <= other.j0 && other.j1 <= box.j1;
}

/// A placed polygon, in cells.
template <class Real>
struct RasterPolygon {
    Outline<Real> outline;
    std::uint16_t name = 0;  ///< written to the nodes of which it is the nearest
    Bounds<Real> tank;
};

/// Names of the nearest body at nodes. A packed world with room for one body has none.
template <class Real>
inline bool has_names([[maybe_unused]] const SlotOf<Real>* nearest) {
    if constexpr (Stored<Real>::shares_momentum) {
        return nearest != nullptr;
    } else {
        return true;
    }
}

/// A field of nodes: node (i, j) stands at origin + j · stride + i.
template <class Real>
struct NodeField {
    DistanceOf<Real>* distance = nullptr;
    SlotOf<Real>* nearest = nullptr;
    std::int32_t origin = 0;
    std::int32_t stride = 0;
    /// Columns of which each row has room in both fields: loops in lanes write back what stands
    /// beside a narrow box. None: such a box is drawn node by node.
    std::int32_t first_column = 0;
    std::int32_t last_column = -1;
};

/// Nodes at most `margin` cells away from the polygon's bounding box, within 0 … last.
template <class Real>
NodeBox nodes_near(const Vec2<Real>* ring, std::int32_t count, Real margin, std::int32_t last_i,
                   std::int32_t last_j);

/// Merges a polygon into the field: a node takes the smaller of its distance and the polygon's,
/// so that overlapping polygons become their union. Outside, distances end at `far`. `binary`
/// writes −½ and +½ instead, which is the binary matrix of the paper: contour lines then run
/// through mid-edges. Returns the number of nodes of the box.
///
/// Inside is what a ray from the left enters an odd number of times. Each edge is measured from
/// the nodes within `far` of it only; deeper inside, nodes look for the nearest edge one by one,
/// with their neighbours' distances for a bound.
/// Cost: edges × their length × 2 far, and a look at every edge for each node that is deep inside.
/// @param scratch a field of nodes with the same numbering, overwritten in the box and beside it.
template <class Real>
std::int32_t rasterize(const RasterPolygon<Real>& polygon, const NodeBox& box, bool binary,
                       Real far, Real* scratch, const NodeField<Real>& field);

}  // namespace weir
