// R9a: decaying vortices in a doubly periodic square, Re = 100, to t = 2. Unit of length: a cell;
// of time: L / U. u = −U cos kx sin ky, v = U sin kx cos ky, p = −(U²/4)(cos 2kx + cos 2ky) with
// k = 2π / L; the velocity decays by exp(−2 ν k² t), the pressure by its square (Taylor & Green
// 1937).
#include <cmath>

#include "problems.hpp"

namespace accuracy {

namespace {

constexpr double kReynolds = 100.0;
constexpr double kEnd = 2.0;
constexpr double kCompareAt = 0.5;

struct Vortices {
    double wave_number;
    double speed;
    double viscosity;
    double decay(double t) const {
        return std::exp(-2.0 * viscosity * wave_number * wave_number * t);
    }
    Vector velocity(Vector x, double t) const {
        const double a = speed * decay(t);
        return {-a * std::cos(wave_number * x.x) * std::sin(wave_number * x.y),
                a * std::sin(wave_number * x.x) * std::cos(wave_number * x.y)};
    }
    double pressure(Vector x, double t) const {
        const double a = speed * decay(t);
        return -0.25 * a * a *
               (std::cos(2.0 * wave_number * x.x) + std::cos(2.0 * wave_number * x.y));
    }
};

double velocity_error(const Particles& particles, const Vortices& exact, double t) {
    double difference = 0.0;
    double norm = 0.0;
    for (const Particle& p : particles) {
        const Vector v = exact.velocity(p.x, t);
        difference += dot(p.v - v, p.v - v);
        norm += dot(v, v);
    }
    return std::sqrt(difference / norm);
}

/// Without the mean, which is free in a periodic box; over the largest pressure.
double pressure_error(const Scheme& scheme, const Vortices& exact, int cells, double t) {
    double sum = 0.0;
    double squares = 0.0;
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const double e = scheme.pressure(i, j) - exact.pressure({i + 0.5, j + 0.5}, t);
            sum += e;
            squares += e * e;
        }
    }
    const double count = static_cast<double>(cells) * cells;
    const double mean = sum / count;
    const double a = exact.speed * exact.decay(t);
    return std::sqrt(std::fmax(0.0, squares / count - mean * mean)) / (0.5 * a * a);
}

Outcome run_taylor_green(Scheme& scheme, const Case& c) {
    Setup setup;
    setup.nx = c.cells;
    setup.ny = c.cells;
    setup.interval = 0.5 / c.cells;
    setup.sound_speed = 10.0 * c.cells;
    setup.periodic_x = true;
    setup.periodic_y = true;
    setup.viscosity = double(c.cells) * c.cells / kReynolds;
    setup.top_speed = 1.25 * c.cells;
    setup.options = c.options;
    const Vortices exact{2.0 * kPi / c.cells, double(c.cells), setup.viscosity};
    Particles start = seed(c.lattice, {0.0, 0.0}, {double(c.cells), double(c.cells)},
                           [](Vector) { return true; });
    for (Particle& p : start) {
        p.v = exact.velocity(p.x, 0.0);
    }
    scheme.start(setup, start);
    const double initial = energy(start, {}).kinetic;
    const auto decay_error = [&](double left, double t) {
        const double k = exact.wave_number;
        return 100.0 * (std::log(initial / left) / (4.0 * exact.viscosity * k * k * t) - 1.0);
    };
    Outcome outcome;
    Signal energies;
    const auto steps = static_cast<int>(std::lround(kEnd / scheme.interval()));
    const auto compare_at = static_cast<int>(std::lround(kCompareAt / scheme.interval()));
    for (int k = 1; k <= steps; ++k) {
        scheme.advance();
        const double t = k * scheme.interval();
        const Particles now = scheme.particles();
        energies.add(t, energy(now, {}).kinetic / initial);
        if (k == compare_at) {
            outcome.add("velocity_error", velocity_error(now, exact, t));
            outcome.add("pressure_error", pressure_error(scheme, exact, c.cells, t));
            outcome.add("decay_error_early", decay_error(energies.y.back() * initial, t));
        }
    }
    outcome.add("decay_error", decay_error(energies.y.back() * initial, energies.t.back()));
    outcome.curves.emplace_back("energy", energies);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 0.0, outcome);
    return outcome;
}

}  // namespace

void report_taylor_green(Report& report, const Effort& effort) {
    report.heading("R9a Taylor-Green vortices, Re 100");
    const std::vector<Metric> metrics = {
        {"decay_error", "%", {{32, 8.0}, {64, 1.0}, {128, 0.2}}},
        {"decay_error_early", "%", {}},
        {"velocity_error", "L2", {{32, 0.05}, {64, 0.02}, {128, 0.008}}},
        {"pressure_error", "L2", {{32, 0.09}, {64, 0.06}, {128, 0.04}}}};
    std::vector<Curve> curves;
    for (const Plan& plan : chosen(effort, {{Kind::projection, resolutions(effort), 3}})) {
        const auto last = sweep(report, effort, "R9a", plan, metrics, run_taylor_green);
        for (std::size_t k = 0; k < last.size(); ++k) {
            curves.push_back({title_of(plan, k), *last[k].curve("energy"), false});
        }
    }
    Curve exact{"exact", {}, true};
    for (double t = 0.0; t <= kEnd; t += 0.1) {
        exact.data.add(t, std::exp(-16.0 * kPi * kPi * t / kReynolds));
    }
    curves.push_back(exact);
    report.plot("R9a kinetic energy", "t U / L", "E / E0", curves, "set logscale y");
}

}  // namespace accuracy
