// Stage: grid update. Reads mass and momentum; writes velocities.
#pragma once

#include "pressure/domain.hpp"

namespace weir {

/// velocity = momentum / mass on every face that has mass, then `fall` on top: what gravity gives,
/// cells/s. Where the mass was stands the velocity before gravity from now on: grid-to-particle
/// needs the change (FLIP). With two liquids the mass gives way to the inverse density.
/// Normal velocity on the tank's walls is 0 but where liquid parts from them.
/// `unreached`: what then stands where no particle reaches.
/// Order: by row. Cost: one division a face.
template <class Real>
void grid_update(const Domain<Real>& domain, Vec2<Real> fall, Work work = {},
                 Real unreached = kNoVelocity<Real>);

/// Faces in air beside the liquid take from the pressure what the liquid's open faces next to them
/// do on average: particles at the surface read both. It is the acceleration that goes on smoothly
/// into the air; to continue the velocity itself would brake whatever turns or shears. Surface
/// tension, which feeds on every ripple, wants the braking: `velocity_itself`.
/// After the projection; reads levels and pressures of the cells.
template <class Real>
void extrapolate(const Domain<Real>& domain, bool velocity_itself, Work work = {});

/// The same, and all that a push on spray must not do: packed worlds do without, but not with an
/// equation of state.
template <class Real>
void extrapolate_by_face(const Domain<Real>& domain, bool velocity_itself, Work work);

}  // namespace weir
