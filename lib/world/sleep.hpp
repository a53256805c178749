// Sleep: a world in which nothing has moved for a while stands still, and its steps do nothing,
// until something changes. Nothing is rounded off on the way: it wakes as it fell asleep.
#pragma once

#include "step/part_met.hpp"
#include "step/regions.hpp"
#include "step/substep.hpp"
#include "world/world_state.hpp"

namespace weir {

/// By itself: linked where a world may sleep.
template <class Real>
struct detail::Rest {
    bool (*is_asleep)(const WorldState<Real>& state);
    /// After a step: counts the time for which nothing was faster than `Sleep::speed_mps`.
    void (*watch)(WorldState<Real>& state, StepReport& report);
};

template <class Real>
bool may_sleep(const detail::WorldState<Real>& state) {
    return state.rest != nullptr;
}

template <class Real>
bool is_asleep(const detail::WorldState<Real>& state) {
    return may_sleep(state) && state.rest->is_asleep(state);
}

/// Whatever the caller changed: the time at rest counts from anew, and something is stirred.
template <class Real>
void wake(detail::WorldState<Real>& state) {
    state.still_s = 0.0F;
    look_for_met(state.simulation);
}

/// What all liquid feels was changed.
template <class Real>
void wake_all(detail::WorldState<Real>& state) {
    wake(state);
    if (state.simulation.regions != nullptr) {
        state.simulation.regions->wake_all();
    }
}

/// A gravity that is not that of the time at rest, within what a sensor's noise may be.
template <class Real>
void wake_by_gravity(detail::WorldState<Real>& state, Vec2f gravity_mps2) {
    const Vec2f off = gravity_mps2 - state.still_gravity_mps2;
    const float most = state.def.sleep.gravity_mps2;
    if (absolute(off.x) > most || absolute(off.y) > most) {
        state.still_gravity_mps2 = gravity_mps2;
        wake_all(state);
    }
}

/// What is not faster rests, cells per unit of time.
template <class Real>
Real resting_speed(const detail::WorldState<Real>& state) {
    return static_cast<Real>(pace_of(state) * static_cast<Face<Real>>(state.def.sleep.speed_mps));
}

/// How many particles, and patches of 4 × 4 cells, may have to be looked at to tell whether all
/// rests.
template <class Real>
std::int32_t most_looks(const detail::WorldState<Real>& state, std::int32_t patches) {
    if (!may_sleep(state)) {
        return 0;
    }
    const Simulation<Real>& simulation = state.simulation;
    return (Stored<Real>::coarse ? 0 : patches) +
           (simulation.bodies.capacity > 0 ? simulation.particles.capacity : 0);
}

}  // namespace weir
