// A scene drawn in a vector editor: solids, moving bodies and liquid as constant data.
//
// Written by svg_to_scene.py, read by examples and firmware; lives in read-only memory. Lengths are
// metres, y points up, the origin is the tank's bottom left corner. Polygons are simple, outer rings
// counter-clockwise; a ring's first vertex is not repeated. Polygons of a kind do not overlap.
#pragma once

#include <cstdint>

namespace scene {

struct Point {
    float x_m;
    float y_m;
};

// One polygon, with holes or without. count >= 3.
struct Shape {
    const Point* points;                // of all rings, the outer one first
    std::int32_t count;
    const std::int32_t* ends = nullptr; // where each ring ends in points; nullptr: there is one
    std::int32_t rings = 1;
};

// Where a ring of a shape begins and ends in its points.
constexpr std::int32_t ring_begin(const Shape& shape, std::int32_t ring) {
    return ring == 0 ? 0 : shape.ends[ring - 1];
}
constexpr std::int32_t ring_end(const Shape& shape, std::int32_t ring) {
    return shape.ends == nullptr ? shape.count : shape.ends[ring];
}

// A body that moves as prescribed; scene_motion.hpp says where it is at a given step. A drawn body
// of several parts becomes several of these with the same motion.
struct Moving {
    Shape shape;                // relative to the pivot
    Point position_m;           // of the pivot at the start
    Point velocity_mps;         // constant; zero for a body on a path
    float spin_radps;           // constant, counter-clockwise
    const Point* path;          // points the pivot visits in a closed loop, or nullptr
    const float* path_fraction; // share of the period at which it reaches each: 0 .. < 1, rising
    std::int32_t path_count;    // 0, or >= 2
    float period_s;             // of one loop; 0 without a path
};

struct Scene {
    const char* name;
    std::int32_t cells_x;
    std::int32_t cells_y;
    float cell_m;
    Point gravity_mps2;
    float dt_s;                       // of one frame
    std::int32_t steps;               // frames worth showing
    std::int32_t particles_per_cell;  // a square number: 4 is a lattice of 2 x 2 in every cell
    const Shape* solids;
    std::int32_t solid_count;
    const Moving* moving;
    std::int32_t moving_count;
    const Shape* liquid;
    std::int32_t liquid_count;
    std::int32_t max_particles;       // lattice points in the liquid and not in a solid: no more
    std::int32_t total_vertices;      // of all solids and moving bodies together, and 3 a hole
    std::int32_t max_vertices;        // of the one that has most
    std::int32_t max_holes;           // of the one that has most
    std::int32_t wall_edges = 0;      // room for walls thinner than a cell, if there are any
};

// Bodies a world must have room for.
constexpr std::int32_t body_count(const Scene& s) { return s.solid_count + s.moving_count; }

}  // namespace scene
