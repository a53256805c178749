// R7: a disc in free space that starts with an affine velocity: (a) pure strain, (b) strain 1 with
// spin 0.5, which carries angular momentum. Unit of length: a cell; of time: 1 / strain. Exact
// solution in affine_drop.hpp. The disc's radius is that of its particles' volume.
#include <cmath>

#include "affine_drop.hpp"
#include "problems.hpp"

namespace accuracy {

namespace {

constexpr double kSoundRatio = 14.0;  ///< sound speed over radius × strain
constexpr double kCore = 0.2;         ///< pressure is read within this radius, over R
constexpr Matrix kStrain{1.0, 0.0, 0.0, -1.0};
constexpr Matrix kStrainAndSpin{1.0, -0.5, 0.5, -1.0};

struct CorePressure {
    double error = 0.0;  ///< of the mean, over the exact value at the centre
    double noise = 0.0;
};

CorePressure core_pressure(const Scheme& scheme, const AffineDrop& exact, Vector centre,
                           double radius) {
    const int reach = static_cast<int>(std::ceil(kCore * radius));
    const int middle_x = static_cast<int>(std::lround(centre.x));
    const int middle_y = static_cast<int>(std::lround(centre.y));
    double sum = 0.0;
    double squares = 0.0;
    int count = 0;
    for (int j = -reach; j < reach; ++j) {
        for (int i = -reach; i < reach; ++i) {
            const Vector arm = Vector{middle_x + i + 0.5, middle_y + j + 0.5} - centre;
            if (dot(arm, arm) > kCore * kCore * radius * radius) {
                continue;
            }
            const double measured = scheme.pressure(middle_x + i, middle_y + j);
            const double e =
                measured / (radius * radius) - exact.pressure((1.0 / radius) * arm);
            sum += e;
            squares += e * e;
            ++count;
        }
    }
    const double mean = sum / count;
    const double scale = exact.pressure({});
    return {mean / scale, std::sqrt(std::fmax(0.0, squares / count - mean * mean)) / scale};
}

Outcome run_free_drop(Scheme& scheme, const Case& c, const Matrix& gradient) {
    const double spin = 0.5 * (gradient.yx - gradient.xy);
    Setup setup;
    setup.nx = 8 * c.cells;
    setup.ny = static_cast<int>((spin == 0.0 ? 2.25 : 3.0) * c.cells);
    setup.ny += setup.ny % 2;
    setup.interval = 0.5 / c.cells;
    setup.sound_speed = kSoundRatio * c.cells;
    setup.top_speed = 2.0 * c.cells;
    setup.options = c.options;
    Particles start = seed_disc(c.lattice, {0.5 * setup.nx, 0.5 * setup.ny}, c.cells);
    const Vector centre = centre_of_mass(start);
    for (Particle& p : start) {
        const Vector arm = p.x - centre;
        p.v = {gradient.xx * arm.x + gradient.xy * arm.y,
               gradient.yx * arm.x + gradient.yy * arm.y};
    }
    scheme.start(setup, start);
    const double radius = std::sqrt(static_cast<double>(start.size()) / (kPerCell * kPi));
    const double kinetic = energy(start, {}).kinetic;
    const double spin_start = angular_momentum(start, centre);
    AffineDrop exact(gradient, 0.0);
    Outcome outcome;
    Signal axes;
    const auto per_unit = static_cast<int>(std::lround(1.0 / scheme.interval()));
    for (int k = 1; k <= 2 * per_unit; ++k) {
        scheme.advance();
        const double t = k * scheme.interval();
        const Ellipse now = ellipse(scheme.particles());
        axes.add(t, now.major / radius);
        if (k % per_unit != 0) {
            continue;
        }
        exact.advance_to(t);
        const std::string suffix = k == per_unit ? "_t1" : "_t2";
        outcome.add("semi_major" + suffix, 100.0 * (now.major / radius / exact.semi_major() - 1.0));
        outcome.add("semi_minor" + suffix, 100.0 * (now.minor / radius / exact.semi_minor() - 1.0));
        outcome.add("angle" + suffix, now.angle_degrees - exact.major_angle_degrees());
        const CorePressure core = core_pressure(scheme, exact, centre, radius);
        outcome.add("centre_pressure" + suffix, 100.0 * core.error);
        outcome.add("pressure_noise" + suffix, 100.0 * core.noise);
    }
    const Particles end = scheme.particles();
    outcome.add("kinetic_energy_change", 100.0 * (energy(end, {}).kinetic / kinetic - 1.0));
    const double scale = spin == 0.0 ? kinetic : spin_start;
    outcome.add("angular_momentum_drift",
                100.0 * (angular_momentum(end, centre) - spin_start) / scale);
    outcome.curves.emplace_back("axes", axes);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 0.0, outcome);
    return outcome;
}

std::vector<Metric> metrics_of(bool with_spin) {
    std::vector<Metric> metrics = {
        {"semi_major_t1", "%", {{32, 0.10}, {64, 0.04}, {128, 0.02}}},
        {"semi_major_t2", "%", {{32, 0.10}, {64, 0.04}, {128, 0.02}}},
        {"semi_minor_t2", "%", {}},
        {"centre_pressure_t1", "%", {{32, 5.0}, {64, 3.0}, {128, 2.0}}},
        {"pressure_noise_t1", "%", {{32, 10.0}, {64, 10.0}, {128, 10.0}}},
        {"kinetic_energy_change", "%", {}}};
    if (with_spin) {
        metrics.push_back({"angle_t2", "degree", {}});
        metrics.push_back({"angular_momentum_drift", "%", {{32, 1e-4}, {64, 1e-4}, {128, 1e-4}}});
    }
    return metrics;
}

Curve exact_axes(const Matrix& gradient) {
    AffineDrop exact(gradient, 0.0);
    Curve curve{"exact", {}, true};
    for (int k = 1; k <= 20; ++k) {
        exact.advance_to(0.1 * k);
        curve.data.add(0.1 * k, exact.semi_major());
    }
    return curve;
}

}  // namespace

void report_free_drop(Report& report, const Effort& effort) {
    for (const bool with_spin : {false, true}) {
        const Matrix gradient = with_spin ? kStrainAndSpin : kStrain;
        const std::string name = with_spin ? "R7b" : "R7a";
        report.heading(name + " free drop, " + (with_spin ? "strain and spin" : "strain"));
        std::vector<Curve> curves;
        const int most = 64;
        for (const Plan& plan : beside_others(effort, resolutions(effort, most),
                                              {Kind::equation_of_state, Kind::reference})) {
            const auto last =
                sweep(report, effort, name, plan, metrics_of(with_spin),
                      [&](Scheme& s, const Case& c) { return run_free_drop(s, c, gradient); });
            for (std::size_t k = 0; k < last.size(); ++k) {
                curves.push_back({title_of(plan, k), *last[k].curve("axes"), false});
            }
        }
        curves.push_back(exact_axes(gradient));
        report.plot(name + " semi-major axis", "t A0", "a / R", curves, "set key left top");
    }
}

}  // namespace accuracy
