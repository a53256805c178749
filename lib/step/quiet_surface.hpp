// Stage: quiet leaning surfaces, between the pressure and the volume's blending.
#pragma once

#include "fluid/particles.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// Where the surface leans to the grid, no arrangement of particles is at rest for good: the level
/// that they show is a tenth of a cell off, and elsewhere as soon as they move. What is slow there,
/// against what gravity gives in a substep, gets more of PIC every fourth substep:
///     v += s (I(u before) − v),   s = ½ (1 − |ū|² / (g dt)²),
/// in cells within one of the surface, if that leans by an eighth or more, or by a 64th where
/// gravity leans by that to a quarter; nothing gets more than a quarter faster. Waves on a surface
/// that will be level and all that is fast keep their bits. Not without
/// weight, with surface tension or in compressible liquid; nor is it asked for where there are thin
/// walls: what has been stirred beside them would come to rest before it is lifted again. The
/// momentum that it takes is the method's own (`step/momentum_ledger.hpp`).
///
/// Needs the velocities before the step on all faces that particles read. `fields.divergence` is
/// overwritten. Order: any. Cost: all levels, and all particles if any cell is such a one.
template <class Real>
void quiet_surface(const StaggeredGrid<Real>& grid, PressureFields<Real>& fields,
                   const Vec2<Real>& gravity, Particles<Real>& particles, Work work = {});

}  // namespace weir
