#include "world/sleep.hpp"

#include "step/rest_on_solids.hpp"

namespace weir {

namespace {

using detail::WorldState;

template <class Real>
bool has_rested(const WorldState<Real>& state) {
    return state.still_s >= state.def.sleep.after_s;
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

/// Whether no particle is faster than that, but for those that lie on a solid.
template <bool Solids, class Real>
bool particles_rest(const Simulation<Real>& simulation, Real speed, StepReport& report) {
    return simulation.max_speed <= speed ||
           (Solids && rest_on_solids(simulation, speed, report.work[kStageCount - 1]));
}

/// What is on its way out of a solid moves without a speed of its own. A pause tells nothing:
/// solids of a world that was restored are not drawn yet.
template <bool Solids, class Real>
void watch_rest(WorldState<Real>& state, StepReport& report) {
    if (report.substeps == 0) {
        return;
    }
    const Sleep& sleep = state.def.sleep;
    const Simulation<Real>& simulation = state.simulation;
    const Real speed = resting_speed(state);
    const bool at_rest = report.particles_stuck == 0 && report.particles_removed_stuck == 0 &&
                         report.particles_reset == 0 && bodies_rest(simulation.bodies, speed) &&
                         particles_rest<Solids>(simulation, speed, report);
    state.still_s = at_rest ? minimum(state.still_s + report.dt_s, sleep.after_s) : 0.0F;
}

}  // namespace

template <bool Solids, class Real>
const detail::Rest<Real>& detail::rest() {
    static constexpr Rest<Real> kRest{has_rested<Real>, watch_rest<Solids, Real>};
    return kRest;
}

#define WEIR_INSTANTIATE(Real)                                         \
    template const detail::Rest<Real>& detail::rest<false, Real>();   \
    template const detail::Rest<Real>& detail::rest<true, Real>();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
