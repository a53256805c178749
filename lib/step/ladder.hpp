// What a step leaves off, rung by rung, to be done in time: WorldDef's plan is rung 0.
#pragma once

#include "step/time_step_limit.hpp"

namespace weir {

/// Sweeps first: what of the divergence they leave, later steps find. Then time: substeps keep
/// their length, which is what stability hangs on, and there are fewer.
template <class Real>
void climb(std::int32_t rung, SubstepPlan<Real>& plan) {
    const auto part = [](std::int32_t whole, std::int32_t of) {
        return static_cast<std::int16_t>((whole + of - 1) / of);
    };
    plan.sweeps = part(plan.sweeps, rung == 0 ? 1 : (rung == 1 ? 2 : 4));
    if (rung == 3) {
        plan.substeps = part(plan.substeps, 2);
    } else if (rung > 3) {
        plan.substeps = 1;
    }
}

}  // namespace weir
