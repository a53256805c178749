// What a step did. A step may not fail; what it had to clamp, refuse or remove stands here.
#pragma once

#include <cstdint>

namespace weir {

/// The stages of a substep, in the order in which they run.
enum class Stage : std::uint8_t {
    contour,           ///< bodies move, polygons are rasterized, cells are cut
    particle_to_grid,  ///< what part of the tank is worked on; scatter of mass and momentum
    grid_update,       ///< density, velocity = momentum / mass, gravity, viscosity
    pressure,          ///< projection or equation of state; faces in solids and tank walls
    volume,            ///< blend of FLIP and PIC; displacement towards uniform density
    grid_to_particle,  ///< gather of velocity, advection
    collide,           ///< inside test against the contour line, reflection
    count
};
inline constexpr std::int32_t kStageCount = static_cast<std::int32_t>(Stage::count);

/// Name of a stage as printed in tables. Never null.
const char* stage_name(Stage stage);

/// What was clamped. Bits, so that several can hold at once.
enum class Clamped : std::uint32_t {
    nothing = 0,
    time_step = 1U << 0U,      ///< dt was not finite, negative, below 1e-9 s, over 1 s or too long
                               ///< for max_substeps; 0 is none of these: a pause
    gravity = 1U << 1U,        ///< gravity was not finite (kept the last) or too strong (limited)
    speed = 1U << 2U,          ///< particles were limited to 2 cells a substep, or SmallFixed's
    sound_speed = 1U << 3U,    ///< the equation of state was softened to fit max_substeps
    not_finite = 1U << 4U,     ///< particles with a non-finite state were put to rest
    not_initialised = 1U << 5U,  ///< there is no world: nothing was done
    viscosity = 1U << 6U,      ///< the liquid was made thinner to fit max_substeps
    surface_tension = 1U << 7U,  ///< it was lowered to fit max_substeps
    body_speed = 1U << 8U,    ///< free bodies were limited to 2 cells a substep, also as they are
                              ///< moved apart, or stopped where their numbers led nowhere
};

/// The ladder of a deadline: what steps leave off to cost less. Rung 0: nothing. 1: half of the
/// pressure's sweeps. 2: three quarters of them. 3: also, every other step moving bodies stay where
/// they are drawn (`walls_held`). 4: also half of the substeps. 5: all substeps but one. With fewer
/// substeps less time passes: `dt_s` says how much. What is left is rounded up.
/// The sweeps are those of the definition, at least 4 (SmallFixed: 2, and 2 more on any rung). Of
/// the default 6 rung 1 makes 3, rungs 2 and 3 make 2, which saves only 7 to 9 % of a step. Who
/// wants these rungs asks for more sweeps (of 24 they save 20 and 28 %). Rungs 4 and 5 save most,
/// unless a step is one substep already, and are slow motion.
inline constexpr std::int32_t kRungs = 6;

/// What a step costs at most, whatever the state of the world: every cell full, every particle
/// that there is room for, every moving body moving. In units of `World::advance`.
struct WorkBound {
    std::int64_t substep[kStageCount] = {};  ///< per stage
    /// A world's very first substep, whose pressure starts from nothing.
    std::int64_t first_substep[kStageCount] = {};
    std::int32_t substeps = 0;  ///< of the step that was asked about, begun now; ≤ max_substeps
    std::int64_t step = 0;      ///< that step: all stages and substeps
    /// A slice of `advance(work)` does less than `work` and this.
    std::int32_t largest_item = 0;
};

struct StepReport {
    std::uint64_t ticks[kStageCount] = {};  ///< per stage, over all substeps; 0: no counter
    /// The same in units of `World::advance`, by which `World::work_bound` bounds them; no more
    /// than 2³² − 1 is told.
    std::uint32_t work[kStageCount] = {};
    std::int32_t substeps = 0;        ///< 0 while asleep
    std::uint32_t clamped = 0;        ///< set of Clamped bits
    /// Nothing moves, and steps do nothing until something is changed: a device may sleep.
    bool asleep = false;
    std::int32_t rung = 0;            ///< of the ladder, as asked for
    /// Bodies moved on as the liquid feels it, but were not drawn: with the next step they are
    /// where they would be. Not if one is free, was put elsewhere, or moves by over a cell a step,
    /// nor with Contour::mid_edge.
    bool walls_held = false;
    /// Time that was simulated, or slept: less than was asked for if `Clamped::time_step`. What
    /// goes by rates, as an inlet or an outlet does, goes by this.
    float dt_s = 0.0F;
    /// Of any particle along an axis, at the end; of what met a solid in the last substep as it was
    /// before. A speed is at most √2 times that.
    float max_speed_mps = 0.0F;
    std::int32_t particles = 0;       ///< alive at the end
    /// Of these, in regions that sleep (`World::let_regions_sleep`), or all in a world asleep.
    std::int32_t particles_asleep = 0;
    std::int32_t nodes_rasterized = 0;  ///< contour nodes computed anew; 0 if nothing moved
    std::int32_t particles_tested = 0;     ///< in a cell that a contour line crosses or fills
    std::int32_t particles_reflected = 0;  ///< found behind a contour line, or stopped before it
    std::int32_t particles_stuck = 0;  ///< inside a solid at the end, on their way out
    /// Removed because a solid left them no way out: none within 32 cells, or pressed by a moving
    /// body against another body or the tank.
    std::int32_t particles_removed_stuck = 0;
    /// Too far from the others for `Capacity::window_cells`, in the last substep: they fell alone.
    std::int32_t particles_beyond = 0;
    std::int32_t contacts_missed = 0;  ///< blows for which the contacts had no room
    /// Cells of groups of 4 × 4 that hold over 15 % too much at the end: a body leaves the liquid
    /// no room, as a piston in a full tank does. 0 without `volume_gain`, and where
    /// surface tension is over 16 cells² times gravity.
    std::int32_t cells_overfull = 0;
    /// In fixed point: how often a face left a particle out, as it held all that it can: 32
    /// particles in `World<SmallFixed>`, in `World<Fixed>` 16,384, or the momentum of
    /// 16,384 at 1 cell/s. The particle takes part in the liquid again where there is room.
    std::int32_t particles_crowded = 0;
    std::int32_t particles_reset = 0;      ///< non-finite: put to rest at the nearest valid place
    std::int32_t particles_slowed = 0;     ///< limited to 2 cells a substep
    std::int32_t bodies_slowed = 0;        ///< free bodies, the same

    constexpr bool has(Clamped what) const {
        return (clamped & static_cast<std::uint32_t>(what)) != 0U;
    }
};

}  // namespace weir
