// What all liquid of a periodic tank has in common along the tank's periodic axes: nothing in the
// tank tells that motion from rest.
#pragma once

#include "grid/borders.hpp"

namespace weir {

/// Takes the mean velocity of the faces amid liquid off all faces, along periodic axes, and notes
/// it as `grid.common`, with the mean of what particles gain (`mass_u`, `mass_v`). SmallFixed takes
/// nothing off where not all fits its range then.
/// @param level > 0: liquid.
template <class Real>
void leave_common_flow(const Borders<Real>& borders, const LevelOf<Real>* level,
                       StaggeredGrid<Real>& grid, Work work);

/// Adds it again; particles gain as much in the mean as before.
template <class Real>
void join_common_flow(const Borders<Real>& borders, const LevelOf<Real>* level,
                      StaggeredGrid<Real>& grid, Work work);

}  // namespace weir
