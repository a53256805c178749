#include "step/rest_on_solids.hpp"

namespace weir {

namespace {

/// Whether a particle is about to meet a solid, or has just met one.
template <class Real>
bool lies_on_solid(const Simulation<Real>& simulation, Vec2<Real> place, Vec2<Real> velocity,
                   Real speed) {
    const GridShape& tank = simulation.layers.shape;
    const auto ahead = [&](Real along) {
        const Real way = absolute(along) > speed ? Real(0.125) : Real(0);
        return along > Real(0) ? way : Real(0) - way;
    };
    const auto in_solid_cell = [&](Vec2<Real> x) {
        return touches_wall(simulation.layers.walls, tank.index(static_cast<std::int32_t>(x.x),
                                                                static_cast<std::int32_t>(x.y)));
    };
    const Vec2<Real> next{place.x + ahead(velocity.x), place.y + ahead(velocity.y)};
    return in_solid_cell(place) || in_solid_cell(within_tank(tank, next));
}

}  // namespace

template <class Real>
bool rest_on_solids(const Simulation<Real>& simulation, Real speed, std::uint32_t& looks) {
    const Real fallen = simulation.pressure.cell_weight;
    if (simulation.bodies.used == 0 || simulation.window.cells > 0 ||
        simulation.max_speed > speed + fallen) {
        return false;
    }
    const Particles<Real>& particles = simulation.particles;
    looks += static_cast<std::uint32_t>(particles.count);
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<Real> v(particles.velocity[k]);
        if ((absolute(v.x) > speed || absolute(v.y) > speed) &&
            !lies_on_solid(simulation, Vec2<Real>(particles.position[k]), v, speed)) {
            return false;
        }
    }
    return true;
}

#define WEIR_INSTANTIATE(Real) \
    template bool rest_on_solids(const Simulation<Real>&, Real, std::uint32_t&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
