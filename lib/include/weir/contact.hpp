// Contact events: what met which bodies within a step, how hard and where.
#pragma once

#include <cstdint>

#include "weir/types.hpp"

namespace weir {

enum class ContactWith : std::uint8_t {
    liquid,  ///< its particles; any kind of body
    body,    ///< a free body with another one, of any kind
    tank,    ///< a free body with the tank's walls
};

/// All blows on one body within a step, of one that it met. Pressure is no blow: liquid at rest on
/// a body presses on it, and its particles touch it now and then with next to no impulse. What lies
/// on something meets it in each step, with the impulse that carries it: of a mass m (`BodyMass`)
/// about m·g·dt, a fall of height h √(2 g h) m, in the step in which it lands and the next one.
struct Contact {
    BodyId body;
    BodyId other;                ///< the body that it met, or none (`BodyId{}`)
    ContactWith with = ContactWith::liquid;
    /// A particle can hit once in each substep; bodies meet at some points, which count each.
    std::int32_t blows = 0;
    /// That the body received, over the first liquid's density and the depth of the tank: times
    /// kg/m³ and m it is N·s. A free `other` received the opposite.
    Vec2f impulse_m3ps;
    Vec2f place_m;               ///< mean of the blows' places, in the tank
};

}  // namespace weir
