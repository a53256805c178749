#include "step/two_way.hpp"

namespace weir {

namespace {

template <class Real>
struct LiquidMomentum {
    Face<Real> mass = Face<Real>(0);  ///< over the first liquid's density, cells²
    Vec2<Face<Real>> momentum;        ///< cells³/s
};

/// Sum over all particles, in groups so that rounding stays that of a group.
template <class Real>
LiquidMomentum<Real> momentum_of(const Simulation<Real>& simulation) {
    using Number = Face<Real>;
    constexpr std::int32_t kGroup = 128;
    const Particles<Real>& particles = simulation.particles;
    const Walls<Real>& walls = simulation.layers.walls;
    LiquidMomentum<Real> all;
    for (std::int32_t first = 0; first < particles.count; first += kGroup) {
        const std::int32_t end = minimum(first + kGroup, particles.count);
        LiquidMomentum<Real> group;
        for (std::int32_t k = first; k < end; ++k) {
            const bool second = particles.kind != nullptr && particles.kind[k] == Liquid::second;
            const Number mass = walls.particle_mass[second ? 1 : 0];
            group.mass += mass;
            group.momentum = group.momentum + mass * convert<Number>(particles.velocity[k]);
        }
        all.mass += group.mass;
        all.momentum = all.momentum + group.momentum;
    }
    return all;
}

template <class Real>
Vec2<Face<Real>> received_by_bodies(const BodyTable<Real>& table) {
    Vec2<Face<Real>> sum;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (table.body[slot].kind != BodyKind::free) {
            sum = sum + table.load[slot].received.linear;
        }
    }
    return sum;
}

template <class Real>
PressedCells<Real> pressed_cells(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    return {simulation.pressure.pressure, simulation.pressure.level,
            dt_s * simulation.settings.gravity};
}

}  // namespace

template <class Real>
void accelerate_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s) {
    locate_bodies(simulation.bodies);
    if (simulation.free_bodies != nullptr) {
        simulation.layers.walls.moving = true;
        simulation.free_bodies->accelerate(simulation.layers.shape, simulation.settings.borders,
                                           simulation.bodies, simulation.settings.gravity, dt_s);
    }
}

template <class Real>
CoupledSolve<Real> coupled_solve(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    const PressureFields<Real>& fields = simulation.pressure;
    const StaggeredGrid<Real>& grid = simulation.grid;
    return {simulation.free_bodies,
            grid.shape,
            simulation.layers.walls,
            grid.inverse_density_u,
            grid.inverse_density_v,
            pressed_cells(simulation, dt_s),
            fields.pressure,
            fields.divergence,
            fields.inverse_diagonal,
            simulation.body_diagonal};
}

template <class Real>
void press_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report) {
    press_on_bodies(simulation.grid.shape, simulation.layers.walls, simulation.bodies,
                    pressed_cells(simulation, dt_s));
    if (simulation.free_bodies != nullptr) {
        report.bodies_slowed += simulation.free_bodies->finish(simulation.bodies, dt_s);
    }
}

template <class Real>
void move_free_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report) {
    if (simulation.free_bodies == nullptr) {
        return;
    }
    simulation.free_bodies->move(simulation.layers.shape, simulation.bodies, dt_s);
    report.nodes_rasterized += merge_moving(simulation.layers, simulation.bodies);
    locate_bodies(simulation.bodies);
}

template <class Real>
Account<Real> open_account(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    const LiquidMomentum<Real> liquid = momentum_of(simulation);
    const Vec2<Face<Real>> fall =
        static_cast<Face<Real>>(dt_s) * convert<Face<Real>>(simulation.settings.gravity);
    return {(liquid.momentum + liquid.mass * fall) + received_by_bodies(simulation.bodies)};
}

template <class Real>
void close_account(const Account<Real>& account, Simulation<Real>& simulation) {
    BodyTable<Real>& table = simulation.bodies;
    Impulse<Real>& tank = table.load[table.capacity].received;
    const Vec2<Face<Real>> now = momentum_of(simulation).momentum + received_by_bodies(table);
    tank.linear = tank.linear + (account.expected - now);
}

#define WEIR_INSTANTIATE(Real)                                                                \
    template void accelerate_bodies(Simulation<Real>&, Seconds<Real>);                        \
    template CoupledSolve<Real> coupled_solve(const Simulation<Real>&, Seconds<Real>);        \
    template void press_bodies(Simulation<Real>&, Seconds<Real>, StepReport&);                \
    template void move_free_bodies(Simulation<Real>&, Seconds<Real>, StepReport&);            \
    template Account<Real> open_account(const Simulation<Real>&, Seconds<Real>);              \
    template void close_account(const Account<Real>&, Simulation<Real>&);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
WEIR_INSTANTIATE(Fixed)
WEIR_INSTANTIATE(SmallFixed)
#undef WEIR_INSTANTIATE

}  // namespace weir
