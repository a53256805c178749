// Diagnostics: sums over particles, and one scatter for what only the grid can tell. The grid's
// arrays are free between steps but for what views show, so looking changes nothing.
#include "step/grid_update.hpp"
#include "step/regions.hpp"
#include "step/window.hpp"
#include "world/find_levels.hpp"
#include "world/world_state.hpp"

namespace weir {

namespace {

template <class Real>
void sum_particles(const Simulation<Real>& simulation, double cell_m, double per_s,
                   Diagnostics& out) {
    const Particles<Real>& particles = simulation.particles;
    const double share = cell_m * cell_m / static_cast<double>(simulation.settings.rest_count);
    const Vec2<double> gravity = (per_s * per_s) * convert<double>(simulation.settings.gravity);
    const double half_dt = 0.5 / per_s * static_cast<double>(simulation.pressure.last_dt);
    double square = 0.0;
    double fall = 0.0;
    double turn = 0.0;
    double count = 0.0;
    Vec2<double> momentum;
    const double second = static_cast<double>(simulation.settings.second_density);
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<double> x = convert<double>(particles.position[k]);
        const Vec2<double> v = per_s * convert<double>(particles.velocity[k]);
        const bool heavy = particles.kind != nullptr && particles.kind[k] == Liquid::second;
        const double weight = heavy ? second : 1.0;
        count += weight;
        momentum = momentum + weight * v;
        square += weight * dot(v, v);
        turn += weight * cross(x, v);
        fall += weight * dot(gravity, x - half_dt * v);
    }
    out.mass_m2 = share * count;
    out.momentum_m3ps = (share * cell_m) * momentum;
    out.angular_momentum_m4ps = share * cell_m * cell_m * turn;
    out.kinetic_energy_m4ps2 = 0.5 * share * cell_m * cell_m * square;
    out.potential_energy_m4ps2 = -(share * cell_m * cell_m * fall);
}

template <class Real>
void sum_volume(const Simulation<Real>& simulation, double cell_m, Diagnostics& out) {
    const PressureFields<Real>& fields = simulation.pressure;
    const Walls<Real>& walls = simulation.layers.walls;
    const GridShape& s = simulation.grid.shape;
    double filled = 0.0;
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            const double density = static_cast<double>(fields.density[c]);
            const double room = walls.active ? static_cast<double>(walls.full_density[c]) : 1.0;
            filled += room * minimum(density, 1.0);
            out.largest_density = maximum(out.largest_density, density);
        }
    }
    out.volume_m2 = filled * cell_m * cell_m;
}

template <class Real>
double largest_outflow(const Simulation<Real>& simulation) {
    const StaggeredGrid<Real>& grid = simulation.grid;
    const GridShape& s = grid.shape;
    double largest = 0.0;
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            if (simulation.pressure.level[c] > Real(0)) {
                const Real outflow = (grid.u[c + 1] - grid.u[c]) +
                                     (grid.v[c + s.stride] - grid.v[c]);
                largest = maximum(largest, static_cast<double>(absolute(outflow)));
            }
        }
    }
    return largest;
}

/// Sums over the part of the grid that is worked on. `density()` goes on to show those of the last
/// substep: these ones stand in the pressure's scratch, which in packed worlds is a half of the
/// momentum, and that is then found anew.
template <class Real>
void sum_cells(Simulation<Real>& simulation, double cell_m, double per_s, Diagnostics& out) {
    static_assert(sizeof(DensityOf<Real>) <= sizeof(VelocityOf<Real>), "there is room");
    PressureFields<Real>& fields = simulation.pressure;
    scatter_all(simulation);
    DensityOf<Real>* const shown = fields.density;
    fields.density = reinterpret_cast<DensityOf<Real>*>(fields.divergence);
    find_levels(simulation);
    sum_volume(simulation, cell_m, out);
    fields.density = shown;
    if constexpr (Stored<Real>::shares_momentum) {
        scatter_all(simulation);
    }
    grid_update(domain_of(simulation), Vec2<Real>{});
    out.divergence_per_s = per_s * largest_outflow(simulation);
}

}  // namespace

template <class Real>
Status World<Real>::diagnose(Diagnostics* diagnostics) {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    if (diagnostics == nullptr) {
        return Status::output_missing;
    }
    Simulation<Real>& simulation = state_->simulation;
    const double cell_m = static_cast<double>(state_->def.cell_m);
    *diagnostics = {};
    const auto per_s = static_cast<double>(units_per_s(*state_));
    sum_particles(simulation, cell_m, per_s, *diagnostics);
    simulation.stages->draw_moved(simulation.layers, simulation.bodies);
    if (simulation.stages->note_moving != nullptr) {
        simulation.stages->note_moving(simulation.bodies, simulation.layers.walls);
    }
    if constexpr (kHasWindow<Real>) {
        if (simulation.window.cells > 0 && !look_around(simulation, !state_->density_stale)) {
            return Status::ok;
        }
    }
    sum_cells(simulation, cell_m, per_s, *diagnostics);
    simulation.grid.shape = simulation.layers.shape;
    if (simulation.regions != nullptr) {  // what sleeps was written, too: no substep may see it
        simulation.occupied = simulation.layers.shape;
    }
    return Status::ok;
}

#define WEIR_INSTANTIATE(Real) \
    template Status World<Real>::diagnose(Diagnostics*);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
