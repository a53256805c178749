// What a definition says of the liquid and of the tank's walls, in cells and the world's unit of
// time. Calls may say it anew (world_settings.cpp).
#pragma once

#include "world/world_state.hpp"

namespace weir {

template <class Real>
Real viscosity_of(const detail::WorldState<Real>& state, float viscosity_m2ps) {
    return static_cast<Real>(state.cells_per_m * pace_of(state) *
                             static_cast<Face<Real>>(viscosity_m2ps));
}

template <class Real>
Real surface_tension_of(const detail::WorldState<Real>& state, float tension_m3ps2) {
    const Face<Real> pace = pace_of(state);
    return static_cast<Real>(state.cells_per_m * pace * pace *
                             static_cast<Face<Real>>(tension_m3ps2));
}

template <class Real>
void set_laws(const TankWalls& walls, Face<Real> pace, Borders<Real>& borders) {
    const auto set = [pace](SurfaceLaw<Real>& law, const Surface& surface) {
        law = surface_law<Real>(surface, pace);
    };
    set(borders.bottom, walls.bottom);
    set(borders.right, walls.right);
    set(borders.top, walls.top);
    set(borders.left, walls.left);
}

}  // namespace weir
