// Stage: pressure, before the solve, only with surface tension. Reads density and level; writes
// the pressure on the surface into air cells.
#pragma once

#include "pressure/domain.hpp"
#include "weir/features.hpp"

namespace weir {

/// p = σ κ on the surface (Young 1805, Laplace 1806): the value that the projection takes there
/// (Gibou, Fedkiw, Cheng & Kang 2002). `amount` = dt · σ/ρ, cells³/s. κ = ∇ · n with
/// n = −∇f/|∇f|, f the density smoothed once by (¼ ½ ¼)², taken at the liquid's and the air
/// cell's centre and interpolated to where the level is zero; an air cell holds the mean over its
/// liquid neighbours, others 0. Walls and solids mirror the density: contact at a right angle.
/// The fields' divergence and inverse diagonal are used as scratch.
/// Order: by row. Cost: 8 operations a cell, 100 more beside walls, and 2 to 5 curvatures of 55 for
/// each air cell beside the liquid.
template <class Real>
void surface_tension(const Domain<Real>& domain, Real amount, Work work = {});

template <class Real>
struct detail::Tension {
    void (*stage)(const Domain<Real>& domain, Real amount, Work work);
};

}  // namespace weir
