// The memory of a world: a sum of blocks, each with an owner, known at compile time.
//
// `layout` is the only place that says what is stored: `world_bytes` adds it up, `World::init`
// carves along it, a snapshot takes from it what it keeps, and the tables that people read are
// printed from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "weir/config.hpp"
#include "weir/parallel.hpp"
#include "weir/storage.hpp"
#include "weir/contact.hpp"

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

/// The caller's memory must start at a multiple of this.
inline constexpr std::size_t world_alignment = 16;

/// Room for records whose types are private; checked by static_assert where they are defined.
template <class Real>
inline constexpr std::size_t kWorldStateBytes =
    sizeof(Real) == 4
        ? (sizeof(void*) == 4 ? (WEIR_PARALLEL ? 928 : 912) + (std::is_same_v<Real, Fixed> ? 16 : 0)
                              : 1264 + (std::is_same_v<Real, SmallFixed> ? 0 : 16))
        : 1504;
template <class Real>
inline constexpr std::size_t kBodyBytes = sizeof(Real) == 4 ? 116 : 176;
inline constexpr std::size_t kWallEdgeBytes = 16;
template <class Real>
inline constexpr std::size_t kThinBodyBytes = 16 + 2 * sizeof(Real);
template <class Real>
inline constexpr std::size_t kBodyLoadBytes = sizeof(Real) == 4 ? 120 : 240;
/// Records for so many bodies, for the tank, and in fixed point for the ledger in whole numbers.
template <class Real>
inline constexpr std::int32_t kLedgerRecords = std::is_floating_point_v<Real> ? 0 : 1;
template <class Real>
constexpr std::int32_t load_records(std::int32_t bodies) {
    return bodies + 1 + kLedgerRecords<Real>;
}
/// Points at which free bodies are before something, for each body, and one more for their number.
inline constexpr std::int32_t kMeetingsPerBody = 6;
template <class Real>
inline constexpr std::size_t kMeetingBytes = sizeof(Real) == 4 ? 96 : 176;
/// How a body pushes into its cells, where there is room to keep it: for some 60 cells a body.
template <class Real>
inline constexpr std::size_t kLeverBytes = sizeof(Real) == 4 ? 4096 : 8192;
/// What is kept of each until the next substep.
template <class Real>
inline constexpr std::size_t kPushBytes = sizeof(Real) == 4 ? 24 : 48;
template <class Real>
inline constexpr std::size_t kRegionsBytes = sizeof(Real) == 4 ? 144 : 160;

/// The pressure's coarse grid: cells along an edge of its cells, and numbers for each of them.
inline constexpr std::int32_t kCoarseEdge = 4;
inline constexpr std::int32_t kCoarseFields = 7;
inline constexpr std::int32_t kCoarseFieldsOfTwoLiquids = 9;
inline constexpr std::int32_t kCoarseFieldsPacked = 2;  ///< SmallFixed: for the volume only

/// Coarse cells along an axis of so many cells.
constexpr std::int32_t coarse_cells(std::int32_t cells) {
    return (cells + kCoarseEdge - 1) / kCoarseEdge;
}

/// Parts of the tank begin at multiples of these: words of the bits of cells beside walls, and
/// pairs of cells of the coarse grid, which is relaxed by colours as the fine one is. Windows also
/// end there, or with the tank.
inline constexpr std::int32_t kWindowColumns = 32;
inline constexpr std::int32_t kWindowRows = 2 * kCoarseEdge;

/// Regions that sleep are known by tiles of so many cells along an edge.
inline constexpr std::int32_t kTileEdge = kCoarseEdge;

/// No part is lower: a particle's row, and a margin on one side at least.
inline constexpr std::int32_t kLeastPart = 5;

/// Entries of an array of so many cells and a ring of ghost cells around them.
constexpr std::int32_t entries_of(std::int32_t columns, std::int32_t rows) {
    return (columns + 2) * (rows + 2);
}

/// Whether only the cells around the liquid are stored.
constexpr bool is_windowed(const Capacity& capacity) {
    return capacity.window_cells > 0 &&
           capacity.window_cells < entries_of(capacity.cells_x, capacity.cells_y);
}

/// Calls visit(columns, rows) for every width that a window can have, and the most rows then.
template <class Visit>
constexpr void for_each_window(const Capacity& capacity, Visit visit) {
    const std::int32_t rest = capacity.cells_x % kWindowColumns;
    for (std::int32_t whole = 0; whole <= capacity.cells_x; whole += kWindowColumns) {
        const std::int32_t widths[] = {whole, whole + rest};
        for (const std::int32_t columns : widths) {
            const std::int32_t rows = capacity.window_cells / (columns + 2) - 2;
            if (columns > 0 && columns <= capacity.cells_x &&
                (rows >= kLeastPart || rows >= capacity.cells_y)) {
                visit(columns, rows < capacity.cells_y ? rows : capacity.cells_y);
            }
        }
    }
}

