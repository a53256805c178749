// The paper's flowchart (its Fig. 4), top to bottom.
#include "step/substep.hpp"

#include <cstring>

#include "fluid/row_order.hpp"
#include "pressure/equation_of_state.hpp"
#include "pressure/projection.hpp"
#include "pressure/surface_level.hpp"
#include "pressure/surface_tension.hpp"
#include "pressure/volume_correction.hpp"
#include "solid/collide.hpp"
#include "step/boundary_condition.hpp"
#include "step/grid_to_particle.hpp"
#include "step/grid_update.hpp"
#include "step/occupied.hpp"
#include "step/particle_to_grid.hpp"
#include "step/stage_clock.hpp"
#include "step/thin_transfer.hpp"
#include "step/two_way.hpp"
#include "step/viscosity.hpp"

namespace weir {

namespace {

/// No particle moves further than this within a substep, cells; beyond it the step would be
/// stable no longer. The plan of substeps aims at `cfl`, which is at most as much.
template <class Real>
constexpr Real kLongestWay = Real(2);

/// What a particle's velocity can be kept as, cells/s.
template <class Real>
constexpr Real kFastest = Real(Stored<Real>::coarse ? 255.0 : 1.0e30);

/// Moving bodies go where their velocities take them.
template <class Real>
void move_bodies(BodyTable<Real>& table, Walls<Real>& walls, bool viscous, Seconds<Real> dt_s) {
    walls.moving = false;
    walls.sticking = false;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        Body<Real>& body = table.body[slot];
        walls.sticking = walls.sticking ||
                         (viscous && body.kind != BodyKind::free && body.surface.no_slip);
        if (body.kind != BodyKind::moving ||
            (table.load != nullptr && table.load[slot].is_free())) {
            continue;
        }
        if (body.velocity.x != Real(0) || body.velocity.y != Real(0) || body.spin != Real(0)) {
            walls.moving = true;
            body.position = body.position + dt_s * body.velocity;
            body.angle = wrapped_angle(body.angle + dt_s * body.spin);
            body.moved = true;
            place(table, body);
        }
    }
}

template <class Real>
void solve_pressure(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work) {
    const Settings<Real>& settings = simulation.settings;
    const Walls<Real>& walls = simulation.layers.walls;
    if (settings.pressure == Pressure::projection) {
        if (plan.surface_tension > Real(0)) {
            surface_tension(simulation.grid.shape, settings.borders, walls,
                            plan.surface_tension * plan.dt_s, simulation.pressure, work);
        }
        const CoupledSolve<Real> coupled = coupled_solve(simulation, plan.dt_s);
        projection(settings.borders, walls, plan.dt_s, settings.sweeps, simulation.grid,
                   simulation.pressure, simulation.free_bodies != nullptr ? &coupled : nullptr,
                   work);
        extrapolate(settings.borders, walls, simulation.pressure,
                    settings.surface_tension > Real(0), simulation.grid, work);
    } else {
        equation_of_state(settings.borders, walls, plan.dt_s, plan.sound_speed,
                          simulation.grid, simulation.pressure, work);
        if (settings.sound_speed > Real(0)) {
            simulation.pressure.change = plan.sound_speed / settings.sound_speed;
        }
    }
}

/// The gain holds for a substep in which something moves half a cell, or a wave of the size of a
/// cell would, under gravity or surface tension. Shorter ones, as viscosity asks for, get their
/// share.
template <class Real>
Real volume_gain(const Simulation<Real>& simulation, Seconds<Real> dt_s) {
    const Vec2<Real> g = simulation.settings.gravity;
    const Real wave = square_root(maximum(absolute(g.x), absolute(g.y)) +
                                  simulation.settings.surface_tension);
    const Real way = dt_s * (simulation.max_speed + wave);
    return simulation.settings.volume_gain * minimum(Real(1), way + way);
}

/// Faces that no liquid owns: inside solids and beyond the tank.
template <class Real>
void fill_borders(Simulation<Real>& simulation, Work work) {
    StaggeredGrid<Real>& grid = simulation.grid;
    if (simulation.layers.walls.active) {
        mirror_in_solids(simulation.layers.walls, simulation.pressure, grid, work);
        if (simulation.layers.walls.thin != nullptr && work.once(grid.shape.size())) {
            mirror_at_thin_walls(simulation.layers.walls, simulation.pressure.level, grid);
        }
    }
    if (work.once(2 * grid.shape.border())) {
        extend_velocity(simulation.settings.borders, grid.shape, grid.u, grid.v);
        extend_velocity(simulation.settings.borders, grid.shape, grid.mass_u, grid.mass_v);
    }
}

template <class Real>
void note(const TransferResult<Real>& result, Simulation<Real>& simulation, StepReport& report) {
    report.particles_reset += result.reset;
    report.particles_slowed += result.slowed;
    simulation.max_speed = maximum(simulation.max_speed, result.max_speed);
}

template <class Real>
void note(const CollideResult<Real>& result, Simulation<Real>& simulation, StepReport& report) {
    report.particles_tested += result.tested;
    report.particles_reflected += result.reflected;
    report.particles_stuck += result.stuck;
    report.particles_removed_stuck += result.removed;
    simulation.max_speed = maximum(simulation.max_speed, result.max_speed);
}

/// The grid's stages see the part of the tank that the liquid is in.
template <class Real>
void skip_empty(Simulation<Real>& simulation, Work work) {
    const GridShape& tank = simulation.layers.shape;
    const Particles<Real>& particles = simulation.particles;
    if (work.once(1)) {
        simulation.furthest = {};
    }
    Vec2<PositionOf<Real>> furthest[kMostPieces] = {};
    work.share(work.take(particles.count, 1), 1, 1, [&](const Part& part, std::int32_t n) {
        furthest[n] = furthest_of(particles.part(part.first, part.end - part.first), {});
    });
    for (const Vec2<PositionOf<Real>>& one : furthest) {
        simulation.furthest = {maximum(simulation.furthest.x, one.x),
                               maximum(simulation.furthest.y, one.y)};
    }
    if (work.once(1)) {
        GridShape& now = simulation.grid.shape;
        now = occupied_part<Real>(tank, simulation.settings.borders, simulation.furthest);
        GridShape& coarse = simulation.pressure.coarse.shape;
        coarse = {coarse_cells(now.nx), coarse_cells(now.ny), coarse.stride};
        Walls<Real>& walls = simulation.layers.walls;
        walls.active = walls_reach(now, simulation.bodies, walls);
        walls.sticking = walls.sticking && walls.active;
    }
    empty_beyond(tank, simulation.occupied, simulation.grid.shape, simulation.pressure, work);
    if (work.once(1)) {
        simulation.occupied = simulation.grid.shape;
    }
}

/// Particles in the order of the rows that they are in, if the definition asks for it.
template <class Real>
void order_particles(Simulation<Real>& simulation, Work work) {
    constexpr std::int32_t kFields =
        Stored<Real>::shares_momentum ? kCoarseFieldsPacked : kCoarseFields;
    if (simulation.settings.keep_sorted && work.once(2 * simulation.particles.count)) {
        // The coarse grid is not in use before the pressure.
        const CoarseGrid<Real>& coarse = simulation.pressure.coarse;
        const std::int32_t rows = coarse_cells(simulation.layers.shape.ny) + 2;
        keep_row_order(simulation.grid.shape,
                       {reinterpret_cast<std::int32_t*>(coarse.correction),
                        kFields * coarse.shape.stride * rows},
                       simulation.particles);
    }
}

/// What pieces of a loop found, each by itself.
template <class Result>
struct Findings {
    Result of[kMostPieces];

