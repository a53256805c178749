// Stage: pressure, explicit. Reads density; writes pressure and the accelerated velocity.
#pragma once

#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Weakly compressible liquid (Monaghan 1994): p = c² (density − 1) where positive, plus a bulk
/// viscosity of 0.3 c cells that takes the ringing out. Stable while c · dt ≤ 0.46 cell.
/// Order: by row. Cost: about 15 operations a cell.
template <class Real>
void equation_of_state(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                       Real sound_speed, StaggeredGrid<Real>& grid,
                       PressureFields<Real>& fields, Work work = {});

}  // namespace weir
