// R6b: sloshing between inclined walls, upright and with the whole scene turned by 17.3 degrees.
// Exact: ω² = g / h for u = A y, v = A x about the apex of a 90 degree V, whose surface stays plane.
// And what number formats add to that error.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "problems.hpp"
#include "v_tank.hpp"

namespace solids {

namespace {

struct Slosh {
    double frequency_error = 0.0;
    double loss = 0.0;  ///< of the amplitude, a period
    double penetration = 0.0;
};

/// Four periods of the V's own mode, after the lattice has come to rest.
template <class Real>
Slosh slosh(int depth, double tilt, Vec shift) {
    const Wedge wedge = v_tank(depth, tilt, shift);
    Pool<Real> pool(wedge.vessel);
    pool.run(300);
    const double h = std::sqrt(0.25 * pool.particles());  // area h²
    const double omega = std::sqrt(kGravity / h);
    const double a = 0.03 * omega;
    pool.stir([&](Vec p) {
        return Vec{a * (p.y - wedge.apex.y), a * (p.x - wedge.apex.x)};
    });
    const auto amplitude = [&] {
        double sum = 0.0;
        double squares = 0.0;
        for (int k = 0; k < pool.particles(); ++k) {
            const Vec d = pool.position(k) - wedge.apex;
            const Vec v = pool.velocity(k);
            sum += v.x * d.y + v.y * d.x;
            squares += weir::dot(d, d);
        }
        return sum / squares;
    };
    Slosh result;
    const float dt = kFrame_s / 2.0F;
    double time = 0.0;
    double before = amplitude();
    double first_crossing = 0.0;
    double last_crossing = 0.0;
    int crossings = 0;
    std::vector<double> peaks;
    double peak = 0.0;
    const double end = 4.1 * 2.0 * M_PI / omega;
    while (time < end) {
        pool.step(dt);
        time += static_cast<double>(pool.report().dt_s);
        const double now = amplitude();
        peak = std::max(peak, std::abs(now));
        if ((now > 0.0) != (before > 0.0)) {
            last_crossing = time - static_cast<double>(pool.report().dt_s) * now / (now - before);
            first_crossing = crossings == 0 ? last_crossing : first_crossing;
            if (crossings > 0) {
                peaks.push_back(peak);
            }
            peak = 0.0;
            ++crossings;
        }
        before = now;
        for (int k = 0; k < pool.particles(); ++k) {
            const Vec d = pool.position(k) - wedge.apex;
            result.penetration =
                std::max(result.penetration, (std::abs(d.x) - d.y) / std::sqrt(2.0));
        }
    }
    if (peaks.size() < 2) {  // the wave is gone
        result.frequency_error = 1.0;
        result.loss = 1.0;
        return result;
    }
    const double half_periods = crossings - 1;
    const double measured = M_PI * half_periods / (last_crossing - first_crossing);
    result.frequency_error = measured / omega - 1.0;
    const double span = 0.5 * static_cast<double>(peaks.size() - 1);
    result.loss = 1.0 - std::pow(peaks.back() / peaks.front(), 1.0 / span);
    return result;
}

/// Means of some starts.
template <class Real>
Slosh mean_slosh(int depth, double tilt) {
    const int starts = depth > 32 ? 4 : 8;
    Slosh mean;
    for (int start = 0; start < starts; ++start) {
        const Slosh one = slosh<Real>(depth, tilt, shift_of(start));
        mean.frequency_error += std::abs(one.frequency_error) / starts;
        mean.loss += one.loss / starts;
        mean.penetration = std::max(mean.penetration, one.penetration);
    }
    return mean;
}

template <class Real>
void slosh_at(Report& report, int depth) {
    const std::string name = "R6b.v_tank." + std::to_string(depth);
    Slosh worst;
    for (const double tilt : {0.0, kTilt}) {
        const Slosh one = mean_slosh<Real>(depth, tilt);
        worst.frequency_error = std::max(worst.frequency_error, one.frequency_error);
        worst.loss = std::max(worst.loss, one.loss);
        worst.penetration = std::max(worst.penetration, one.penetration);
        report.figure(name + (tilt > 0.0 ? ".loss_turned" : ".loss_upright"),
                      100.0 * one.loss, "%/period");
    }
    if (depth == 16) {
        report.figure(name + ".frequency", 100.0 * worst.frequency_error, "%");
        report.figure(name + ".loss", 100.0 * worst.loss, "%/period");
    } else {
        accurate<Real>(report, name + ".frequency", 100.0 * worst.frequency_error, "%",
                       depth == 32 ? 0.3 : 0.15);
        accurate<Real>(report, name + ".loss", 100.0 * worst.loss, "%/period",
                       depth == 32 ? 1.9 : 0.7);
    }
    report.at_most(name + ".penetration", worst.penetration, "cells", 0.05);
}

constexpr int kFormatDepth = 32;
/// With 32 a loss was uncertain by more than its target.
constexpr int kFormatStarts = 192;
using Figures = std::array<double, kFormatStarts>;

double mean(const Figures& figures) {
    return std::accumulate(figures.begin(), figures.end(), 0.0) / kFormatStarts;
}

/// Of each start, %.
struct Sloshes {
    Figures frequency;  ///< error
    Figures loss;       ///< a period: none is exact
};

template <class Real>
Sloshes all_starts(double tilt) {
    Sloshes all;
    for (int start = 0; start < kFormatStarts; ++start) {
        const Slosh one = slosh<Real>(kFormatDepth, tilt, shift_of(start));
        const auto k = static_cast<std::size_t>(start);
        all.frequency[k] = 100.0 * one.frequency_error;
        all.loss[k] = 100.0 * one.loss;
    }
    return all;
}

/// What the mean of the starts is off, of the error that double has with them. Starts that differ
/// by a last bit already differ by chance: that much of a mean is uncertain.
void compare(Report& report, const std::string& name, const Figures& exactest,
             const Figures& figures, bool has_target) {
    Figures size;
    Figures off;
    Figures square;
    for (std::size_t k = 0; k < kFormatStarts; ++k) {
        size[k] = std::abs(exactest[k]);
        off[k] = figures[k] - exactest[k];
        square[k] = off[k] * off[k];
    }
    const double variance = mean(square) - mean(off) * mean(off);
    report.figure(name + ".off_double", mean(off), "%");
    report.figure(name + ".by_chance", std::sqrt(variance / (kFormatStarts - 1)), "%");
    const double ratio = std::abs(mean(off)) / mean(size);
    if (has_target) {
        report.at_most(name + ".off_double_over_error", ratio, "1", 0.1);
    } else {
        report.figure(name + ".off_double_over_error", ratio, "1");
    }
}

void compare(Report& report, const std::string& name, const Sloshes& exactest,
             const Sloshes& sloshes, bool has_target) {
    compare(report, name + ".frequency", exactest.frequency, sloshes.frequency, has_target);
    compare(report, name + ".loss", exactest.loss, sloshes.loss, has_target);
}

}  // namespace

void formats(Report& report, const Effort&) {
    for (const double tilt : {0.0, kTilt}) {
        const std::string name = tilt > 0.0 ? "formats.v_tank_turned." : "formats.v_tank.";
        const Sloshes exactest = all_starts<double>(tilt);
        report.figure(name + "double.frequency", mean(exactest.frequency), "%");
        report.figure(name + "double.loss", mean(exactest.loss), "%/period");
        compare(report, name + "fixed", exactest, all_starts<weir::Fixed>(tilt), true);
        compare(report, name + "small_fixed", exactest, all_starts<weir::SmallFixed>(tilt), false);
        compare(report, name + "float", exactest, all_starts<float>(tilt), false);
    }
}

void sloshing(Report& report, const Effort& effort) {
    at_resolutions(report, effort, {16, 32, 64}, [&](auto zero, int depth) {
        slosh_at<decltype(zero)>(report, depth);
    });
}

}  // namespace solids