/// Entries of the arrays of cells, faces and nodes. Packed worlds store all of the tank.
template <class Real>
constexpr std::int32_t cell_entries(const Capacity& capacity) {
    return !Stored<Real>::shares_momentum && is_windowed(capacity)
               ? capacity.window_cells
               : entries_of(capacity.cells_x, capacity.cells_y);
}

/// Entries of an array of the coarse grid.
template <class Real>
constexpr std::int32_t coarse_entries(const Capacity& capacity) {
    if (Stored<Real>::shares_momentum || !is_windowed(capacity)) {
        return entries_of(coarse_cells(capacity.cells_x), coarse_cells(capacity.cells_y));
    }
    std::int32_t most = 0;
    for_each_window(capacity, [&](std::int32_t columns, std::int32_t rows) {
        const std::int32_t entries = entries_of(coarse_cells(columns), coarse_cells(rows));
        most = most < entries ? entries : most;
    });
    return most;
}

inline constexpr std::size_t kRowSpanBytes = 24;
/// In narrower parts of the tank rows are always worked on from end to end, columns.
inline constexpr std::int32_t kLeastSpanned = 128;
/// Loops in lanes pass over empty ends of rows, in float worlds that store the whole tank.
template <class Real>
constexpr std::int32_t row_spans(const Capacity& capacity) {
    return WEIR_PARALLEL && std::is_same_v<Real, float> && !is_windowed(capacity) &&
                   capacity.cells_x >= kLeastSpanned
               ? coarse_cells(capacity.cells_y)
               : 0;
}

/// Words with a bit a cell.
template <class Real>
constexpr std::int32_t near_entries(const Capacity& capacity) {
    if (Stored<Real>::shares_momentum || !is_windowed(capacity)) {
        return (capacity.cells_x + 31) / 32 * capacity.cells_y;
    }
    std::int32_t most = 0;
    for_each_window(capacity, [&](std::int32_t columns, std::int32_t rows) {
        const std::int32_t entries = (columns + 31) / 32 * rows;
        most = most < entries ? entries : most;
    });
    return most;
}

/// Longest list of pieces: a triangle per vertex, each a count and three vertex numbers.
inline constexpr std::size_t kPieceIndicesPerVertex = 4;
/// Scratch of the decomposition into pieces, numbers.
inline constexpr std::size_t kScratchPerVertex = 5;
/// Whether polygons are cut into convex pieces: free bodies meet others piece by piece. What else a
/// step asks outlines tell.
template <class Real>
constexpr bool keeps_pieces(const Capacity& capacity) {
    return capacity.two_way && !Stored<Real>::shares_momentum;
}
/// Of a vertex: its room for pieces, or for the ends of rings that would stand behind them.
template <class Real>
constexpr std::size_t piece_bytes(const Capacity& capacity) {
    return (keeps_pieces<Real>(capacity) ? kPieceIndicesPerVertex : 1) * sizeof(std::uint16_t);
}
/// What a hole takes besides its vertices: its bridge to the outer ring doubles two of them, and
/// one more place keeps the hole's end.
inline constexpr std::int32_t kPlacesPerHole = 3;

struct Layout {
    std::size_t offset[kBlockCount] = {};
    std::size_t bytes[kBlockCount] = {};
    std::size_t owner_bytes[kOwnerCount] = {};
    std::size_t total_bytes = 0;
    std::uint16_t element_bytes[kBlockCount] = {};
    Kept kept[kBlockCount] = {};
};

