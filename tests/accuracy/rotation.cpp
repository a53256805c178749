// R11a: what the transfers alone do to a rigidly rotating disc. No pressure: the equation of state
// with next to no sound speed, so that only particle-to-grid and back remains.
// R11b: a rotating square patch with a free surface, no gravity, ω = 1, to t ω = 2. Kinetic energy,
// angular momentum and centre of mass are constant; the pressure at the start is a series:
// p_c = −0.147343 ρ ω² L². It needs tension, so it is run with the projection only.
#include <algorithm>
#include <cmath>

#include "problems.hpp"

namespace accuracy {

namespace {

constexpr double kCentrePressure = -0.147343;
constexpr double kNoSound = 1e-6;

Particles rotating(Particles particles, Vector centre) {
    for (Particle& p : particles) {
        const Vector arm = p.x - centre;
        p.v = {-arm.y, arm.x};
    }
    return particles;
}

/// Root mean square distance from the centre.
double extent(const Particles& particles, Vector centre) {
    double sum = 0.0;
    for (const Particle& p : particles) {
        sum += dot(p.x - centre, p.x - centre);
    }
    return std::sqrt(sum / static_cast<double>(particles.size()));
}

Outcome run_transfers(Scheme& scheme, const Case& c) {
    Setup setup;
    setup.nx = 3 * c.cells;
    setup.ny = setup.nx;
    setup.sound_speed = kNoSound;
    setup.top_speed = 1.5 * c.cells;
    setup.options = c.options;
    const Vector centre{0.5 * setup.nx, 0.5 * setup.ny};
    const Particles start = rotating(seed_disc(c.lattice, centre, c.cells), centre);
    const double kinetic = energy(start, {}).kinetic;
    const double spin = angular_momentum(start, centre);
    Outcome outcome;
    // A hundred transfers next to without moving. A power of two: every format knows it.
    setup.interval = std::ldexp(1.0, -24);
    scheme.start(setup, start);
    for (int k = 0; k < 100; ++k) {
        scheme.advance();
    }
    const Particles after = scheme.particles();
    outcome.add("energy_loss_100_transfers", 100.0 * (1.0 - energy(after, {}).kinetic / kinetic));
    outcome.add("spin_loss_100_transfers",
                100.0 * (1.0 - angular_momentum(after, centre) / spin));
    // Two turns, velocities set anew before each step: what advection alone does. A rim speed of
    // 0.35 cells a step keeps an interval a single step in every scheme.
    const int per_turn = static_cast<int>(std::ceil(2.0 * kPi * c.cells / 0.35));
    setup.interval = 2.0 * kPi / per_turn;
    scheme.start(setup, start);
    for (int k = 0; k < 2 * per_turn; ++k) {
        scheme.replace(rotating(scheme.particles(), centre));
        scheme.advance();
    }
    const Particles turned = scheme.particles();
    outcome.add("radius_growth_2_turns",
                100.0 * (extent(turned, centre) / extent(start, centre) - 1.0));
    check_particles(scheme, start.size(), setup.nx, setup.ny, 0.0, outcome);
    return outcome;
}

void add_centre_pressure(const Scheme& scheme, const Setup& setup, int cells, Outcome& outcome) {
    double sum = 0.0;
    double squares = 0.0;
    const int reach = std::max(1, cells / 16);
    for (int j = -reach; j < reach; ++j) {
        for (int i = -reach; i < reach; ++i) {
            const double p =
                scheme.pressure(setup.nx / 2 + i, setup.ny / 2 + j) / double(cells) / cells;
            sum += p;
            squares += p * p;
        }
    }
    const double count = 4.0 * reach * reach;
    const double mean = sum / count;
    outcome.add("centre_pressure", 100.0 * (mean / kCentrePressure - 1.0));
    outcome.add("pressure_noise", 100.0 *
                                      std::sqrt(std::fmax(0.0, squares / count - mean * mean)) /
                                      std::fabs(kCentrePressure));
}

Outcome run_patch(Scheme& scheme, const Case& c) {
    Setup setup;
    setup.nx = static_cast<int>(3.5 * c.cells);
    setup.ny = setup.nx;
    setup.interval = 0.5 / c.cells;
    setup.sound_speed = 7.0 * c.cells;
    setup.top_speed = 1.5 * c.cells;
    setup.options = c.options;
    const Vector middle{0.5 * setup.nx, 0.5 * setup.ny};
    const Vector arm{0.5 * c.cells, 0.5 * c.cells};
    const Particles patch =
        seed(c.lattice, middle - arm, middle + arm, [](Vector) { return true; });
    const Vector centre = centre_of_mass(patch);
    const Particles start = rotating(patch, centre);
    scheme.start(setup, start);
    const double kinetic = energy(start, {}).kinetic;
    const double spin = angular_momentum(start, centre);
    Outcome outcome;
    Signal energies;
    const auto steps = static_cast<int>(std::lround(2.0 / scheme.interval()));
    for (int k = 1; k <= steps; ++k) {
        scheme.advance();
        energies.add(k * scheme.interval(), energy(scheme.particles(), {}).kinetic / kinetic);
        if (k == steps / 20) {  // t ω = 0.1: the patch has hardly turned, the solver has settled
            add_centre_pressure(scheme, setup, c.cells, outcome);
        }
    }
    const Particles end = scheme.particles();
    double farthest = 0.0;
    for (const Particle& p : end) {
        farthest = std::max(farthest, std::sqrt(dot(p.x - centre, p.x - centre)));
    }
    const Vector moved = centre_of_mass(end) - centre_of_mass(start);
    outcome.add("kinetic_energy_loss", 100.0 * (1.0 - energies.y.back()));
    outcome.add("angular_momentum_drift", 100.0 * (angular_momentum(end, centre) / spin - 1.0));
    outcome.add("centre_of_mass_shift", std::hypot(moved.x, moved.y));
    outcome.add("farthest_particle", farthest / c.cells);
    outcome.curves.emplace_back("energy", energies);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 0.0, outcome);
    return outcome;
}

}  // namespace

