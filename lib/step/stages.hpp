// What of a world's stages hangs on whether there is room for bodies, around whichever substep.
#pragma once

#include "solid/collide.hpp"
#include "solid/layers.hpp"
#include "step/rest_on_solids.hpp"
#include "step/substep.hpp"

namespace weir {

template <class Real>
using SubstepFunction = void (*)(Simulation<Real>&, const SubstepPlan<Real>&, Work, StepReport&);

template <class Real, SubstepFunction<Real> Substep>
const Stages<Real>& stages_in_open() {
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
const Stages<Real>& stages_among_solids() {
    static constexpr Stages<Real> kStages{Substep,
                                          inside_solid<Real>,
                                          merge_moving<Real>,
                                          draw_stored<Real>,
                                          empty_lone_slivers<Real>,
                                          end_leads<Real>,
                                          rest_on_solids<Real>};
    return kStages;
}

}  // namespace weir
