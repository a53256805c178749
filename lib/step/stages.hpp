// What of a world's stages hangs on whether there is room for bodies, around whichever substep.
#pragma once

#include "solid/collide.hpp"
#include "solid/layers.hpp"
#include "solid/moving_walls.hpp"
#include "solid/thin_sight.hpp"
#include "step/substep.hpp"

namespace weir {

template <class Real>
using SubstepFunction = void (*)(Simulation<Real>&, const SubstepPlan<Real>&, Work, StepReport&);

template <Bodies Room, class Real, SubstepFunction<Real> Substep>
const Stages<Real>& stages_around() {
    constexpr auto kNothing = [](auto&, auto&) -> std::int32_t { return 0; };
    constexpr auto kSame = [](const GridShape&, const Walls<Real>&, Vec2<Real> place) {
        return place;
    };
    if constexpr (Room != Bodies::none) {
        constexpr bool kMoving = Room == Bodies::moving;
        constexpr decltype(Stages<Real>::draw_moved) kDrawn = kNothing;
        constexpr decltype(Stages<Real>::most_moved) kMost = kNothing;
        constexpr decltype(Stages<Real>::centre_seen) kCentre = kSame;
        static constexpr Stages<Real> kStages{Substep,
                                              kMoving ? move_bodies<Real> : nullptr,
                                              kMoving ? note_moving<Real> : nullptr,
                                              inside_solid<Real>,
                                              kHasThinWalls<Real> ? centre_seen<Real> : kCentre,
                                              kMoving ? merge_moving<Real> : kDrawn,
                                              kMoving ? most_nodes<Real> : kMost,
                                              draw_stored<Real>,
                                              empty_lone_slivers<Real>,
                                              kMoving ? end_leads<Real> : nullptr,
                                              kMoving ? slow_leads<Real> : nullptr};
        return kStages;
    } else {
        constexpr auto kNowhere = [](const GridShape&, const Walls<Real>&, Vec2<Real>) {
            return false;
        };
        static constexpr Stages<Real> kStages{Substep,  nullptr,  nullptr,  kNowhere,
                                              kSame,    kNothing, kNothing, kNothing,
                                              nullptr,  nullptr,  nullptr};
        return kStages;
    }
}

}  // namespace weir
