// Stage: volume. Reads density; adds a displacement to the velocity that particles move along.
#pragma once

#include "pressure/domain.hpp"

namespace weir {

/// Particles drift apart where they are too dense and together where they are too thin: positions
/// move by −`gain_per_s` dt ∇density, velocities stay, so no kinetic energy enters. Without it a
/// liquid that has splashed loses a third of its volume. Local: each face looks at its two cells.
/// What the drift lifts, which falls again, costs its patch of 4 × 4 cells velocity; what hangs is
/// not lifted. Without gravity neither is looked at.
/// `divergence` is used as scratch. Called after blend_change: only the advecting velocity sees
/// the drift, and only the change that particles gather the price.
/// `overfull`: liquid cells in patches of 4 × 4 that hold far more than they have room for, which
/// no drift cures; 0 with surface tension.
/// `fall`: what gravity gives in the substep, cells/s.
/// Without `Solids`: a program that adds none links nothing of them.
template <bool Solids, class Real>
void volume_correction(const Domain<Real>& domain, Real gain_per_s, Vec2<Real> fall,
                       std::int32_t& overfull, Work work = {});

}  // namespace weir