    template <class Real>
    void note_all(Simulation<Real>& simulation, StepReport& report) const {
        for (const Result& found : of) {
            note(found, simulation, report);
        }
    }
};

/// What particles look like to a loop: so many cells.
constexpr std::int32_t kCellsAParticle = 4;

/// Moves particles where there are no solids.
template <class Real>
void gather_freely(Simulation<Real>& simulation, const Transfer<Real>& transfer, Work work,
                   StepReport& report) {
    Findings<TransferResult<Real>> found{};
    const Part part = work.take(simulation.gathered, 1);
    // What hits the tank's walls is summed in its order.
    const Work alone = transfer.tank != nullptr ? Work() : work;
    alone.share(part, kCellsAParticle, kBlock<Real>, [&](const Part& piece, std::int32_t n) {
        Particles<Real> some =
            simulation.particles.part(piece.first, piece.end - piece.first);
        found.of[n] = grid_to_particle(simulation.grid, transfer, some);
    });
    found.note_all(simulation, report);
}

/// Moves a block of particles and lets them meet the solids.
template <class Real>
void gather_block(Simulation<Real>& simulation, const Transfer<Real>& transfer,
                  const Part& places, bool mark_removed, StageClock* clock,
                  TransferResult<Real>& moved, CollideResult<Real>& collisions) {
    const Walls<Real>& walls = simulation.layers.walls;
    Particles<Real>& particles = simulation.particles;
    Vec2<PositionOf<Real>> before[kBlock<Real>];
    Vec2<VelocityOf<Real>> velocity[kBlock<Real>];
    const std::int32_t first = places.first;
    const std::int32_t count = places.end - first;
    std::memcpy(before, particles.position + first,
                static_cast<std::size_t>(count) * sizeof before[0]);
    Particles<Real> block = particles.part(first, count);
    if (walls.thin != nullptr) {
        std::memcpy(velocity, particles.velocity + first,
                    static_cast<std::size_t>(count) * sizeof velocity[0]);
    }
    moved = grid_to_particle(simulation.grid, transfer, block);
    if (walls.thin != nullptr) {
        Transfer<Real> again = transfer;
        again.tank = nullptr;  // what hit its walls has been counted
        const TransferResult<Real> beside =
            gather_past_walls(simulation.grid, again, *walls.thin,
                              transfer.dt_s * simulation.settings.gravity, before, velocity, block);
        moved.far += beside.far;
        moved.max_speed = maximum(moved.max_speed, beside.max_speed);
    }
    if (clock != nullptr) {
        clock->charge(Stage::grid_to_particle);
    }
    collide(simulation.grid.shape, walls, {before, moved.far > 0, transfer.dt_s, mark_removed},
            first, count, particles, simulation.contacts, collisions);
    if (clock != nullptr) {
        clock->charge(Stage::collide);
    }
}

/// Moves the particles and lets them meet the solids: a block at a time, because a particle's path
/// is known only while the place that it comes from is.
template <class Real>
void gather_among_solids(Simulation<Real>& simulation, const Transfer<Real>& transfer, Work work,
                         StageClock& clock, StepReport& report) {
    // From the pool's end, which may come nearer on the way.
    const Part part = work.take((simulation.gathered + kBlock<Real> - 1) / kBlock<Real>,
                                kBlock<Real>);
    const auto places = [&](std::int32_t at) {
        const std::int32_t end = simulation.gathered - at * kBlock<Real>;
        return Part{maximum(0, end - kBlock<Real>), end};
    };
    // Blows are summed in their order.
    const bool alone = simulation.contacts.capacity > 0 || simulation.bodies.load != nullptr ||
                       Stored<Real>::coarse;
    const std::int32_t cost = kCellsAParticle * kBlock<Real>;
    Findings<TransferResult<Real>> moved{};
    Findings<CollideResult<Real>> collisions{};
    const auto stage = [&](const Part& blocks, std::int32_t n, bool mark, StageClock* charged) {
        for (std::int32_t at = blocks.first; at < blocks.end; ++at) {
            TransferResult<Real> block;
            gather_block(simulation, transfer, places(at), mark, charged, block,
                         collisions.of[n]);
            moved.of[n].add(block);
        }
    };
    if (alone || work.pieces(part.end - part.first, cost, 1) <= 1) {
        stage(part, 0, false, &clock);
    } else {
        work.share(part, cost, 1, [&](const Part& blocks, std::int32_t n) {
            stage(blocks, n, true, nullptr);
        });
        std::int32_t removed = 0;
        for (const CollideResult<Real>& of : collisions.of) {
            removed += of.removed;
        }
        simulation.particles.remove_marked(removed);
        clock.charge(Stage::grid_to_particle);
    }
    moved.note_all(simulation, report);
    collisions.note_all(simulation, report);
}

template <class Real>
void gather(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work, StageClock& clock,
            StepReport& report) {
    const Settings<Real>& settings = simulation.settings;
    Transfer<Real> transfer{dt_s, settings.flip_ratio,
                            minimum(kLongestWay<Real> / dt_s, kFastest<Real>), settings.borders};
    if (simulation.bodies.load != nullptr) {
        transfer.tank = &simulation.bodies.load[simulation.bodies.capacity].received;
        transfer.particle_mass = simulation.layers.walls.particle_mass;
    }
    prepare_gather(simulation.grid, work);
    if (work.once(1)) {
        simulation.grid.shape = simulation.layers.shape;
        simulation.max_speed = Real(0);
        simulation.gathered = simulation.particles.count;
        report.particles_stuck = 0;
    }
    if (!simulation.layers.walls.active) {
        gather_freely(simulation, transfer, work, report);
        clock.charge(Stage::grid_to_particle);
        return;
    }
    transfer.near = Real(1) / dt_s;
    ThinWalls<Real>& thin = simulation.layers.thin;
    if (simulation.layers.walls.thin != nullptr &&
        work.once(simulation.bodies.vertices_used + 1)) {
        follow_bodies(thin, simulation.bodies);
    }
    gather_among_solids(simulation, transfer, work, clock, report);
    if (thin.capacity > 0 && work.once(simulation.bodies.capacity)) {
        forget_ways(thin, simulation.bodies);
    }
}

}  // namespace

