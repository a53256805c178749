// The step: make the input sane, plan the substeps, run them, report.
#include "step/ladder.hpp"
#include "step/part_met.hpp"
#include "step/substep.hpp"
#include "world/sleep.hpp"
#include "world/step_input.hpp"
#include "world/world_state.hpp"

namespace weir {

template <class Real>
Status World<Real>::set_gravity(Vec2f gravity_mps2) {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    if (!is_finite(gravity_mps2)) {
        state_->pending |= static_cast<std::uint32_t>(Clamped::gravity);
        return Status::gravity_not_finite;
    }
    const float strongest = reach_of<Real>(state_->unit_exponent).gravity;
    const float most = minimum(kMaxGravity, strongest * state_->def.cell_m);
    const Vec2f limited{clamp(gravity_mps2.x, -most, most), clamp(gravity_mps2.y, -most, most)};
    if (limited.x != gravity_mps2.x || limited.y != gravity_mps2.y) {
        state_->pending |= static_cast<std::uint32_t>(Clamped::gravity);
    }
    wake_by_gravity(*state_, limited);
    Simulation<Real>& simulation = state_->simulation;
    const Vec2<Real> gravity = convert<Real>(pull_of(*state_) * convert<Face<Real>>(limited));
    // The pressure of what is at rest goes with gravity: else a sensor's noise, which is up as
    // often as down, takes some of it each time. What a blow built up must not act after it.
    const Real before = length(simulation.settings.gravity);
    const bool elastic = simulation.pressure.elasticity != nullptr;
    const Real now = elastic && before > Real(0)
                         ? maximum(Real(0), dot(gravity, simulation.settings.gravity) / before)
                         : length(gravity);
    const Real most_now = elastic ? before : before + before;
    if (before > Real(0) && now != before && !is_asleep(*state_)) {
        Real& change = simulation.pressure.change;
        change = minimum(kMostRescale<Real>, change * (minimum(now, most_now) / before));
    }
    if (gravity.x != simulation.settings.gravity.x || gravity.y != simulation.settings.gravity.y) {
        look_for_met(simulation);
    }
    simulation.settings.gravity = gravity;
    return Status::ok;
}

namespace {

template <class Real>
void begin(detail::WorldState<Real>& state, float dt_s, std::int32_t rung, StepReport& report) {
    Simulation<Real>& simulation = state.simulation;
    report = StepReport();
    state.report = &report;
    report.clamped = state.pending;
    report.rung = clamp(rung, 0, kRungs - 1);
    state.pending = 0;
    state.stepping = true;
    state.substeps_left = 0;
    state.progress.begin();
    clear(simulation.contacts);
    const float unit = unit_of(state);
    const Seconds<Real> dt = sane_time_step(simulation.settings, dt_s * units_per_s(state), report);
    if (is_asleep(state)) {  // forces stay those of the last step that was made
        report.dt_s = unit * static_cast<float>(dt);
        return;
    }
    if (simulation.bodies.load != nullptr) {
        forget_impulses(simulation.bodies);
    }
    if (Stored<Real>::coarse && any_wall_drags(simulation.settings.borders)) {
        look_for_met(simulation);
    }
    if (dt > Seconds<Real>{}) {
        SubstepPlan<Real> plan = plan_substeps(simulation, dt);
        if (plan.sound_speed < simulation.settings.sound_speed) {
            mark(report, Clamped::sound_speed);
        }
        // With substeps to spare, what is missing is rounding.
        const bool all_used = plan.substeps == simulation.settings.max_substeps;
        if (all_used && plan.viscosity < simulation.settings.viscosity) {
            mark(report, Clamped::viscosity);
        }
        if (all_used && plan.surface_tension < simulation.settings.surface_tension) {
            mark(report, Clamped::surface_tension);
        }
        report.dt_s = unit * static_cast<float>(dt);
        const std::int32_t planned = plan.substeps;
        climb(report.rung, simulation, plan);
        report.walls_held = plan.walls_held;
        if (plan.substeps < planned) {
            mark(report, Clamped::time_step);
            report.dt_s =
                unit * (static_cast<float>(plan.substeps) * static_cast<float>(plan.dt_s));
        }
        report.substeps = plan.substeps;
        if (simulation.walls_behind_s > Seconds<Real>{} &&
            simulation.stages->slow_leads != nullptr) {
            using Number = Face<Real>;
            const auto behind = static_cast<Number>(simulation.walls_behind_s);
            const Number step =
                static_cast<Number>(plan.substeps) * static_cast<Number>(plan.dt_s);
            simulation.stages->slow_leads(simulation.bodies, behind / (behind + step));
        }
        state.plan = plan;
        state.substeps_left = plan.substeps;
        state.density_stale = false;
    }
    state.stepped_s = report.dt_s;
}

template <class Real>
void end(detail::WorldState<Real>& state) {
    Simulation<Real>& simulation = state.simulation;
    StepReport& report = *state.report;
    simulation.layers.show(simulation.bodies.used > 0);
    if (report.walls_held) {
        simulation.walls_behind_s = static_cast<Seconds<Real>>(report.dt_s * units_per_s(state));
    }
    if (simulation.contacts.capacity > 0) {
        simulation.contacts.blows->finish(simulation.contacts);
    }
    report.contacts_missed = simulation.contacts.missed;
    if (report.particles_slowed > 0) {
        mark(report, Clamped::speed);
    }
    if (report.bodies_slowed > 0) {
        mark(report, Clamped::body_speed);
    }
    if (report.particles_reset > 0) {
        mark(report, Clamped::not_finite);
    }
    report.particles = simulation.particles.count;
    report.max_speed_mps =
        state.def.cell_m * static_cast<float>(simulation.max_speed) * units_per_s(state);
    if (may_sleep(state)) {
        state.rest->watch(state, report);
        report.asleep = is_asleep(state);
        const std::int32_t apart =
            simulation.regions != nullptr ? simulation.regions->asleep : 0;
        report.particles_asleep = report.asleep ? report.particles : apart;
    }
    if (report.dt_s > 0.0F && simulation.stages->end_leads != nullptr) {
        simulation.stages->end_leads(simulation.bodies, report.walls_held);
    }
    state.stepping = false;
}

/// Goes on with a step until it is done or the work is. True: it is done.
template <class Real>
bool go_on(detail::WorldState<Real>& state, std::int32_t work) {
    Progress& progress = state.progress;
    while (state.substeps_left > 0 && work > 0) {
        progress.resume(work);
        state.simulation.stages->substep(state.simulation, state.plan, Work(progress),
                                         *state.report);
        work = progress.left();
        if (progress.complete()) {
            progress.begin();
            --state.substeps_left;
        }
    }
    if (state.substeps_left > 0) {
        return false;
    }
    end(state);
    return true;
}

}  // namespace

template <class Real>
Status World<Real>::begin_step(float dt_s, StepReport* report, std::int32_t rung) {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    if (report == nullptr) {
        return Status::output_missing;
    }
    begin(*state_, dt_s, rung, *report);
    return Status::ok;
}

template <class Real>
bool World<Real>::advance(std::int32_t work) {
    return state_ == nullptr || !state_->stepping || go_on(*state_, maximum(work, 1));
}

template <class Real>
StepReport World<Real>::step(float dt_s, std::int32_t rung) {
    StepReport report;
    if (state_ == nullptr) {
        mark(report, Clamped::not_initialised);
        return report;
    }
    while (!advance(kMostWork)) {
    }
    begin(*state_, dt_s, rung, report);
    while (!advance(kMostWork)) {
    }
    return report;
}

#define WEIR_INSTANTIATE(Real)                                                 \
    template Status World<Real>::set_gravity(Vec2f);                           \
    template Status World<Real>::begin_step(float, StepReport*, std::int32_t); \
    template bool World<Real>::advance(std::int32_t);                          \
    template StepReport World<Real>::step(float, std::int32_t);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
