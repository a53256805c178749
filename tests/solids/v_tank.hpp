// Liquid in a 90 degree V, upright or with the whole scene turned by 17.3 degrees.
#pragma once

#include <cmath>

#include "vessel.hpp"

namespace solids {

inline constexpr double kTilt = 17.3 * M_PI / 180.0;

/// Apex, and what is inside.
struct Wedge {
    Vessel vessel;
    Vec apex;
    double depth;
};

Wedge v_tank(int depth, double tilt, Vec shift);

/// What is rounded in the lattice and the contour depends on where they stand in their cells: each
/// figure is the mean of some starts, shifted by parts of a cell.
Vec shift_of(int start);

}  // namespace solids
