// An RGB picture in memory, with filled polygons and discs whose edges are anti-aliased.
//
// Coordinates are pixels, x to the right, y down; the pixel in the corner covers 0..1 x 0..1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace weir_picture {

struct Color {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;
};

// Between two colours; t is clamped to 0 (a) .. 1 (b).
Color mixed(Color a, Color b, float t);

struct Point {
    float x = 0.0f;
    float y = 0.0f;
};

class Canvas {
public:
    // Sizes below 1 become 1, above kMaxSide become kMaxSide.
    Canvas(int width, int height, Color background);

    static constexpr int kMaxSide = 16384;

    int width() const { return width_; }
    int height() const { return height_; }
    // Row by row from the top, three bytes a pixel, no padding.
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }
    Color pixel(int x, int y) const;

    // Replaces a pixel; outside the picture nothing happens.
    void set(int x, int y, Color color);

    // Lays a colour over a pixel, coverage 0..1.
    void blend(int x, int y, Color color, float coverage);

    // Even-odd filling. Fewer than 3 points draw nothing. Not finite points draw nothing.
    void fill_polygon(const std::vector<Point>& points, Color color);

    void fill_disc(Point centre, float radius, Color color);

    // Corners included; parts outside are cut off.
    void fill_rectangle(int x, int y, int width, int height, Color color);

    // Printable ASCII in a 5 x 7 dot font, each dot scale x scale pixels; others show as '?'.
    // x, y is the top left corner. An advance is 6 dots, a line 7.
    void draw_text(int x, int y, const std::string& text, int scale, Color color);

    // Copies another picture with its corner at x, y; parts outside are cut off.
    void paste(const Canvas& other, int x, int y);

private:
    std::size_t offset(int x, int y) const;

    int width_;
    int height_;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace weir_picture
