// A packed world that keeps a ledger has it around the substep: one that does not has no
// instruction of it.
#include "step/stage_clock.hpp"
#include "step/stages.hpp"
#include "step/two_way.hpp"

namespace weir {

namespace {

template <bool Solids, class Real>
void balanced_substep(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                      StepReport& report) {
    StageClock opening(simulation.ticks, work, report);
    simulation.two_way->open_ledger(simulation, work);
    opening.charge(Stage::particle_to_grid);
    plain_stages<Solids, Real>().substep(simulation, plan, work, report);
    StageClock closing(simulation.ticks, work, report);
    simulation.two_way->close_ledger(simulation, plan.dt_s, work);
    closing.charge(Stage::collide);
}

}  // namespace

template <bool Solids, class Real>
const Stages<Real>& balanced_stages() {
    return stages_around<Solids, Real, balanced_substep<Solids, Real>>();
}

#define WEIR_INSTANTIATE(Real)                                   \
    template const Stages<Real>& balanced_stages<false, Real>(); \
    template const Stages<Real>& balanced_stages<true, Real>();
WEIR_FOR_PACKED(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
