// Which substep a world takes, and what else of its stages hangs on whether there are bodies.
#include "solid/collide.hpp"
#include "solid/layers.hpp"
#include "step/rest_on_solids.hpp"
#include "step/stage_clock.hpp"
#include "step/substep.hpp"
#include "step/two_way.hpp"

namespace weir {

namespace {

template <class Real>
using SubstepFunction = void (*)(Simulation<Real>&, const SubstepPlan<Real>&, Work, StepReport&);

/// A packed world that keeps a ledger has it around the substep: one that does not has no
/// instruction of it.
template <bool Solids, class Real>
void balanced_substep(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                      StepReport& report) {
    StageClock opening(simulation.ticks, work, report);
    simulation.two_way->open_ledger(simulation, work);
    opening.charge(Stage::particle_to_grid);
    substep<Solids>(simulation, plan, work, report);
    StageClock closing(simulation.ticks, work, report);
    simulation.two_way->close_ledger(simulation, plan.dt_s, work);
    closing.charge(Stage::collide);
}

template <class Real, SubstepFunction<Real> Substep>
const Stages<Real>& in_open() {
    static constexpr auto kNowhere = [](const GridShape&, const Walls<Real>&, Vec2<Real>) {
        return false;
    };
    static constexpr auto kNothing = [](Layers<Real>&, BodyTable<Real>&) -> std::int32_t {
        return 0;
    };
    static constexpr auto kNoSolid = [](Layers<Real>&, const BodyTable<Real>&) -> std::int32_t {
        return 0;
    };
    static constexpr Stages<Real> kStages{Substep, kNowhere, kNothing, kNoSolid,
                                          nullptr, nullptr,  nullptr};
    return kStages;
}

template <class Real, SubstepFunction<Real> Substep>
const Stages<Real>& among_solids() {
    static constexpr Stages<Real> kStages{Substep,
                                          inside_solid<Real>,
                                          merge_moving<Real>,
                                          draw_stored<Real>,
                                          empty_lone_slivers<Real>,
                                          end_leads<Real>,
                                          rest_on_solids<Real>};
    return kStages;
}

}  // namespace

template <class Real>
const Stages<Real>& open_stages() {
    return in_open<Real, substep<false, Real>>();
}
template <class Real>
const Stages<Real>& solid_stages() {
    return among_solids<Real, substep<true, Real>>();
}
template <class Real>
const Stages<Real>& balanced_open_stages() {
    return in_open<Real, balanced_substep<false, Real>>();
}
template <class Real>
const Stages<Real>& balanced_solid_stages() {
    return among_solids<Real, balanced_substep<true, Real>>();
}

#define WEIR_INSTANTIATE(Real)                        \
    template const Stages<Real>& open_stages<Real>(); \
    template const Stages<Real>& solid_stages<Real>();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE
#define WEIR_INSTANTIATE(Real)                                 \
    template const Stages<Real>& balanced_open_stages<Real>(); \
    template const Stages<Real>& balanced_solid_stages<Real>();
WEIR_FOR_PACKED(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
