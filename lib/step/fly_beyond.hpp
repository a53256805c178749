// Stage: those that a window leaves out.
#pragma once

#include "solid/picture_beyond.hpp"
#include "step/gather.hpp"
#include "step/tank_walls.hpp"
#include "step/window.hpp"

namespace weir {

/// The nodes of all cells that a way touches, and of those around them.
template <class Real>
NodeBox nodes_around(Vec2<Real> from, Vec2<Real> to) {
    const auto cell = [](Real place) { return static_cast<std::int32_t>(place); };
    return {cell(minimum(from.x, to.x)) - 1, cell(minimum(from.y, to.y)) - 1,
            cell(maximum(from.x, to.x)) + 2, cell(maximum(from.y, to.y)) + 2};
}

/// Some of the particles that are left out: they fall, and meet the tank's walls and the solids.
template <bool Solids, class Real>
void fly(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, const Part& part,
         StepReport& report) {
    const Settings<Real>& settings = simulation.settings;
    const GridShape& tank = simulation.layers.shape;
    Particles<Real>& particles = simulation.particles;
    Transfer<Real> transfer = transfer_of(settings, plan.dt_s);
    transfer.near = kLongWay<Real> / plan.dt_s;
    const Vec2<Real> size{static_cast<Real>(tank.nx), static_cast<Real>(tank.ny)};
    TransferResult<Real> moved;
    CollideResult<Real> collisions;
    PictureBeyond<Real> picture(tank, simulation.layers.walls, simulation.bodies);
    Walls<Real> walls = simulation.layers.walls;
    walls.stored.picture = &picture;
    const NodeBox drawn = Solids ? all_drawn(simulation.bodies) : NodeBox{};
    // From the last one on: who takes the place of one that is removed has been moved.
    for (std::int32_t k = -1 - part.first; k > -1 - part.end; --k) {
        const Vec2<PositionOf<Real>> before = particles.position[k];
        Vec2<Real> x = before;
        Vec2<Real> v = particles.velocity[k];
        v = v + settings.fall_in(plan.dt_s);
        moved.far = 0;
        advect<Real>(size, {transfer, particles.kind_at(k)}, v, x, v, moved);
        particles.position[k] = x;
        particles.velocity[k] = v;
        if constexpr (Solids) {
            const NodeBox near = nodes_around(Vec2<Real>(before), x);
            if (overlap(near, drawn) && picture.any_at(near)) {
                collide(tank, walls,
                        {&before, moved.far > 0, simulation.walls_moved_s, false, true}, k, 1,
                        particles, simulation.contacts, collisions);
            }
        }
    }
    note(moved, simulation, report);
    note(collisions, simulation, report);
}

/// Moves the particles that are left out.
template <bool Solids, class Real>
void fly_beyond(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                StepReport& report) {
    const Part part = work.take(simulation.window.beyond, 1);
    if (!part.empty()) {
        fly<Solids>(simulation, plan, part, report);
    }
    if (Solids && work.foreseeing()) {
        work.expect(kBlock<Real>, 1);  // the others fill a block less
    }
    if (work.once(1)) {
        report.particles_beyond = simulation.window.beyond;
        show_beyond(simulation);
    }
}

}  // namespace weir
