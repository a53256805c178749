// Stage: pressure, first part. Reads face masses; writes density and level of every cell.
#pragma once

#include "pressure/domain.hpp"
#include "pressure/slivers.hpp"

namespace weir {

/// Height of a flat surface over the centre of a cell that shows the given density, cells.
/// Exact inverse of the kernel with which face masses average to a cell: −3/2 … 3/2.
template <class Real>
Real level_of_density(Real density);

/// Under so many cells of liquid no surface is near. Viscous flow is so smooth that particles
/// gather in streaks and thin out beside them; without viscosity their own motion undoes that.
template <class Real>
inline constexpr Real kPressedHead = Real(2);

/// Density = mean of the masses on the cell's four faces over what a full cell would show there;
/// level from it. An air cell that liquid surrounds counts as liquid: it would be a sink of
/// pressure. So does one that particles reach and whose last pressure was above `held`; 0: none
/// does. `empty_slivers`: null where there is no room for bodies. Order: by row. Cost: 4 sums and
/// about one square root a cell near the surface.
template <class Real>
void surface_level(const Domain<Real>& domain, Real rest_count,
                   EmptySlivers<Real> empty_slivers = nullptr, Work work = {},
                   Real held = Real(0));

}  // namespace weir
