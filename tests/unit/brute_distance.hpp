// The field of signed distance by brute force in double: every edge, and a ray's crossings.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {

inline constexpr float kCell = 0.02F;

using Point = Vec2<double>;

inline double to_segment(Point p, Point a, Point b) {
    const Point edge = b - a;
    const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
    const Point foot = a + t * edge;
    return std::hypot(p.x - foot.x, p.y - foot.y);
}

/// Signed distance by every edge and by counting crossings of a ray, in cells. Edges on or beyond
/// the border of a tank of that size are no walls.
inline double brute_distance(const std::vector<Point>& ring, Point p, Point tank) {
    constexpr double kHair = 1.0 / 16384.0;
    double nearest = 1.0e9;
    bool inside = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k];
        const Point b = ring[(k + 1) % ring.size()];
        const bool beyond = std::max(a.x, b.x) <= kHair || std::max(a.y, b.y) <= kHair ||
                            std::min(a.x, b.x) >= tank.x - kHair ||
                            std::min(a.y, b.y) >= tank.y - kHair;
        nearest = beyond ? nearest : std::min(nearest, to_segment(p, a, b));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            inside = !inside;
        }
    }
    return inside ? -nearest : nearest;
}

/// A ring in metres, placed, in cells.
inline std::vector<Point> placed(const Ring& ring, const Motion& motion) {
    std::vector<Point> out;
    const double c = std::cos(static_cast<double>(motion.angle_rad));
    const double s = std::sin(static_cast<double>(motion.angle_rad));
    const auto cell = static_cast<double>(kCell);
    for (const Vec2f v : ring) {
        const Point local = convert<double>(v);
        const Point at = convert<double>(motion.position_m);
        out.push_back({(at.x + c * local.x - s * local.y) / cell,
                       (at.y + s * local.x + c * local.y) / cell});
    }
    return out;
}

/// Compares the field with the union of the rings. Beyond the band only the sign and the limit
/// count: a node further out than the band may say anything that is at least as far as the band.
inline void expect_field(const World<float>& world, const std::vector<std::vector<Point>>& rings) {
    constexpr auto kFar = static_cast<double>(kFarFromSolids);
    const FieldView<float> field = world.signed_distance();
    ASSERT_EQ(field.columns, world.cells_x() + 1);
    ASSERT_EQ(field.rows, world.cells_y() + 1);
    const Point tank{double(world.cells_x()), double(world.cells_y())};
    for (std::int32_t j = 0; j < field.rows; ++j) {
        for (std::int32_t i = 0; i < field.columns; ++i) {
            double exact = kFar;
            for (const std::vector<Point>& ring : rings) {
                exact = std::min(exact, brute_distance(ring, {double(i), double(j)}, tank));
            }
            const auto value = static_cast<double>(field.at(i, j));
            if (exact > -kFar) {
                ASSERT_NEAR(value, exact, 8.0e-5) << i << ", " << j;
            } else {
                ASSERT_LE(value, -kFar + 2.0e-5) << i << ", " << j;
            }
        }
    }
}

}  // namespace weir
