// Stage: grid update, only if there is viscosity, or no weight. Reads particles' places, masses and
// levels of the faces; writes momentum.
#pragma once

#include "step/time_step_limit.hpp"

namespace weir {

/// Momentum over mass is the flow at the mean place of a face's particles, and smoothed. Faces of
/// which particles interpolate what they carry, Σ_j M_ij v_j = Σ_p m_p w_i v_p, know it at their
/// own place, and unsmoothed: M_ij = Σ_p m_p w_i w_j is the consistent mass matrix (Burgess, Sulsky
/// & Brackbill 1992, J. Comput. Phys. 103), of which the faces' masses are the row sums.
/// Turns momentum into mass times such a velocity, by Jacobi's iteration from what the faces'
/// mean places and the flow's slope tell, which is all but that in flow that does not bend.
///
/// Faces at the surface stay as they are where anything pulls at it, or waves would swing by
/// another period; `to_surface`: they get what the slope beside them tells. Those beside walls that
/// liquid sticks to (step/no_slip.hpp) and beside thin ones stay, and others take them as without
/// the wall's part. Momentum is kept but there, at the surface and beside walls. Packed worlds do
/// without.
///
/// After particle-to-grid and `surface_level`, before `grid_update`. The fields' divergence,
/// inverse diagonal and coarse correction are the scratch.
/// Order: by particle, then by node. Cost: 5 shares a particle, 60 operations a face, and that
/// for both components.
template <class Real>
struct detail::MassMatrix {
    void (*solve)(const Domain<Real>& domain, const Particles<Real>& particles,
                  Real second_density, bool to_surface, Work work);
};

/// Whether a substep asks for it.
template <class Real>
bool interpolates(const Simulation<Real>& simulation, const SubstepPlan<Real>& plan) {
    return simulation.mass_matrix != nullptr &&
           (plan.viscosity > Real(0) || simulation.settings.is_weightless());
}

}  // namespace weir
