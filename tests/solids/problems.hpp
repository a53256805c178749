// The problems: one function each, called from the table in main.cpp. Names follow the reference
// problems (R1 … R14) where there is one.
#pragma once

#include "report.hpp"

namespace solids {

struct Effort {
    bool full = false;  ///< long runs and large counts; else all problems take a few minutes
};

// Contours.
void contour_normals(Report& report, const Effort& effort);  // R3

// Polygons.
void real_geometry(Report& report, const Effort& effort);

// Tightness.

// Moving bodies.

// Still water.
void still_water(Report& report, const Effort& effort);  // R4c
void sloshing(Report& report, const Effort& effort);     // R6b

// Cost.

}  // namespace solids
