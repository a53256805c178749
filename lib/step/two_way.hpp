// Stages between liquid and bodies, in worlds with room for them (`Capacity::two_way`): what
// bodies and tank receive, and free bodies.
#pragma once

#include "step/simulation.hpp"

namespace weir {

/// Before the pressure: free bodies take up gravity and blows.
template <class Real>
void accelerate_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s);

/// The pressure solve, as free bodies share in it.
template <class Real>
CoupledSolve<Real> coupled_solve(const Simulation<Real>& simulation, Seconds<Real> dt_s);

/// After the pressure, where there are no bodies: its impulse on the tank.
template <class Real>
void press_tank(Simulation<Real>& simulation, Seconds<Real> dt_s);

/// After the pressure: its impulse on the tank and on all bodies, and the velocity that free
/// ones get of it.
template <class Real>
void press_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report);

/// Free bodies go on, before the particles do, which meet them where they then are.
template <class Real>
void move_free_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report);

}  // namespace weir
