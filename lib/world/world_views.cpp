// Views of the grid, for whoever looks.
#include "step/regions.hpp"
#include "step/scatter.hpp"
#include "step/substep.hpp"
#include "weir/world.hpp"
#include "world/find_levels.hpp"
#include "world/world_state.hpp"

namespace weir {

namespace {

template <class Number>
FieldView<Number> view_of(const Number* field, const GridShape& window) {
    return {field + window.index(0, 0), window.nx, window.ny, window.stride, window.i0, window.j0};
}

/// What is looked at between steps also shows those who sleep.
template <class Real>
void show_asleep(detail::WorldState<Real>& state) {
    Simulation<Real>& simulation = state.simulation;
    if (simulation.regions != nullptr && !state.stepping) {
        simulation.regions->stages->show_fields(simulation);
    }
}

/// Mass of the particles that stand where cells are stored.
template <class Real>
void scatter_stored(const Particles<Real>& particles, const Borders<Real>& borders,
                    StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    clear_rows(s, {0, s.ny + 2}, grid.mass_u);
    clear_rows(s, {0, s.ny + 2}, grid.mass_v);
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<Real> x = particles.position[k];
        const std::int32_t i = static_cast<std::int32_t>(x.x) - s.i0;
        const std::int32_t j = static_cast<std::int32_t>(x.y) - s.j0;
        if (i >= 0 && i < s.nx && j >= 0 && j < s.ny) {
            scatter(grid.mass_u, grid.momentum_u(), s.stride, stencil_u(s, x), Real(0));
            scatter(grid.mass_v, grid.momentum_v(), s.stride, stencil_v(s, x), Real(0));
        }
    }
    fold_counts(borders, s, grid.mass_u, grid.mass_v);
}

/// Who looks after a restore, or after particles came or went, and before the next substep finds
/// densities, finds them here. No substep reads what it writes.
template <class Real>
void find_density(Simulation<Real>& simulation) {
    simulation.grid.shape = simulation.occupied = stored_part(simulation);
    if (simulation.window.cells > 0) {
        if constexpr (kHasWindow<Real>) {
            scatter_stored(simulation.particles, simulation.settings.borders, simulation.grid);
        }
    } else {
        scatter_all(simulation);
    }
    find_levels(simulation);
    simulation.grid.shape = simulation.layers.shape;
    if (simulation.regions != nullptr) {
        simulation.regions->stale = true;
    }
}

}  // namespace

template <class Real>
FieldView<Real> World<Real>::pressure() const {
    if (state_ == nullptr) {
        return {};
    }
    show_asleep(*state_);
    return view_of(state_->simulation.pressure.pressure, stored_part(state_->simulation));
}

template <class Real>
FieldView<DensityOf<Real>> World<Real>::density() const {
    if (state_ == nullptr) {
        return {};
    }
    if (state_->density_stale && !state_->stepping) {
        find_density(state_->simulation);
        state_->density_stale = false;
    }
    show_asleep(*state_);
    return view_of(state_->simulation.pressure.density, stored_part(state_->simulation));
}

template <class Real>
float World<Real>::pressure_scale() const {
    if (state_ == nullptr || !(state_->simulation.pressure.last_dt > Seconds<Real>{})) {
        return 0.0F;
    }
    const float scale = velocity_scale();
    return scale * scale / static_cast<float>(state_->simulation.pressure.last_dt);
}

template <class Real>
float World<Real>::velocity_scale() const {
    return state_ == nullptr ? 0.0F : state_->def.cell_m * units_per_s(*state_);
}

template <class Real>
FieldView<DistanceOf<Real>> World<Real>::signed_distance() const {
    if (state_ == nullptr || state_->def.capacity.bodies == 0) {
        return {};
    }
    const GridShape s = stored_part(state_->simulation);
    return {state_->simulation.layers.walls.distance + s.index(0, 0), s.nx + 1, s.ny + 1, s.stride,
            s.i0, s.j0};
}

template <class Real>
View<Contact> World<Real>::contacts() const {
    if (state_ == nullptr || state_->stepping) {  // they are sums until `finish`
        return {};
    }
    return {state_->simulation.contacts.entry, state_->simulation.contacts.used};
}

#define WEIR_INSTANTIATE(Real)                                                 \
    template FieldView<Real> World<Real>::pressure() const;                    \
    template FieldView<DensityOf<Real>> World<Real>::density() const;          \
    template float World<Real>::pressure_scale() const;                        \
    template float World<Real>::velocity_scale() const;                        \
    template FieldView<DistanceOf<Real>> World<Real>::signed_distance() const; \
    template View<Contact> World<Real>::contacts() const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
