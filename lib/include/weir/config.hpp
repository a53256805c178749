// What a world is made of. Each field: meaning, unit, range, and why the default is what it is.
#pragma once

#include <cstdint>

#include "weir/parallel.hpp"
#include "weir/types.hpp"

namespace weir {

/// Limits of the smallest and the largest world. They keep every index within 32 bits.
inline constexpr std::int32_t kMinCells = 4;
inline constexpr std::int32_t kMaxCells = 8192;
inline constexpr std::int32_t kMaxParticles = 16 * 1024 * 1024;
inline constexpr std::int32_t kMaxBodies = 4096;
inline constexpr std::int32_t kMaxVertices = 1024 * 1024;
inline constexpr std::int32_t kMaxWallEdges = 65000;
inline constexpr std::int32_t kMaxBodyVertices = 16 * 1024;

/// Strongest gravity along an axis, m/s²: no sensor on a device feels more than 100 g. Of more
/// `World::init` refuses the definition; `World::set_gravity` limits it, and a report says so.
inline constexpr float kMaxGravity = 1000.0F;
/// Faster liquid or bodies than this are refused, cells/s.
inline constexpr float kMaxSpeed = 1.0e6F;
/// Angles of bodies beyond this are refused, rad; faster spin too, rad/s.
inline constexpr float kMaxAngle = 1.0e4F;

/// What fixed point bears: cells along an axis, speeds in cells/s, gravity in cells/s², surface
/// tension in cells³/s² (water's on cells of 1.35 mm and above), places of bodies in cells from the
/// tank's origin. Beyond it set-up calls refuse, and `set_gravity` limits.
inline constexpr std::int32_t kMaxCellsFixed = 256;
inline constexpr std::int32_t kMaxCellsSmallFixed = 255;
inline constexpr std::int32_t kMaxBodiesSmallFixed = 255;
inline constexpr float kMaxSpeedFixed = 16000.0F;
inline constexpr float kMaxSpeedSmallFixed = 255.0F;  ///< unless `top_speed_mps` says otherwise
/// Highest top speed that a definition may promise in SmallFixed, cells/s.
inline constexpr float kMaxTopSpeedSmallFixed = 2040.0F;
inline constexpr float kMaxGravityFixed = 30000.0F;
inline constexpr float kMaxTensionFixed = 30000.0F;
inline constexpr float kFurthestFixed = 16000.0F;

/// How much of everything a world can ever hold. Memory is a function of this alone.
struct Capacity {
    std::int32_t particles = 1000;  ///< 1 … kMaxParticles
    std::int32_t cells_x = 32;      ///< kMinCells … kMaxCells; the tank is cells_x × cells_y cells
    std::int32_t cells_y = 32;      ///< kMinCells … kMaxCells
    std::int32_t bodies = 0;        ///< 0 … kMaxBodies, static and moving together
    /// false: static ones only, and 6 bytes less a cell (double: 10, SmallFixed: 3, of one body 2).
    bool moving_bodies = true;
    std::int32_t vertices = 0;      ///< 0 … kMaxVertices, of all bodies; and 3 a hole
    /// Walls thinner than 1.5 cells: room for their edges, 0 … kMaxWallEdges, about 3 for each cell
    /// of their length and 6 for each edge. Near such walls particles and faces go one by one: 1.2
    /// to 1.6 times the time on a desktop, 2.7 in a small tank that one goes through. Not of free
    /// bodies, which would not be pushed back. 0: none; then walls that stand still are tight from
    /// 1.05 cells on, at any angle and speed, and have holes below one. Walls that move are tight
    /// from 1.5 on; below 1.75 one particle in 100,000 may pass where liquid is pressed against the
    /// tank.
    std::int32_t wall_edges = 0;
    /// 0 … kMaxBodies: contacts that a step can report, of a body with the liquid, of a free one
    /// with another or with the tank.
    std::int32_t contacts = 0;
    /// Room and time for what liquid does to bodies and tank: `World::force`, `add_free_body`
    /// (in SmallFixed forces alone: there are no free bodies).
    bool two_way = false;
    bool second_liquid = false;     ///< room for two liquids: a byte a particle, 2 numbers a cell
    bool particle_tags = false;     ///< a byte of the caller's with each particle: dye, an owner
    /// Room for `World::let_regions_sleep`: 8 bytes a cell (double: 16, SmallFixed: 5). Not with
    /// `two_way`, `window_cells` or periodic borders.
    bool sleeping_regions = false;
    /// Of a huge tank store only so many cells, a window around the liquid; 0, or as many as the
    /// tank has: all of it. The window has to hold the rectangle around all particles and 4 cells
    /// more on each side, out to multiples of 32 columns and 8 rows, and a ring around that: at
    /// least 66 × 18 cells; of a periodic axis the whole length. With room for bodies it is a cell
    /// larger above and on the right, at least 66 × 26. While it suffices no bit is different.
    /// If it does not, its sides with the fewest particles are cut off. Particles beyond it fall
    /// alone: they meet the tank's walls and the bodies, but no other particle, and change places
    /// in the views, until they are within reach again; `StepReport::particles_beyond` counts
    /// them. A pool beyond it falls flat for good: a level of many pools that all matter wants
    /// `sleeping_regions` instead. A particle that a body buries there stays in it and goes along.
    /// Beside bodies a particle beyond takes several times as long as one within, which its unit of
    /// work (`WorkBound`) does not tell. Not with thin walls or `two_way`, nor in SmallFixed.
    std::int32_t window_cells = 0;
};

/// How the liquid keeps its volume within a substep.
enum class Pressure : std::uint8_t {
    projection,         ///< implicit, incompressible: the default, large steps, quiet at rest
    equation_of_state,  ///< explicit, weakly compressible: simple, small steps
};

/// Where a solid's contour line runs within a cell.
enum class Contour : std::uint8_t {
    interpolated,  ///< where the exact signed distance is zero: straight walls are exact
    mid_edge,      ///< through the middle of cell edges, from the binary matrix: as in the paper
};

/// Which of the two liquids of a tank a particle belongs to.
enum class Liquid : std::uint8_t { first, second };
/// Which liquids a call is about.
enum class Liquids : std::uint8_t { all, first, second };

/// A free-running counter, any unit, never decreasing. Null: the report's ticks stay 0.
using TickFunction = std::uint64_t (*)();

/// How a solid's surface answers liquid: friction for what hits it, sticking for what is viscous.
struct Surface {
    float restitution = 0.0F;  ///< normal velocity given back: 0 (slide along) … 1 (mirror)
    /// Coulomb: a blow takes at most this times its normal part along the surface; 0 … 1000
    float friction = 0.0F;
    /// Viscous liquid sticks. It means nothing without viscosity, nor, without
    /// `Capacity::wall_edges`, on bodies thinner than a cell.
    bool no_slip = false;
    /// Of the surface along itself, as of a belt, m/s: counter-clockwise about the body, or about
    /// the tank. It shows where there is friction, or viscosity and no slip.
    float conveyor_mps = 0.0F;
};

/// Surfaces of the tank's own walls.
struct TankWalls {
    Surface bottom;
    Surface right;
    Surface top;
    Surface left;
};

/// The same surface all around.
constexpr TankWalls every_wall(const Surface& surface) {
    return {surface, surface, surface, surface};
}

/// When a world may stop: once nothing in it was faster for that long, its steps do nothing, at
/// next to no cost, until gravity, viscosity, a wall, a body or a particle is changed.
/// `StepReport::asleep` tells. Liquid that lies apart sleeps by itself after
/// `World::let_regions_sleep`.
struct Sleep {
    /// Of any particle along an axis, and of any free body, m/s; 0 (never sleeps) … kMaxSpeed
    /// cells/s. Water without viscosity is long in calming down: try 0.02 √(gh), h the depth, and
    /// 0.05 in SmallFixed, where the tank may lean.
    float speed_mps = 0.0F;
    /// s; 0.1 … 1000. Longer than half a period of the tank's waves: at its highest a wave stands.
    float after_s = 1.0F;
    /// Gravity may change by this and wake nobody, each part; 0 … kMaxGravity. A sensor's noise.
    float gravity_mps2 = 0.0F;
};

/// Everything that `World::init` wants to know. The defaults work for water in a tank.
struct WorldDef {
    Capacity capacity;

