#include "paper_solids.hpp"

#include <algorithm>
#include <cmath>

namespace paper {
namespace {

constexpr float kTau = 6.28318530717958647692F;
constexpr float kDiagonal = 0.70710678118654752440F;  // 1/sqrt(2): the slope of a corner line

Contact behind(bool is_behind, Point normal) {
    return is_behind ? Contact{Side::behind_line, normal} : Contact{};
}

}  // namespace

Polygon regular_polygon(Point centre, float radius, int corners, float angle_rad) {
    Polygon polygon;
    for (int k = 0; k < corners; ++k) {
        const float angle = angle_rad + kTau * static_cast<float>(k) / static_cast<float>(corners);
        polygon.push_back(
            {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return polygon;
}

Polygon box_polygon(Point low, Point high) {
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

Polygon placed(const Polygon& local, Point position, float angle_rad) {
    const float c = std::cos(angle_rad);
    const float s = std::sin(angle_rad);
    Polygon polygon;
    polygon.reserve(local.size());
    for (const Point& p : local) {
        polygon.push_back({position.x + c * p.x - s * p.y, position.y + s * p.x + c * p.y});
    }
    return polygon;
}

bool is_inside(const Polygon& polygon, Point point) {
    Point a = polygon.back();
    for (const Point& b : polygon) {
        const float turn = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
        if (turn <= 0.0F) {
            return false;
        }
        a = b;
    }
    return true;
}

Contact test_cell(int contour_case, float u, float v) {
    const float sum = u + v;         // the lines round the lower left and upper right corner
    const float difference = u - v;  // the lines round the lower right and upper left corner
    const Point up_right{kDiagonal, kDiagonal};
    const Point down_left{-kDiagonal, -kDiagonal};
    const Point up_left{-kDiagonal, kDiagonal};
    const Point down_right{kDiagonal, -kDiagonal};
    switch (contour_case) {
        case kLowLeft: return behind(sum < 0.5F, up_right);
        case kLowRight: return behind(difference > 0.5F, up_left);
        case kHighRight: return behind(sum > 1.5F, down_left);
        case kHighLeft: return behind(difference < -0.5F, down_right);
        case kLowLeft | kLowRight: return behind(v < 0.5F, {0.0F, 1.0F});
        case kLowRight | kHighRight: return behind(u > 0.5F, {-1.0F, 0.0F});
        case kHighRight | kHighLeft: return behind(v > 0.5F, {0.0F, -1.0F});
        case kHighLeft | kLowLeft: return behind(u < 0.5F, {1.0F, 0.0F});
        case kLowLeft | kHighRight:
            return sum < 1.0F ? behind(sum < 0.5F, up_right) : behind(sum > 1.5F, down_left);
        case kLowRight | kHighLeft:
            return difference > 0.0F ? behind(difference > 0.5F, up_left)
                                     : behind(difference < -0.5F, down_right);
        case kCaseFull - kLowLeft: return behind(sum > 0.5F, down_left);
        case kCaseFull - kLowRight: return behind(difference < 0.5F, down_right);
        case kCaseFull - kHighRight: return behind(sum < 1.5F, up_right);
        case kCaseFull - kHighLeft: return behind(difference > -0.5F, up_left);
        case kCaseFull: return {Side::buried, {}};
        default: return {};
    }
}

Point reflected(Point velocity, Point normal) {
    const float along = velocity.x * normal.x + velocity.y * normal.y;
    if (along >= 0.0F) {
        return velocity;
    }
    return {velocity.x - 2.0F * along * normal.x, velocity.y - 2.0F * along * normal.y};
}

Solids::Solids(int nodes_x, int nodes_y) : nodes_x_(nodes_x), nodes_y_(nodes_y) {
    const std::size_t nodes = static_cast<std::size_t>(nodes_x) * static_cast<std::size_t>(nodes_y);
    static_solid_.assign(nodes, 0);
    solid_.assign(nodes, 0);
    cases_.assign(nodes, 0);
}

void Solids::add_static(const Polygon& polygon) {
    rasterize(polygon, static_solid_);
    has_static_ = true;
}

void Solids::add_dynamic(const Polygon& local, Point position, float angle_rad, float spin_rad) {
    dynamic_.push_back({local, position, angle_rad, spin_rad});
}

void Solids::rasterize(const Polygon& polygon, std::vector<std::uint8_t>& matrix) const {
    Point low = polygon.front();
    Point high = polygon.front();
    for (const Point& p : polygon) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const int i0 = std::max(0, static_cast<int>(std::ceil(low.x)));
    const int j0 = std::max(0, static_cast<int>(std::ceil(low.y)));
    const int i1 = std::min(nodes_x_ - 1, static_cast<int>(std::floor(high.x)));
    const int j1 = std::min(nodes_y_ - 1, static_cast<int>(std::floor(high.y)));
    for (int j = j0; j <= j1; ++j) {
        for (int i = i0; i <= i1; ++i) {
            std::uint8_t& cell = matrix[node(i, j)];
            if (cell == 0 && is_inside(polygon, {static_cast<float>(i), static_cast<float>(j)})) {
                cell = 1;
            }
        }
    }
}

void Solids::march() {
    for (int j = 0; j + 1 < nodes_y_; ++j) {
        const std::uint8_t* low = &solid_[node(0, j)];
        const std::uint8_t* high = &solid_[node(0, j + 1)];
        std::uint8_t* out = &cases_[node(0, j)];
        for (int i = 0; i + 1 < nodes_x_; ++i) {
            out[i] = static_cast<std::uint8_t>(low[i] * kLowLeft + low[i + 1] * kLowRight +
                                               high[i + 1] * kHighRight + high[i] * kHighLeft);
        }
    }
}

void Solids::rebuild() {
    solid_ = static_solid_;
    for (Dynamic& body : dynamic_) {
        body.angle_rad += body.spin_rad;
        rasterize(placed(body.local, body.position, body.angle_rad), solid_);
    }
    march();
}

Contact Solids::contact(Point point) const {
    const int i = static_cast<int>(point.x);
    const int j = static_cast<int>(point.y);
    const int contour = cases_[node(i, j)];
    if (contour == 0) {
        return {};
    }
    return test_cell(contour, point.x - static_cast<float>(i), point.y - static_cast<float>(j));
}

}  // namespace paper
