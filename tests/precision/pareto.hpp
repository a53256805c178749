// Error against run time: the points that no other beats in both, and the time to a given error.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace precision {

struct Point {
    double time = 0.0;   ///< wall time per unit of physical time
    double error = 0.0;
    std::string label;
};

/// By rising time and falling error.
std::vector<Point> pareto_front(std::vector<Point> points);

/// Wall time at which the front reaches the error: between two points along the straight line in
/// logarithms, before the first the first's own time. None if it never does.
std::optional<double> time_to_error(const std::vector<Point>& front, double error);

/// Least error within that time. None if nothing is as fast.
std::optional<double> error_within(const std::vector<Point>& front, double time);

}  // namespace precision
