// A packed world that keeps a ledger has it around the substep: one that does not has no
// instruction of it.
#include "step/stage_clock.hpp"
#include "step/stages.hpp"
#include "step/two_way.hpp"

namespace weir {

namespace {

template <Bodies Room, class Real>
void balanced_substep(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                      StepReport& report) {
    StageClock opening(simulation.ticks, work, report);
    simulation.two_way->open_ledger(simulation, work);
    opening.charge(Stage::particle_to_grid);
    plain_stages<Room, Real>().substep(simulation, plan, work, report);
    StageClock closing(simulation.ticks, work, report);
    simulation.two_way->close_ledger(simulation, plan.dt_s, work);
    closing.charge(Stage::collide);
}

}  // namespace

template <Bodies Room, class Real>
const Stages<Real>& balanced_stages() {
    return stages_around<Room, Real, balanced_substep<Room, Real>>();
}

#define WEIR_INSTANTIATE(Real)                                           \
    template const Stages<Real>& balanced_stages<Bodies::none, Real>();  \
    template const Stages<Real>& balanced_stages<Bodies::still, Real>(); \
    template const Stages<Real>& balanced_stages<Bodies::moving, Real>();
WEIR_FOR_PACKED(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
