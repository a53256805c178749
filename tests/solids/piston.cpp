// A piston that a closed tank full of liquid stands in the way of. Nothing can yield: the step has
// to say so, and to go on with finite numbers, everything inside and no more energy than the piston
// could have given.
#include <algorithm>
#include <cmath>

#include "measure/tank_def.hpp"
#include "problems.hpp"
#include "tank.hpp"

namespace solids {

namespace {

constexpr int kCells = 32;
constexpr double kCell = 0.02;
constexpr double kSide = kCells * kCell;

struct Outcome {
    bool finite = true;
    bool inside = true;
    int added = 0;
    int alive = 0;
    int removed = 0;        ///< that the reports tell
    int steps_told = 0;     ///< in which something was overfull, clamped or removed
    double first_told = 0;  ///< how far in it had got, of the tank
    double densest = 0.0;
    double energy = 0.0;    ///< largest kinetic energy over that of all liquid at the piston's speed
};

/// Drives a piston of the tank's height in from the left, to `stroke` of the tank's width.
template <class Real>
Outcome press(weir::Pressure pressure, double speed, double stroke) {
    weir::WorldDef def = measure::tank_def(kCells, kCells, 4 * kCells * kCells, 1, 4);
    def.cell_m = static_cast<float>(kCell);
    def.pressure = pressure;
    Tank<Real> tank(def);
    const Ring ring = rectangle(kSide, 2.0 * kSide);
    weir::BodyDef body = body_of(ring, -0.5 * kSide, 0.5 * kSide);
    body.motion.velocity_mps = {static_cast<float>(speed), 0.0F};
    weir::BodyId id;
    require(tank->add_moving_body(body, &id));
    Outcome out;
    require(tank->fill({{0.0F, 0.0F}, {static_cast<float>(kSide), static_cast<float>(kSide)}},
                       &out.added));
    weir::Diagnostics seen;
    for (double pushed = 0.0; pushed < stroke * kSide;) {
        const weir::StepReport report = tank->step(1.0F / 120.0F);
        pushed += speed * static_cast<double>(report.dt_s);
        out.removed += report.particles_removed_stuck;
        if (report.cells_overfull > 0 || report.clamped != 0 ||
            report.particles_removed_stuck > 0) {
            out.first_told = out.steps_told == 0 ? pushed / kSide : out.first_told;
            ++out.steps_told;
        }
        require(tank->diagnose(&seen));
        out.densest = std::max(out.densest, seen.largest_density);
        out.energy = std::max(out.energy, seen.kinetic_energy_m4ps2 /
                                              (0.5 * seen.mass_m2 * speed * speed));
    }
    out.alive = tank->particle_positions().size;
    for (std::int32_t k = 0; k < out.alive; ++k) {
        const weir::Vec2<double> x = tank.position(k);
        const weir::Vec2<double> w = tank.velocity(k);
        out.finite = out.finite && std::isfinite(x.x) && std::isfinite(x.y);
        out.inside = out.inside && x.x >= 0.0 && x.x <= kCells && x.y >= 0.0 && x.y <= kCells;
        out.finite = out.finite && std::isfinite(w.x) && std::isfinite(w.y);
    }
    return out;
}

template <class Real>
void press(Report& report, const std::string& name, weir::Pressure pressure, double speed) {
    const Outcome out = press<Real>(pressure, speed, 0.5);
    report.holds(name + ".finite", out.finite);
    report.holds(name + ".inside", out.inside);
    report.equals(name + ".unaccounted", out.added - out.alive - out.removed, "particles", 0.0);
    report.at_least(name + ".steps_reported", out.steps_told, "1", 1.0);
    report.at_most(name + ".first_reported_at", 100.0 * out.first_told, "% of the tank", 20.0);
    report.figure(name + ".largest_density", out.densest, "1");
    report.at_most(name + ".energy_over_all_at_piston_speed", out.energy, "1", 16.0);
}

template <class Real>
void press_both(Report& report, double speed, const std::string& at) {
    press<Real>(report, "piston.projection." + at, weir::Pressure::projection, speed);
    press<Real>(report, "piston.equation_of_state." + at, weir::Pressure::equation_of_state,
                speed);
}

}  // namespace

void piston(Report& report, const Effort& effort) {
    for (const double speed : {0.1, 1.0}) {
        const std::string at = speed < 0.5 ? "slow" : "fast";
        in_scalar(report, effort.real,
                  [&](auto zero) { press_both<decltype(zero)>(report, speed, at); });
        if (effort.real == Scalar::single_precision) {
            press<weir::Fixed>(report, "piston.fixed." + at, weir::Pressure::projection, speed);
        }
    }
}

}  // namespace solids
