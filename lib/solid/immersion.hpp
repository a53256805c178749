// What of a free body the grid does not show, and how the liquid lifts that.
//
// The contour cuts corners, and shows nothing of what is much thinner than a cell: a square of one
// cell displaces a quarter of what it should, and sank at half the liquid's density. What is
// missing is lifted as Archimedes has it, and takes its own mass of liquid along (added mass), so
// that no density is too low.
#pragma once

#include "solid/body_force.hpp"
#include "solid/obstacles.hpp"

namespace weir {

/// After the pressure: finds `load.ease` for the next substep, and adds to the body's twist what
/// liquid around the missing part does to it now: it turns the body as that lies in it, and takes
/// it along.
/// Cost: a look at each cell of the body's rectangle, and at each cell's length of its outline.
template <class Real>
void immerse(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells, std::uint16_t slot,
             Twist<Real>& twist);

}  // namespace weir
