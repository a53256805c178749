// One substep, from particles back to particles.
#pragma once

#include "step/simulation.hpp"

namespace weir {

/// Advances everything by dt_s. Adds counts and ticks to the report.
template <class Real>
void substep(Simulation<Real>& simulation, Real dt_s, Real sound_speed, StepReport& report);

}  // namespace weir
