// What bodies and tank receive, balanced with what the liquid loses (`Capacity::two_way`).
#pragma once

#include "step/simulation.hpp"

namespace weir {

/// Packed worlds do without: they have no free bodies, and boards for them little room for code.
template <class Real>
inline constexpr bool kHasLedger = !Stored<Real>::shares_momentum;

/// At a substep's top: the liquid's momentum and what all have received so far.
template <class Real>
void open_ledger(Simulation<Real>& simulation, Work work);

/// At its end: what gravity gave, less what the liquid's momentum changed by and what was counted
/// where it was exchanged, is what the method itself does to momentum. The tank and the bodies
/// that move as told get it, each by the share of what it received in this step; it acts on their
/// centres of mass. Free bodies have what moved them. Where nobody received any it is nobody's.
/// Cost: all particles are read twice.
template <class Real>
void close_ledger(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work);

}  // namespace weir
