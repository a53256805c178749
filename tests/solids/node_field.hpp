// A field of distances at grid nodes, drawn by the library from polygons, and the contour in it.
#pragma once

#include <cstdint>
#include <vector>

#include "contour/marching_squares.hpp"
#include "contour/raster.hpp"

namespace solids {

using Points = std::vector<weir::Vec2<double>>;

/// A regular polygon, counter-clockwise, its first corner at `angle`.
Points regular_polygon(int corners, double radius, weir::Vec2<double> centre, double angle);

/// Nodes 0 … cells along each axis.
template <class Real>
struct NodeGrid {
    explicit NodeGrid(int cells_a_side, Real furthest = Real(1.5));

    /// Merges a polygon into the field.
    void draw(const Points& outline, bool binary = false);
    void corners(int i, int j, Real distance[4]) const;

    int cells;
    Real far;
    std::vector<Real> distance;
    std::vector<std::uint16_t> nearest;
};

extern template struct NodeGrid<float>;
extern template struct NodeGrid<double>;

}  // namespace solids
