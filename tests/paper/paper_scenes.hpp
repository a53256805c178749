// The scenes of the paper's four tables, once for both methods: same solids, same liquid.
//
// The paper gives particle counts, polygon counts, and names (simple and complex shapes; box,
// standard and complex scene). The drawings of its scenes are not at hand, so what stands here
// under those names is ours: ratios between two methods on one scene mean something, a scene's
// own frame rate against the paper's does not.
//
// Lengths are in cells, the origin is the tank's lower left corner, y is up.
#pragma once

#include <string>
#include <vector>

#include "paper_solids.hpp"
#include "setting_solids.hpp"

namespace paper_bench {

using paper::Point;

/// A solid about its own origin. The outline may be concave; the pieces are convex and cover it,
/// for the method that knows only convex ones.
struct Solid {
    paper::Polygon outline;
    std::vector<paper::Polygon> pieces;
    Point position;
    float angle_rad = 0.0F;
    float spin_radps = 0.0F;  ///< 0: static
};

struct Scene {
    std::string name;
    float cell_m = 0.01F;
    float gravity_mps2 = 9.81F;
    int cells_x = 0;
    int cells_y = 0;
    float depth_cells = 0.0F;  ///< height of the liquid at the start
    std::vector<Solid> solids;
    std::vector<Point> particles;  ///< 2 × 2 per cell, row by row, none in a solid
    std::vector<Point> velocities_mps;  ///< of particles; none: at rest (Weir's runner alone)
};

enum class Shape { triangle, hexagon, star };

const char* setting_name(Setting setting);
const char* shape_name(Shape shape);

/// Tables I and IV: a dam of exactly that many particles in a tank with static solids (and, in the
/// complex one, turning ones).
Scene setting_scene(Setting setting, int particles);

/// Tables II and III: a dam in a lattice of that many equal polygons, all turning, so that they
/// are rasterized anew in every step; or none turning.
Scene polygon_scene(Shape shape, int polygons, int particles, bool turning);

}  // namespace paper_bench
