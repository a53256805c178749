// R8: a disc with a strain under the central force −B² (x − x_c), B = strain = 1: it swings for
// ever. Three periods. Unit of length: a cell; of time: 1 / B. The force is a kick to every
// particle before each interval, half a kick before the first (leapfrog).
#include <algorithm>
#include <cmath>

#include "affine_drop.hpp"
#include "problems.hpp"

namespace accuracy {

namespace {

constexpr double kPeriod = 4.827343;
constexpr int kPeriods = 3;
constexpr double kSoundRatio = 15.0;
constexpr Matrix kStrain{1.0, 0.0, 0.0, -1.0};

struct Drop {
    Vector centre;
    double potential(const Particles& particles) const {
        double sum = 0.0;
        for (const Particle& p : particles) {
            sum += 0.5 * dot(p.x - centre, p.x - centre);
        }
        return sum;
    }
    void kick(Scheme& scheme, double dt) const {
        Particles particles = scheme.particles();
        for (Particle& p : particles) {
            p.v = p.v - dt * (p.x - centre);
        }
        scheme.replace(particles);
    }
};

}  // namespace

Outcome run_oscillating_drop(Scheme& scheme, const Case& c, int periods) {
    Setup setup;
    setup.nx = static_cast<int>(4.25 * c.cells);
    setup.nx += setup.nx % 2;
    setup.ny = setup.nx;
    const double per_period = std::ceil(kPeriod * 2.0 * c.cells);
    setup.interval = kPeriod / per_period;
    setup.sound_speed = kSoundRatio * c.cells;
    setup.top_speed = 2.0 * c.cells;
    setup.options = c.options;
    Particles start = seed_disc(c.lattice, {0.5 * setup.nx, 0.5 * setup.ny}, c.cells);
    const Drop drop{centre_of_mass(start)};
    for (Particle& p : start) {
        const Vector arm = p.x - drop.centre;
        p.v = {arm.x, -arm.y};
    }
    scheme.start(setup, start);
    const double radius = std::sqrt(static_cast<double>(start.size()) / (kPerCell * kPi));
    const double spin_start = angular_momentum(start, drop.centre);
    const double initial = energy(start, {}).kinetic + drop.potential(start);
    const auto steps = static_cast<int>(std::ceil((periods + 0.05) * kPeriod / scheme.interval()));
    Signal difference;
    Signal major;
    Signal energies;
    double momentum_most = 0.0;
    double spin_most = 0.0;
    for (int k = 1; k <= steps; ++k) {
        drop.kick(scheme, (k == 1 ? 0.5 : 1.0) * scheme.interval());
        scheme.advance();
        const double t = k * scheme.interval();
        const Particles now = scheme.particles();
        const Ellipse shape = ellipse(now);
        difference.add(t, shape.difference_xx_yy);
        major.add(t, shape.major / radius);
        energies.add(t, (energy(now, {}).kinetic + drop.potential(now)) / initial);
        const Vector p = momentum(now);
        momentum_most = std::max(momentum_most, std::hypot(p.x, p.y));
        spin_most = std::max(spin_most, std::fabs(angular_momentum(now, drop.centre) - spin_start));
    }
    const double cube = kPerCell * radius * radius * radius;
    const double left = value_at(energies, periods * kPeriod);
    const Oscillation swing = oscillation(difference);
    Outcome outcome;
    outcome.add("period_error",
                swing.omega > 0.0 ? 100.0 * (2.0 * kPi / swing.omega / kPeriod - 1.0) : 100.0);
    outcome.add("energy_loss_per_period", 100.0 * (1.0 - left) / periods);
    double last_peak = 0.0;
    for (std::size_t k = 0; k < major.t.size(); ++k) {
        const bool last = major.t[k] > (periods - 0.5) * kPeriod;
        last_peak = last ? std::max(last_peak, major.y[k]) : last_peak;
    }
    outcome.add("last_elongation_error", 100.0 * (last_peak / 1.931852 - 1.0));
    outcome.add("momentum", momentum_most / cube);
    outcome.add("angular_momentum", spin_most / (cube * radius));
    outcome.curves.emplace_back("major", major);
    outcome.curves.emplace_back("energy", energies);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 0.0, outcome);
    return outcome;
}

void report_oscillating_drop(Report& report, const Effort& effort) {
    report.heading("R8 drop in a central force, 3 periods");
    const std::vector<Metric> metrics = {
        {"period_error", "%", {{32, 0.05}, {64, 0.02}, {128, 0.01}}},
        {"energy_loss_per_period", "%", {{32, 0.1}, {64, 0.05}, {128, 0.02}}},
        {"last_elongation_error", "%", {}},
        {"momentum", "rho A0 R^3", {{32, 1e-6}, {64, 1e-6}, {128, 1e-6}}},
        {"angular_momentum", "rho A0 R^4", {{32, 1e-6}, {64, 1e-6}, {128, 1e-6}}}};
    std::vector<Curve> major;
    std::vector<Curve> energies;
    for (const Plan& plan :
         beside_others(effort, resolutions(effort, 64),
                       {Kind::projection_double, Kind::equation_of_state, Kind::reference})) {
        const auto last = sweep(
            report, effort, "R8", plan, metrics,
            [](Scheme& s, const Case& c) { return run_oscillating_drop(s, c, kPeriods); });
        for (std::size_t k = 0; k < last.size(); ++k) {
            const std::string title = title_of(plan, k);
            major.push_back({title, *last[k].curve("major"), false});
            energies.push_back({title, *last[k].curve("energy"), false});
        }
    }
    AffineDrop exact(kStrain, 1.0);
    Curve curve{"exact", {}, true};
    for (double t = 0.1; t < (kPeriods + 0.05) * kPeriod; t += 0.1) {
        exact.advance_to(t);
        curve.data.add(t, exact.semi_major());
    }
    major.push_back(curve);
    report.plot("R8 semi-major axis", "t B", "a / R", major);
    report.plot("R8 energy", "t B", "E / E0", energies);
}

}  // namespace accuracy
