#include "node_field.hpp"

#include <cmath>

namespace solids {

using weir::Vec2;

Points regular_polygon(int corners, double radius, Vec2<double> centre, double angle) {
    Points points;
    for (int k = 0; k < corners; ++k) {
        const double a = angle + 2.0 * M_PI * k / corners;
        points.push_back({centre.x + radius * std::cos(a), centre.y + radius * std::sin(a)});
    }
    return points;
}

template <class Real>
NodeGrid<Real>::NodeGrid(int cells_a_side, Real furthest)
    : cells(cells_a_side),
      far(furthest),
      distance(static_cast<std::size_t>((cells + 1) * (cells + 1)), far),
      nearest(distance.size(), 0xFFFF) {}

template <class Real>
void NodeGrid<Real>::draw(const Points& outline, bool binary) {
    std::vector<Vec2<Real>> ring;
    for (const Vec2<double>& p : outline) {
        ring.push_back(weir::convert<Real>(p));
    }
    const auto count = static_cast<std::int32_t>(ring.size());
    const weir::RasterPolygon<Real> polygon{{ring.data(), count}, 0, {}};
    std::vector<Real> scratch(distance.size());
    const weir::NodeBox box = weir::nodes_near(ring.data(), count, far, cells, cells);
    weir::rasterize(polygon, box, binary, far, scratch.data(),
                    weir::NodeField<Real>{distance.data(), nearest.data(), 0, cells + 1});
}

template <class Real>
void NodeGrid<Real>::corners(int i, int j, Real corner[4]) const {
    const Real* low = distance.data() + j * (cells + 1) + i;
    corner[0] = low[0];
    corner[1] = low[1];
    corner[2] = low[cells + 2];
    corner[3] = low[cells + 1];
}

template struct NodeGrid<float>;
template struct NodeGrid<double>;

}  // namespace solids
