// The arrays that a world's memory is made of: whose each is, what a snapshot keeps of it, and what
// an element takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "weir/contact.hpp"
#include "weir/parallel.hpp"
#include "weir/storage.hpp"

namespace weir {

/// Who uses a block, for the table of memory by owner.
enum class Owner : std::uint8_t {
    world,      ///< the world's own state and the step's report
    particles,  ///< positions, velocities, kinds and tags
    bodies,     ///< body table, contact events, forces
    vertices,   ///< polygons, their pose in the tank, their convex pieces
    contour,    ///< signed distance at nodes (static and merged), contour matrix
    cut_cells,  ///< open fractions of faces and cells
    thin_walls,  ///< edges of walls thinner than 1.5 cells
    grid,       ///< staggered momentum, velocity, mass and inverse density
    pressure,   ///< pressure, its right-hand side and diagonal, surface level
    count
};
inline constexpr std::int32_t kOwnerCount = static_cast<std::int32_t>(Owner::count);

/// Name of an owner as printed in tables. Never null.
const char* owner_name(Owner owner);

/// One array in the caller's memory.
enum class Block : std::uint8_t {
    world_state,
    particle_position,
    particle_velocity,
    particle_kind,
    particle_tag,
    body_table,
    contact,
    vertex_local,
    vertex_placed,
    piece_index,
    decomposition_scratch,
    body_load,
    body_push,
    body_meeting,
    body_lever,  ///< how free bodies push into cells, kept for a pressure solve; on desktops
    body_diagonal,
    static_distance,
    static_body,
    merged_distance,
    merged_body,
    contour_case,
    near_wall,  ///< a bit a cell
    open_u,
    open_v,
    full_density,
    wall_edge,
    wall_edge_of_cell,
    wall_mark,
    wall_span,
    wall_body,
    row_span,    ///< what of every four rows there is work to do for; on desktops
    velocity_u,  ///< a component's mass stands behind its velocity: the transfers pair them
    mass_u,      ///< then, once velocity is known, the velocity before the pressure
    velocity_v,
    mass_v,
    inverse_density_u,  ///< first the mass, where mass_u counts particles
    inverse_density_v,
    pressure,
    divergence,
    inverse_diagonal,
    density,
    level,
    coarse_cells,  ///< numbers for each cell of the pressure's coarse grid
    coarse_cut,    ///< what walls cut off from them
    regions,       ///< what is known of sleeping regions, in one record
    region_tile,   ///< for each 4 × 4 cells the number of the region that sleeps there
    kept_pressure,  ///< of sleeping liquid
    kept_density,
    count
};
inline constexpr std::int32_t kBlockCount = static_cast<std::int32_t>(Block::count);

/// What a snapshot keeps of a block.
enum class Kept : std::uint8_t {
    nothing,    ///< scratch: each step writes it before it reads it
    redrawn,    ///< follows, to the bit, from what is kept: computed again where that is other
    members,    ///< single members, listed in world/snapshot_members.hpp
    whole,      ///< all of it
    particles,  ///< as much as there are particles
    vertices,   ///< as much as there are vertices
};

/// Cells that can be asked for room at a time: what is added beneath the surface elsewhere joins
/// one that is near. Not in packed worlds.
inline constexpr std::int32_t kMostInlets = 8;

/// Microsoft's compilers give members that are empty a place, too.
#if defined(_MSC_VER)
inline constexpr std::size_t kEmptyMemberBytes = 32;
#else
inline constexpr std::size_t kEmptyMemberBytes = 0;
#endif
/// Room for records whose types are private; checked by static_assert where they are defined.
template <class Real>
inline constexpr std::size_t kWorldStateBytes =
    kEmptyMemberBytes +
    (sizeof(Real) == 4
        ? (sizeof(void*) == 4 ? (WEIR_PARALLEL ? 952 : 912) : 1312) +
              (std::is_same_v<Real, Fixed> ? 24 : 0) +
              (std::is_same_v<Real, SmallFixed> ? 0 : 72 + 5 * sizeof(void*))
        : 1696);
template <class Real>
inline constexpr std::size_t kBodyBytes = sizeof(Real) == 4 ? 116 : 176;
inline constexpr std::size_t kWallEdgeBytes = 16;
inline constexpr std::size_t kRowSpanBytes = 24;
inline constexpr std::size_t kCutOffBytes = 6;
template <class Real>
inline constexpr std::size_t kThinBodyBytes = 16 + 2 * sizeof(Real);
template <class Real>
inline constexpr std::size_t kBodyLoadBytes = sizeof(Real) == 4 ? 120 : 240;
template <class Real>
inline constexpr std::size_t kMeetingBytes = sizeof(Real) == 4 ? 108 : 208;
/// How a body pushes into its cells, where there is room to keep it: for some 50 cells a body.
template <class Real>
inline constexpr std::size_t kLeverBytes = sizeof(Real) == 4 ? 4096 : 8192;
/// What is kept of each until the next substep.
template <class Real>
inline constexpr std::size_t kPushBytes = sizeof(Real) == 4 ? 24 : 48;
template <class Real>
inline constexpr std::size_t kRegionsBytes = sizeof(Real) == 4 ? 144 : 160;

namespace detail {
/// What is the same of a block whatever the capacity.
struct BlockKind {
    Owner owner;
    Kept kept;
    std::uint16_t element_bytes;
};

/// Fields of the solver that share the grid's memory in packed worlds.
template <class Real>
inline constexpr std::uint16_t kSolverBytes = Stored<Real>::shares_momentum ? 0 : sizeof(Real);

/// In the order of `Block`.
template <class Real>
inline constexpr BlockKind kBlockKinds[kBlockCount] = {
    {Owner::world, Kept::members, kWorldStateBytes<Real>},
    {Owner::particles, Kept::particles, 2 * sizeof(PositionOf<Real>)},
    {Owner::particles, Kept::particles, 2 * sizeof(VelocityOf<Real>)},
    {Owner::particles, Kept::particles, 1}, {Owner::particles, Kept::particles, 1},
    {Owner::bodies, Kept::members, kBodyBytes<Real>},
    {Owner::bodies, Kept::nothing, sizeof(Contact)},
    {Owner::vertices, Kept::vertices, 2 * sizeof(Real)},
    {Owner::vertices, Kept::redrawn, 2 * sizeof(Real)},
    {Owner::vertices, Kept::vertices, sizeof(std::uint16_t)},  // pieces: of as many as there may be
    {Owner::vertices, Kept::nothing, sizeof(std::uint16_t)},
    {Owner::bodies, Kept::whole, kBodyLoadBytes<Real>},
    {Owner::bodies, Kept::whole, kPushBytes<Real>},
    {Owner::bodies, Kept::nothing, kMeetingBytes<Real>},
    {Owner::bodies, Kept::nothing, kLeverBytes<Real>},
    {Owner::bodies, Kept::nothing, kSolverBytes<Real>},
    {Owner::contour, Kept::redrawn, sizeof(DistanceOf<Real>)},
    {Owner::contour, Kept::redrawn, sizeof(SlotOf<Real>)},
    {Owner::contour, Kept::redrawn, sizeof(DistanceOf<Real>)},
    {Owner::contour, Kept::redrawn, sizeof(SlotOf<Real>)},
    {Owner::contour, Kept::redrawn, 1},
    {Owner::contour, Kept::redrawn, sizeof(std::uint32_t)},
    {Owner::cut_cells, Kept::redrawn, sizeof(ShareOf<Real>)},
    {Owner::cut_cells, Kept::redrawn, sizeof(ShareOf<Real>)},
    {Owner::cut_cells, Kept::redrawn, sizeof(ShareOf<Real>)},
    {Owner::thin_walls, Kept::redrawn, kWallEdgeBytes},
    {Owner::thin_walls, Kept::redrawn, sizeof(std::uint16_t)},
    {Owner::thin_walls, Kept::redrawn, 1},
    {Owner::thin_walls, Kept::redrawn, sizeof(std::uint16_t)},
    {Owner::thin_walls, Kept::redrawn, kThinBodyBytes<Real>},
    {Owner::grid, Kept::nothing, kRowSpanBytes},
    {Owner::grid, Kept::nothing, sizeof(Real)},
    {Owner::grid, Kept::nothing, sizeof(VelocityOf<Real>)},
    {Owner::grid, Kept::nothing, sizeof(Real)},
    {Owner::grid, Kept::nothing, sizeof(VelocityOf<Real>)},
    {Owner::grid, Kept::nothing, sizeof(VelocityOf<Real>)},
    {Owner::grid, Kept::nothing, sizeof(VelocityOf<Real>)},
    {Owner::pressure, Kept::whole, sizeof(Real)},
    {Owner::pressure, Kept::nothing, kSolverBytes<Real>},
    {Owner::pressure, Kept::nothing, kSolverBytes<Real>},
    {Owner::pressure, Kept::nothing, sizeof(DensityOf<Real>)},
    {Owner::pressure, Kept::nothing, sizeof(LevelOf<Real>)},
    {Owner::pressure, Kept::nothing, sizeof(Real)},
    {Owner::pressure, Kept::nothing, kCutOffBytes},
    {Owner::world, Kept::members, kRegionsBytes<Real>},
    {Owner::world, Kept::whole, 1},
    {Owner::pressure, Kept::whole, sizeof(Real)},
    {Owner::pressure, Kept::whole, sizeof(DensityOf<Real>)},
};
}  // namespace detail

}  // namespace weir
