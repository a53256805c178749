// Stage: grid update, last part. Reads projected velocities; writes faces that no liquid owns.
#pragma once

#include "pressure/domain.hpp"

namespace weir {

/// Faces inside solids, as particles near the wall will read them: the velocity at the mirror
/// point in the liquid, its part along the wall kept (slip), its normal part turned round so that
/// it vanishes on the wall. Relative to the wall's own velocity. The velocity before the step,
/// which stands where the mass was, is set so that what particles near the wall read as change is
/// the liquid's change along the wall and a stop towards it: the difference between the liquid's
/// speed and their own would drag them along and take nothing from the liquid in return. Liquid
/// that gravity takes from a wall, where no pressure holds it, takes the face along: it does not
/// hang there. Where no liquid is near the mirror point (level > 0 in 3 × 3 cells) faces keep what
/// they have: drops meet the wall one by one, and bounce as told.
/// Order: none, a copy is read; the fields' divergence and inverse diagonal are the scratch.
/// @param fall what gravity gave in the step, cells/s.
/// Cost: about 200 operations for each closed face within 1½ cells of a wall.
template <class Real>
void mirror_in_solids(const Domain<Real>& domain, Vec2<Real> fall, Work work = {});

}  // namespace weir
