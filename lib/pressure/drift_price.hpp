// What a patch pays for its drift, and what of it the patch makes.
#pragma once

#include "pressure/drift_weights.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// Sum of squares of a patch's excess from which on it counts as stirred: 0.025 a cell. A lattice
/// that a wave passes has a tenth of that.
template <class Real>
inline constexpr Real kStirred = Real(0.01 * kOfDisorder<Real>);

/// What of a velocity's square along each axis is that of rising and falling, out of which patches
/// pay: currents, which no height can be taken from, go on.
/// @param fall what gravity gives, in any unit
template <class Real>
inline Vec2<Real> share_of_falling(Vec2<Real> fall) {
    const Real most = maximum(absolute(fall.x), absolute(fall.y));
    if (!(most > Real(0))) {
        return {};
    }
    const Real x = fall.x / most;
    const Real y = fall.y / most;
    const Real square = x * x + y * y;
    return {x * x / square, y * y / square};
}

/// What of a patch's velocity rises or falls over the most that it pays of it: impacts keep their
/// pressure.
template <class Real>
inline constexpr Real kMostPrice = Real(32);

/// The same of the most that comes back: what is at rest stays so. Drops, and what is compressible,
/// are stirred by less.
template <class Real>
inline Real most_refund(const PressureFields<Real>& fields) {
    return Real(fields.on_surface || fields.sound_speed > Real(0) ? 256 : 152);
}

/// From this sum of squares of its excess on a patch counts as torn: liquid that does not reach a
/// wall. Pools that come to rest have less.
template <class Real>
inline constexpr Real kTorn = Real(0.025 * kOfDisorder<Real>);

/// Which share of its drift a patch makes. What is torn is drawn up only as far as it can pay:
/// liquid that falls from a wall has nothing to pay from at first.
template <class Real>
inline Real share_of_drift(const Weights<Real>& sums, bool pressed) {
    const Real torn = clamp<Real>(in_turn(sums.disorder) - kTorn<Real>, Real(0), kStirred<Real>);
    const Real due = kMostPrice<Real> * (in_turn(sums.raised) * (torn / kStirred<Real>));
    const Real moving = in_turn(sums.moving);
    return !pressed && due > Real(0) ? moving / (moving + due) : Real(1);
}

/// Which share of its velocity a patch gives for what the drift lifts in it, and gets for what it
/// lets down. Liquid in order is not asked: what it does is reversed later.
template <class Real>
inline Ratio<Real> price_of(const Weights<Real>& sums, Real most_refund) {
    const Real disorder = minimum<Real>(in_turn(sums.disorder), kStirred<Real>);
    const Real work = in_turn(sums.raised) * (disorder / kStirred<Real>);
    const Real moving = in_turn(sums.moving);
    if (work > Real(0)) {
        return share_of(work, moving + kMostPrice<Real> * work);
    }
    return moving > -most_refund * work ? share_of(work, moving) : Ratio<Real>(0);
}

}  // namespace weir
