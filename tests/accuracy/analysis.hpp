// What is read off particles and signals.
#pragma once

#include <vector>

#include "scheme.hpp"

namespace accuracy {

inline constexpr double kPi = 3.14159265358979323846;

/// Per particle mass 1: divide by kPerCell for areas.
struct Energy {
    double kinetic = 0.0;
    double potential = 0.0;  ///< above the tank's floor (against gravity)
    double total() const { return kinetic + potential; }
};
/// @param lag how far velocities are behind positions, twice: a step of those that leap.
Energy energy(const Particles& particles, Vector gravity, double lag = 0.0);

struct Speed {
    double largest = 0.0;
    double rms = 0.0;
};
Speed speed(const Particles& particles);

Vector centre_of_mass(const Particles& particles);
Vector momentum(const Particles& particles);
double angular_momentum(const Particles& particles, Vector about);

/// Semi-axes of the filled ellipse with the particles' second moments, and its direction.
struct Ellipse {
    double major = 0.0;
    double minor = 0.0;
    double angle_degrees = 0.0;  ///< of the major axis, -90 ... 90
    double difference_xx_yy = 0.0;  ///< of the second moments: changes sign as the axes swap
};
Ellipse ellipse(const Particles& particles);

bool all_finite(const Particles& particles);
/// Particles outside the tank by more than the slack.
int count_outside(const Particles& particles, int nx, int ny, double slack);

struct Signal {
    std::vector<double> t;
    std::vector<double> y;
    void add(double at, double value) {
        t.push_back(at);
        y.push_back(value);
    }
};

/// Linear between samples; the end values beyond them.
double value_at(const Signal& signal, double t);
Signal running_median(const Signal& signal, double width);
/// Root mean square of a(t) − b(t) at b's own times within [from, to].
double rms_difference(const Signal& a, const Signal& b, double from, double to);

/// A decaying oscillation read off its zero crossings and extrema.
struct Oscillation {
    double omega = 0.0;            ///< from the first to the last zero crossing
    double loss_per_period = 0.0;  ///< of the amplitude, from a line through ln |extremum|
    int crossings = 0;
};
Oscillation oscillation(const Signal& signal);

/// −slope of ln |error| over ln N: the order of convergence. 0 with fewer than two points.
double convergence_order(const std::vector<double>& cells, const std::vector<double>& errors);

}  // namespace accuracy
