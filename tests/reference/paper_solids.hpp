// The solid part of the paper: polygons -> binary matrix -> contour matrix -> reflection.
//
// Stage: before the liquid's step (rebuild) and late in it (contact). Reads polygons, writes the
// binary matrix and the contour matrix. Cost: rebuild is one copy and one look at every node of
// the grid, and one left-turn test per polygon edge for each node in a moving polygon's bounding
// box; contact is one look-up per particle and, where a line crosses the cell, a comparison.
//
// Source: "Interaction Between Fluid and Solid Body Surfaces in Fluid Simulation using
// Material-Point Method": convex counter-clockwise polygons, left-turn test at the nodes, static
// matrix cached and copied, dynamic polygons merged in at each step, marching squares with lines
// through the middle of cell edges, v' = v - 2 (v.n) n. Its known faults are kept on purpose
// (thin solids fall between nodes, contours are staircases, a moving solid's own velocity is not
// seen by the liquid); this is the yardstick, not the library.
#pragma once

#include <cstdint>
#include <vector>

namespace paper {

struct Point {
    float x = 0.0F;
    float y = 0.0F;
};

/// Convex and counter-clockwise (y up), in cells.
using Polygon = std::vector<Point>;

Polygon regular_polygon(Point centre, float radius, int corners, float angle_rad);
Polygon box_polygon(Point low, Point high);
/// The polygon turned about the origin, then shifted.
Polygon placed(const Polygon& local, Point position, float angle_rad);

/// Left-turn test: every edge has the point strictly on its left.
bool is_inside(const Polygon& polygon, Point point);

/// Corner bits of a marching-squares case. Node (i, j) is the lower left corner of cell (i, j).
enum Corner : std::uint8_t { kLowLeft = 1, kLowRight = 2, kHighRight = 4, kHighLeft = 8 };
inline constexpr int kCaseFull = 15;

enum class Side : std::uint8_t { outside, behind_line, buried };

/// Where a point of a cell is against the contour; `normal` points into the liquid and is set
/// only behind a line (a full cell has no line: the paper's particles are trapped there).
struct Contact {
    Side side = Side::outside;
    Point normal;
};

/// The inside test for one of the 16 cases; (u, v) in [0, 1]² within the cell. A saddle (5, 10)
/// is read as two separate corners.
Contact test_cell(int contour_case, float u, float v);

/// v' = v - 2 (v.n) n, if the velocity points into the solid; otherwise unchanged.
Point reflected(Point velocity, Point normal);

class Solids {
public:
    Solids(int nodes_x, int nodes_y);

    /// Rasterized once, into the cached matrix.
    void add_static(const Polygon& polygon);
    /// A polygon about its own origin that turns by `spin` per step; rasterized in every step.
    void add_dynamic(const Polygon& local, Point position, float angle_rad, float spin_rad);

    /// Turns the dynamic polygons by one step, merges them in, and redoes the contour matrix.
    void rebuild();

    Contact contact(Point point) const;
    bool solid_at(int i, int j) const { return solid_[node(i, j)] != 0; }
    int contour_case(int i, int j) const { return cases_[node(i, j)]; }
    bool empty() const { return !has_static_ && dynamic_.empty(); }

private:
    struct Dynamic {
        Polygon local;
        Point position;
        float angle_rad;
        float spin_rad;
    };

    std::size_t node(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes_x_) +
               static_cast<std::size_t>(i);
    }
    void rasterize(const Polygon& polygon, std::vector<std::uint8_t>& matrix) const;
    void march();

    int nodes_x_;
    int nodes_y_;
    bool has_static_ = false;
    std::vector<std::uint8_t> static_solid_;
    std::vector<std::uint8_t> solid_;
    std::vector<std::uint8_t> cases_;
    std::vector<Dynamic> dynamic_;
};

}  // namespace paper
