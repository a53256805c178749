// From metres and seconds to the cells and steps of the paper's method.
//
// The method counts in cells and steps: one step is one unit of time, and a pressure
// p = stiffness (density / rest - 1) on particles of mass 1 gives a sound speed of
// sqrt(stiffness) cells per step. An explicit step must not let sound run past a cell, so the
// step's length follows from two choices:
//   * sound_ratio: sound speed over sqrt(g * depth). The liquid's density varies by about
//     1 / sound_ratio²: 10 is the usual choice for a nearly incompressible liquid (Monaghan 1994,
//     J. Comput. Phys. 110:399: c0 = 10 v_max); at 3 the liquid gives by about a tenth.
//   * cfl: sound's way in a step, cells; 0.3 ... 0.5. (A dam break onto turning polygons kept its
//     energy at 0.5; it had up to twice of it at 0.8 and up to nine times at 1.)
// Then dt = cfl cell / c, stiffness = cfl², gravity = g dt² / cell.
#pragma once

#include "paper_fluid.hpp"

namespace paper {

struct Scaling {
    float cell_m = 0.01F;
    float gravity_mps2 = 9.81F;  ///< magnitude, > 0
    float depth_m = 0.5F;        ///< height of the liquid at the start, > 0
    float sound_ratio = 10.0F;
    float cfl = 0.5F;

    float sound_speed_mps() const;
    float seconds_per_step() const;
    /// Writes gravity (downward), stiffness and the viscosities, which damp sound: they scale
    /// with the sound speed, so that a wave loses as much per cell it runs, whatever the step.
    void apply(FluidConfig& config) const;
};

/// Share of (sound speed × cell) used as shear and as bulk viscosity. Programs of this family use
/// 0.02 and up to 1 at a sound speed of one cell per step; 0.2 is enough to keep sound down.
inline constexpr float kShearShare = 0.02F;
inline constexpr float kBulkShare = 0.2F;

}  // namespace paper