template <class Real>
void substep(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
             StepReport& report) {
    const Seconds<Real> dt_s = plan.dt_s;
    StaggeredGrid<Real>& grid = simulation.grid;
    Walls<Real>& walls = simulation.layers.walls;
    const Settings<Real>& settings = simulation.settings;
    StageClock clock(simulation.ticks, report);

    if (simulation.bodies.used > 0) {
        if (work.once(simulation.bodies.vertices_used + 1)) {
            move_bodies(simulation.bodies, walls, plan.viscosity > Real(0), dt_s);
        }
        if (work.once(simulation.bodies.capacity)) {
            const std::int32_t nodes = merge_moving(simulation.layers, simulation.bodies);
            report.nodes_rasterized += nodes;
            work.spend(nodes);
        }
        clock.charge(Stage::contour);
    }
    skip_empty(simulation, work);
    order_particles(simulation, work);
    const bool two_way = simulation.bodies.load != nullptr;
    if (two_way && work.once(simulation.bodies.capacity)) {
        accelerate_bodies(simulation, dt_s);
    }
    particle_to_grid(simulation.particles, settings.borders, settings.second_density, grid,
                     walls.thin, work);
    clock.charge(Stage::particle_to_grid);

    surface_level(grid, settings.borders, walls, settings.rest_count, simulation.pressure, work);
    grid_update(settings.borders, settings.gravity, dt_s, simulation.pressure.level, grid, work);
    if (plan.viscosity > Real(0)) {
        Impulse<Real>* tank =
            two_way ? &simulation.bodies.load[simulation.bodies.capacity].received : nullptr;
        diffuse_velocity(settings.borders, walls, simulation.pressure, plan.viscosity * dt_s, grid,
                         tank, work);
    }
    clock.charge(Stage::grid_update);

    solve_pressure(simulation, plan, work);
    if (two_way && work.once(grid.shape.size())) {
        press_bodies(simulation, dt_s, report);
    }
    fill_borders(simulation, work);
    clock.charge(Stage::pressure);

    blend_change(settings.borders, settings.flip_ratio, simulation.pressure, grid, walls.thin,
                 work);
    if (settings.volume_gain > Real(0) && settings.pressure == Pressure::projection) {
        volume_correction(settings.borders, walls, dt_s, volume_gain(simulation, dt_s),
                          simulation.pressure, grid, report.cells_overfull, work);
    }
    clock.charge(Stage::volume);

    if (two_way && work.once(simulation.bodies.vertices_used + 1)) {
        move_free_bodies(simulation, dt_s, report);
        clock.charge(Stage::contour);
    }
    gather(simulation, dt_s, work, clock, report);
}

template void substep(Simulation<float>&, const SubstepPlan<float>&, Work, StepReport&);
template void substep(Simulation<double>&, const SubstepPlan<double>&, Work, StepReport&);
template void substep(Simulation<Fixed>&, const SubstepPlan<Fixed>&, Work, StepReport&);
template void substep(Simulation<SmallFixed>&, const SubstepPlan<SmallFixed>&, Work, StepReport&);

}  // namespace weir