void report_rotation(Report& report, const Effort& effort) {
    const std::vector<int> few = effort.quick ? std::vector<int>{16} : std::vector<int>{32};
    report.heading("R11a transfers of a rigid rotation, no pressure");
    const std::vector<Metric> transfers = {{"energy_loss_100_transfers", "%", {}},
                                           {"spin_loss_100_transfers", "%", {}},
                                           {"radius_growth_2_turns", "%", {}}};
    const std::vector<Plan> alone = {{Kind::equation_of_state, resolutions(effort, 64), 3},
                                     {Kind::reference, few, 3}};
    for (const Plan& plan : chosen(effort, alone)) {
        sweep(report, effort, "R11a", plan, transfers, run_transfers);
    }

    report.heading("R11b rotating square patch");
    const std::vector<Metric> patch = {
        {"kinetic_energy_loss", "%", {{32, 1.0}, {64, 0.25}, {128, 0.10}}},
        {"angular_momentum_drift", "%", {{32, 1e-4}, {64, 1e-4}, {128, 1e-4}}},
        {"centre_pressure", "%", {}},
        {"pressure_noise", "%", {}},
        {"centre_of_mass_shift", "cell", {}},
        {"farthest_particle", "L", {}}};
    std::vector<Curve> curves;
    for (const Plan& plan : chosen(effort, {{Kind::projection, resolutions(effort), 3}})) {
        const auto last = sweep(report, effort, "R11b", plan, patch, run_patch);
        for (std::size_t k = 0; k < last.size(); ++k) {
            curves.push_back({title_of(plan, k), *last[k].curve("energy"), false});
        }
    }
    report.plot("R11b kinetic energy", "t omega", "E / E0", curves);
}

}  // namespace accuracy
