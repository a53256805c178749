// Both transfers where particles and faces are kept in 16 bits: whole numbers, products of 32 bits,
// no division. Weights are 256ths that add up to 256, so that faces hold what particles gave.
#pragma once

#include "step/grid_to_particle.hpp"

namespace weir {

/// Adds mass and momentum of the particles to the cleared grid; ghost rows are not folded back.
/// Faces that hold 32 particles take no more, so that nothing wraps around.
/// @return how often a particle came to faces that are full.
std::int32_t scatter_packed(const Particles<SmallFixed>& particles,
                            StaggeredGrid<SmallFixed>& grid);

/// Between its two passes a gather keeps a word of so many particles, if it is given no scratch.
inline constexpr std::int32_t kStripPacked = 32;

/// As `grid_to_particle`.
TransferResult<SmallFixed> gather_packed(const StaggeredGrid<SmallFixed>& grid,
                                         const Transfer<SmallFixed>& transfer,
                                         Particles<SmallFixed>& particles);

}  // namespace weir