    float cell_m = 0.02F;               ///< edge of a cell, m; 1e-6 … 1e3
    /// Each part at most kMaxGravity: more is refused here, and limited in `World::set_gravity`.
    /// Worlds defined without any, nor surface tension, take 1.7 times a step's instructions in
    /// float while there is none, and err less than half as much.
    Vec2f gravity_mps2{0.0F, -9.81F};

    /// What nothing is meant to be faster than along an axis, m/s; 0: 255 cells/s, or as many as
    /// kMaxTopSpeedSmallFixed. SmallFixed keeps velocities in 16 bits, up to 255, 127.5, 63.75 …
    /// cells/s, whichever is enough, down to 1: the slower, the finer. A 32,768th of it is the last
    /// digit, and liquid should move at some hundreds of those. Liquid that gets faster is limited,
    /// and the report says so; bodies are refused. Gravity may be 0.46 top² / cell_m at least.
    /// SmallFixed wants a top speed on cells of 5 mm and below, where 255 of them are 1.3 m/s, in
    /// whatever is shaken, on larger cells too, and wherever steps report `Clamped::speed`: about
    /// 2 √(2gh), h the tank's height, g the strongest pull. Other arithmetic has no need of it.
    float top_speed_mps = 0.0F;

    std::int32_t particles_per_cell = 4;  ///< at rest: 1, 4, 9 or 16. 4 is a 2×2 lattice

