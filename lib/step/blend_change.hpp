// Stage: blending of what particles keep with what they take, before grid-to-particle. Reads and
// writes the faces.
#pragma once

#include "pressure/domain.hpp"

namespace weir {

/// Turns the velocity before the pressure (kept where the mass was) into the one field that a
/// particle's velocity needs (Brackbill & Ruppel 1986; Zhu & Bridson 2005):
///     v' = flip · v + I(change),  change = u − u_before + (1 − flip) ũ,
/// one gather instead of two. ũ is the velocity before, sharpened by what a scatter and a gather
/// smooth away, so that the share of PIC damps the noise between particles and not the flow.
/// Beside thin walls nothing is smoothed across, nor sharpened. `unsmoothed`: the scatter did
/// not (step/mass_matrix.hpp), and ũ is the velocity before as it is.
/// ũ is left in the fields' divergence (of u) and inverse diagonal.
template <class Real>
void blend_change(const Domain<Real>& domain, Real flip_ratio, bool unsmoothed = false,
                  Work work = {});

}  // namespace weir
