// Stage: bend paths, between the volume's blending and its drift.
#pragma once

#include "pressure/domain.hpp"

namespace weir {

/// Where the pressure does not see to what straight paths do (see pressure/leap.hpp), beside
/// surfaces and walls or, if nothing leaps, everywhere, the field along which particles
/// go bends with the flow:
///     u += ¼ dt (ũ·∇)ũ, with surface tension or where nothing leaps ½ dt,
/// of the velocity ũ before the step that `blend_change` left in the fields' divergence and inverse
/// diagonal. Half as much between a cell that the pressure sees to and one that it does not.
/// Beside solids nothing bends, nor in packed worlds; beside thin walls the gather bends by what it
/// sees.
/// Order: any.
template <class Real>
void bend_paths(const Domain<Real>& domain, Seconds<Real> dt_s, Work work = {});

}  // namespace weir