    Pressure pressure = Pressure::projection;
    Contour contour = Contour::interpolated;

    /// Red-black relaxation sweeps per substep, after one correction on cells four times as large;
    /// 1 … 1000, of which 4 are always made: after fewer, energy might rise. What is left of the
    /// divergence falls to a fiftieth with 6, a sixteenth with 4. `SmallFixed` makes two more in
    /// place of that correction, 4 at least, and where liquid is over 24 cells deep more: 5 at 40
    /// cells, 18 at 64, 82 at 128, along the axis that gravity pulls along more. Only the ladder's
    /// rungs (`kRungs`) make fewer.
    std::int32_t pressure_sweeps = 6;

    /// Longest way of a particle within one substep, cells; 0.1 … 2. The step is cut accordingly,
    /// and at rest so that gravity · dt² is at most 0.12 cells in each part of it: on cells of 2 cm
    /// a 64th of a second is one substep, a 60th two.
    float cfl = 1.0F;
    /// Most substeps per step; 1 … 1000. Beyond it speeds are limited, and the report says so.
    std::int32_t max_substeps = 16;

    /// Share of the particle's own velocity kept, against the grid's; 0 (PIC: viscous, smooth)
    /// … 1 (FLIP: lively, noisy). 0.97 loses about 1 % of a wave per period. Of each substep: slow
    /// motion has more of them a second and is thicker (a dam that keeps 0.94 of its energy for a
    /// second at steps of 1/60 s keeps 0.89 at 1/2000). More counts as 0.97 with an equation of
    /// state: noise would gain energy.
    float flip_ratio = 0.97F;

    /// Strength of the drift towards uniform particle density; 0 (off) … 1.
    float volume_gain = 0.15F;

    /// Equation of state only: speed of sound, m/s; 0 = 10 times the speed of a fall through the
    /// whole tank, which keeps the density within about 1 %. By this definition's gravity, or by
    /// 9.81 m/s² along y if it has none.
    float sound_speed_mps = 0.0F;

    /// Kinematic shear viscosity, m²/s; 0 (not computed) … 1e6 cells²/s. Water has 1e-6, which no
    /// grid of centimetres can see; honey has 7e-3. Explicit: much of it costs substeps, any of it
    /// twice a step's instructions in float. What is not 0 here may become anything later, 0 too
    /// (`World::set_viscosity`).
    float viscosity_m2ps = 0.0F;

