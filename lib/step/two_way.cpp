#include "step/two_way.hpp"

#include "geometry/convex_decomposition.hpp"
#include "geometry/moments.hpp"
#include "solid/moving_walls.hpp"
#include "step/momentum_ledger.hpp"

namespace weir {

namespace {

/// Pressure on the tank's walls: of the cells before them, and its way to the wall at rest.
template <class Real>
void press_on_tank(const Simulation<Real>& simulation, const PressedCells<Real>& cells,
                   Impulse<Real>& tank) {
    const GridShape& s = simulation.layers.shape;
    const GridShape& here = simulation.grid.shape;  // the part that liquid is in
    const Walls<Real>& walls = simulation.layers.walls;
    const Borders<Real>& b = simulation.settings.borders;
    const auto push = [&](std::int32_t c, std::int32_t face, const ShareOf<Real>* open,
                          Vec2<Real> outward) {
        if (cells.level[c] > Real(0)) {
            const Real way = dot(gradient_at_rest(s, walls, cells, c), outward);
            const Real more = Real(0.5) * way;
            const Real share = walls.active ? Real(open[face]) : Real(1);
            const Vec2<Real> force = (share * (cells.pressure[c] + more)) * outward;
            tank.linear = tank.linear + convert<Face<Real>>(force);
        }
    };
    for (std::int32_t j = 0; j < here.ny && !b.wrap_x; ++j) {
        const std::int32_t left = s.index(0, j);
        const std::int32_t right = s.index(s.nx - 1, j);
        push(left, left, walls.open_u, {Real(-1), Real(0)});
        if (here.nx == s.nx) {
            push(right, right + 1, walls.open_u, {Real(1), Real(0)});
        }
    }
    for (std::int32_t i = 0; i < here.nx && !b.wrap_y; ++i) {
        const std::int32_t bottom = s.index(i, 0);
        const std::int32_t top = s.index(i, s.ny - 1);
        push(bottom, bottom, walls.open_v, {Real(0), Real(-1)});
        if (here.ny == s.ny) {
            push(top, top + s.stride, walls.open_v, {Real(0), Real(1)});
        }
    }
}

template <class Real>
PressedCells<Real> pressed_cells(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    return {simulation.pressure.pressure,
            simulation.pressure.level,
            simulation.settings.fall_in(dt_s),
            simulation.pressure.density,
            simulation.grid.u,
            simulation.grid.v,
            simulation.grid.inverse_density_u,
            simulation.grid.inverse_density_v};
}

template <class Real>
Obstacles<Real> obstacles_of(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    const Vec2<Real> g = simulation.settings.gravity;
    const Face<Real> dt = static_cast<Face<Real>>(dt_s);
    return {simulation.layers.shape, simulation.settings.borders,
            simulation.bodies,       simulation.layers.walls,
            dt * convert<Face<Real>>(g), dt,
            static_cast<Face<Real>>(simulation.walls_moved_s)};
}

template <class Real>
void locate(Simulation<Real>& simulation, Work work) {
    if (work.once(simulation.bodies.capacity)) {
        locate_bodies(simulation.bodies);
        if (simulation.free_bodies != nullptr) {
            simulation.layers.walls.moving = &moving_walls<Real>();
        }
    }
}

template <class Real>
void accelerate_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work) {
    if (work.once(1)) {
        work.spend(simulation.free_bodies->accelerate(obstacles_of(simulation, dt_s),
                                                      simulation.bodies));
    }
    if (work.foreseeing()) {
        work.expect(1, cost_with(1, simulation.free_bodies->most_looks(simulation.bodies)));
    }
}

template <class Real>
void press_tank(Simulation<Real>& simulation, Seconds<Real> dt_s) {
    press_on_tank(simulation, pressed_cells(simulation, dt_s),
                  tank_received(simulation.bodies));
}

/// What the rounds over free bodies' points cost in a substep.
template <class Real>
void charge_rounds(const Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work) {
    const std::int32_t cycles =
        simulation.pressure.elasticity != nullptr ? 0 : simulation.pressure.solve.cycles;
    const auto rounds = [&](bool most) {
        return simulation.free_bodies->rounds(simulation.bodies, 2 * plan.sweeps, cycles, most);
    };
    if (work.once(1)) {
        work.spend(rounds(false));
    }
    if (work.foreseeing()) {
        work.expect(1, cost_with(1, rounds(true)));
    }
}

template <class Real>
void press_bodies(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                  StepReport& report) {
    if (simulation.free_bodies != nullptr) {
        charge_rounds(simulation, plan, work);
    }
    if (!work.once(simulation.grid.shape.size())) {
        return;
    }
    const Seconds<Real> dt_s = plan.dt_s;
    const PressedCells<Real> cells = pressed_cells(simulation, dt_s);
    press_tank(simulation, dt_s);
    press_on_bodies(simulation.grid.shape, simulation.layers.walls, simulation.bodies, cells);
    if (simulation.free_bodies != nullptr) {
        report.bodies_slowed += simulation.free_bodies->finish(
            obstacles_of(simulation, dt_s), cells, simulation.bodies, simulation.contacts);
    }
}

template <class Real>
void move_free_bodies(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report) {
    if (simulation.free_bodies == nullptr) {
        return;
    }
    report.bodies_slowed += simulation.free_bodies->move(obstacles_of(simulation, dt_s),
                                                         simulation.bodies, dt_s);
    report.nodes_rasterized += merge_moving(simulation.layers, simulation.bodies);
    locate_bodies(simulation.bodies);
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
            obstacles_of(simulation, dt_s),
            fields.pressure,
            fields.divergence,
            fields.inverse_diagonal,
            simulation.body_diagonal};
}

