// Sleep: a world in which nothing has moved for a while stands still, and its steps do nothing,
// until something changes. Nothing is rounded off on the way: it wakes as it fell asleep.
#pragma once

#include "step/part_met.hpp"
#include "step/regions.hpp"
#include "step/substep.hpp"
#include "world/world_state.hpp"

namespace weir {

template <class Real>
bool may_sleep(const detail::WorldState<Real>& state) {
    return state.def.sleep.speed_mps > 0.0F;
}

template <class Real>
bool is_asleep(const detail::WorldState<Real>& state) {
    return may_sleep(state) && state.still_s >= state.def.sleep.after_s;
}

/// Whatever the caller changed: the time at rest counts from anew, and something is stirred.
template <class Real>
void wake(detail::WorldState<Real>& state) {
    state.still_s = 0.0F;
    look_for_met(state.simulation);
}

/// A gravity that is not that of the time at rest, within what a sensor's noise may be.
template <class Real>
void wake_by_gravity(detail::WorldState<Real>& state, Vec2f gravity_mps2) {
    const Vec2f off = gravity_mps2 - state.still_gravity_mps2;
    const float most = state.def.sleep.gravity_mps2;
    if (absolute(off.x) > most || absolute(off.y) > most) {
        state.still_gravity_mps2 = gravity_mps2;
        wake(state);
        if (state.simulation.regions != nullptr) {
            state.simulation.regions->wake_all();
        }
    }
}

/// What is not faster rests, cells per unit of time.
template <class Real>
Real resting_speed(const detail::WorldState<Real>& state) {
    return static_cast<Real>(pace_of(state) * static_cast<Face<Real>>(state.def.sleep.speed_mps));
}

/// Whether no point of any body is faster than that. What moves as told is never at rest.
template <class Real>
bool bodies_rest(const BodyTable<Real>& table, Real speed) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        const Body<Real>& body = table.body[slot];
        const bool yields = table.load != nullptr && table.load[slot].is_free();
        if (body.kind == BodyKind::moving && body.fastest_point() > (yields ? speed : Real(0))) {
            return false;
        }
    }
    return true;
}

/// Whether particles may have to be looked at to tell whether they rest.
template <class Real>
bool looks_at_particles(const detail::WorldState<Real>& state) {
    return may_sleep(state) && state.simulation.bodies.capacity > 0;
}

/// Whether no particle is faster than that, but for those that lie on a solid.
template <class Real>
bool particles_rest(const Simulation<Real>& simulation, Real speed, StepReport& report) {
    const auto on_solids = simulation.stages->rest_on_solids;
    return simulation.max_speed <= speed ||
           (on_solids != nullptr &&
            on_solids(simulation, speed, report.work[kStageCount - 1]));
}

/// After a step: counts the time for which nothing was faster than `Sleep::speed_mps`. What is on
/// its way out of a solid moves without a speed of its own. A pause tells nothing: solids of a
/// world that was restored are not drawn yet.
template <class Real>
void watch_rest(detail::WorldState<Real>& state, StepReport& report) {
    if (report.substeps == 0) {
        return;
    }
    const Sleep& sleep = state.def.sleep;
    const Simulation<Real>& simulation = state.simulation;
    const Real speed = resting_speed(state);
    const bool at_rest = report.particles_stuck == 0 && report.particles_removed_stuck == 0 &&
                         report.particles_reset == 0 && bodies_rest(simulation.bodies, speed) &&
                         particles_rest(simulation, speed, report);
    state.still_s = at_rest ? minimum(state.still_s + report.dt_s, sleep.after_s) : 0.0F;
}

}  // namespace weir
