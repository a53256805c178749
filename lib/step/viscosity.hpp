// Stage: grid update, only if there is viscosity. Reads velocities and levels; writes velocities.
#pragma once

#include "pressure/domain.hpp"
#include "weir/features.hpp"

namespace weir {

/// Newtonian shear viscosity, explicit: u += ν dt ∇·(∇u + (∇u)ᵀ) on faces that hold liquid, beside
/// walls that it sticks to and thin ones ν dt ∇²u; a face without liquid, or closed by a solid,
/// exerts no stress, one that is less than half full or open in part as much as it holds, or less:
/// momentum is kept and kinetic energy falls, in spray and in gaps, too.
/// Stable while ν dt ≤ ¼ cell², which the plan of substeps keeps. `amount` = ν dt, cells².
/// `fall`: what gravity has given, which the pressure has not held yet: walls of the tank without
/// slip pull by what is slower or faster than that. What they pull, `tank` receives; null: nobody
/// wants to know.
/// The fields' divergence and inverse diagonal are used as scratch, ghosts of the density mirrored.
/// Order: none (reads only the velocities before). Cost: about 30 operations a face.
template <class Real>
struct detail::Viscosity {
    void (*diffuse)(const Domain<Real>& domain, Real amount, Vec2<Real> fall,
                    Impulse<Real>* tank, Work work);
    const StickingWalls<Real>* sticking;  ///< null where there is no room for bodies
};

}  // namespace weir
