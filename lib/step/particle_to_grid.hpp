// Stage: particle-to-grid. Reads particles; writes mass and momentum on the faces.
#pragma once

#include "fluid/particles.hpp"
#include "grid/borders.hpp"
#include "solid/thin_walls.hpp"

namespace weir {

/// Clears the grid, then adds every particle's mass 1 and momentum to its four u faces and four
/// v faces with bilinear weights. Ghost rows are folded back.
/// With two liquids momentum and, beside the count, mass are weighted by the particle's density.
/// Past thin walls (`thin`, null: there are none) a particle gives only to faces that it sees; such
/// worlds run the plain loops.
/// @return how often a particle found no room on faces that are full; 0 but in fixed point.
/// Order: by particle, then by node. Cost: 8 weights and 16 sums a particle; two liquids: 24.
template <class Real>
std::int32_t particle_to_grid(const Particles<Real>& particles, const Borders<Real>& borders,
                              Real second_density, StaggeredGrid<Real>& grid,
                              const ThinWalls<Real>* thin = nullptr, Work work = {});

}  // namespace weir
