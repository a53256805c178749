// Turns the frames that run_scene wrote into a contact sheet (PNG) and an animation (GIF):
//   draw_frames FRAMES SHEET.png ANIMATION.gif [longer side, pixels]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "drawing.hpp"
#include "scene_outline.hpp"
#include "weir/weir.hpp"
#include "weir_picture/frame.hpp"
#include "weir_picture/image_file.hpp"

namespace {

struct Pose {
    float x_m;
    float y_m;
    float angle_rad;
};

struct Frame {
    std::int32_t step = 0;
    std::vector<weir::Vec2f> position;
    std::vector<weir::Vec2f> velocity;
    std::vector<Pose> pose;
};

template <class T>
bool read(std::ifstream& in, std::vector<T>& out, std::int32_t count) {
    out.resize(static_cast<std::size_t>(count));
    const auto bytes = static_cast<std::streamsize>(out.size() * sizeof(T));
    return static_cast<bool>(in.read(reinterpret_cast<char*>(out.data()), bytes));
}

bool read(std::ifstream& in, Frame& frame) {
    std::int32_t head[3];
    if (!in.read(reinterpret_cast<char*>(head), sizeof head)) {
        return false;
    }
    frame.step = head[0];
    return read(in, frame.position, head[1]) && read(in, frame.velocity, head[1]) &&
           read(in, frame.pose, head[2]);
}

weir_picture::Polygon placed(const scene::Shape& shape, const Pose& pose, bool moving) {
    const float c = std::cos(pose.angle_rad);
    const float s = std::sin(pose.angle_rad);
    weir_picture::Polygon polygon;
    polygon.moving = moving;
    for (const scene::Point p : scene::one_line(shape)) {
        polygon.points.push_back({(pose.x_m + c * p.x_m - s * p.y_m) / kScene.cell_m,
                                  (pose.y_m + s * p.x_m + c * p.y_m) / kScene.cell_m});
    }
    return polygon;
}

weir_picture::Canvas draw(const Frame& frame, const weir_picture::Style& style) {
    std::vector<weir_picture::Polygon> polygons;
    for (std::int32_t k = 0; k < kScene.solid_count; ++k) {
        polygons.push_back(placed(kScene.solids[k], {0.0F, 0.0F, 0.0F}, false));
    }
    for (std::size_t k = 0; k < frame.pose.size(); ++k) {
        polygons.push_back(placed(kScene.moving[k].shape, frame.pose[k], true));
    }
    std::vector<float> speed;
    for (const weir::Vec2f v : frame.velocity) {
        speed.push_back(kScene.cell_m * std::sqrt(v.x * v.x + v.y * v.y));
    }
    weir_picture::Particles particles;
    if (!frame.position.empty()) {
        particles.x = &frame.position[0].x;
        particles.y = &frame.position[0].y;
    }
    particles.stride = 2;
    particles.speed = speed.data();
    particles.count = frame.position.size();
    const float time_s = static_cast<float>(frame.step) * kScene.dt_s;
    return weir_picture::draw_frame(kScene.cells_x, kScene.cells_y, particles, polygons,
                                    weir_picture::time_caption(time_s), style);
}

std::vector<weir_picture::Canvas> draw_all(std::ifstream& in, int longer_side) {
    weir_picture::Style style =
        weir_picture::style_for(kScene.cells_x, kScene.cells_y, longer_side);
    // Water that has fallen through the tank's height has the brightest colour.
    style.full_speed = std::sqrt(2.0F * 9.81F * static_cast<float>(kScene.cells_y) * kScene.cell_m);
    std::vector<weir_picture::Canvas> canvases;
    for (Frame frame; read(in, frame);) {
        canvases.push_back(draw(frame, style));
    }
    return canvases;
}

/// Twelve moments: the first, the last, and ten between.
std::vector<weir_picture::Canvas> selection(const std::vector<weir_picture::Canvas>& all) {
    constexpr std::size_t kMoments = 12;
    if (all.size() <= kMoments) {
        return all;
    }
    std::vector<weir_picture::Canvas> some;
    for (std::size_t k = 0; k < kMoments; ++k) {
        some.push_back(all[k * (all.size() - 1) / (kMoments - 1)]);
    }
    return some;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: draw_frames FRAMES SHEET.png ANIMATION.gif [pixels]\n");
        return 64;
    }
    std::ifstream in(argv[1], std::ios::binary);
    const std::vector<weir_picture::Canvas> frames =
        draw_all(in, argc > 4 ? std::atoi(argv[4]) : 480);
    if (frames.empty()) {
        std::fprintf(stderr, "draw_frames: no frames in %s\n", argv[1]);
        return 1;
    }
    std::string error;
    const auto sheet = weir_picture::contact_sheet(selection(frames), 3);
    if (!weir_picture::write_png(argv[2], sheet, &error) ||
        !weir_picture::write_gif(argv[3], frames, 8, &error)) {
        std::fprintf(stderr, "draw_frames: %s\n", error.c_str());
        return 1;
    }
    return 0;
}
