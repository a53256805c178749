// The memory of a world: a sum of blocks, each with an owner, known at compile time.
//
// `layout` is the only place that says what is stored: `world_bytes` adds it up, `World::init`
// carves along it, a snapshot takes from it what it keeps, and the tables that people read are
// printed from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "weir/blocks.hpp"
#include "weir/config.hpp"

namespace weir {

/// The caller's memory must start at a multiple of this.
inline constexpr std::size_t world_alignment = 16;

/// Records for so many bodies, for the tank, and in fixed point for the ledger in whole numbers.
template <class Real>
inline constexpr std::int32_t kLedgerRecords = std::is_floating_point_v<Real> ? 0 : 1;
template <class Real>
constexpr std::int32_t load_records(std::int32_t bodies) {
    return bodies + 1 + kLedgerRecords<Real>;
}
/// Points at which free bodies are before something, for each body, and one more for their number.
inline constexpr std::int32_t kMeetingsPerBody = 6;

/// The pressure's coarse grid: cells along an edge of its cells, and numbers for each of them.
inline constexpr std::int32_t kCoarseEdge = 4;
inline constexpr std::int32_t kCoarseFields = 7;
inline constexpr std::int32_t kCoarseFieldsOfTwoLiquids = 9;

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

/// Numbers of the pressure's coarse grid, for each of its cells. Packed worlds have two, which
/// stand where the inverse diagonal has.
template <class Real>
constexpr std::int32_t coarse_fields_of(const Capacity& capacity) {
    return Stored<Real>::shares_momentum
               ? 0
               : (capacity.second_liquid ? kCoarseFieldsOfTwoLiquids : kCoarseFields);
}

/// Nodes have room for the name of the nearest body. One body alone needs none in a packed world:
/// the distance tells.
template <class Real>
constexpr bool keeps_names(const Capacity& capacity) {
    return !Stored<Real>::shares_momentum || capacity.bodies > 1;
}

namespace detail {
/// Bytes that so many elements take: what stands behind them is aligned, too.
constexpr std::size_t block_bytes(std::size_t element_bytes, std::size_t elements) {
    return (element_bytes * elements + world_alignment - 1) / world_alignment * world_alignment;
}
}  // namespace detail

/// Places every block of a world of that capacity. Pure; the same on every machine.
template <class Real>
constexpr Layout layout(const Capacity& capacity) {
    // One ring of ghost cells on each side; nodes and faces share the cells' numbering.
    const std::int32_t cells = cell_entries<Real>(capacity);
    const std::int32_t solid_cells = capacity.bodies > 0 ? cells : 0;
    const std::int32_t moving_cells = capacity.moving_bodies ? solid_cells : 0;
    const bool named = keeps_names<Real>(capacity), pieces = keeps_pieces<Real>(capacity);
    const std::int32_t loads = capacity.two_way ? load_records<Real>(capacity.bodies) : 0;
    const std::int32_t wall_edges = capacity.bodies > 0 ? capacity.wall_edges : 0;
    const bool thin = wall_edges > 0, mixed = capacity.second_liquid,
               sleeps = capacity.sleeping_regions;
    Layout result;
    // First the number of elements, then, as they are placed, the bytes that they take.
    const auto any = [&result](std::int32_t elements, auto... blocks) {
        ((result.bytes[static_cast<std::size_t>(blocks)] = static_cast<std::size_t>(elements)),
         ...);
    };
    any(1, Block::world_state);
    any(capacity.particles, Block::particle_position, Block::particle_velocity);
    any(mixed ? capacity.particles : 0, Block::particle_kind);
    any(capacity.particle_tags ? capacity.particles : 0, Block::particle_tag);
    any(capacity.bodies, Block::body_table);
    any(capacity.contacts, Block::contact);
    any(capacity.vertices, Block::vertex_local, Block::vertex_placed, Block::piece_index);
    // Polygons are cut into pieces where free bodies meet something. In packed worlds are none.
    any(pieces ? static_cast<std::int32_t>(kScratchPerVertex) * capacity.vertices : 0,
        Block::decomposition_scratch);
    any(loads, Block::body_load);
    any(pieces ? 1 + kMeetingsPerBody * capacity.bodies : 0, Block::body_push,
        Block::body_meeting);
    any(WEIR_PARALLEL && pieces ? capacity.bodies : 0, Block::body_lever);
    any(loads > 0 ? moving_cells : 0, Block::body_diagonal);
    any(moving_cells, Block::static_distance);
    any(named ? moving_cells : 0, Block::static_body);
    any(named ? solid_cells : 0, Block::merged_body);
    any(solid_cells, Block::merged_distance, Block::contour_case, Block::open_u, Block::open_v,
        Block::full_density);
    any(capacity.bodies > 0 ? near_entries<Real>(capacity) : 0, Block::near_wall);
    any(wall_edges, Block::wall_edge);
    any(thin ? cells : 0, Block::wall_edge_of_cell, Block::wall_mark);
    any(thin ? capacity.vertices : 0, Block::wall_span);
    any(thin ? capacity.bodies : 0, Block::wall_body);
    any(row_spans<Real>(capacity), Block::row_span);
    any(cells, Block::velocity_u, Block::mass_u, Block::velocity_v, Block::mass_v,
        Block::pressure, Block::divergence, Block::inverse_diagonal, Block::density,
        Block::level);
    any(mixed ? cells : 0, Block::inverse_density_u, Block::inverse_density_v);
    any(coarse_fields_of<Real>(capacity) * coarse_entries<Real>(capacity), Block::coarse_cells);
    any(Stored<Real>::shares_momentum || capacity.bodies == 0 ? 0 : coarse_entries<Real>(capacity),
        Block::coarse_cut);
    any(sleeps ? 1 : 0, Block::regions);
    any(sleeps ? coarse_cells(capacity.cells_x) * coarse_cells(capacity.cells_y) : 0,
        Block::region_tile);
    any(sleeps ? cells : 0, Block::kept_pressure, Block::kept_density);
    for (std::int32_t slot = 0; slot < kBlockCount; ++slot) {
        const detail::BlockKind& kind = detail::kBlockKinds<Real>[slot];
        const std::size_t size = slot == static_cast<std::int32_t>(Block::piece_index)
                                     ? piece_bytes<Real>(capacity)
                                     : kind.element_bytes;
        const std::size_t bytes = detail::block_bytes(size, result.bytes[slot]);
        result.offset[slot] = result.total_bytes;
        result.bytes[slot] = bytes;
        result.element_bytes[slot] = static_cast<std::uint16_t>(size);
        result.kept[slot] = kind.kept;
        result.owner_bytes[static_cast<std::size_t>(kind.owner)] += bytes;
        const std::size_t left = ~std::size_t{0} - result.total_bytes;  // more has no memory
        result.total_bytes += bytes < left ? bytes : left;
    }
    return result;
}

/// Bytes that `World<Real>::init` needs for that capacity.
template <class Real>
constexpr std::size_t world_bytes(const Capacity& capacity) {
    return layout<Real>(capacity).total_bytes;
}

}  // namespace weir
