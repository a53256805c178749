// R6a: a standing wave half a length long in a tank L = 1, depth h = 0.5, amplitude 0.02 h, started
// flat with the velocity of linear theory. Unit of length: a cell; of time: sqrt(h/g). Frequency
// and loss are read off the modal velocity, the projection of the particles' velocities on the
// mode. The lattice is relaxed at rest first: relaxing lifts the surface by some hundredths of a
// cell, which is not a wave.
#include <cmath>

#include "problems.hpp"

namespace accuracy {

namespace {

constexpr int kRelaxingSteps = 1000;
constexpr double kPeriods = 4.2;
constexpr double kAmplitude = 0.02;  ///< over the depth
constexpr double kDepthNumber = 0.5 * kPi;  ///< k h
/// sqrt(h/g) ω of linear theory: incompressible sqrt(kh tanh kh), and with c = 10 sqrt(g h).
constexpr double kOmega = 1.20027477;
constexpr double kOmegaCompressible = 1.19979609;
/// Tadjbakhsh & Keller 1960: dω/ω over (k a)².
constexpr double kAmplitudeEffect = -0.09732056;

struct Mode {
    double wave_number;
    double depth;
    Vector velocity(Vector x) const {
        const double scale = 1.0 / std::sinh(kDepthNumber);
        return {-scale * std::cosh(wave_number * x.y) * std::sin(wave_number * x.x),
                scale * std::sinh(wave_number * x.y) * std::cos(wave_number * x.x)};
    }
};

double modal_velocity(const Particles& particles, const Mode& mode) {
    double sum = 0.0;
    double norm = 0.0;
    for (const Particle& p : particles) {
        const Vector shape = mode.velocity(p.x);
        sum += dot(p.v, shape);
        norm += dot(shape, shape);
    }
    return sum / norm;
}

/// As `start_pool`, and lets it come to rest.
Particles start_at_rest(Scheme& scheme, const Case& c, Setup& setup) {
    Particles start = start_pool(c, scheme, setup);
    // In a compressible scheme every interval is many steps.
    const int relaxing = scheme.compressible()
                             ? static_cast<int>(15.0 / scheme.interval())
                             : kRelaxingSteps;
    for (int k = 0; c.start == nullptr && k < relaxing; ++k) {
        scheme.advance();
    }
    scheme.reset_clock();
    return start;
}

}  // namespace

Particles rest_before_wave(Scheme& scheme, const Case& c) {
    Setup setup;
    start_at_rest(scheme, c, setup);
    return scheme.particles();
}

Outcome run_standing_wave(Scheme& scheme, const Case& c) {
    const double depth = 0.5 * c.cells;
    Setup setup;
    const Particles start = start_at_rest(scheme, c, setup);
    const Mode mode{kPi / c.cells, depth};
    const double speed_scale = kAmplitude * depth * kOmega;
    Particles moving = scheme.particles();
    for (Particle& p : moving) {
        p.v = p.v + speed_scale * mode.velocity(p.x);
    }
    scheme.replace(moving);
    Signal signal;
    signal.add(0.0, modal_velocity(moving, mode) / speed_scale);
    const double end = kPeriods * 2.0 * kPi / kOmega;
    const auto steps = static_cast<int>(std::ceil(end / scheme.interval()));
    for (int k = 1; k <= steps; ++k) {
        scheme.advance();
        signal.add(k * scheme.interval(),
                   modal_velocity(scheme.particles(), mode) / speed_scale);
    }
    const Oscillation wave = oscillation(signal);
    const double steepness = kAmplitude * kDepthNumber;
    const double exact = (scheme.compressible() ? kOmegaCompressible : kOmega) *
                         (1.0 + kAmplitudeEffect * steepness * steepness);
    Outcome outcome;
    // A wave that is gone after one swing has no frequency: all of it counts as error.
    outcome.add("frequency_error", wave.omega > 0.0 ? 100.0 * (wave.omega / exact - 1.0) : 100.0);
    outcome.add("loss_per_period", wave.omega > 0.0 ? 100.0 * wave.loss_per_period : 100.0);
    outcome.add("crossings", wave.crossings);
    outcome.curves.emplace_back("wave", signal);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 1.0, outcome);
    return outcome;
}

void report_standing_wave(Report& report, const Effort& effort) {
    report.heading("R6a standing wave");
    const std::vector<Metric> metrics = {
        {"frequency_error", "%", {{32, 0.5}, {64, 0.2}, {128, 0.1}}},
        {"loss_per_period", "%", {{32, 1.0}, {64, 0.4}, {128, 0.1}}}};
    std::vector<Curve> curves;
    for (const Plan& plan :
         beside_others(effort, resolutions(effort),
                       {Kind::projection_double, Kind::equation_of_state, Kind::reference})) {
        const auto last = sweep(report, effort, "R6a", plan, metrics, run_standing_wave);
        for (std::size_t k = 0; k < last.size(); ++k) {
            const std::string title = title_of(plan, k);
            curves.push_back({title, *last[k].curve("wave"), false});
        }
    }
    Signal exact;
    for (double t = 0.0; t < kPeriods * 2.0 * kPi / kOmega; t += 0.2) {
        exact.add(t, std::cos(kOmega * t));
    }
    curves.push_back({"linear theory", exact, true});
    report.plot("R6a modal velocity", "t sqrt(g/h)", "u / u0", curves);
}

}  // namespace accuracy
