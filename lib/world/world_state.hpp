// What stands at the head of the caller's memory.
#pragma once

#include "step/time_step_limit.hpp"
#include "weir/world.hpp"
#include "world/unit_of_time.hpp"

namespace weir::detail {

template <class Real>
struct WorldState {
    explicit WorldState(const WorldDef& definition)
        : simulation{}, def(definition), stepping(false), density_stale(false) {}

    Simulation<Real> simulation;
    WorldDef def;
    Face<Real> cells_per_m = Face<Real>(0);
    float stepped_s = 0.0F;        ///< in the last step
    std::uint16_t tag = 0;         ///< this world's own, in the names of its bodies
    // A byte for both: none is left.
    bool stepping : 1;       ///< a step was begun and is not yet done
    bool density_stale : 1;  ///< particles are others than the last substep's
    std::int8_t unit_exponent = 0;  ///< of the unit of time, a power of 2 s; ask `unit_of`
    float still_s = 0.0F;          ///< for so long nothing has moved, at most Sleep::after_s
    Vec2f still_gravity_mps2;      ///< in that time
    std::uint32_t pending = 0;     ///< Clamped bits that the next report shall carry
    std::int32_t substeps_left = 0;
    SubstepPlan<Real> plan;        ///< of that step
    Progress progress;             ///< in its present substep
    StepReport* report = nullptr;  ///< of that step, with the caller
    const Rest<Real>* rest = nullptr;  ///< null: the definition does without
};

/// The unit of time inside, s, and how many are a second: known to be 1 but in packed worlds.
template <class Real>
float unit_of(const WorldState<Real>& state) {
    return Stored<Real>::coarse ? power_of_two(state.unit_exponent) : 1.0F;
}
template <class Real>
float units_per_s(const WorldState<Real>& state) {
    return Stored<Real>::coarse ? power_of_two(-state.unit_exponent) : 1.0F;
}
/// What 1 m/s is in cells per unit of time.
template <class Real>
Face<Real> pace_of(const WorldState<Real>& state) {
    return state.cells_per_m * static_cast<Face<Real>>(unit_of(state));
}
/// What 1 m/s² is in cells per unit of time and unit of time.
template <class Real>
Face<Real> pull_of(const WorldState<Real>& state) {
    return pace_of(state) * static_cast<Face<Real>>(unit_of(state));
}

/// Whether calls that change the world may do so now.
template <class Real>
Status ready(const WorldState<Real>* state) {
    if (state == nullptr) {
        return Status::not_initialised;
    }
    return state->stepping ? Status::step_in_progress : Status::ok;
}
static_assert(sizeof(WorldState<float>) <= kWorldStateBytes<float>, "raise kWorldStateBytes");
static_assert(sizeof(WorldState<Fixed>) <= kWorldStateBytes<Fixed>, "raise kWorldStateBytes");
static_assert(sizeof(WorldState<SmallFixed>) <= kWorldStateBytes<SmallFixed>,
              "raise kWorldStateBytes");
static_assert(sizeof(WorldState<double>) <= kWorldStateBytes<double>, "raise kWorldStateBytes");

}  // namespace weir::detail
