// Contact events: which bodies particles hit within a step, how hard and where.
#pragma once

#include <cstdint>

#include "weir/types.hpp"

namespace weir {

/// All blows of particles on one body within a step. Pressure is no blow: liquid at rest on a body
/// presses on it, and its particles touch it now and then with next to no impulse.
struct Contact {
    BodyId body;
    std::int32_t particles = 0;  ///< blows; a particle can hit once in each substep
    /// That the body received, over the first liquid's density and the depth of the tank: times
    /// kg/m³ and m it is N·s.
    Vec2f impulse_m3ps;
    Vec2f place_m;               ///< mean of the blows' places, in the tank
};

}  // namespace weir
