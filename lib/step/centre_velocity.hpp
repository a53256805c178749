// Stage: grid update, only if there is viscosity. Reads particles' places; writes velocities.
#pragma once

#include "fluid/particles.hpp"
#include "pressure/domain.hpp"

namespace weir {

/// Faces are given what particles would have told them of the flow at the face's own place, not at
/// theirs: v + ∇u·(x_face − x), as affine particles do (Jiang, Schroeder, Selle, Teran & Stomakhin
/// 2015, eq. 8), with ∇u from the four faces around the particle. Without it a face's velocity is
/// that of the mean place of its particles, which viscosity takes for another flow. Faces at the
/// surface stay as they are: waves would swing by another period. Momentum is kept but there and
/// beside walls.
///
/// ∇u is of faces that are off themselves. Each pass halves what is wrong, so of two passes
/// (`again`: the second) twice the second less the first is taken. What errs in the second order
/// cancels with what the gather does to a particle: `blend_change` then sharpens nothing.
///
/// After `grid_update`, which has given `fall`, ghost lines of the velocity before it extended. Of
/// that one slopes are taken, and it goes first; the velocity now follows in the second pass. Faces
/// beside walls that liquid sticks to (step/no_slip.hpp) and beside thin ones stay as they are,
/// too; packed worlds do without. The fields' divergence and inverse diagonal are the scratch.
/// Order: by particle, then by node. Cost of a pass: 8 weights and 16 sums a particle.
template <class Real>
void centre_velocity(const Domain<Real>& domain, const Particles<Real>& particles,
                     Real second_density, Vec2<Real> fall, bool again, Work work = {});

}  // namespace weir
