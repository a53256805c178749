// Films of liquid under faces of free bodies that lie on something that is not free: a cell shows
// nothing of so narrow a gap, or counts as air.
//
// From each end of such a face inwards, as far as cells beneath hold liquid, their pressure lifts
// the body as any. What is left to the middle has the pressure of the last of these cells, or of
// the one before the end, and draws from it what the body's motion makes room for.
#pragma once

#include "solid/obstacles.hpp"

namespace weir {

/// A face is followed so many cells far at most.
inline constexpr std::int32_t kLooksUnder = 16;

/// To the points that were found, once a substep. Wants to know where liquid is.
template <class Real>
void lay_films(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells);

/// What the films' pressure does to a free body, per impulse that it already has of the cells.
template <class Real>
Impulse<Real> film_impulse(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                           std::uint16_t slot);

}  // namespace weir
