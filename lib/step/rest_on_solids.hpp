// What lies on a solid falls onto it in every substep or two, and is stopped: that is no motion.
#pragma once

#include "step/simulation.hpp"

namespace weir {

/// Whether no particle is faster than that, cells per unit of time, or by no more than gravity adds
/// in one substep while it touches a solid. Adds the particles it has looked at to looks.
template <class Real>
bool rest_on_solids(const Simulation<Real>& simulation, Real speed, std::uint32_t& looks);

}  // namespace weir
