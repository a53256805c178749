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

/// After the pressure: its impulse on all bodies, and the velocity that free ones get of it.
template <class Real>
void press_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report);

/// Free bodies go on, before the particles do, which meet them where they then are.
template <class Real>
void move_free_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report);

/// The account of momentum within a substep: from its begin until the particles met the solids.
template <class Real>
struct Account {
    Vec2<Face<Real>> expected;  ///< momentum of liquid and bodies if there were no tank, cells³/s
};
template <class Real>
Account<Real> open_account(const Simulation<Real>& simulation, Seconds<Real> dt_s);

/// What the liquid lost, beyond what gravity gave and the bodies received, went to the tank: the
/// frame in which everything else holds still. It includes what the method itself does to
/// momentum: particles are unevenly dense, the pressure takes them to be even.
template <class Real>
void close_account(const Account<Real>& account, Simulation<Real>& simulation);

}  // namespace weir
