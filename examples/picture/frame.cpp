#include "weir_picture/frame.hpp"

#include <algorithm>
#include <cstdio>

namespace weir_picture {

namespace {

constexpr int kMargin = 8;   // around the tank, pixels
constexpr int kWall = 3;     // thickness of the tank's outline, pixels
constexpr int kSheetGap = 8; // between frames of a contact sheet, pixels

Color speed_color(const Style& style, float share) {
    if (!(share > 0.0f)) {
        return style.slow;
    }
    return share < 0.5f ? mixed(style.slow, style.medium, 2.0f * share)
                        : mixed(style.medium, style.fast, 2.0f * share - 1.0f);
}

int text_scale(int width) { return std::max(1, std::min(4, width / 200)); }

}  // namespace

Style style_for(int cells_x, int cells_y, int longer_side_pixels) {
    Style style;
    const int longer = std::max(1, std::max(cells_x, cells_y));
    style.pixels_per_cell = std::max(1, (longer_side_pixels + longer / 2) / longer);
    return style;
}

Canvas draw_frame(int cells_x, int cells_y, const Particles& particles,
                  const std::vector<Polygon>& polygons, const std::string& caption,
                  const Style& style) {
    const int width = cells_x * style.pixels_per_cell;
    const int height = cells_y * style.pixels_per_cell;
    const int scale = text_scale(width);
    const int band = caption.empty() ? 0 : 7 * scale + kMargin;
    Canvas canvas(width + 2 * kMargin, height + 2 * kMargin + band, style.background);
    const float zoom = static_cast<float>(style.pixels_per_cell);
    const auto on_canvas = [&](float x, float y) {
        return Point{static_cast<float>(kMargin) + x * zoom,
                     static_cast<float>(kMargin + height) - y * zoom};
    };

    const float radius = style.particle_radius_cells * zoom;
    for (std::size_t i = 0; i < particles.count; ++i) {
        const float share =
            particles.speed != nullptr ? particles.speed[i] / style.full_speed : 0.0f;
        const std::size_t at = i * particles.stride;
        canvas.fill_disc(on_canvas(particles.x[at], particles.y[at]), radius,
                         speed_color(style, share));
    }
    for (const bool moving : {false, true}) {
        for (const Polygon& polygon : polygons) {
            if (polygon.moving != moving) {
                continue;
            }
            std::vector<Point> points;
            for (const Point p : polygon.points) {
                points.push_back(on_canvas(p.x, p.y));
            }
            canvas.fill_polygon(points, moving ? style.moving : style.solid);
        }
    }
    // The tank is open to the sky in drawings, closed in the simulation: draw all four walls.
    // Outside it nothing shows: a body may be partly outside.
    const int outer_width = width + 2 * kMargin;
    canvas.fill_rectangle(0, 0, outer_width, kMargin - kWall, style.background);
    canvas.fill_rectangle(0, kMargin + height + kWall, outer_width, kMargin + band,
                          style.background);
    for (const int x : {0, kMargin + width + kWall}) {
        canvas.fill_rectangle(x, 0, kMargin - kWall, height + 2 * kMargin, style.background);
    }
    for (const int y : {kMargin - kWall, kMargin + height}) {
        canvas.fill_rectangle(kMargin - kWall, y, width + 2 * kWall, kWall, style.frame);
    }
    for (const int x : {kMargin - kWall, kMargin + width}) {
        canvas.fill_rectangle(x, kMargin - kWall, kWall, height + 2 * kWall, style.frame);
    }
    canvas.draw_text(kMargin, 2 * kMargin + height, caption, scale, style.text);
    return canvas;
}

std::string time_caption(float time_s) {
    char text[48];
    std::snprintf(text, sizeof text, "t = %.2f s", static_cast<double>(time_s));
    return text;
}

Canvas contact_sheet(const std::vector<Canvas>& frames, int columns, Color background) {
    if (frames.empty()) {
        return Canvas(1, 1, background);
    }
    columns = std::max(1, std::min(columns, static_cast<int>(frames.size())));
    const int rows = (static_cast<int>(frames.size()) + columns - 1) / columns;
    int width = 0;
    int height = 0;
    for (const Canvas& frame : frames) {
        width = std::max(width, frame.width());
        height = std::max(height, frame.height());
    }
    Canvas sheet(columns * (width + kSheetGap) + kSheetGap, rows * (height + kSheetGap) + kSheetGap,
                 background);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const int column = static_cast<int>(i) % columns;
        const int row = static_cast<int>(i) / columns;
        sheet.paste(frames[i], kSheetGap + column * (width + kSheetGap),
                    kSheetGap + row * (height + kSheetGap));
    }
    return sheet;
}

}  // namespace weir_picture
