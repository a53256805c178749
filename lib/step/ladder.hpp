// What a step leaves off, rung by rung, to be done in time: WorldDef's plan is rung 0.
#pragma once

#include "step/time_step_limit.hpp"

namespace weir {

/// A body whose fastest point moves further in a step is not held, cells.
template <class Real>
inline constexpr Real kFurthestHeld = Real(1);

/// Whether moving bodies can stay where they are for that long: all of them are drawn where they
/// are, none was held in the last step, and none is fast or free.
template <class Real>
bool can_hold(const Simulation<Real>& simulation, const SubstepPlan<Real>& plan) {
    bool moving = false;
    if (simulation.walls_behind_s > Seconds<Real>{} || simulation.free_bodies != nullptr ||
        simulation.layers.walls.binary) {
        return false;
    }
    const auto substeps = static_cast<Real>(static_cast<std::int32_t>(plan.substeps));
    const BodyTable<Real>& table = simulation.bodies;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.kind != BodyKind::moving) {
            continue;
        }
        const Real speed = body.fastest_point();
        if (body.leapt || !(substeps * (plan.dt_s * speed) <= kFurthestHeld<Real>)) {
            return false;
        }
        moving = moving || speed > Real(0);
    }
    return moving;
}

/// Sweeps first: what of the divergence they leave, later steps find. Then the picture of the
/// solids, which may be a step old. Then time: substeps keep their length, which is what stability
/// hangs on, and there are fewer.
template <class Real>
void climb(std::int32_t rung, const Simulation<Real>& simulation, SubstepPlan<Real>& plan) {
    const auto part = [](std::int32_t whole, std::int32_t of) {
        return static_cast<std::int16_t>((whole + of - 1) / of);
    };
    plan.sweeps = part(plan.sweeps, rung == 0 ? 1 : (rung == 1 ? 2 : 4));
    if (rung == 4) {
        plan.substeps = part(plan.substeps, 2);
    } else if (rung > 4) {
        plan.substeps = 1;
    }
    plan.walls_held = rung >= 3 && can_hold(simulation, plan);
}

}  // namespace weir
