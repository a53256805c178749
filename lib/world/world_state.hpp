// What stands at the head of the caller's memory.
#pragma once

#include "step/time_step_limit.hpp"
#include "weir/world.hpp"

namespace weir::detail {

template <class Real>
struct WorldState {
    Simulation<Real> simulation;
    WorldDef def;
    Face<Real> cells_per_m = Face<Real>(0);
    float stepped_s = 0.0F;        ///< in the last step
    std::uint16_t tag = 0;         ///< this world's own, in the names of its bodies
    bool stepping = false;         ///< a step was begun and is not yet done
    float still_s = 0.0F;          ///< for so long nothing has moved, at most Sleep::after_s
    Vec2f still_gravity_mps2;      ///< in that time
    std::uint32_t pending = 0;     ///< Clamped bits that the next report shall carry
    std::int32_t substeps_left = 0;
    SubstepPlan<Real> plan;        ///< of that step
    Progress progress;             ///< in its present substep
    StepReport* report = nullptr;  ///< of that step, with the caller
};

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
