#include "weir_picture/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "font.hpp"

namespace weir_picture {

namespace {

constexpr int kRowsPerPixel = 4;  // vertical sub-samples; horizontally coverage is exact

std::uint8_t mixed_byte(std::uint8_t a, std::uint8_t b, float t) {
    const float value = static_cast<float>(a) + (static_cast<float>(b) - static_cast<float>(a)) * t;
    return static_cast<std::uint8_t>(value + 0.5f);
}

// Where a polygon's edges cross a horizontal line, sorted.
void crossings(const std::vector<Point>& points, float y, std::vector<float>* out) {
    out->clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point a = points[i];
        const Point b = points[i + 1 == points.size() ? 0 : i + 1];
        if ((a.y <= y) != (b.y <= y)) {
            out->push_back(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
        }
    }
    std::sort(out->begin(), out->end());
}

// Adds a span's share of each pixel of a row.
void add_span(float from, float to, float weight, std::vector<float>* row) {
    const float right = static_cast<float>(row->size());
    from = std::max(0.0f, std::min(right, from));
    to = std::max(0.0f, std::min(right, to));
    for (int x = static_cast<int>(from); static_cast<float>(x) < to; ++x) {
        const float pixel = static_cast<float>(x);
        const float covered = std::min(to, pixel + 1.0f) - std::max(from, pixel);
        (*row)[static_cast<std::size_t>(x)] += covered * weight;
    }
}

}  // namespace

Color mixed(Color a, Color b, float t) {
    t = t > 0.0f ? std::min(t, 1.0f) : 0.0f;
    return {mixed_byte(a.r, b.r, t), mixed_byte(a.g, b.g, t), mixed_byte(a.b, b.b, t)};
}

Canvas::Canvas(int width, int height, Color background)
    : width_(std::max(1, std::min(width, kMaxSide))),
      height_(std::max(1, std::min(height, kMaxSide))),
      bytes_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3) {
    for (std::size_t i = 0; i < bytes_.size(); i += 3) {
        bytes_[i] = background.r;
        bytes_[i + 1] = background.g;
        bytes_[i + 2] = background.b;
    }
}

std::size_t Canvas::offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
            static_cast<std::size_t>(x)) * 3;
}

Color Canvas::pixel(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) {
        return {};
    }
    const std::size_t at = offset(x, y);
    return {bytes_[at], bytes_[at + 1], bytes_[at + 2]};
}

void Canvas::set(int x, int y, Color color) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) {
        return;
    }
    const std::size_t at = offset(x, y);
    bytes_[at] = color.r;
    bytes_[at + 1] = color.g;
    bytes_[at + 2] = color.b;
}

void Canvas::blend(int x, int y, Color color, float coverage) {
    set(x, y, mixed(pixel(x, y), color, coverage));
}

void Canvas::fill_polygon(const std::vector<Point>& points, Color color) {
    if (points.size() < 3) {
        return;
    }
    float top = static_cast<float>(height_);
    float bottom = 0.0f;
    for (const Point p : points) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
            return;
        }
        top = std::min(top, p.y);
        bottom = std::max(bottom, p.y);
    }
    const int first = static_cast<int>(std::max(top, 0.0f));
    const int last = static_cast<int>(std::min(bottom, static_cast<float>(height_ - 1)));
    std::vector<float> cuts;
    std::vector<float> row(static_cast<std::size_t>(width_));
    for (int y = first; y <= last; ++y) {
        std::fill(row.begin(), row.end(), 0.0f);
        for (int sub = 0; sub < kRowsPerPixel; ++sub) {
            const float part = (static_cast<float>(sub) + 0.5f) / kRowsPerPixel;
            crossings(points, static_cast<float>(y) + part, &cuts);
            for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
                add_span(cuts[i], cuts[i + 1], 1.0f / kRowsPerPixel, &row);
            }
        }
        for (int x = 0; x < width_; ++x) {
            if (row[static_cast<std::size_t>(x)] > 0.0f) {
                blend(x, y, color, row[static_cast<std::size_t>(x)]);
            }
        }
    }
}

void Canvas::fill_disc(Point centre, float radius, Color color) {
    const float reach = radius + 1.0f;
    // The comparison is false for not finite numbers too.
    if (!(reach > 0.0f && centre.x > -reach && centre.y > -reach &&
          centre.x < static_cast<float>(width_) + reach &&
          centre.y < static_cast<float>(height_) + reach && reach < 2.0f * kMaxSide)) {
        return;
    }
    const int left = std::max(0, static_cast<int>(centre.x - reach));
    const int right = std::min(width_ - 1, static_cast<int>(centre.x + reach));
    const int top = std::max(0, static_cast<int>(centre.y - reach));
    const int bottom = std::min(height_ - 1, static_cast<int>(centre.y + reach));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const float dx = static_cast<float>(x) + 0.5f - centre.x;
            const float dy = static_cast<float>(y) + 0.5f - centre.y;
            const float inside = radius + 0.5f - std::sqrt(dx * dx + dy * dy);
            if (inside > 0.0f) {
                blend(x, y, color, inside);
            }
        }
    }
}

void Canvas::fill_rectangle(int x, int y, int width, int height, Color color) {
    const int right = std::min(width_, x + width);
    const int bottom = std::min(height_, y + height);
    for (int row = std::max(0, y); row < bottom; ++row) {
        for (int column = std::max(0, x); column < right; ++column) {
            set(column, row, color);
        }
    }
}

void Canvas::draw_text(int x, int y, const std::string& text, int scale, Color color) {
    for (const char c : text) {
        for (int column = 0; column < kGlyphWidth; ++column) {
            const unsigned bits = glyph_column(c, column);
            for (int row = 0; row < kGlyphHeight; ++row) {
                if ((bits >> row) & 1u) {
                    fill_rectangle(x + column * scale, y + row * scale, scale, scale, color);
                }
            }
        }
        x += (kGlyphWidth + 1) * scale;
    }
}

void Canvas::paste(const Canvas& other, int x, int y) {
    for (int row = 0; row < other.height(); ++row) {
        for (int column = 0; column < other.width(); ++column) {
            set(x + column, y + row, other.pixel(column, row));
        }
    }
}

}  // namespace weir_picture
