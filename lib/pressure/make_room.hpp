// Asks the pressure for room: what bodies have pressed together does.
#pragma once

#include "base/work.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// Share of what a patch has too much that it gives up in a substep, if all around yields: 0.3 % of
/// its volume at most, which no particle feels as a blow.
template <class Real>
inline constexpr Real kRoomGain = Real(0.03);
/// The same around a body that was put into the liquid, which takes a second for it and no longer.
template <class Real>
inline constexpr Real kRoomGainAround = Real(0.1);

/// What may be asked for in a substep is so much in one in which gravity moves something by 1/8192
/// of a cell, or in a 64th of a second if that is shorter; in a shorter one in proportion. The same
/// volume in ever less time would fling the liquid.
template <class Real>
inline Real pace_of_room(const PressureFields<Real>& fields) {
    const Real fallen = square_root(fields.last_dt * fields.cell_weight);
    return minimum(Real(1), Real(64) * maximum(fallen, static_cast<Real>(fields.last_dt)));
}

/// The equation of a cell with liquid wants so much to flow out of it, cells/s.
template <class Real>
inline void ask_for_outflow(std::int32_t c, Real outflow, PressureFields<Real>& fields) {
    fields.divergence[c] = Real(fields.divergence[c]) - outflow;
    fields.solve.wanted = fields.solve.wanted + product(Real(fields.pressure[c]), outflow);
}

/// The drift moves particles, not bodies: liquid that a crowd of them covers cannot rise by it, and
/// is pressed together by their weight until they lie on each other; nor does it soon lift what a
/// body that was put into a pool pressed together. So each patch of 4 × 4 cells that is too full
/// asks for an outflow, which lifts both; the less the more pressure it has.
/// Between the equations and their solve. Without gravity nothing is asked for.
template <class Real>
void make_room(const GridShape& s, Real gain, Work work, PressureFields<Real>& fields);

/// From now on it can be asked for without solids, too: who has no bodies nor adds liquid links
/// nothing of it.
template <class Real>
inline void link_make_room([[maybe_unused]] PressureFields<Real>& fields) {
    if constexpr (kHasInlets<Real>) {
        fields.inlets.make_room_around = make_room<Real>;
    }
}

}  // namespace weir
