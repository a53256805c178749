// R4a: water at rest in a tank 1 wide and 0.75 high, 0.5 deep, for 40 sqrt(H/g), from a lattice led
// to rest. (An explicit pressure starts from the lattice: it has its own damping.) Unit of length:
// a cell; of time: sqrt(H/g). Pressure is compared to the weight above, the depth being the
// liquid's volume over the tank's width.
#include <algorithm>
#include <cmath>

#include "problems.hpp"

namespace accuracy {

namespace {

constexpr double kEnd = 40.0;
/// Deep liquid takes longer: steps per cell of the tank's width, and at most.
constexpr int kSettlingSteps = 64;
constexpr int kMostSettlingSteps = 4096;
constexpr double kQuietFrom = 0.8 * kEnd;  ///< figures are means over the last fifth

struct Pool {
    int width;
    double depth;
    double gravity;
    double sound;  ///< 0: incompressible
    /// p / ρ at a height. Compressible: dp/dy = −g (1 + p/c²) with the whole weight at the floor.
    double pressure(double y) const {
        if (sound == 0.0) {
            return gravity * (depth - y);
        }
        const double k = sound * sound;
        const double surface = k / gravity * std::log(1.0 + gravity * depth / k);
        return k * (std::exp(gravity * (surface - y) / k) - 1.0);
    }
};

struct PressureError {
    double bottom = 0.0;  ///< mean over the lowest row, relative to g H
    double l2 = 0.0;      ///< over all cells below the surface
};

PressureError compare(const Scheme& scheme, const Pool& pool) {
    PressureError error;
    const double scale = pool.gravity * pool.depth;
    const int rows = static_cast<int>(pool.depth);
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < pool.width; ++i) {
            const double e = (scheme.pressure(i, j) - pool.pressure(j + 0.5)) / scale;
            error.l2 += e * e;
            error.bottom += j == 0 ? e : 0.0;
        }
    }
    error.l2 = std::sqrt(error.l2 / (rows * pool.width));
    error.bottom /= pool.width;
    return error;
}

Signal pressure_profile(const Scheme& scheme, const Pool& pool, int ny) {
    Signal profile;
    for (int j = 0; j < ny; ++j) {
        double sum = 0.0;
        for (int i = 0; i < pool.width; ++i) {
            sum += scheme.pressure(i, j);
        }
        profile.add((j + 0.5) / pool.depth, sum / pool.width / (pool.gravity * pool.depth));
    }
    return profile;
}

/// The problem starts at rest, but a lattice that is shifted or turned is not: it rearranges, and
/// what that stirs up swings on. It is led to rest as structures are (kinetic damping, Cundall
/// 1976): whenever the kinetic energy has passed a peak, all velocities are set to 0.
void settle(Scheme& scheme, int steps) {
    double before = 0.0;
    for (int k = 0; k < steps; ++k) {
        scheme.advance();
        Particles now = scheme.particles();
        const double kinetic = energy(now, {}).kinetic;
        if (kinetic < before) {
            for (Particle& p : now) {
                p.v = {};
            }
            scheme.replace(now);
            before = 0.0;
        } else {
            before = kinetic;
        }
    }
}

}  // namespace

Outcome run_hydrostatic(Scheme& scheme, const Case& c) {
    const double depth = 0.5 * c.cells;
    Setup setup;
    const Particles start = start_pool(c, scheme, setup);
    if (!scheme.compressible()) {
        settle(scheme, std::min(kSettlingSteps * c.cells, kMostSettlingSteps));
        scheme.reset_clock();
    }
    const double volume = static_cast<double>(start.size()) / kPerCell;
    const Pool pool{c.cells, volume / c.cells, depth,
                    scheme.compressible() ? setup.sound_speed * c.options.sound_scale : 0.0};
    Outcome outcome;
    PressureError mean;
    Speed quiet;
    double kinetic = 0.0;
    int samples = 0;
    Signal speeds;
    for (double t = 0.0; t < kEnd; t += scheme.interval()) {
        scheme.advance();
        const Particles now = scheme.particles();
        const Speed s = speed(now);
        speeds.add(t, std::max(s.largest / depth, 1e-12));
        if (t < kQuietFrom) {
            continue;
        }
        const PressureError e = compare(scheme, pool);
        mean.bottom += e.bottom;
        mean.l2 += e.l2;
        quiet.largest += s.largest;
        quiet.rms += s.rms;
        kinetic += energy(now, {}).kinetic;
        ++samples;
    }
    const double wave_speed = depth;  // sqrt(g H)
    const double shift = centre_of_mass(scheme.particles()).y - centre_of_mass(start).y;
    outcome.add("bottom_pressure_error", 100.0 * mean.bottom / samples);
    outcome.add("pressure_l2", mean.l2 / samples);
    outcome.add("residual_speed_max", quiet.largest / samples / wave_speed);
    outcome.add("residual_speed_rms", quiet.rms / samples / wave_speed);
    outcome.add("kinetic_energy",
                kinetic / samples / kPerCell / (0.5 * depth * depth * depth * c.cells));
    outcome.add("centre_of_mass_shift", shift);
    outcome.add("centre_height_error",
                100.0 * (centre_of_mass(scheme.particles()).y / (0.5 * pool.depth) - 1.0));
    outcome.curves.emplace_back("profile", pressure_profile(scheme, pool, setup.ny));
    outcome.curves.emplace_back("speed", speeds);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 1.0, outcome);
    return outcome;
}

void report_hydrostatic(Report& report, const Effort& effort) {
    report.heading("R4a hydrostatic pool");
    const std::vector<Metric> metrics = {
        {"bottom_pressure_error", "%", {{16, 0.2}, {32, 0.2}, {64, 0.2}, {128, 0.2}}},
        {"pressure_l2", "rho g H", {{32, 0.0015}, {64, 0.0008}, {128, 0.0004}}},
        {"residual_speed_max", "sqrt(g H)", {{16, 1e-5}, {32, 1e-5}, {64, 1e-5}, {128, 1e-5}}},
        {"residual_speed_rms", "sqrt(g H)", {}},
        {"kinetic_energy", "rho g H^2 W/2", {{32, 1e-9}, {64, 1e-9}, {128, 1e-9}}},
        {"centre_of_mass_shift", "cell", {}},
        {"centre_height_error", "%", {}}};
    std::vector<Curve> profiles;
    std::vector<Curve> speeds;
    for (const Plan& plan : beside_others(effort, resolutions(effort),
                                          {Kind::equation_of_state, Kind::reference})) {
        const auto last = sweep(report, effort, "R4a", plan, metrics, run_hydrostatic);
        for (std::size_t k = 0; k < last.size(); ++k) {
            const std::string title = title_of(plan, k);
            profiles.push_back({title, *last[k].curve("profile"), false});
            speeds.push_back({title, *last[k].curve("speed"), false});
        }
    }
    Signal exact;
    for (double y = 0.0; y <= 1.0; y += 0.05) {
        exact.add(y, 1.0 - y);
    }
    profiles.push_back({"exact", exact, true});
    report.plot("R4a profile", "y / H", "p / (rho g H)", profiles);
    report.plot("R4a speed", "t sqrt(g/H)", "max |v| / sqrt(g H)", speeds, "set logscale y");
}

}  // namespace accuracy
