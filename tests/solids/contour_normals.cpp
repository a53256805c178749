// R3: normals and positions of contour lines against the exact outline.
#include <algorithm>
#include <cmath>

#include "contour/gradient.hpp"
#include "node_field.hpp"
#include "problems.hpp"

namespace solids {

namespace {

using weir::Vec2;

constexpr double kDegrees = 180.0 / M_PI;

/// Length-weighted.
struct Error {
    double length = 0.0;
    double angle_squares = 0.0;
    double angle_max = 0.0;
    double position_squares = 0.0;
    double position_max = 0.0;

    double angle_rms() const { return std::sqrt(angle_squares / length) * kDegrees; }
    double position_rms() const { return std::sqrt(position_squares / length); }
};

double angle_between(Vec2<double> a, Vec2<double> b) {
    return std::atan2(weir::cross(a, b), weir::dot(a, b));
}

/// The normal that a particle meets on a contour line, or the line's own.
Vec2<double> normal_at(const NodeGrid<float>& grid, int i, int j,
                       const weir::ContourLine<float>& line, bool binary) {
    const auto middle = 0.5F * (line.from + line.to);
    const float* node = grid.distance.data() + j * (grid.cells + 1) + i;
    const weir::Neighbours has{i > 0, i + 1 < grid.cells, j > 0, j + 1 < grid.cells};
    return weir::convert<double>(
        binary ? line.normal
               : weir::wall_normal(node, grid.cells + 1, middle, has, grid.far, line.normal));
}

/// Adds every contour line of the field; `normal(p)` and `distance(p)` are the exact ones.
template <class Normal, class Distance>
void compare(const NodeGrid<float>& grid, bool binary, Normal normal, Distance distance,
             Error& error) {
    for (int j = 0; j < grid.cells; ++j) {
        for (int i = 0; i < grid.cells; ++i) {
            float corner[4];
            grid.corners(i, j, corner);
            const auto cell = weir::contour_cell(corner);
            for (int k = 0; k < cell.lines; ++k) {
                const Vec2<double> origin{static_cast<double>(i), static_cast<double>(j)};
                const auto from = origin + weir::convert<double>(cell.line[k].from);
                const auto to = origin + weir::convert<double>(cell.line[k].to);
                const auto middle = 0.5 * (from + to);
                const double size = weir::length(to - from);
                const double angle = std::abs(
                    angle_between(normal_at(grid, i, j, cell.line[k], binary), normal(middle)));
                const double off = std::abs(distance(middle));
                error.length += size;
                error.angle_squares += size * angle * angle;
                error.angle_max = std::max(error.angle_max, angle * kDegrees);
                error.position_squares += size * off * off;
                error.position_max = std::max(error.position_max, off);
            }
        }
    }
}

constexpr int kCells = 44;

/// A half plane through the grid's middle: its corners are far outside.
Error of_lines(bool binary) {
    Error error;
    for (int k = 0; k < 25; ++k) {
        for (const double offset : {0.137, 0.731}) {
            const double angle = (0.37 + 3.6 * k) / kDegrees;
            const Vec2<double> n{std::cos(angle), std::sin(angle)};
            const Vec2<double> along{-n.y, n.x};
            const Vec2<double> on = Vec2<double>{22.0, 22.0} + offset * n;
            const double far = 100.0;
            NodeGrid<float> grid(kCells);
            grid.draw({on + far * along, on + far * along - far * n, on - far * along - far * n,
                       on - far * along},
                      binary);
            compare(
                grid, binary, [&](Vec2<double>) { return n; },
                [&](Vec2<double> p) { return weir::dot(p - on, n); }, error);
        }
    }
    return error;
}

Error of_circles(double radius, bool binary) {
    Error error;
    for (int k = 0; k < 8; ++k) {
        const Vec2<double> centre{22.0 + 0.37 * k / 8.0, 22.0 + 0.61 * k / 8.0};
        NodeGrid<float> grid(kCells);
        grid.draw(regular_polygon(1000, radius, centre, 0.1), binary);
        compare(
            grid, binary, [&](Vec2<double> p) { return p - centre; },
            [&](Vec2<double> p) { return weir::length(p - centre) - radius; }, error);
    }
    return error;
}

}  // namespace

void contour_normals(Report& report, const Effort&) {
    const Error line = of_lines(false);
    report.at_most("lines.normal_rms", line.angle_rms(), "deg", 0.01);
    report.at_most("lines.position_rms", line.position_rms(), "cells", 1e-4);
    report.figure("lines.normal_rms.binary", of_lines(true).angle_rms(), "deg");
    double last = 0.0;
    double limit = 0.4;
    for (const int radius : {4, 8, 16}) {
        const std::string name = "circle_" + std::to_string(radius);
        const Error error = of_circles(radius, false);
        report.at_most(name + ".normal_rms", error.angle_rms(), "deg", limit);
        limit /= 4.0;
        report.figure(name + ".normal_max", error.angle_max, "deg");
        report.figure(name + ".position_rms", error.position_rms(), "cells");
        if (last > 0.0) {
            // dx² / 8R: halved at twice the radius in cells, a quarter relative to the radius.
            report.at_least(name + ".position_order", 1.0 + std::log2(last / error.position_rms()),
                            "1", 1.9);
        }
        last = error.position_rms();
        report.figure(name + ".normal_rms.binary", of_circles(radius, true).angle_rms(), "deg");
    }
}

}  // namespace solids
