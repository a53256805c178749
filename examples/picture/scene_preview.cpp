// Draws a scene header as it starts, and how its moving bodies move: a check of a drawing before
// any simulation runs.
//
//   svg_to_scene.py drawing.svg scene_data.hpp
//   c++ -std=c++17 -DWEIR_SCENE_HEADER='"scene_data.hpp"' scene_preview.cpp ... -lweir_picture
//   scene_preview OUT.png [OUT.gif]
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include WEIR_SCENE_HEADER
#include "scene_motion.hpp"
#include "scene_outline.hpp"
#include "weir_picture/frame.hpp"
#include "weir_picture/image_file.hpp"

namespace {

using weir_picture::Point;
using weir_picture::Polygon;

std::vector<Point> in_cells(const scene::Shape& shape, const scene::Motion& motion) {
    std::vector<Point> points;
    const float c = std::cos(motion.angle_rad);
    const float s = std::sin(motion.angle_rad);
    for (const scene::Point p : scene::one_line(shape)) {
        points.push_back({(motion.position_m.x_m + c * p.x_m - s * p.y_m) / kScene.cell_m,
                          (motion.position_m.y_m + s * p.x_m + c * p.y_m) / kScene.cell_m});
    }
    return points;
}

bool inside(const std::vector<Point>& polygon, Point p) {
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Point a = polygon[i];
        const Point b = polygon[j];
        if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
            in = !in;
        }
    }
    return in;
}

std::vector<Polygon> bodies(std::uint32_t step) {
    std::vector<Polygon> out;
    for (std::int32_t i = 0; i < kScene.solid_count; ++i) {
        out.push_back({in_cells(kScene.solids[i], {}), false});
    }
    for (std::int32_t i = 0; i < kScene.moving_count; ++i) {
        const scene::Moving& body = kScene.moving[i];
        out.push_back({in_cells(body.shape, scene::motion_at(body, step, kScene.dt_s)), true});
    }
    return out;
}

bool inside_any(const std::vector<std::vector<Point>>& polygons, Point p) {
    for (const std::vector<Point>& polygon : polygons) {
        if (inside(polygon, p)) {
            return true;
        }
    }
    return false;
}

// Seeds on the lattice, outside of every solid.
std::vector<float> seeds() {
    std::vector<std::vector<Point>> liquid;
    std::vector<std::vector<Point>> solid;
    for (std::int32_t i = 0; i < kScene.liquid_count; ++i) {
        liquid.push_back(in_cells(kScene.liquid[i], {}));
    }
    for (const Polygon& body : bodies(0)) {
        solid.push_back(body.points);
    }
    int side = 1;
    while (side * side < kScene.particles_per_cell) {
        ++side;
    }
    std::vector<float> xy;
    for (int y = 0; y < kScene.cells_y * side; ++y) {
        for (int x = 0; x < kScene.cells_x * side; ++x) {
            const Point p{(static_cast<float>(x) + 0.5f) / static_cast<float>(side),
                          (static_cast<float>(y) + 0.5f) / static_cast<float>(side)};
            if (inside_any(liquid, p) && !inside_any(solid, p)) {
                xy.push_back(p.x);
                xy.push_back(p.y);
            }
        }
    }
    return xy;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s OUT.png [OUT.gif]\n", argv[0]);
        return 2;
    }
    const std::vector<float> xy = seeds();
    weir_picture::Style style = weir_picture::style_for(kScene.cells_x, kScene.cells_y, 800);
    weir_picture::Particles particles{xy.data(), xy.data() + 1, 2, nullptr, xy.size() / 2};
    const auto draw = [&](std::uint32_t step) {
        return weir_picture::draw_frame(
            kScene.cells_x, kScene.cells_y, particles, bodies(step),
            std::string(kScene.name) + "  " +
                weir_picture::time_caption(static_cast<float>(step) * kScene.dt_s),
            style);
    };
    std::string error;
    bool good = weir_picture::write_png(argv[1], draw(0), &error);
    if (good && argc > 2) {
        std::vector<weir_picture::Canvas> frames;
        for (std::uint32_t step = 0; step < 180; step += 3) {
            frames.push_back(draw(step));
        }
        good = weir_picture::write_gif(argv[2], frames, 5, &error);
    }
    if (!good) {
        std::fprintf(stderr, "%s\n", error.c_str());
        return 1;
    }
    const int most = static_cast<int>(kScene.max_particles);
    std::printf("%zu particles of at most %d\n", particles.count, most);
    return particles.count <= static_cast<std::size_t>(most) ? 0 : 1;
}