namespace detail {
/// Bytes that so many elements take: what stands behind them is aligned, too.
constexpr std::size_t block_bytes(std::size_t element_bytes, std::size_t elements) {
    return (element_bytes * elements + world_alignment - 1) / world_alignment * world_alignment;
}

/// Behind those that were placed before.
constexpr void place(Block block, Owner owner, Kept kept, std::size_t element_bytes,
                     std::size_t elements, Layout& result) {
    const std::size_t bytes = block_bytes(element_bytes, elements);
    const auto slot = static_cast<std::size_t>(block);
    result.offset[slot] = result.total_bytes;
    result.bytes[slot] = bytes;
    result.element_bytes[slot] = static_cast<std::uint16_t>(element_bytes);
    result.kept[slot] = kept;
    result.owner_bytes[static_cast<std::size_t>(owner)] += bytes;
    const std::size_t left = ~std::size_t{0} - result.total_bytes;  // more has no memory
    result.total_bytes += bytes < left ? bytes : left;
}

/// Where free bodies meet something. In packed worlds there are none.
template <class Real>
constexpr void place_meetings(const Capacity& capacity, Layout& result) {
    const bool free_bodies = capacity.two_way && !Stored<Real>::shares_momentum;
    const std::int32_t room = free_bodies ? 1 + kMeetingsPerBody * capacity.bodies : 0;
    const auto elements = static_cast<std::size_t>(room);
    place(Block::body_push, Owner::bodies, Kept::whole, kPushBytes<Real>, elements, result);
    place(Block::body_meeting, Owner::bodies, Kept::nothing, kMeetingBytes<Real>, elements, result);
    place(Block::body_lever, Owner::bodies, Kept::nothing, kLeverBytes<Real>,
          static_cast<std::size_t>(WEIR_PARALLEL && free_bodies ? capacity.bodies : 0), result);
}
}  // namespace detail

/// Numbers of the pressure's coarse grid, for each of its cells.
template <class Real>
constexpr std::int32_t coarse_fields_of(const Capacity& capacity) {
    return Stored<Real>::shares_momentum
               ? kCoarseFieldsPacked
               : (capacity.second_liquid ? kCoarseFieldsOfTwoLiquids : kCoarseFields);
}

/// Nodes have room for the name of the nearest body. One body alone needs none in a packed world:
/// the distance tells.
template <class Real>
constexpr bool keeps_names(const Capacity& capacity) {
    return !Stored<Real>::shares_momentum || capacity.bodies > 1;
}

