// One substep, from particles back to particles.
#pragma once

#include "step/time_step_limit.hpp"

namespace weir {

/// Advances everything by plan.dt_s, or does as much of it as the work allows. Adds counts and
/// ticks to the report.
template <class Real>
void substep(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
             StepReport& report);

}  // namespace weir
