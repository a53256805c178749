#include "reference_pressure.hpp"

#include <algorithm>

namespace accuracy {

namespace {

/// Quadratic B-spline and its derivative at 0.5 ≤ t < 1.5 from the first of three nodes.
void weights(double t, double* w, double* d) {
    w[0] = 0.5 * (1.5 - t) * (1.5 - t);
    w[1] = 0.75 - (t - 1.0) * (t - 1.0);
    w[2] = 0.5 * (t - 0.5) * (t - 0.5);
    d[0] = t - 1.5;
    d[1] = -2.0 * (t - 1.0);
    d[2] = t - 0.5;
}

double hermite(double f0, double f1, double g0, double g1, double t) {
    const double rise = f1 - f0;
    return f0 + t * (g0 + t * (3.0 * rise - 2.0 * g0 - g1 + t * (g0 + g1 - 2.0 * rise)));
}

double mix(double a, double b, double t) {
    return a + t * (b - a);
}

}  // namespace

void ReferencePressure::scatter(const paper::Fluid& fluid) {
    for (int k = 0; k < fluid.size(); ++k) {
        const double x = double(fluid.position(k).x) + paper::kMargin;
        const double y = double(fluid.position(k).y) + paper::kMargin;
        const int i = static_cast<int>(x - 0.5);
        const int j = static_cast<int>(y - 0.5);
        double wx[3];
        double wy[3];
        double dx[3];
        double dy[3];
        weights(x - i, wx, dx);
        weights(y - j, wy, dy);
        for (int b = 0; b < 3; ++b) {
            for (int a = 0; a < 3; ++a) {
                Node& node = nodes_[static_cast<std::size_t>((j + b) * columns_ + i + a)];
                node.mass += wx[a] * wy[b];
                node.slope_x -= dx[a] * wy[b];
                node.slope_y -= wx[a] * dy[b];
            }
        }
    }
}

double ReferencePressure::density_at(double x, double y) const {
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    const double u = x - i;
    const double v = y - j;
    const Node* low = &nodes_[static_cast<std::size_t>(j * columns_ + i)];
    const Node* high = low + columns_;
    const double bottom = hermite(low[0].mass, low[1].mass, low[0].slope_x, low[1].slope_x, u);
    const double top = hermite(high[0].mass, high[1].mass, high[0].slope_x, high[1].slope_x, u);
    const double left = hermite(low[0].mass, high[0].mass, low[0].slope_y, high[0].slope_y, v);
    const double right = hermite(low[1].mass, high[1].mass, low[1].slope_y, high[1].slope_y, v);
    const double bilinear =
        mix(mix(low[0].mass, low[1].mass, u), mix(high[0].mass, high[1].mass, u), v);
    return mix(bottom, top, v) + mix(left, right, u) - bilinear;
}

void ReferencePressure::compute(const paper::Fluid& fluid) {
    const paper::FluidConfig& config = fluid.config();
    columns_ = config.cells_x + 2 * paper::kMargin + 1;
    cells_x_ = config.cells_x;
    const int rows = config.cells_y + 2 * paper::kMargin + 1;
    nodes_.assign(static_cast<std::size_t>(columns_ * rows), Node{});
    pressure_.assign(static_cast<std::size_t>(cells_x_ * config.cells_y), 0.0);
    scatter(fluid);
    const double rest = double(config.rest_density);
    const double stiffness = double(config.stiffness);
    for (int k = 0; k < fluid.size(); ++k) {
        const paper::Point x = fluid.position(k);
        const double density =
            density_at(double(x.x) + paper::kMargin, double(x.y) + paper::kMargin);
        const double p = std::clamp(stiffness * (density / rest - 1.0),
                                    -double(config.max_tension) * stiffness,
                                    double(config.max_compression) * stiffness);
        // What has sunk into a soft wall still presses on it.
        const int i = std::clamp(static_cast<int>(x.x), 0, cells_x_ - 1);
        const int j = std::clamp(static_cast<int>(x.y), 0, config.cells_y - 1);
        pressure_[static_cast<std::size_t>(j * cells_x_ + i)] += p / rest;
    }
}

double ReferencePressure::at(int i, int j) const {
    return pressure_[static_cast<std::size_t>(j * cells_x_ + i)];
}

}  // namespace accuracy
