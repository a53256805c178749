// What a substep needs to know, in cells and seconds.
#pragma once

#include "grid/borders.hpp"

namespace weir {

template <class Real>
struct Settings {
    Vec2<Real> gravity;          ///< cells/s²
    Real rest_count = Real(4);   ///< particles per full cell
    Real flip_ratio = Real(0.97);
    Real volume_gain = Real(0.25);
    Real sound_speed = Real(0);  ///< cells/s; equation of state
    Real viscosity = Real(0);    ///< kinematic, cells²/s
    Real surface_tension = Real(0);  ///< over density, cells³/s²
    Real second_density = Real(1);   ///< of the second liquid over the first's
    Borders<Real> borders;
    Real cfl = Real(1);          ///< cells per substep
    std::int16_t sweeps = 6;
    std::int16_t max_substeps = 16;

    /// Whether nothing pulls at the liquid, neither as a whole nor at its surface.
    bool is_weightless() const {
        return gravity.x == Real(0) && gravity.y == Real(0) && surface_tension == Real(0);
    }
    /// What gravity makes of a velocity in so long.
    Vec2<Real> fall_in(Seconds<Real> dt_s) const { return dt_s * gravity; }
    /// Whether liquid is as deep as its rows are long. Where these have no end nothing is deep.
    bool pulls_sideways() const {
        return absolute(gravity.x) > absolute(gravity.y) && !borders.wrap_x;
    }
    /// By how much a step of so long presses more from a cell to the next, along the stronger axis.
    Real cell_weight(Seconds<Real> dt_s) const {
        return dt_s * larger_part(gravity);
    }
};

}  // namespace weir
