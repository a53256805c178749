// Cell fields of the pressure stage. `pressure` survives from step to step: the solve starts there.
#pragma once

#include "grid/staggered_grid.hpp"

namespace weir {

template <class Real>
struct PressureFields {
    Real* pressure = nullptr;          ///< dt · p / ρ (the first liquid's), cells²/s; 0 in air
    Real* divergence = nullptr;        ///< net flow out of the cell, cells/s
    Real* inverse_diagonal = nullptr;  ///< 0 where the cell is not liquid
    Real* density = nullptr;           ///< 1 = full at rest
    Real* level = nullptr;             ///< height of the surface over the centre, cells; > 0 liquid
    bool on_surface = false;           ///< but with surface tension air cells hold the surface's
    Seconds<Real> last_dt{};           ///< dt that `pressure` was solved for
    Real gravity_change = Real(1);     ///< strength of gravity now over then, at most 1
};

}  // namespace weir
