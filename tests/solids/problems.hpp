// The problems: one function each, called from the table in main.cpp. Names follow the reference
// problems (R1 … R14) where there is one.
#pragma once

#include <initializer_list>

#include "measure/report.hpp"
#include "scalar.hpp"

namespace solids {

using measure::Report;

struct Effort {
    bool full = false;  ///< long runs and large counts; else all problems take a few minutes
    Scalar real = Scalar::single_precision;
};

/// run(zero of the arithmetic, cells) at each of the resolutions; beyond 32 cells if all is run.
template <class Run>
void at_resolutions(Report& report, const Effort& effort, std::initializer_list<int> resolutions,
                    Run run) {
    for (const int cells : resolutions) {
        if (cells <= 32 || effort.full) {
            in_scalar(report, effort.real, [&](auto zero) { run(zero, cells); });
        }
    }
}

// Contours.
void one_particle(Report& report, const Effort& effort);     // R1
void coverage(Report& report, const Effort& effort);         // R2
void contour_normals(Report& report, const Effort& effort);  // R3

// Polygons.
void real_geometry(Report& report, const Effort& effort);

// Tightness.
void torture(Report& report, const Effort& effort);
void thin_walls(Report& report, const Effort& effort);

// Moving bodies.
void couette(Report& report, const Effort& effort);       // R10
void floating_box(Report& report, const Effort& effort);  // R12
void jet_on_plate(Report& report, const Effort& effort);  // R13a
void piston(Report& report, const Effort& effort);
void third_law(Report& report, const Effort& effort);

// Still water.
void still_water(Report& report, const Effort& effort);  // R4c
void sloshing(Report& report, const Effort& effort);     // R6b
void formats(Report& report, const Effort& effort);      // R6b in all arithmetics
void buoyancy(Report& report, const Effort& effort);     // R4d
void vessels_soak(Report& report, const Effort& effort);  // R14 ii-iv

// Cost.
void cost_of_solids(Report& report, const Effort& effort);

}  // namespace solids
