// Stage: blending of what particles keep with what they take, before grid-to-particle. Reads and
// writes the faces.
#pragma once

#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/thin_walls.hpp"

namespace weir {

/// Turns the velocity before the pressure (kept where the mass was) into the one field that a
/// particle's velocity needs (Brackbill & Ruppel 1986; Zhu & Bridson 2005):
///     v' = flip · v + I(change),  change = u − u_before + (1 − flip) ũ,
/// one gather instead of two. ũ is the velocity before, sharpened by what a scatter and a gather
/// smooth away, so that the share of PIC damps the noise between particles and not the flow.
/// Beside thin walls (`thin`, null: there are none) nothing is smoothed across, nor sharpened.
/// ũ is left in the fields' divergence (of u) and inverse diagonal.
template <class Real>
void blend_change(const Borders<Real>& borders, Real flip_ratio, PressureFields<Real>& fields,
                  StaggeredGrid<Real>& grid, const ThinWalls<Real>* thin = nullptr,
                  Work work = {});

}  // namespace weir
