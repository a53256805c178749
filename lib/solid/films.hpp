// Films of liquid under free bodies that lie on something that is not free, and between those and
// free ones that touch them: a cell shows nothing of so narrow a gap, or counts as air.
//
// A body is closed: what cells press on from above and from below is the same, in whichever
// direction. What is missing below, where it lies, has the pressure of the next cells of liquid on
// both sides, and draws from them what the body's motion makes room for. So a body that the
// contour does not show has no film, and none is lifted by cells and film alike.
#pragma once

#include "solid/obstacles.hpp"

namespace weir {

/// So many cells liquid is looked for beside a body at most.
inline constexpr std::int32_t kLooksUnder = 16;

/// To the points that were found, once a substep. Wants to know where liquid is.
template <class Real>
void lay_films(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells);

/// What the films' pressure does to a free body, per impulse that it already has of the cells.
template <class Real>
Impulse<Real> film_impulse(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                           std::uint16_t slot);

}  // namespace weir
