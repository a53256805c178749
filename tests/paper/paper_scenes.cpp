#include "paper_scenes.hpp"

#include <algorithm>
#include <cmath>

namespace paper_bench {
namespace {

constexpr float kPi = 3.14159265358979323846F;
constexpr float kGap = 0.6F;      // particles keep away from solids: none starts in a cut cell
constexpr int kAspect = 2;        // tank: width over height
constexpr float kDamHeight = 0.8F;  // over the tank's height
constexpr float kFill = 0.4F;     // liquid's share of the tank

Solid convex(const paper::Polygon& outline, Point position, float angle_rad, float spin_radps) {
    return {outline, {outline}, position, angle_rad, spin_radps};
}

// Five tips on a pentagon. The inner radius is that of a pentagram.
Solid star(float radius, Point position, float angle_rad, float spin_radps) {
    const float inner = radius * 0.381966F;
    Solid solid;
    solid.position = position;
    solid.angle_rad = angle_rad;
    solid.spin_radps = spin_radps;
    const paper::Polygon tips = paper::regular_polygon({}, radius, 5, 0.0F);
    const paper::Polygon core = paper::regular_polygon({}, inner, 5, 0.2F * kPi);
    solid.pieces.push_back(core);
    for (std::size_t k = 0; k < 5; ++k) {
        solid.outline.push_back(tips[k]);
        solid.outline.push_back(core[k]);
        solid.pieces.push_back({tips[k], core[k], core[(k + 4) % 5]});
    }
    return solid;
}

Solid shaped(Shape shape, float radius, Point position, float angle_rad, float spin_radps) {
    if (shape == Shape::star) {
        return star(radius, position, angle_rad, spin_radps);
    }
    const int corners = shape == Shape::triangle ? 3 : 6;
    return convex(paper::regular_polygon({}, radius, corners, 0.0F), position, angle_rad,
                  spin_radps);
}

float distance_to_edge(Point p, Point a, Point b) {
    const float ex = b.x - a.x;
    const float ey = b.y - a.y;
    const float t =
        std::clamp(((p.x - a.x) * ex + (p.y - a.y) * ey) / (ex * ex + ey * ey), 0.0F, 1.0F);
    return std::hypot(p.x - a.x - t * ex, p.y - a.y - t * ey);
}

// A solid in place, with the circle round it that saves most of the looking.
struct Placed {
    std::vector<paper::Polygon> pieces;
    Point centre;
    float reach = 0.0F;
};

Placed place(const Solid& solid) {
    Placed result;
    result.centre = solid.position;
    for (const paper::Polygon& piece : solid.pieces) {
        result.pieces.push_back(paper::placed(piece, solid.position, solid.angle_rad));
        for (const Point& p : piece) {
            result.reach = std::max(result.reach, std::hypot(p.x, p.y));
        }
    }
    return result;
}

bool is_clear(Point p, const std::vector<Placed>& solids) {
    for (const Placed& solid : solids) {
        if (std::hypot(p.x - solid.centre.x, p.y - solid.centre.y) > solid.reach + kGap) {
            continue;
        }
        for (const paper::Polygon& piece : solid.pieces) {
            if (paper::is_inside(piece, p)) {
                return false;
            }
            for (std::size_t k = 0; k < piece.size(); ++k) {
                if (distance_to_edge(p, piece[k], piece[(k + 1) % piece.size()]) < kGap) {
                    return false;
                }
            }
        }
    }
    return true;
}

// A dam at the left wall, as wide as it takes; then row by row, as a user's fill would be.
void pour(Scene& scene, int particles) {
    std::vector<Placed> solids;
    for (const Solid& solid : scene.solids) {
        solids.push_back(place(solid));
    }
    const int rows = static_cast<int>(2.0F * scene.depth_cells);
    const auto wanted = static_cast<std::size_t>(particles);
    for (int i = 0; i < 2 * scene.cells_x && scene.particles.size() < wanted; ++i) {
        for (int j = 0; j < rows && scene.particles.size() < wanted; ++j) {
            const Point p{0.25F + 0.5F * static_cast<float>(i),
                          0.25F + 0.5F * static_cast<float>(j)};
            if (is_clear(p, solids)) {
                scene.particles.push_back(p);
            }
        }
    }
    std::stable_sort(scene.particles.begin(), scene.particles.end(),
                     [](Point a, Point b) { return a.y < b.y; });
}

Scene tank(const std::string& name, int particles) {
    Scene scene;
    scene.name = name;
    const float cells = 0.25F * static_cast<float>(particles) / kFill;
    scene.cells_y = static_cast<int>(std::sqrt(cells / kAspect)) + 1;
    scene.cells_x = kAspect * scene.cells_y;
    scene.depth_cells = kDamHeight * static_cast<float>(scene.cells_y);
    return scene;
}

Solid solid_of(const PlacedForm& placed) {
    const Point at{placed.x, placed.y};
    const float x = placed.size_x;
    const float y = placed.size_y;
    switch (placed.form) {
        case Form::rectangle:
            return convex(paper::box_polygon({-x, -y}, {x, y}), at, placed.angle_rad,
                          placed.spin_radps);
        case Form::ramp:
            return convex({{-x, -y}, {x, -y}, {x, y}}, at, placed.angle_rad, placed.spin_radps);
        case Form::triangle:
            return shaped(Shape::triangle, x, at, placed.angle_rad, placed.spin_radps);
        case Form::hexagon:
            return shaped(Shape::hexagon, x, at, placed.angle_rad, placed.spin_radps);
        default:
            return shaped(Shape::star, x, at, placed.angle_rad, placed.spin_radps);
    }
}

}  // namespace

const char* setting_name(Setting setting) {
    return setting == Setting::box ? "box" : setting == Setting::standard ? "standard" : "complex";
}

const char* shape_name(Shape shape) {
    return shape == Shape::triangle ? "triangle" : shape == Shape::hexagon ? "hexagon" : "star";
}

Scene setting_scene(Setting setting, int particles) {
    Scene scene = tank(setting_name(setting), particles);
    for_each_solid(setting, static_cast<float>(scene.cells_x), static_cast<float>(scene.cells_y),
                   [&](const PlacedForm& placed) { scene.solids.push_back(solid_of(placed)); });
    pour(scene, particles);
    return scene;
}

Scene polygon_scene(Shape shape, int polygons, int particles, bool turning) {
    Scene scene = tank(std::to_string(polygons) + " " + shape_name(shape) + "s", particles);
    const auto w = static_cast<float>(scene.cells_x);
    const auto h = static_cast<float>(scene.cells_y);
    const float radius = shape == Shape::hexagon ? 1.7F : 4.0F;
    const int rows = static_cast<int>(std::sqrt(0.5F * static_cast<float>(polygons)));
    const int columns = (polygons + rows - 1) / rows;
    const float margin = radius + 1.0F;
    const float step_x = (w - 2.0F * margin) / static_cast<float>(columns - 1);
    const float step_y = (h - 2.0F * margin) / static_cast<float>(rows - 1);
    for (int k = 0; k < polygons; ++k) {
        const Point at{margin + step_x * static_cast<float>(k / rows),
                       margin + step_y * static_cast<float>(k % rows)};
        scene.solids.push_back(
            shaped(shape, radius, at, static_cast<float>(k), turning ? kTurn : 0.0F));
    }
    pour(scene, particles);
    return scene;
}

}  // namespace paper_bench
