// What stops free bodies: the tank's walls.
#pragma once

#include "grid/borders.hpp"
#include "solid/body_load.hpp"

namespace weir {

template <class Real>
struct Obstacles {
    const GridShape& tank;
    const Borders<Real>& borders;
    const BodyTable<Real>& bodies;
    Face<Real> dt;
    Face<Real> slow;  ///< what approaches no faster than this comes to rest, cells/s
};

/// Whether any of its points may be at the tank's walls.
template <class Real>
bool near_walls(const GridShape& s, const Body<Real>& body) {
    const Real r = body.radius + Real(1);
    return body.position.x < r || body.position.y < r ||
           body.position.x + r > static_cast<Real>(s.nx) ||
           body.position.y + r > static_cast<Real>(s.ny);
}

/// Nothing stops the body.
template <class Real>
void release(BodyLoad<Real>& load) {
    load.yield = Yield<Real>{};
    load.yield.xx = load.yield.yy = load.inverse_mass;
    load.yield.turn = load.inverse_inertia;
    load.stopped = Twist<Real>{};
}

/// Before the pressure: throws a body back that hits an obstacle with restitution, and stops one
/// that does not sink. Changes `load.unpressed`.
template <class Real>
void throw_back(const Obstacles<Real>& obstacles, std::uint16_t slot);

/// Adds to `load.change` what lets no point come nearer to an obstacle than the obstacle is, and
/// takes the directions in which that had to be done out of `load.yield`: within the pressure
/// solve the body goes on as fast along them as it then does. What leads away from an obstacle is
/// free; what was held already stays so. Of bodies that sink.
template <class Real>
void stop(const Obstacles<Real>& obstacles, std::uint16_t slot);

}  // namespace weir
