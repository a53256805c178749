#include "step/time_step_limit.hpp"

namespace weir {

namespace {

/// √(g dt²), 0.12 cells: beyond it a column at rest would feel the step. Lower by measurement only.
template <class Real>
constexpr Real kRootOfGravityWay = Real(0.346410162);

template <class Real>
constexpr Real kSoundCfl = Real(0.4);

/// Sound that steps were too long for stiffens again by so much a step: what is crammed together
/// would be torn apart.
template <class Real>
constexpr Real kSoundRecovery = Real(1.0625);

/// ν dt, cells²: the limit of the five-point formula.
template <class Real>
constexpr Real kDiffusion = Real(0.25);

/// √(σ/ρ dt²), 1/2π cells³ (Brackbill, Kothe & Zemach 1992). Drops bore six times as much.
template <class Real>
constexpr Real kRootOfCapillary = Real(0.398942280);
template <class Real>
constexpr Real kCapillary = Real(0.159154943);

/// Ceiling that survives any finite ratio.
template <class Real>
std::int32_t at_least(Real ratio, std::int32_t most) {
    return ratio < static_cast<Real>(most) ? maximum(1, ceil_to_int(ratio)) : most + 1;
}

/// Fastest point of any body or particle, along an axis or less, cells/s.
template <class Real>
Real fastest(const Simulation<Real>& simulation) {
    Real speed = simulation.max_speed;
    const BodyTable<Real>& table = simulation.bodies;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.kind == BodyKind::moving) {
            speed = maximum(speed, body.fastest_point());
        }
    }
    return speed;
}

/// Density of the lightest liquid: the same tension makes the fastest ripples on it.
template <class Real>
Real lightest(const Simulation<Real>& simulation) {
    const bool two = simulation.pressure.second_liquid != nullptr;
    return two ? minimum(Real(1), simulation.settings.second_density) : Real(1);
}

/// Sound that steps are too long for. Liquid that is faster than it piles up: what it then stored
/// would tear it apart, so sound gives way by as much again.
template <class Real>
Real softened(Real sound_speed, Real speed) {
    return speed > sound_speed ? sound_speed * (sound_speed / speed) : sound_speed;
}

}  // namespace

template <class Real>
Seconds<Real> longest_step(const Settings<Real>& settings) {
    const Real gravity = larger_part(settings.gravity);
    const Real most = static_cast<Real>(static_cast<std::int32_t>(settings.max_substeps));
    if (!(gravity > Real(0))) {
        return Seconds<Real>(1);
    }
    const Real most_s = most * (kRootOfGravityWay<Real> / square_root(gravity));
    return static_cast<Seconds<Real>>(minimum(Real(1), most_s));
}

template <class Real>
SubstepPlan<Real> plan_substeps(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    const Settings<Real>& settings = simulation.settings;
    const bool elastic = simulation.pressure.elasticity != nullptr;
    const Real gravity = larger_part(settings.gravity);
    const Real speed = fastest(simulation);
    const std::int32_t most = settings.max_substeps;
    const Real reach = (speed + gravity * dt_s) * dt_s / settings.cfl;
    const Real fall = dt_s * (square_root(gravity) / kRootOfGravityWay<Real>);
    std::int32_t wanted = maximum(at_least(reach, most), at_least(fall, most));
    SubstepPlan<Real> plan;
    const Real last = simulation.pressure.sound_speed;
    plan.sound_speed = last > Real(0) ? minimum(settings.sound_speed, kSoundRecovery<Real> * last)
                                      : settings.sound_speed;
    if (elastic) {
        const Real waves = (settings.sound_speed + speed) * dt_s / kSoundCfl<Real>;
        wanted = maximum(wanted, at_least(waves, most));
    }
    if (settings.viscosity > Real(0)) {
        wanted = maximum(wanted, at_least(settings.viscosity * dt_s / kDiffusion<Real>, most));
    }
    const Real light = lightest(simulation);
    if (settings.surface_tension > Real(0)) {
        const Real ripples = dt_s * (square_root(settings.surface_tension) /
                                     (square_root(light) * kRootOfCapillary<Real>));
        wanted = maximum(wanted, at_least(ripples, most));
    }
    plan.substeps = static_cast<std::int16_t>(minimum(wanted, most));
    plan.sweeps = settings.sweeps;
    plan.dt_s = part_of(dt_s, plan.substeps);
    if (elastic && wanted > most) {
        plan.sound_speed = minimum(plan.sound_speed,
                                   softened(kSoundCfl<Real> / plan.dt_s, speed + gravity * dt_s));
    }
    plan.viscosity = minimum(settings.viscosity, kDiffusion<Real> / plan.dt_s);
    plan.surface_tension =
        minimum(settings.surface_tension, (light * kCapillary<Real>) / (plan.dt_s * plan.dt_s));
    // Liquid that was just put there has not shown how fast it is. Where forces are counted, what
    // is lost so would have to be settled. Packed liquid cannot do without: it would creep on.
    const bool counts = !Stored<Real>::coarse && simulation.two_way != nullptr;
    // Substeps that follow sound are so short that half of it has to do.
    const Real pull = gravity * plan.dt_s;
    plan.settling = kSettles<Real> && !counts && !simulation.pressure.crowded &&
                    simulation.pressure.last_dt > Seconds<Real>{} &&
                    speed <= kSettling<Real> && kSettling<Real> <= (elastic ? pull + pull : pull);
    return plan;
}

#define WEIR_INSTANTIATE(Real)                                  \
    template Seconds<Real> longest_step(const Settings<Real>&); \
    template SubstepPlan<Real> plan_substeps(const Simulation<Real>&, Seconds<Real>);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
