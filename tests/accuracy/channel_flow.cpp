// R10: a channel between two walls without slip, periodic along it, Re = 10: started from rest by
// the upper wall (Couette) or by a body force (Poiseuille). Unit of length: a cell; of time:
// height / speed. Compared to the series at ν t / h² = 0.1 and 1.
#include <algorithm>
#include <cmath>

#include "problems.hpp"

namespace accuracy {

namespace {

constexpr double kReynolds = 10.0;
constexpr double kEarly = 0.1;
constexpr double kLate = 1.0;
constexpr int kTerms = 200;

/// u / U at height y over h, τ = ν t / h².
double couette(double y, double tau) {
    double u = y;
    for (int n = 1; n <= kTerms; ++n) {
        const double sign = n % 2 == 0 ? 1.0 : -1.0;
        u += sign * 2.0 / (n * kPi) * std::sin(n * kPi * y) *
             std::exp(-double(n) * n * kPi * kPi * tau);
    }
    return u;
}

double poiseuille(double y, double tau) {
    double u = 4.0 * y * (1.0 - y);
    for (int n = 1; n <= kTerms; n += 2) {
        u -= 32.0 / (kPi * kPi * kPi * n * n * n) * std::sin(n * kPi * y) *
             std::exp(-double(n) * n * kPi * kPi * tau);
    }
    return u;
}

using Profile = double (*)(double, double);

double profile_error(const Particles& particles, Profile exact, double tau, int cells) {
    double difference = 0.0;
    double norm = 0.0;
    for (const Particle& p : particles) {
        const double u = exact(p.x.y / cells, tau) * cells;
        difference += (p.v.x - u) * (p.v.x - u) + p.v.y * p.v.y;
        norm += u * u;
    }
    return 100.0 * std::sqrt(difference / norm);
}

Signal profile_of(const Particles& particles, int cells) {
    std::vector<double> sum(static_cast<std::size_t>(cells), 0.0);
    std::vector<double> count(static_cast<std::size_t>(cells), 0.0);
    for (const Particle& p : particles) {
        const auto j = static_cast<std::size_t>(p.x.y);
        sum[j] += p.v.x;
        count[j] += 1.0;
    }
    Signal signal;
    for (int j = 0; j < cells; ++j) {
        const auto k = static_cast<std::size_t>(j);
        signal.add((j + 0.5) / cells, count[k] > 0.0 ? sum[k] / count[k] / cells : 0.0);
    }
    return signal;
}

Outcome run_channel(Scheme& scheme, const Case& c, bool driven_by_wall) {
    const Profile exact = driven_by_wall ? couette : poiseuille;
    Setup setup;
    setup.nx = std::max(8, c.cells / 4);
    setup.ny = c.cells;
    setup.viscosity = double(c.cells) * c.cells / kReynolds;
    setup.periodic_x = true;
    setup.no_slip = true;
    const double h = c.cells;
    const double speed_scale = c.cells;
    if (driven_by_wall) {
        setup.slide_top = speed_scale;
    } else {
        setup.gravity.x = 8.0 * setup.viscosity * speed_scale / (h * h);
    }
    setup.interval = 0.1 / std::ceil(0.1 * 2.0 * c.cells);
    setup.sound_speed = 10.0 * c.cells;
    setup.top_speed = 1.25 * speed_scale;
    setup.options = c.options;
    const Particles start = seed(c.lattice, {0.0, kWallGap}, {double(setup.nx), h - kWallGap},
                                 [](Vector) { return true; });
    scheme.start(setup, start);
    Outcome outcome;
    const double unit = kReynolds;  // time in which τ grows by 1
    const auto steps = static_cast<int>(std::lround(kLate * unit / scheme.interval()));
    const auto early = static_cast<int>(std::lround(kEarly * unit / scheme.interval()));
    for (int k = 1; k <= steps; ++k) {
        scheme.advance();
        const double tau = k * scheme.interval() / unit;
        if (k == early) {
            outcome.add("velocity_error_early", profile_error(scheme.particles(), exact, tau,
                                                              c.cells));
            outcome.curves.emplace_back("early", profile_of(scheme.particles(), c.cells));
        }
    }
    const Particles end = scheme.particles();
    outcome.add("velocity_error", profile_error(end, exact, kLate, c.cells));
    outcome.curves.emplace_back("late", profile_of(end, c.cells));
    check_particles(scheme, start.size(), setup.nx, setup.ny, 0.0, outcome);
    return outcome;
}

}  // namespace

void report_channel_flow(Report& report, const Effort& effort) {
    const std::vector<Metric> metrics = {
        {"velocity_error", "%", {{32, 0.2}, {64, 0.05}, {128, 0.02}}},
        {"velocity_error_early", "%", {}}};
    for (const bool driven_by_wall : {true, false}) {
        const std::string name = driven_by_wall ? "R10 Couette" : "R10 Poiseuille";
        report.heading(name + ", Re 10");
        std::vector<Curve> curves;
        for (const Plan& plan : chosen(effort, {{Kind::projection, resolutions(effort, 64), 3}})) {
            const auto last = sweep(
                report, effort, driven_by_wall ? "R10.couette" : "R10.poiseuille", plan, metrics,
                [&](Scheme& s, const Case& c) { return run_channel(s, c, driven_by_wall); });
            for (std::size_t k = 0; k < last.size(); ++k) {
                const std::string cells = std::to_string(plan.cells[k]);
                curves.push_back({cells + " cells, tau 0.1", *last[k].curve("early"), false});
                curves.push_back({cells + " cells, tau 1", *last[k].curve("late"), false});
            }
        }
        for (const double tau : {kEarly, kLate}) {
            Curve exact{tau == kEarly ? "exact, tau 0.1" : "exact, tau 1", {}, true};
            for (double y = 0.0; y <= 1.0; y += 0.05) {
                exact.data.add(y, driven_by_wall ? couette(y, tau) : poiseuille(y, tau));
            }
            curves.push_back(exact);
        }
        report.plot(name, "y / h", "u / U", curves, "set key left top");
    }
}

}  // namespace accuracy
