// Stage: grid-to-particle and collide, over the whole pool.
#pragma once

#include <cstring>

#include "solid/collide.hpp"
#include "step/free_words.hpp"
#include "step/grid_to_particle.hpp"
#include "step/occupied.hpp"
#include "step/simulation.hpp"
#include "step/stage_clock.hpp"
#include "step/thin_transfer.hpp"
#include "step/time_step_limit.hpp"

namespace weir {

/// No particle moves further than this within a substep, cells; beyond it the step would be
/// stable no longer. The plan of substeps aims at `cfl`, which is at most as much.
template <class Real>
inline constexpr Real kLongestWay = Real(2);
static_assert(kLongestWay<float> + 1.0F < kMargin, "or a way leads past what a window stores");

/// What a particle's velocity can be kept as, cells/s.
template <class Real>
inline constexpr Real kFastest = Real(Stored<Real>::coarse ? 255.0 : 1.0e30);

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
    if (result.covered) {
        simulation.pressure.room_turns = kRoomTurns;
        if constexpr (Stored<Real>::coarse) {  // what is at rest drifts again
            simulation.pressure.crowded = simulation.settings.volume_gain > Real(0);
        }
    }
    simulation.max_speed = maximum(simulation.max_speed, result.max_speed);
#if WEIR_PARALLEL
    simulation.grid.knows_rows = simulation.grid.knows_rows && !result.leapt;
#endif
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
inline constexpr std::int32_t kCellsAParticle = 4;

/// Of particles that meet nothing but the tank's walls.
template <class Real>
Transfer<Real> transfer_of(const Settings<Real>& settings, Seconds<Real> dt_s) {
    return {dt_s, settings.flip_ratio, minimum(kLongestWay<Real> / dt_s, kFastest<Real>),
            settings.borders};
}

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

/// Room for up to so many copies, which is not emptied before it is used.
template <class Value, std::int32_t Most>
class Copies {
public:
    const Value* of(const Value* from, std::int32_t count) {
        std::memcpy(bytes_, from, static_cast<std::size_t>(count) * sizeof(Value));
        return reinterpret_cast<const Value*>(bytes_);
    }
    /// For who leaves them there himself. (g++ would warn of what it does not see written.)
    Value* room() { return whole(reinterpret_cast<Value*>(bytes_)); }

private:
    // Also of words, so that small values are copied by words.
    alignas(Value) alignas(std::uint32_t) unsigned char bytes_[Most * sizeof(Value)];
};

/// Moves a block of particles past thin walls, too. `before`: where they come from.
template <class Real>
TransferResult<Real> move_past_walls(const Simulation<Real>& simulation,
                                     const Transfer<Real>& transfer,
                                     const Vec2<PositionOf<Real>>* before,
                                     Particles<Real>& block) {
    Copies<Vec2<VelocityOf<Real>>, kBlock<Real>> copies;
    const Vec2<VelocityOf<Real>>* velocity = copies.of(block.velocity, block.count);
    TransferResult<Real> moved = grid_to_particle(simulation.grid, transfer, block);
    Transfer<Real> again = transfer;
    again.tank = nullptr;  // what hit its walls has been counted
    const TransferResult<Real> beside =
        gather_past_walls(simulation.grid, again, simulation.layers.walls,
                          simulation.pressure.density, simulation.settings.fall_in(transfer.dt_s),
                          before, velocity, block);
    moved.far += beside.far;
    moved.max_speed = maximum(moved.max_speed, beside.max_speed);
    return moved;
}

/// There is room for a block at least.
template <class Real>
void lend_scratch(const PressureFields<Real>& fields, const GridShape& tank,
                  Transfer<Real>& transfer) {
    static_assert(kFewestFreeWords<Real> >= kBlock<Real>, "or the smallest tank has too little");
    const FreeWords words = free_words(fields, tank);
    transfer.ways = words.data;
    transfer.room = words.size;
}

/// Moves a block of particles and lets them meet the solids.
template <class Real>
void gather_block(Simulation<Real>& simulation, Transfer<Real>& transfer, const Part& places,
                  bool mark_removed, StageClock* clock, TransferResult<Real>& moved,
                  CollideResult<Real>& collisions) {
    const Walls<Real>& walls = simulation.layers.walls;
    Particles<Real>& particles = simulation.particles;
    const std::int32_t first = places.first;
    const std::int32_t count = places.end - first;
    constexpr bool kLeft = Stored<Real>::coarse;  // by the gather, on one thread
    Copies<Vec2<PositionOf<Real>>, kLeft ? 1 : kBlock<Real>> copies;
    const auto* before = static_cast<const Vec2<PositionOf<Real>>*>(transfer.ways);
    const bool in_lanes = kHasLanes<Real> && simulation.grid.pairs != nullptr;
    Transfer<Real> leaving = transfer;  // threads share the other one
    if (in_lanes) {
        auto* const left = copies.room();
        leaving.ways = left;
        before = left;
    } else if constexpr (!kLeft) {
        before = copies.of(particles.position + first, count);
    }
    const Transfer<Real>& how = in_lanes ? leaving : transfer;
    Particles<Real> block = particles.part(first, count);
    moved = walls.thin != nullptr
                ? move_past_walls(simulation, how, before, block)
                : grid_to_particle(simulation.grid, how, block);
    if (clock != nullptr) {
        clock->charge(Stage::grid_to_particle);
    }
    collide(simulation.grid.shape, walls,
            {before, moved.far > 0, simulation.walls_moved_s, mark_removed, false,
             &simulation.bodies},
            first, count, particles, simulation.contacts, collisions);
    if (clock != nullptr) {
        clock->charge(Stage::collide);
    }
}

/// Moves the particles and lets them meet the solids: a block at a time, because a particle's path
/// is known only while the place that it comes from is.
template <class Real>
void gather_among_solids(Simulation<Real>& simulation, Transfer<Real>& transfer, Work work,
                         StageClock& clock, StepReport& report) {
    // From the pool's end, which may come nearer on the way.
    const Part part = work.take((simulation.gathered + kBlock<Real> - 1) / kBlock<Real>,
                                kBlock<Real>);
    clock.charge(Stage::grid_to_particle);
    const auto places = [&](std::int32_t at, std::int32_t blocks) {
        const std::int32_t end = simulation.gathered - at * kBlock<Real>;
        return Part{maximum(0, end - blocks * kBlock<Real>), end};
    };
    // So many blocks at once; but the tank sums what hits it block by block, however a step is cut.
    const bool together = Stored<Real>::coarse && transfer.tank == nullptr;
    const std::int32_t most = together ? transfer.room / kBlock<Real> : 1;
    // Blows are summed in their order.
    const bool alone = simulation.contacts.capacity > 0 || simulation.bodies.load != nullptr ||
                       Stored<Real>::coarse;
    const std::int32_t cost = kCellsAParticle * kBlock<Real>;
    Findings<TransferResult<Real>> moved{};
    Findings<CollideResult<Real>> collisions{};
    const auto stage = [&](const Part& blocks, std::int32_t n, bool mark, StageClock* charged) {
        for (std::int32_t at = blocks.first; at < blocks.end; at += most) {
            TransferResult<Real> block;
            gather_block(simulation, transfer, places(at, minimum(most, blocks.end - at)), mark,
                         charged, block, collisions.of[n]);
            moved.of[n].add(block);
            if constexpr (Stored<Real>::coarse) {
                transfer.max_speed = moved.of[n].max_speed;
            }
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

template <bool Solids, class Real>
void gather(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
            StageClock& clock, StepReport& report) {
    const Settings<Real>& settings = simulation.settings;
    const Seconds<Real> dt_s = plan.dt_s;
    Transfer<Real> transfer = transfer_of(settings, dt_s);
    if (simulation.bodies.load != nullptr) {
        transfer.tank = &tank_received(simulation.bodies);
        transfer.particle_mass = simulation.layers.walls.particle_mass;
    }
    transfer.settling = plan.settling;
    const bool freely = !Solids || !simulation.layers.walls.active;
    if constexpr (Stored<Real>::coarse) {
        if (!WEIR_PARALLEL || !freely) {  // there is none for a second thread
            lend_scratch(simulation.pressure, simulation.layers.shape, transfer);
        }
    }
    prepare_gather(simulation.grid, work);
    if (work.once(1)) {
        simulation.grid.shape = simulation.layers.shape;
        simulation.max_speed = Real(0);
        simulation.gathered = simulation.particles.count;
        report.particles_stuck = 0;
    }
    if (freely) {
        gather_freely(simulation, transfer, work, report);
        clock.charge(Stage::grid_to_particle);
    }
    if constexpr (Solids) {
        ThinWalls<Real>& thin = simulation.layers.thin;
        if (!freely) {
            transfer.near = kLongWay<Real> / dt_s;
            transfer.keeps_places = true;
            if (simulation.layers.walls.thin != nullptr &&
                work.once(simulation.bodies.vertices_used + 1)) {
                follow_bodies(thin, simulation.bodies);
            }
            gather_among_solids(simulation, transfer, work, clock, report);
            clock.charge(Stage::collide);
        }
        if (kHasThinWalls<Real> && thin.capacity > 0 && work.once(simulation.bodies.capacity)) {
            forget_ways(thin, simulation.bodies);
        }
    }
}

}  // namespace weir
