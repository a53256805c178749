#include "pareto.hpp"

#include <algorithm>
#include <cmath>

namespace precision {

std::vector<Point> pareto_front(std::vector<Point> points) {
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
        return a.time < b.time || (a.time == b.time && a.error < b.error);
    });
    std::vector<Point> front;
    for (const Point& point : points) {
        if (front.empty() || point.error < front.back().error) {
            front.push_back(point);
        }
    }
    return front;
}

std::optional<double> time_to_error(const std::vector<Point>& front, double error) {
    for (std::size_t k = 0; k < front.size(); ++k) {
        if (front[k].error > error) {
            continue;
        }
        if (k == 0) {
            return front[k].time;
        }
        const Point& before = front[k - 1];
        const double share =
            std::log(before.error / error) / std::log(before.error / front[k].error);
        return before.time * std::pow(front[k].time / before.time, share);
    }
    return std::nullopt;
}

std::optional<double> error_within(const std::vector<Point>& front, double time) {
    std::optional<double> error;
    for (const Point& point : front) {
        if (point.time <= time) {
            error = point.error;
        }
    }
    return error;
}

}  // namespace precision
