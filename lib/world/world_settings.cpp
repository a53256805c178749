// What the definition said of the liquid and of the tank's walls, said anew: a world is planned
// from its settings step by step, so nothing else has to be told. What a definition does without is
// not linked, and stays away.
#include "world/settings_of.hpp"
#include "world/sleep.hpp"

namespace weir {

template <class Real>
Status World<Real>::set_viscosity(float viscosity_m2ps) {
    Status valid = ready(state_);
    if (valid == Status::ok) {
        valid = check_viscosity(viscosity_m2ps, state_->def.cell_m);
    }
    if (valid != Status::ok) {
        return valid;
    }
    Simulation<Real>& simulation = state_->simulation;
    if (viscosity_m2ps > 0.0F && simulation.viscosity == nullptr) {
        return Status::viscosity_missing;
    }
    const Real viscosity = viscosity_of(*state_, viscosity_m2ps);
    Settings<Real>& settings = simulation.settings;
    if (viscosity != settings.viscosity) {
        settings.viscosity = viscosity;
        settings.borders.viscous = viscosity > Real(0);
        wake_all(*state_);
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::set_surface_tension(float tension_m3ps2) {
    Status valid = ready(state_);
    if (valid == Status::ok) {
        const WorldDef& def = state_->def;
        valid = check_surface_tension(tension_m3ps2, def.pressure, def.cell_m,
                                      reach_of<Real>(state_->unit_exponent));
    }
    if (valid != Status::ok) {
        return valid;
    }
    Simulation<Real>& simulation = state_->simulation;
    if (tension_m3ps2 > 0.0F && simulation.tension == nullptr) {
        return Status::surface_tension_missing;
    }
    const Real tension = surface_tension_of(*state_, tension_m3ps2);
    if (tension != simulation.settings.surface_tension) {
        simulation.settings.surface_tension = tension;
        simulation.pressure.on_surface = kNoTension;  // a substep with some says which
        wake_all(*state_);
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::set_walls(const TankWalls& walls) {
    Status valid = ready(state_);
    if (valid == Status::ok) {
        valid = check_walls(walls, state_->def.cell_m, reach_of<Real>(state_->unit_exponent));
    }
    if (valid != Status::ok) {
        return valid;
    }
    Simulation<Real>& simulation = state_->simulation;
    Borders<Real>& now = simulation.settings.borders;
    Borders<Real> next;
    set_laws(walls, pace_of(*state_), next);
    const auto change = [&](const SurfaceLaw<Real>& to, SurfaceLaw<Real>& law,
                            const NodeBox& along) {
        if (!alike(to, law)) {
            law = to;
            touch_regions(simulation.regions, along);
            wake(*state_);
        }
    };
    const std::int32_t nx = simulation.layers.shape.nx;
    const std::int32_t ny = simulation.layers.shape.ny;
    change(next.bottom, now.bottom, {0, 0, nx, 0});
    change(next.right, now.right, {nx, 0, nx, ny});
    change(next.top, now.top, {0, ny, nx, ny});
    change(next.left, now.left, {0, 0, 0, ny});
    return Status::ok;
}

#define WEIR_INSTANTIATE(Real)                                   \
    template Status World<Real>::set_viscosity(float);           \
    template Status World<Real>::set_surface_tension(float);     \
    template Status World<Real>::set_walls(const TankWalls&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