/// Packed worlds have no free bodies, so no pieces.
template <class Real>
constexpr Decompose<Real> decomposer() {
    if constexpr (Stored<Real>::shares_momentum) {
        return nullptr;
    } else {
        return decompose<Real>;
    }
}

/// Nothing smaller than a thousandth of a cell does: its inverse would be noise.
template <class Real>
bool weighs_something(const BodyLoad<Real>& load) {
    constexpr Face<Real> kLeast = Face<Real>(1.0e-12);
    return load.mass > kLeast && load.inertia > kLeast;
}

template <class Real>
bool weigh(const BodyDef& def, const BodyTable<Real>& table, const Body<Real>& body,
           BodyLoad<Real>& load) {
    load = BodyLoad<Real>{};
    if (def.open) {
        return true;
    }
    Outline<Real> outline = table.outline(body);
    outline.vertex = table.local + body.first_vertex;
    const Moments<Real> moments = moments_of(outline);
    const auto density = static_cast<Face<Real>>(def.density_ratio);
    load.centre = moments.centroid;
    load.area = moments.area;
    load.mass = density * moments.area;
    load.inertia = density * moments.inertia;
    return weighs_something(load);
}

}  // namespace

template <bool Solids, class Real>
const detail::TwoWay<Real>& detail::two_way() {
    if constexpr (Solids) {
        static constexpr TwoWay<Real> kStages{
            open_ledger<Real>,  press_tank<Real>,        close_ledger<Real>,
            locate<Real>,       accelerate_bodies<Real>, coupled_solve<Real>,
            press_bodies<Real>, move_free_bodies<Real>,  decomposer<Real>(),
            weigh<Real>};
        return kStages;
    } else {
        static constexpr TwoWay<Real> kStages{open_ledger<Real>, press_tank<Real>,
                                              close_ledger<Real>, nullptr, nullptr, nullptr,
                                              nullptr, nullptr, nullptr, nullptr};
        return kStages;
    }
}

#define WEIR_INSTANTIATE(Real)                                           \
    template const detail::TwoWay<Real>& detail::two_way<false, Real>(); \
    template const detail::TwoWay<Real>& detail::two_way<true, Real>();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
