// The paper's flowchart (its Fig. 4), top to bottom.
#include "step/substep.hpp"

#include "fluid/row_order.hpp"
#include "pressure/equation_of_state.hpp"
#include "pressure/projection.hpp"
#include "pressure/surface_level.hpp"
#include "pressure/surface_tension.hpp"
#include "pressure/volume_correction.hpp"
#include "solid/face_axis.hpp"
#include "step/bend_paths.hpp"
#include "step/blend_change.hpp"
#include "step/boundary_condition.hpp"
#include "step/fly_beyond.hpp"
#include "step/gather.hpp"
#include "step/grid_update.hpp"
#include "step/mass_matrix.hpp"
#include "step/momentum_ledger.hpp"
#include "step/occupied.hpp"
#include "step/part_met.hpp"
#include "step/particle_to_grid.hpp"
#include "step/quiet_surface.hpp"
#include "step/regions.hpp"
#include "step/row_spans.hpp"
#include "step/stage_clock.hpp"
#include "step/stages.hpp"
#include "step/thin_transfer.hpp"
#include "step/two_way.hpp"
#include "step/viscosity.hpp"

namespace weir {

namespace {

template <bool Solids, class Real>
void solve_pressure(Simulation<Real>& simulation, const Domain<Real>& domain,
                    const SubstepPlan<Real>& plan, Work work) {
    const Settings<Real>& settings = simulation.settings;
    const detail::Elasticity<Real>* elasticity = simulation.pressure.elasticity;
    if (work.once(1)) {
        simulation.pressure.cell_weight = settings.cell_weight(plan.dt_s);
        if (elasticity != nullptr) {
            elasticity->follow_sound(plan.sound_speed, simulation.pressure);
        }
    }
    if constexpr (!Stored<Real>::coarse) {  // packed worlds have no tension
        if (plan.surface_tension > Real(0)) {
            simulation.tension->stage(domain, plan.surface_tension * plan.dt_s, work);
        }
    }
    const auto solve = [&](const CoupledSolve<Real>* coupled) {
        projection<Solids>(domain, plan.dt_s, plan.sweeps, coupled, work);
    };
    if (Solids && simulation.free_bodies != nullptr && elasticity == nullptr) {
        const CoupledSolve<Real> coupled = simulation.two_way->coupled_solve(simulation, plan.dt_s);
        solve(&coupled);
    } else {
        solve(nullptr);
    }
    extrapolate(domain, settings.surface_tension > Real(0), work);
}

/// Whoever looks at levels has to know whether there are drops (`least_head`), and what follows
/// whether liquid is led to rest.
template <class Real>
void find_surface(Simulation<Real>& simulation, const Domain<Real>& domain,
                  const SubstepPlan<Real>& plan, Work work) {
    PressureFields<Real>& fields = simulation.pressure;
    fields.settling = plan.settling;
    if (!Stored<Real>::coarse && plan.surface_tension > Real(0)) {
        const Real held = Real(1.0F / kDropLength2) * plan.surface_tension;
        fields.on_surface = held >= larger_part(simulation.settings.gravity) ? kDrops : kPools;
    }
    const Settings<Real>& settings = simulation.settings;
    const bool thins_out = plan.viscosity > Real(0) && !fields.on_surface;
    surface_level(domain, settings.rest_count, simulation.stages->empty_slivers, work,
                  thins_out ? kPressedHead<Real> * settings.cell_weight(fields.last_dt) : Real(0));
}

/// As Fall::of says. Sound makes substeps so short that rounding always shows. Others owe only
/// what is as little, and none does while liquid is led to rest, which wants the same fall in each.
template <class Real>
Real most_owed(const Simulation<Real>& simulation, const SubstepPlan<Real>& plan) {
    const bool elastic = simulation.pressure.elasticity != nullptr;
    return plan.settling ? Real(0) : (elastic ? Real(kMaxSpeedSmallFixed) : Real(0.25));
}

template <class Real>
void update_grid(Simulation<Real>& simulation, const Domain<Real>& domain,
                 const SubstepPlan<Real>& plan, Work work) {
    const bool in_turn = plan.viscosity > Real(0) && !plan.settling;
    const Settings<Real>& settings = simulation.settings;
    const Vec2<Real> exact = in_turn ? fall_in_turn<Real>(plan.dt_s, settings.gravity,
                                                          simulation.pressure.quiet_turn)
                                     : settings.fall_in(plan.dt_s);
    const Real most = most_owed(simulation, plan);
    // Only beside solids does it matter who is reached: without any 0 is exact in fixed point, too.
    // Not by whether they are within reach: what creeps by a last digit would tell.
    const Real unreached = simulation.bodies.used > 0 ? kNoVelocity<Real> : Real(-0.0);
    grid_update(domain, simulation.fall.of(exact, most), work, unreached);
    if (work.once(1)) {
        simulation.fall.give(exact, most);
    }
}

/// The gain holds for a substep in which something moves half a cell, or a wave of the size of a
/// cell would, under gravity or surface tension. Shorter ones, as viscosity asks for, get their
/// share. Divided by dt.
template <class Real>
Real volume_gain_per_s(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    const Settings<Real>& settings = simulation.settings;
    const Real wave = square_root(larger_part(settings.gravity) + settings.surface_tension);
    const Real way = dt_s * (simulation.max_speed + wave);
    return simulation.settings.volume_gain * minimum(Real(1), way + way) / dt_s;
}

/// Faces that no liquid owns: inside solids and beyond the tank.
template <bool Solids, class Real>
void fill_borders(const Domain<Real>& domain, Vec2<Real> fall, Work work) {
    StaggeredGrid<Real>& grid = domain.grid;
    if constexpr (Solids) {
        const Walls<Real>& walls = domain.walls;
        if (walls.active) {
            mirror_in_solids(domain, fall, work);
            if (walls.thin != nullptr && work.once(grid.shape.size())) {
                mirror_at_thin_walls(walls, domain.fields.level, grid);
                if (walls.sticking != nullptr) {
                    walls.sticking->bind_to_thin(walls, domain.fields.level, grid);
                }
            }
        }
    }
    if (work.once(2 * grid.shape.border())) {
        extend_velocity(domain.borders, grid.shape, grid.u, grid.v);
        extend_velocity(domain.borders, grid.shape, grid.mass_u, grid.mass_v);
    }
}

/// Worlds with thin walls do without, and liquid that is being led to rest. Whoever rounds in turns
/// wants another turn all the same.
template <class Real>
void quiet_leaning(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work) {
    if (plan.settling) {
        return;
    }
    if (!simulation.layers.any_thin()) {
        quiet_surface(simulation.grid, simulation.pressure, simulation.settings.gravity,
                      simulation.particles, work);
    } else if (work.once(1)) {
        next_turn(simulation.pressure.quiet_turn);
    }
}

/// How often `hide_beyond` looks at each particle.
constexpr std::int32_t kLooksBeyond = 3;

/// Moves the window to the grid's part, whose cells get other numbers by that. Returns the cost.
template <class Real>
std::int32_t follow(Simulation<Real>& simulation) {
    GridShape& part = simulation.grid.shape;
    GridShape& coarse = simulation.pressure.coarse.shape;
    const std::int32_t cost = move_window(part, simulation);
    part.stride = simulation.layers.shape.stride;
    coarse = {coarse_cells(part.nx), coarse_cells(part.ny), coarse.stride};
    return cost;
}

/// All stages see the particles that are awake.
template <class Real>
void skip_asleep(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work) {
    if (simulation.regions != nullptr) {
        simulation.regions->stages->begin(simulation, plan, work);
    }
}

template <class Real>
void watch_asleep(Simulation<Real>& simulation, Work work, StageClock& clock,
                  const StepReport& report) {
    if (simulation.regions != nullptr) {
        simulation.regions->stages->end(simulation, work, report);
        clock.charge(Stage::grid_to_particle);
    }
}

/// The grid's stages see the part of the tank that the liquid is in.
template <class Real>
void skip_empty(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work) {
    const GridShape& tank = simulation.layers.shape;
    const Particles<Real>& particles = simulation.particles;
    Walls<Real>& walls = simulation.layers.walls;
    if (work.once(1)) {
        simulation.extent = Extent<Real>::of_first(particles);
    }
    Extent<Real> pieces[kMostPieces];
    for (Extent<Real>& one : pieces) {
        one = simulation.extent;
    }
    work.share(work.take(particles.count, 1), 1, 1, [&](const Part& part, std::int32_t n) {
        pieces[n] = extent_of(particles.part(part.first, part.end - part.first),
                              tank.nx - kMargin);
    });
    for (const Extent<Real>& one : pieces) {
        simulation.extent.add(one);
    }
    const bool windowed = kHasWindow<Real> && simulation.window.cells > 0;
    if (work.once(1)) {
        GridShape& now = simulation.grid.shape;
        // What thin walls and whoever counts forces know of cells is told from the corner on.
        const bool from_corner = walls.thin != nullptr || simulation.bodies.load != nullptr;
        now = occupied_part(tank, simulation.settings.borders, simulation.extent, from_corner);
        if constexpr (kHasWindow<Real>) {
            if (windowed && !fits_window(simulation, now)) {
                work.spend(kLooksBeyond * particles.count);
                now = hide_beyond(simulation);
            }
        }
        GridShape& coarse = simulation.pressure.coarse.shape;
        coarse = {coarse_cells(now.nx), coarse_cells(now.ny), coarse.stride};
        simulation.layers.show(walls_reach(now, simulation.bodies));
    }
    empty_beyond(tank, simulation.occupied, simulation.grid.shape, simulation.pressure, work);
    if (work.once(1)) {
        if constexpr (kHasWindow<Real>) {
            if (windowed) {
                work.spend(follow(simulation));
            }
        }
        skip_empty_columns(simulation, plan);
        simulation.occupied = simulation.grid.shape;
    }
    if (windowed && work.foreseeing()) {
        work.expect(1, kLooksBeyond * particles.count + 1);
        work.expect(1, 1 + simulation.window.cells +
                           most_stored_nodes(simulation.layers, simulation.bodies));
    }
}

/// Particles in the order of the rows that they are in, if the definition asks for it.
template <class Real>
void order_particles(Simulation<Real>& simulation, Work work) {
    const detail::RowOrder<Real>* order = simulation.row_order;
    if (order != nullptr && work.once(2 * simulation.particles.count)) {
        const auto row_of = [](PositionOf<Real> y) { return static_cast<std::int32_t>(Real(y)); };
        const Extent<Real>& extent = simulation.extent;
        order->keep({row_of(extent.low.y), row_of(extent.high.y) + 1},
                    words_before_pressure(simulation.pressure, stored_part(simulation)),
                    simulation.particles, work);
    }
}

/// Bodies move, and the contour with them.
template <class Real>
void draw_bodies(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                 StepReport& report) {
    if (work.once(simulation.bodies.vertices_used + 1)) {
        Seconds<Real>& moved_s = simulation.walls_moved_s;
        moved_s = plan.walls_held ? Seconds<Real>{} : plan.dt_s + simulation.walls_behind_s;
        simulation.walls_behind_s = Seconds<Real>{};
        simulation.layers.show(true);
        Walls<Real>& walls = simulation.layers.walls;
        walls.sticking = plan.viscosity > Real(0) && walls.any_sticking
                             ? simulation.viscosity->sticking
                             : nullptr;
        if (simulation.stages->move_bodies != nullptr) {
            simulation.stages->move_bodies(simulation.bodies, walls, moved_s);
        }
    }
    if (work.once(simulation.bodies.capacity)) {
        const std::int32_t nodes =
            simulation.stages->draw_moved(simulation.layers, simulation.bodies);
        report.nodes_rasterized += nodes;
        work.spend(nodes);
    }
    if (work.foreseeing()) {
        const BodyTable<Real>& table = simulation.bodies;
        work.expect(1, cost_with(maximum(std::int32_t{table.capacity}, table.vertices_used + 1),
                                 plan.walls_held ? 0
                                                 : simulation.stages->most_moved(
                                                       simulation.layers, table)));
    }
}

/// Between the transfers.
template <bool Solids, class Real>
void solve_on_grid(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                   StageClock& clock, StepReport& report) {
    const Seconds<Real> dt_s = plan.dt_s;
    const Domain<Real> domain = domain_of(simulation);
    const Settings<Real>& settings = simulation.settings;
    const detail::TwoWay<Real>* two_way = simulation.two_way;
    find_surface(simulation, domain, plan, work);
    const bool interpolated = interpolates(simulation, plan);
    if (interpolated) {
        const bool to_surface = !(plan.viscosity > Real(0));
        simulation.mass_matrix->solve(domain, simulation.particles, settings.second_density,
                                      to_surface, work);
    }
    update_grid(simulation, domain, plan, work);
    if (plan.viscosity > Real(0)) {
        Impulse<Real>* tank = two_way != nullptr ? &tank_received(simulation.bodies) : nullptr;
        const Vec2<Real> fall = settings.fall_in(dt_s);
        simulation.viscosity->diffuse(domain, plan.viscosity * dt_s, fall, tank, work);
    }
    accelerate_free(simulation, dt_s, work);
    clock.charge(Stage::grid_update);

    solve_pressure<Solids>(simulation, domain, plan, work);
    if (two_way != nullptr) {
        if constexpr (Solids) {
            two_way->press_bodies(simulation, plan, work, report);
        } else if (work.once(domain.grid.shape.size())) {
            two_way->press_tank(simulation, dt_s);
        }
    }
    if (simulation.pressure.elasticity != nullptr) {
        simulation.pressure.elasticity->release_pressure(domain, work);
    }
    fill_borders<Solids>(domain, settings.fall_in(dt_s), work);
    clock.charge(Stage::pressure);

    quiet_leaning(simulation, plan, work);
    blend_change(domain, settings.flip_ratio, interpolated, work);
    bend_paths(domain, dt_s, work);
    // In Fixed drift ends by itself: what does not make a last digit of a place is none.
    if (settings.volume_gain > Real(0) && !(Stored<Real>::coarse && plan.settling)) {
        volume_correction<Solids>(domain, volume_gain_per_s(simulation, dt_s),
                                  settings.fall_in(dt_s), report.cells_overfull, work);
    }
    clock.charge(Stage::volume);
}

template <bool Solids, class Real>
void substep(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
             StepReport& report) {
    const Seconds<Real> dt_s = plan.dt_s;
    const Settings<Real>& settings = simulation.settings;
    StageClock clock(simulation.ticks, work, report);

    if (Solids && simulation.bodies.used > 0) {
        draw_bodies(simulation, plan, work, report);
        clock.charge(Stage::contour);
    }
    skip_asleep(simulation, plan, work);
    skip_empty(simulation, plan, work);
    order_particles(simulation, work);
    const detail::TwoWay<Real>* two_way = simulation.two_way;
    if (kLedgerWithin<Real> && two_way != nullptr) {
        two_way->open_ledger(simulation, work);
    }
    locate_before<Solids>(simulation, work);
    report.particles_crowded += particle_to_grid<Real>(
        simulation.particles, settings.borders, settings.second_density, simulation.grid,
        simulation.layers.walls.thin, work);
    clock.charge(Stage::particle_to_grid);

    solve_on_grid<Solids>(simulation, plan, work, clock, report);
    if (Solids && two_way != nullptr) {
        move_free(simulation, dt_s, work, report);
        clock.charge(Stage::contour);
    }
    gather<Solids>(simulation, plan, work, clock, report);
    if constexpr (Stored<Real>::coarse) {
        part_met<Solids>(simulation, work);
        clock.charge(Stage::grid_to_particle);
    }
    if constexpr (kHasWindow<Real>) {
        if (simulation.window.cells > 0) {
            fly_beyond<Solids>(simulation, plan, work, report);
            clock.charge(Stage::grid_to_particle);
        }
    }
    if (kLedgerWithin<Real> && two_way != nullptr) {
        two_way->close_ledger(simulation, dt_s, work);
        clock.charge(Stage::collide);
    }
    watch_asleep(simulation, work, clock, report);
}

}  // namespace

template <Bodies Room, class Real>
const Stages<Real>& plain_stages() {
    return stages_around<Room, Real, substep<Room != Bodies::none, Real>>();
}

#define WEIR_INSTANTIATE(Real)                                        \
    template const Stages<Real>& plain_stages<Bodies::none, Real>();  \
    template const Stages<Real>& plain_stages<Bodies::still, Real>(); \
    template const Stages<Real>& plain_stages<Bodies::moving, Real>();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
