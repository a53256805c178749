// S10, S11: time step, sound speed and viscosity over and beyond their limits.
#include <algorithm>
#include <cmath>

#include "cases.hpp"

namespace stability {

using weir::Clamped;
using weir::StepReport;

namespace {

std::string with(const std::string& name, const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return name + text;
}

/// A dam break until it rests, in steps of dt.
template <class Real>
void break_dam(Tank<Real>& tank, float seconds, float dt_s) {
    tank.fill(0, 0, 8, 12);
    tank.run(static_cast<std::int32_t>(seconds / dt_s), dt_s);
}

template <class Real>
void cfl_sweep(Report& report, const Scheme& scheme) {
    for (const float cfl : {0.1F, 0.25F, 0.5F, 1.0F, 1.5F, 2.0F}) {
        for (const float frames : {1.0F, 4.0F}) {
            weir::WorldDef def = tank_def(scheme, 24, 16, 512);
            def.cfl = cfl;
            def.max_substeps = 200;
            Tank<Real> tank(def);
            break_dam(tank, 8.0F, frames * scheme.dt_s());
            const std::string name =
                with(with(label<Real>("S10", scheme), ".cfl%g", static_cast<double>(cfl)),
                     ".frames%g", static_cast<double>(frames));
            report.run(name, tank.tally(), bounds_of(scheme));
            report.figure(name + ".settled_volume_error", tank.volume_error(), "1");
        }
    }
}

/// Sound from far too soft to stiff; substeps from one to plenty. Softened sound is reported.
template <class Real>
void sound_sweep(Report& report) {
    const Scheme scheme{weir::Pressure::equation_of_state, weir::Contour::interpolated};
    for (const float sound : {0.5F, 2.0F, 5.0F, 10.0F, 20.0F, 50.0F}) {
        for (const std::int32_t substeps : {1, 4, 16, 100}) {
            weir::WorldDef def = tank_def(scheme, 24, 16, 512);
            def.sound_speed_mps = sound;
            def.max_substeps = substeps;
            Tank<Real> tank(def);
            break_dam(tank, 4.0F, scheme.dt_s());
            const std::string name =
                with(with(label<Real>("S10", scheme), ".sound%g", static_cast<double>(sound)),
                     ".of%g", substeps);
            report.run(name, tank.tally(), bounds_of(scheme));
            const double carried = 0.4 * substeps;  // sound's Courant number over the step
            const auto asked = static_cast<double>(sound / kCell * scheme.dt_s());
            if (asked > carried) {
                report.holds(name + ".softened_is_reported",
                             tank.tally().saw(Clamped::sound_speed));
            }
        }
    }
}

/// Fewer sweeps than this are accepted by the world, but not stable: figures without a target.
constexpr std::int32_t kFewestStableSweeps = 8;

/// Sweeps at two depths; the share of the particles' own velocity from none to all.
template <class Real>
void solver_sweep(Report& report, const Scheme& scheme, bool full) {
    for (const std::int32_t sweeps : {1, 2, 4, 6, 8, 16, 40}) {
        for (const std::int32_t scale : {1, 4}) {
            if (scheme.elastic() || (scale > 1 && sweeps % 8 != 0) || (scale > 1 && !full)) {
                continue;
            }
            weir::WorldDef def = tank_def(scheme, 24 * scale, 16 * scale, 512 * scale * scale);
            def.pressure_sweeps = sweeps;
            Tank<Real> tank(def);
            const auto unit = static_cast<float>(scale);
            tank.fill(0, 0, 8 * unit, 12 * unit);
            tank.run(480 * scale, scheme.dt_s());
            const std::string name = with(
                with(label<Real>("S10", scheme), ".depth%g", 12 * scale), ".sweeps%g", sweeps);
            Bounds bounds = bounds_of(scheme);
            bounds.energy = sweeps < kFewestStableSweeps ? 0.0 : bounds.energy;
            report.run(name, tank.tally(), bounds);
            report.figure(name + ".energy", tank.tally().energy_ratio, "of put in");
        }
    }
    for (const float flip : {0.0F, 0.5F, 0.9F, 0.97F, 0.99F, 1.0F}) {
        weir::WorldDef def = tank_def(scheme, 24, 16, 512);
        def.flip_ratio = flip;
        Tank<Real> tank(def);
        break_dam(tank, 8.0F, scheme.dt_s());
        report.run(with(label<Real>("S10", scheme), ".flip%g", static_cast<double>(flip)),
                   tank.tally(), bounds_of(scheme));
    }
}

/// `amount` is ν dt / cell², for a whole step.
template <class Real>
void thicken(Report& report, const Scheme& scheme, float amount, std::int32_t substeps) {
    weir::WorldDef def = tank_def(scheme, 24, 16, 512);
    def.max_substeps = substeps;
    def.viscosity_m2ps = amount * kCell * kCell / scheme.dt_s();
    def.walls = weir::every_wall({0.0F, 0.0F, true, 0.0F});
    Tank<Real> tank(def);
    tank.fill(0, 0, 8, 12);
    std::int32_t fewest = substeps;
    for (int k = 0; k < 400; ++k) {
        fewest = std::min(fewest, tank.step(scheme.dt_s()).substeps);
    }
    const std::string name = with(with(label<Real>("S11", scheme), ".nu%g",
                                       static_cast<double>(amount)),
                                  ".of%g", substeps);
    report.run(name, tank.tally(), bounds_of(scheme));
    const double wanted = std::ceil(static_cast<double>(amount) / 0.25 * 0.9999);
    report.at_least(name + ".substeps", fewest, "1",
                    std::min(wanted, static_cast<double>(substeps)));
    report.holds(name + ".thinned_is_reported",
                 tank.tally().saw(Clamped::viscosity) ==
                     (static_cast<double>(amount) > 0.2501 * substeps));
}

/// Liquid that sticks and is thick falls past a solid: friction only takes energy.
template <class Real>
void rub(Report& report, const Scheme& scheme, float amount, float flip, bool solid) {
    weir::WorldDef def = tank_def(scheme, 24, 24, 1024, 1, 3);
    def.viscosity_m2ps = amount * kCell * kCell / scheme.dt_s();
    def.flip_ratio = flip;
    def.walls = weir::every_wall({0.0F, 0.0F, true, 0.0F});
    Tank<Real> tank(def);
    if (solid) {
        tank.add_static({{-3, -2}, {3, -1}, {0.5F, 3}}, {11.3F, 5.4F});
    }
    tank.fill(0, 12, 20, 22);
    tank.run(200, scheme.dt_s());
    const std::string name = with(with(label<Real>("S11", scheme), ".sticks.nu%g",
                                       static_cast<double>(amount)),
                                  ".flip%g", static_cast<double>(flip)) +
                             (solid ? ".past_a_solid" : "");
    report.run(name, tank.tally(), bounds_of(scheme));
}

}  // namespace

void step_sweep(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, effort.full, [&](const Scheme& scheme, auto real) {
        cfl_sweep<decltype(real)>(report, scheme);
        solver_sweep<decltype(real)>(report, scheme, effort.full);
    });
    each_scheme(effort.scalar, false, false, [&](const Scheme& scheme, auto real) {
        if (scheme.elastic()) {
            sound_sweep<decltype(real)>(report);
        }
    });
}

void viscosity_sweep(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, effort.full, [&](const Scheme& scheme, auto real) {
        for (const float amount : {0.1F, 0.24F, 0.26F, 0.5F, 2.0F, 7.9F, 8.1F, 100.0F}) {
            thicken<decltype(real)>(report, scheme, amount, 32);
        }
        thicken<decltype(real)>(report, scheme, 10.0F, 1);
        for (const float flip : {0.5F, 0.9F, 0.97F, 1.0F}) {
            rub<decltype(real)>(report, scheme, 0.0F, flip, false);
            rub<decltype(real)>(report, scheme, 0.0F, flip, true);
            rub<decltype(real)>(report, scheme, 0.2F, flip, true);
        }
    });
}

}  // namespace stability
