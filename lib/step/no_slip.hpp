// Stage: grid update, where viscous liquid sticks to bodies. Absent if none of them holds it.
#pragma once

#include "pressure/domain.hpp"
#include "solid/face_axis.hpp"

namespace weir {

/// What a wall without slip takes out of the scatter: the particles that a face reads stand on its
/// open side only, so their mean place is further from the wall than the face. The velocity along
/// the wall, which grows from the wall's own in proportion to the distance, is set back to where
/// the face is; faces inside the wall have the wall's. The tank's walls do the same by images.
/// After `grid_update`. The fields' divergence and inverse diagonal are the scratch.
/// Cost: a look at each cell, about 60 operations for each face within a cell of such a wall.
template <class Real>
void centre_at_walls(const Domain<Real>& domain, Work work = {});

/// The same of velocities of one component as scattered, before the mass matrix (mass_matrix.hpp)
/// asks them what particles beside a wall interpolate.
template <class Real>
void centre_flow(const FaceAxis<Real>& axis, const VelocityOf<Real>* other_mass,
                 const Real* other_momentum, VelocityOf<Real>* flow);

/// Viscosity beside walls without slip, over what `diffuse` did there: a neighbour beyond the wall
/// pulls with the wall's velocity at the wall's distance θ, (u_wall − u)/θ (Gibou, Fedkiw, Cheng &
/// Kang 2002), the wall's part implicitly, so that no θ is too small. `fall`: as for the tank's
/// walls (step/viscosity.hpp). What the walls pull the bodies receive. Reads the velocity before
/// `diffuse` from the fields' scratch.
template <class Real>
void diffuse_to_walls(const Domain<Real>& domain, Real amount, Vec2<Real> fall,
                      std::int32_t from);

/// Of faces nearer than half a cell to a thin wall without slip, the velocity along it: between the
/// wall's own and that of the liquid a cell from the wall, in proportion to the distance. After
/// `mirror_at_thin_walls`. Cost: about 200 operations for each such face.
template <class Real>
void bind_to_thin_walls(const Walls<Real>& walls, const LevelOf<Real>* level,
                        StaggeredGrid<Real>& grid);

}  // namespace weir
