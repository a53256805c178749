// Skip: of the rows that a substep works on, the columns that liquid can be in. A dam that breaks
// lies in a corner of its rectangle, and so does a pool that sways.
//
// Cells beyond are empty and stay so: pressure, density and level are what a cell without liquid
// has. All other fields are written as far as `GridShape::entries` tells and hold anything beyond.
#pragma once

#include "math/lanes.hpp"
#include "step/simulation.hpp"
#include "step/time_step_limit.hpp"

namespace weir {

/// Whether there are loops that know of spans: those that desktops run.
template <class Real>
inline constexpr bool kHasRowSpans = WEIR_PARALLEL && kHasLanes<Real>;

void narrow_rows(Simulation<float>& simulation, const SubstepPlan<float>& plan);

/// Tells what of the grid's rows has to be worked on, from the densities that the last substep
/// found. Where that would spare less than an eighth whole rows are worked on, whose loops are
/// shorter; so they are with terms whose stages do not know of spans.
template <class Real>
void skip_empty_columns([[maybe_unused]] Simulation<Real>& simulation,
                        [[maybe_unused]] const SubstepPlan<Real>& plan) {
    if constexpr (kHasRowSpans<Real>) {
        narrow_rows(simulation, plan);
    }
}

}  // namespace weir