/// Places every block of a world of that capacity. Pure; the same on every machine.
template <class Real>
constexpr Layout layout(const Capacity& capacity) {
    const auto count = [](std::int32_t value) { return static_cast<std::size_t>(value); };
    const std::size_t particles = count(capacity.particles), vertices = count(capacity.vertices);
    // One ring of ghost cells on each side; nodes and faces share the cells' numbering.
    const std::size_t cells = count(cell_entries<Real>(capacity));
    const std::size_t coarse = count(coarse_entries<Real>(capacity));
    const std::size_t coarse_fields = count(coarse_fields_of<Real>(capacity));
    const std::size_t solid_cells = capacity.bodies > 0 ? cells : 0;
    const std::size_t moving_cells = capacity.moving_bodies ? solid_cells : 0;
    const std::size_t named_cells = keeps_names<Real>(capacity) ? solid_cells : 0;
    const std::size_t named_moving = keeps_names<Real>(capacity) ? moving_cells : 0;
    const std::size_t near_words = capacity.bodies > 0 ? count(near_entries<Real>(capacity)) : 0;
    const std::size_t wall_edges = capacity.bodies > 0 ? count(capacity.wall_edges) : 0;
    const std::size_t thin = wall_edges > 0 ? 1 : 0, bodies = count(capacity.bodies);
    const std::size_t loads = capacity.two_way ? count(load_records<Real>(capacity.bodies)) : 0;
    const std::size_t mixed_cells = capacity.second_liquid ? cells : 0,
                      kept_cells = capacity.sleeping_regions ? cells : 0;
    const std::size_t tiles = capacity.sleeping_regions ? count(coarse_cells(capacity.cells_x)) *
                                                              count(coarse_cells(capacity.cells_y))
                                                        : 0;
    const std::size_t point = 2 * sizeof(Real), index = sizeof(std::uint16_t);
    const std::size_t scratch = Stored<Real>::shares_momentum ? 0 : sizeof(Real);
    const std::size_t speed = sizeof(VelocityOf<Real>), distance = sizeof(DistanceOf<Real>);
    const std::size_t share = sizeof(ShareOf<Real>), spans = count(row_spans<Real>(capacity));
    Layout result;
    const auto add = [&result](Block block, Owner owner, Kept kept, std::size_t element_bytes,
                               std::size_t elements) {
        detail::place(block, owner, kept, element_bytes, elements, result);
    };
    add(Block::world_state, Owner::world, Kept::members, kWorldStateBytes<Real>, 1);
    add(Block::particle_position, Owner::particles, Kept::particles, 2 * sizeof(PositionOf<Real>),
        particles);
    add(Block::particle_velocity, Owner::particles, Kept::particles, 2 * speed, particles);
    const auto if_any = [particles](bool any) { return any ? particles : 0; };
    add(Block::particle_kind, Owner::particles, Kept::particles, 1, if_any(capacity.second_liquid));
    add(Block::particle_tag, Owner::particles, Kept::particles, 1, if_any(capacity.particle_tags));
    add(Block::body_table, Owner::bodies, Kept::members, kBodyBytes<Real>, bodies);
    add(Block::contact, Owner::bodies, Kept::nothing, sizeof(Contact), count(capacity.contacts));
    add(Block::vertex_local, Owner::vertices, Kept::vertices, point, vertices);
    add(Block::vertex_placed, Owner::vertices, Kept::redrawn, point, vertices);
    add(Block::piece_index, Owner::vertices, Kept::vertices, piece_bytes<Real>(capacity), vertices);
    add(Block::decomposition_scratch, Owner::vertices, Kept::nothing, index,
        keeps_pieces<Real>(capacity) ? kScratchPerVertex * vertices : 0);
    add(Block::body_load, Owner::bodies, Kept::whole, kBodyLoadBytes<Real>, loads);
    detail::place_meetings<Real>(capacity, result);
    add(Block::body_diagonal, Owner::bodies, Kept::nothing, scratch, loads > 0 ? moving_cells : 0);
    add(Block::static_distance, Owner::contour, Kept::redrawn, distance, moving_cells);
    add(Block::static_body, Owner::contour, Kept::redrawn, sizeof(SlotOf<Real>), named_moving);
    add(Block::merged_distance, Owner::contour, Kept::redrawn, distance, solid_cells);
    add(Block::merged_body, Owner::contour, Kept::redrawn, sizeof(SlotOf<Real>), named_cells);
    add(Block::contour_case, Owner::contour, Kept::redrawn, 1, solid_cells);
    add(Block::near_wall, Owner::contour, Kept::redrawn, sizeof(std::uint32_t), near_words);
    add(Block::open_u, Owner::cut_cells, Kept::redrawn, share, solid_cells);
    add(Block::open_v, Owner::cut_cells, Kept::redrawn, share, solid_cells);
    add(Block::full_density, Owner::cut_cells, Kept::redrawn, share, solid_cells);
    add(Block::wall_edge, Owner::thin_walls, Kept::redrawn, kWallEdgeBytes, wall_edges);
    add(Block::wall_edge_of_cell, Owner::thin_walls, Kept::redrawn, index, thin * cells);
    add(Block::wall_mark, Owner::thin_walls, Kept::redrawn, 1, thin * cells);
    add(Block::wall_span, Owner::thin_walls, Kept::redrawn, index, thin * vertices);
    add(Block::wall_body, Owner::thin_walls, Kept::redrawn, kThinBodyBytes<Real>, thin * bodies);
    add(Block::row_span, Owner::grid, Kept::nothing, kRowSpanBytes, spans);
    add(Block::velocity_u, Owner::grid, Kept::nothing, sizeof(Real), cells);
    add(Block::mass_u, Owner::grid, Kept::nothing, speed, cells);
    add(Block::velocity_v, Owner::grid, Kept::nothing, sizeof(Real), cells);
    add(Block::mass_v, Owner::grid, Kept::nothing, speed, cells);
    add(Block::inverse_density_u, Owner::grid, Kept::nothing, speed, mixed_cells);
    add(Block::inverse_density_v, Owner::grid, Kept::nothing, speed, mixed_cells);
    add(Block::pressure, Owner::pressure, Kept::whole, sizeof(Real), cells);
    add(Block::divergence, Owner::pressure, Kept::nothing, scratch, cells);
    add(Block::inverse_diagonal, Owner::pressure, Kept::nothing, scratch, cells);
    add(Block::density, Owner::pressure, Kept::nothing, sizeof(DensityOf<Real>), cells);
    add(Block::level, Owner::pressure, Kept::nothing, sizeof(LevelOf<Real>), cells);
    add(Block::coarse_cells, Owner::pressure, Kept::nothing, sizeof(Real), coarse_fields * coarse);
    add(Block::regions, Owner::world, Kept::members, kRegionsBytes<Real>,
        capacity.sleeping_regions ? 1U : 0U);
    add(Block::region_tile, Owner::world, Kept::whole, 1, tiles);
    add(Block::kept_pressure, Owner::pressure, Kept::whole, sizeof(Real), kept_cells);
    add(Block::kept_density, Owner::pressure, Kept::whole, sizeof(DensityOf<Real>), kept_cells);
    return result;
}

/// Bytes that `World<Real>::init` needs for that capacity.
template <class Real>
constexpr std::size_t world_bytes(const Capacity& capacity) {
    return layout<Real>(capacity).total_bytes;
}

}  // namespace weir
