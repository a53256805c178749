// Both transfers four numbers at a time: the same sums in the same order as the plain loops, and so
// the same bits. A face's two numbers stand side by side, so that a stencil's row is one load.
#pragma once

#include "math/lanes.hpp"
#include "step/grid_to_particle.hpp"

namespace weir {

#if WEIR_HAS_LANES
/// Adds mass and momentum of one liquid's particles to the grid; ghost rows are not folded back.
/// Overwrites all of mass_u, mass_v, u, v and the scratch of the grid. `thin` null: no such walls.
void scatter_in_lanes(const Particles<float>& particles, const ThinWalls<float>* thin,
                      StaggeredGrid<float>& grid, Work work);

/// As `prepare_gather`.
void pair_fields(StaggeredGrid<float>& grid, Work work);

/// As `grid_to_particle`.
TransferResult<float> gather_in_lanes(const StaggeredGrid<float>& grid,
                                      const Transfer<float>& transfer,
                                      Particles<float>& particles);
#endif

}  // namespace weir
