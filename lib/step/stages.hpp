// What of a world's stages hangs on whether there is room for bodies, around whichever substep.
#pragma once

#include "solid/collide.hpp"
#include "solid/layers.hpp"
#include "step/rest_on_solids.hpp"
#include "step/substep.hpp"

namespace weir {

template <class Real>
using SubstepFunction = void (*)(Simulation<Real>&, const SubstepPlan<Real>&, Work, StepReport&);

template <bool Solids, class Real, SubstepFunction<Real> Substep>
const Stages<Real>& stages_around() {
    if constexpr (Solids) {
        static constexpr Stages<Real> kStages{Substep,
                                              inside_solid<Real>,
                                              merge_moving<Real>,
                                              draw_stored<Real>,
                                              empty_lone_slivers<Real>,
                                              end_leads<Real>,
                                              rest_on_solids<Real>};
        return kStages;
    } else {
        constexpr auto kNowhere = [](const GridShape&, const Walls<Real>&, Vec2<Real>) {
            return false;
        };
        constexpr auto kNothing = [](Layers<Real>&, auto&) -> std::int32_t { return 0; };
        static constexpr Stages<Real> kStages{Substep, kNowhere, kNothing, kNothing,
                                              nullptr, nullptr,  nullptr};
        return kStages;
    }
}

}  // namespace weir
