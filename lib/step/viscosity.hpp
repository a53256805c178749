// Stage: grid update, only if there is viscosity. Reads velocities and levels; writes velocities.
#pragma once

#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// Newtonian shear viscosity, explicit: u += ν dt ∇²u on faces that hold liquid; a face without
/// liquid exerts no stress. Stable while ν dt ≤ ¼ cell², which the plan of substeps keeps.
/// `amount` = ν dt, cells². The fields' divergence and inverse diagonal are used as scratch.
/// Order: none (reads only the velocities before). Cost: about 12 operations a face.
template <class Real>
void diffuse_velocity(const Borders<Real>& borders, PressureFields<Real>& fields, Real amount,
                      StaggeredGrid<Real>& grid);

}  // namespace weir
