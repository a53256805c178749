// What liquid does to bodies and to the tank, and what bodies weigh.
#pragma once

#include "weir/types.hpp"

namespace weir {

/// Impulse over the last step, by pressure and by particles that hit. Over the first liquid's
/// density and the depth of the tank: times kg/m³ and m it is N·s; divided by `dt_s`, a force.
/// What hits a free body at a step's very end moves it with the next step, and so does what it gets
/// without gravity for sums to be right.
struct BodyForce {
    Vec2f impulse_m3ps;
    /// About the body's centre of mass, counter-clockwise. 0 for the tank.
    float angular_impulse_m4ps = 0.0F;
    float dt_s = 0.0F;  ///< time that the last step simulated
};

/// Of the whole polygon, holes left out, evenly filled; for static bodies and those that move as
/// told too, at their density_ratio. Over the first liquid's density and the depth of the tank:
/// times kg/m³ and m it is kg, and kg·m².
struct BodyMass {
    float mass_m2 = 0.0F;
    float inertia_m4 = 0.0F;  ///< about the centre of mass
    Vec2f centre_m;           ///< of mass, in the body's own frame
};

}  // namespace weir
