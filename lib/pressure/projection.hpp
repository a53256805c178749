// Stage: pressure, implicit. Reads level and u*; writes pressure and the projected velocity.
#pragma once

#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Makes the velocity free of divergence in the liquid (Chorin 1968), with the free surface where
/// the level is zero between two cell centres (Gibou, Fedkiw, Cheng & Kang 2002), at the pressure
/// that the air cell beside it holds (`fields.on_surface`; otherwise 0), and with faces open as far
/// as the solids leave them (Ng, Min & Gibou 2009). With two liquids faces answer by the inverse
/// density that the grid holds. Starts from the last pressure, makes one correction on a coarse
/// grid and then `sweeps` red-black relaxations, no more and no less: time is bounded, the result
/// is the same on every machine. Cost: about 10 operations a liquid cell and sweep.
template <class Real>
void projection(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                std::int32_t sweeps, StaggeredGrid<Real>& grid, PressureFields<Real>& fields);

/// Share of the way from a liquid cell's centre to its air neighbour's that is liquid.
template <class Real>
inline Real liquid_fraction(Real level_liquid, Real level_air) {
    // Below 1/20 the equation would be stiffer than the surface is known.
    return maximum(Real(0.05), level_liquid / (level_liquid - level_air));
}

}  // namespace weir
