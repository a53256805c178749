#include "analysis.hpp"

#include <algorithm>
#include <cmath>

namespace accuracy {

Energy energy(const Particles& particles, Vector gravity, double lag) {
    Energy sum;
    for (const Particle& p : particles) {
        sum.kinetic += 0.5 * dot(p.v, p.v);
        sum.potential -= dot(gravity, p.x - 0.5 * lag * p.v);
    }
    return sum;
}

Speed speed(const Particles& particles) {
    double largest = 0.0;
    double sum = 0.0;
    for (const Particle& p : particles) {
        const double squared = dot(p.v, p.v);
        largest = std::max(largest, squared);
        sum += squared;
    }
    return {std::sqrt(largest), std::sqrt(sum / static_cast<double>(particles.size()))};
}

Vector centre_of_mass(const Particles& particles) {
    Vector sum;
    for (const Particle& p : particles) {
        sum = sum + p.x;
    }
    return (1.0 / static_cast<double>(particles.size())) * sum;
}

Vector momentum(const Particles& particles) {
    Vector sum;
    for (const Particle& p : particles) {
        sum = sum + p.v;
    }
    return sum;
}

double angular_momentum(const Particles& particles, Vector about) {
    double sum = 0.0;
    for (const Particle& p : particles) {
        sum += cross(p.x - about, p.v);
    }
    return sum;
}

Ellipse ellipse(const Particles& particles) {
    const Vector centre = centre_of_mass(particles);
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (const Particle& p : particles) {
        const Vector arm = p.x - centre;
        xx += arm.x * arm.x;
        xy += arm.x * arm.y;
        yy += arm.y * arm.y;
    }
    const double count = static_cast<double>(particles.size());
    // Each particle stands for a square of its spacing, which has a second moment of its own.
    const double own = 0.25 / 12.0;
    xx = xx / count + own;
    xy = xy / count;
    yy = yy / count + own;
    const double mean = 0.5 * (xx + yy);
    const double radius = std::hypot(0.5 * (xx - yy), xy);
    Ellipse result;
    result.major = 2.0 * std::sqrt(mean + radius);
    result.minor = 2.0 * std::sqrt(mean - radius);
    result.angle_degrees = 0.5 * std::atan2(2.0 * xy, xx - yy) * 180.0 / kPi;
    result.difference_xx_yy = xx - yy;
    return result;
}

bool all_finite(const Particles& particles) {
    return std::all_of(particles.begin(), particles.end(), [](const Particle& p) {
        return std::isfinite(p.x.x) && std::isfinite(p.x.y) && std::isfinite(p.v.x) &&
               std::isfinite(p.v.y);
    });
}

int count_outside(const Particles& particles, int nx, int ny, double slack) {
    int outside = 0;
    for (const Particle& p : particles) {
        const bool inside =
            p.x.x >= -slack && p.x.x <= nx + slack && p.x.y >= -slack && p.x.y <= ny + slack;
        outside += inside ? 0 : 1;
    }
    return outside;
}

double value_at(const Signal& signal, double t) {
    const auto next = std::lower_bound(signal.t.begin(), signal.t.end(), t);
    if (next == signal.t.begin()) {
        return signal.y.front();
    }
    if (next == signal.t.end()) {
        return signal.y.back();
    }
    const auto k = static_cast<std::size_t>(next - signal.t.begin());
    const double share = (t - signal.t[k - 1]) / (signal.t[k] - signal.t[k - 1]);
    return signal.y[k - 1] + share * (signal.y[k] - signal.y[k - 1]);
}

Signal running_median(const Signal& signal, double width) {
    Signal result;
    for (std::size_t k = 0; k < signal.t.size(); ++k) {
        std::vector<double> window;
        for (std::size_t n = 0; n < signal.t.size(); ++n) {
            if (std::fabs(signal.t[n] - signal.t[k]) <= 0.5 * width) {
                window.push_back(signal.y[n]);
            }
        }
        const auto middle = window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
        std::nth_element(window.begin(), middle, window.end());
        result.add(signal.t[k], *middle);
    }
    return result;
}

double rms_difference(const Signal& a, const Signal& b, double from, double to) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < b.t.size(); ++k) {
        if (b.t[k] >= from - 1e-9 && b.t[k] <= to + 1e-9) {
            const double difference = value_at(a, b.t[k]) - b.y[k];
            sum += difference * difference;
            ++count;
        }
    }
    return count > 0 ? std::sqrt(sum / count) : 0.0;
}

namespace {

/// Slope of the line of least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
    const double count = static_cast<double>(x.size());
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        sx += x[k];
        sy += y[k];
        sxx += x[k] * x[k];
        sxy += x[k] * y[k];
    }
    const double spread = count * sxx - sx * sx;
    return spread > 0.0 ? (count * sxy - sx * sy) / spread : 0.0;
}

/// Height of the parabola through three equidistant samples.
double peak(double a, double b, double c) {
    const double curve = a - 2.0 * b + c;
    const double rise = 0.5 * (c - a);
    return curve != 0.0 ? b - 0.5 * rise * rise / curve : b;
}

}  // namespace

Oscillation oscillation(const Signal& s) {
    std::vector<double> crossing;
    std::vector<double> extremum_t;
    std::vector<double> extremum_log;
    std::size_t since = 0;
    for (std::size_t k = 1; k < s.t.size(); ++k) {
        if ((s.y[k - 1] < 0.0) == (s.y[k] < 0.0)) {
            continue;
        }
        const double share = s.y[k - 1] / (s.y[k - 1] - s.y[k]);
        crossing.push_back(s.t[k - 1] + share * (s.t[k] - s.t[k - 1]));
        if (crossing.size() > 1) {  // the arch between this crossing and the one before
            std::size_t top = since;
            for (std::size_t n = since; n < k; ++n) {
                top = std::fabs(s.y[n]) > std::fabs(s.y[top]) ? n : top;
            }
            extremum_t.push_back(s.t[top]);
            extremum_log.push_back(
                std::log(std::fabs(peak(s.y[top - 1], s.y[top], s.y[top + 1]))));
        }
        since = k;
    }
    Oscillation result;
    result.crossings = static_cast<int>(crossing.size());
    if (crossing.size() < 3) {
        return result;
    }
    std::vector<double> number;
    for (std::size_t k = 0; k < crossing.size(); ++k) {
        number.push_back(static_cast<double>(k));
    }
    result.omega = kPi / slope(number, crossing);
    result.loss_per_period =
        1.0 - std::exp(slope(extremum_t, extremum_log) * 2.0 * kPi / result.omega);
    return result;
}

double convergence_order(const std::vector<double>& cells, const std::vector<double>& errors) {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (errors[k] != 0.0) {
            x.push_back(std::log(cells[k]));
            y.push_back(std::log(std::fabs(errors[k])));
        }
    }
    return x.size() > 1 ? -slope(x, y) : 0.0;
}

}  // namespace accuracy
