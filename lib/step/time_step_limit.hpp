// How many substeps a step needs.
#pragma once

#include "step/simulation.hpp"

namespace weir {

template <class Real>
struct SubstepPlan {
    std::int16_t substeps = 1;   ///< at most 1000, as sweeps
    std::int16_t sweeps = 1;     ///< of the pressure
    Seconds<Real> dt_s{};
    Real sound_speed = Real(0);  ///< cells/s, softened if max_substeps is too few for it
    Real viscosity = Real(0);    ///< cells²/s, lowered likewise
    Real surface_tension = Real(0);  ///< cells³/s², lowered likewise
    bool settling = false;  ///< all that moves is what fixed point cannot tell from rest
    bool walls_held = false;  ///< moving bodies stay where they are drawn
};

/// Substeps so that no particle travels further than cfl cells (Courant, Friedrichs & Lewy 1928),
/// gravity moves nothing by more than a tenth of a cell, and sound, where there is any, no
/// further than half a cell, and viscosity spreads over no more than a quarter of a cell²,
/// and the shortest ripple of surface tension is followed. Bounded by max_substeps.
template <class Real>
SubstepPlan<Real> plan_substeps(const Simulation<Real>& simulation, Seconds<Real> dt_s);

/// The longest step that max_substeps can carry against gravity, at most one second.
template <class Real>
Seconds<Real> longest_step(const Settings<Real>& settings);

}  // namespace weir