    /// Surface tension over density, m³/s²; 0 (not computed) … 1e12 cells³/s², in Fixed
    /// kMaxTensionFixed. Water has 7.3e-5, which shows on cells of a few millimetres and below.
    /// Solids and walls are met at a right angle. Explicit: on small cells it costs substeps. With
    /// Pressure::projection only. What is not 0 may change (`World::set_surface_tension`).
    float surface_tension_m3ps2 = 0.0F;

    /// Density of the second liquid over that of the first; 0.01 … 100. Only with
    /// `capacity.second_liquid`, and with Pressure::projection. Unlike densities want more sweeps.
    /// Poured into 30 cells of water, 0.8 rises to the top within 20 s, 0.9 within 80. In Fixed,
    /// whose pressures have less room, let the first be the heavier one if it is over ten times as
    /// heavy: 20 cells of a second liquid that is 100 times as heavy lose their height.
    float second_density_ratio = 1.0F;

    TankWalls walls;  ///< may change (`World::set_walls`)

    Sleep sleep;

    /// What leaves the tank on one side enters it on the other. Such a world holds no bodies, and
    /// an even number of cells along that axis.
    bool periodic_x = false;
    bool periodic_y = false;

    /// Puts particles in the order of the grid's rows whenever they are too mixed: they keep no
    /// place in the views then. Worth it on processors with a cache and some 100,000 particles.
    bool keep_sorted = false;

    TickFunction ticks = nullptr;

    /// Who shares out a step's work to several threads; null: all is done by the caller's. The bits
    /// are the same for any number of threads, and for none. Worth it from some 20,000 particles.
    ParallelFor parallel_for = nullptr;
};

/// Where a body is and how it moves. Set once, it goes on: each step adds velocity and spin.
/// Each substep rounds where that leads, in fixed point to 65,536ths of a cell and of a radian, in
/// float to 24 bits. What creeps goes faster or slower than told by as much as half of that a
/// substep, and less than half stands still: at 120 substeps a second 0.0009 cells/s and rad/s in
/// fixed point, 4,096 cells from the origin in float 0.03 cells/s. Clocks, and what creeps, are led
/// (`World::move_body`): what one step rounds the next one knows.
struct Motion {
    Vec2f position_m;          ///< of the body's own origin, in the tank
    float angle_rad = 0.0F;    ///< counter-clockwise; |angle| ≤ 1e4
    Vec2f velocity_mps;        ///< of the body's own origin
    float spin_radps = 0.0F;   ///< counter-clockwise
};

/// What holds a free body. A velocity that is held stays as told (`Motion`): of a hinge that of the
/// origin, of the others that of the centre of mass.
enum class Hold : std::uint8_t {
    none,     ///< it moves and turns
    hinge,    ///< it turns about its origin: a water wheel, a flap, a seesaw
    rail_x,   ///< it goes along x and does not turn
    rail_y,   ///< along y: a lift, a float in a shaft
    upright,  ///< it moves and does not turn
};

/// A solid: a simple polygon, with holes or without, given in the body's own frame.
struct BodyDef {
    /// Outer ring, m: an array, or pointer and number; 3 … kMaxBodyVertices vertices, holes
    /// included and 3 more for each; either way round. Copied, without repeated vertices and
    /// straight corners.
    View<Vec2f> polygon;
    /// `polygon` is an open polyline, 2 … kMaxBodyVertices vertices, without holes: a wall of no
    /// thickness with liquid on both sides. It may cross itself. Wants `capacity.wall_edges`.
    bool open = false;
    View<View<Vec2f>> holes;   ///< rings inside it, none in another; either way round; copied
    Motion motion;             ///< a static body takes only position and angle
    Surface surface;
    /// Of the body over the first liquid's, for `add_free_body` and `mass`; 1e-3 … 1e3.
    float density_ratio = 0.5F;
    Hold hold = Hold::none;    ///< for `add_free_body`
};

}  // namespace weir
