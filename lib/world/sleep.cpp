#include "world/sleep.hpp"

#include "pressure/patch_drift.hpp"
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

/// Mean excess of a patch from which on liquid is pressed together, twice with an equation of
/// state; packed worlds have theirs (drift_packed.hpp).
template <class Real>
constexpr Real kPressed = Real(0.01);

/// Whether some of the liquid has yet to rise, as the last drift found.
template <class Real>
bool is_pressed(const Simulation<Real>& simulation, [[maybe_unused]] std::uint32_t& looks) {
    const PressureFields<Real>& fields = simulation.pressure;
    if constexpr (Stored<Real>::coarse) {
        return fields.crowded;
    } else {
        if (!(simulation.settings.volume_gain > Real(0))) {
            return false;
        }
        const GridShape& big = fields.coarse.shape;
        looks += static_cast<std::uint32_t>(big.size());
        const Real most = fields.elasticity != nullptr ? kPressed<Real> + kPressed<Real>
                                                       : kPressed<Real>;
        bool pressed = false;
        for_each_patch(simulation.grid.shape, big, Part{0, big.ny}, [&](const Patch& patch) {
            const Real mean = fields.coarse.correction[patch.q];
            pressed = pressed || (mean > most && mean != kSolidPatch<Real>);
        });
        return pressed;
    }
}

/// What is pressed together rises at a speed that may be taken for rest: of a tall tank that was
/// shaken a tenth was missing, asleep. So its time at rest counts by a share. Not by none: beside
/// solids a patch may stay a little too dense for good.
constexpr float kPressedShare = 1.0F / 16.0F;

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
    if (!at_rest) {
        state.still_s = 0.0F;
        return;
    }
    const bool pressed = is_pressed(simulation, report.work[kStageCount - 1]);
    const float still_s = pressed ? kPressedShare * report.dt_s : report.dt_s;
    state.still_s = minimum(state.still_s + still_s, sleep.after_s);
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
