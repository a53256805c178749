// Pressure, explicit: weakly compressible liquid, whose density answers to the flow.
#pragma once

#include "pressure/domain.hpp"
#include "weir/features.hpp"

namespace weir {

/// p = c² (ρ − 1), where ρ is not what particles show, a fifth of which is noise, but what
/// continuity makes of the flow: Dp/Dt = −c² ∇·u (artificial compressibility, Chorin 1967). What
/// the flow loses the pressure keeps, and gives back: no energy comes of it. Particles follow by
/// the volume correction. Liquid is not under tension: p ≥ 0.
///
/// Called once a substep, in this order; the projection sets up flow and diagonals in between, by
/// the velocity before the step, and accelerates by what `compress` leaves. Stable while
/// c dt ≤ 0.4 cells. Cost: some 30 operations a cell.

/// From now on sound has this speed, cells/s. Slower sound takes its share of the pressure along,
/// or what is stored would grow.
template <class Real>
void follow_sound(Real sound_speed, PressureFields<Real>& fields);

/// Moves the pressure with the liquid, upwind, one colour of the cells and then the other: left
/// behind, from a third of c on it shook what passed by. `weights`: of the velocity that it goes
/// with, the one before the step.
template <class Real>
void carry_pressure(const OpenWeights<Real>& weights, PressureFields<Real>& fields, Work work);

/// Advances it, and adds for this step a bulk viscosity of 3/8 c cells, which takes ringing out.
/// Surface cells, whose diagonal is large, and thin ones, which hold less, are as much softer. It
/// does not resist that liquid parts from a wall, where air can come in between.
template <class Real>
void compress(const Domain<Real>& domain, Work work);

/// When all have read the pressure: takes the viscosity out of it again.
template <class Real>
void release_pressure(const Domain<Real>& domain, Work work);

/// All of it: a program whose definition asks for no equation of state does not link this file.
template <class Real>
struct detail::Elasticity {
    void (*follow_sound)(Real sound_speed, PressureFields<Real>& fields);
    void (*carry_pressure)(const OpenWeights<Real>& weights, PressureFields<Real>& fields,
                           Work work);
    void (*compress)(const Domain<Real>& domain, Work work);
    void (*release_pressure)(const Domain<Real>& domain, Work work);
    /// The general loops, in packed worlds; in others, which have no others, null. What whole
    /// numbers make of faces at gaps, of jets and of spray takes it that pressure stores nothing.
    void (*push)(const Domain<Real>& domain, const Part& rows);
    void (*extrapolate)(const Domain<Real>& domain, bool velocity_itself, Work work);
};

}  // namespace weir
