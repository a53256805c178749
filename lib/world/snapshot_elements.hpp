// Elements of blocks that a snapshot brings, and whether they may be let in.
#pragma once

#include "geometry/convex_decomposition.hpp"
#include "step/substep.hpp"
#include "world/snapshot_members.hpp"

namespace weir {

/// One kind of element, and whether those that a snapshot brings may be let in.
template <class T>
T read(const std::byte* from, std::size_t index) {
    T value;
    std::memcpy(&value, from + index * sizeof value, sizeof value);
    return value;
}

template <class Real>
bool all_finite(const std::byte* from, std::size_t numbers) {
    for (std::size_t k = 0; k < numbers; ++k) {
        if (!is_finite(read<Real>(from, k))) {
            return false;
        }
    }
    return true;
}

/// Packed loops count on pressures of 29 bits, which all finite numbers of others are.
template <class Real>
bool all_pressures(const std::byte* from, std::size_t numbers) {
    if constexpr (!Stored<Real>::shares_momentum) {
        return all_finite<Real>(from, numbers);
    } else {
        for (std::size_t k = 0; k < numbers; ++k) {
            if (fixed::magnitude(read<Real>(from, k).raw) >= 1U << 28U) {
                return false;
            }
        }
        return true;
    }
}

template <class Real>
bool all_in_tank(const GridShape& s, const std::byte* from, std::size_t points) {
    for (std::size_t k = 0; k < points; ++k) {
        const Vec2<Real> x = read<Vec2<PositionOf<Real>>>(from, k);
        const bool inside = x.x >= Real(0) && x.x < static_cast<Real>(s.nx) && x.y >= Real(0) &&
                            x.y < static_cast<Real>(s.ny);
        if (!inside) {
            return false;
        }
    }
    return true;
}

inline bool all_kinds(const std::byte* from, std::size_t kinds) {
    for (std::size_t k = 0; k < kinds; ++k) {
        if (static_cast<std::uint8_t>(from[k]) > static_cast<std::uint8_t>(Liquid::second)) {
            return false;
        }
    }
    return true;
}

template <class Real>
bool all_vertices(const std::byte* from, std::size_t vertices) {
    for (std::size_t k = 0; k < 2 * vertices; ++k) {
        constexpr Real kFurthest = Believed<Real>::furthest_vertex;
        if (!(absolute(read<Real>(from, k)) <= kFurthest)) {
            return false;
        }
    }
    return true;
}

/// Whether all numbers in a body's room for pieces name vertices of it, and every ring has one.
template <class Real>
bool all_indices(const std::byte* from, std::int32_t per_vertex, const Body<Real>& body) {
    const auto at = [&](std::int32_t k) {
        return static_cast<std::int32_t>(
            read<std::uint16_t>(from, static_cast<std::size_t>(k)));
    };
    const std::int32_t end_of_room = per_vertex * body.room;
    std::int32_t end = 0;
    for (std::int32_t k = end_of_room - body.rings; k < end_of_room; ++k) {
        if (at(k) <= end) {
            return false;
        }
        end = at(k);
    }
    return end == body.vertex_count && pieces_fit(at, body.piece_length, body.vertex_count);
}

/// How many of a body's places in a block are kept. Ring ends stand at the end of its pieces.
template <class Real>
std::size_t elements_of(Block block, const Body<Real>& body) {
    return static_cast<std::size_t>(block == Block::piece_index ? body.room : body.vertex_count);
}

/// Whether elements of a block that come from outside can do no harm. No default: a block that is
/// added has to be thought of.
template <class Real>
bool harmless(Block block, const Simulation<Real>& world, const std::byte* from,
              std::size_t elements, const Body<Real>& of) {
    switch (block) {
        case Block::particle_position: return all_in_tank<Real>(world.layers.shape, from, elements);
        case Block::particle_velocity: return all_finite<VelocityOf<Real>>(from, 2 * elements);
        case Block::particle_kind: return all_kinds(from, elements);
        case Block::particle_tag: return true;
        case Block::vertex_local: return all_vertices<Real>(from, elements);
        case Block::piece_index: return all_indices(from, world.bodies.per_vertex(), of);
        case Block::pressure:
        case Block::kept_pressure: return all_pressures<Real>(from, elements);
        case Block::kept_density: return all_finite<DensityOf<Real>>(from, elements);
        case Block::region_tile: return true;  // any number names a region
        case Block::body_load:
            // Of the ledger's whole numbers any will do.
            return all_finite<Face<Real>>(from, (elements - kLedgerRecords<Real>) *
                                                    (sizeof(BodyLoad<Real>) / sizeof(Face<Real>)));
        case Block::body_push:  // guesses, of whatever
            return all_finite<Face<Real>>(from, elements * (sizeof(Push<Real>) /
                                                            sizeof(Face<Real>)));
        case Block::world_state:
        case Block::body_table:
        case Block::vertex_placed:
        case Block::contact:
        case Block::body_meeting:
        case Block::body_lever:
        case Block::body_diagonal:
        case Block::decomposition_scratch:
        case Block::static_distance:
        case Block::static_body:
        case Block::merged_distance:
        case Block::merged_body:
        case Block::contour_case:
        case Block::near_wall:
        case Block::open_u:
        case Block::open_v:
        case Block::full_density:
        case Block::wall_edge:
        case Block::wall_edge_of_cell:
        case Block::wall_mark:
        case Block::wall_span:
        case Block::wall_body:
        case Block::row_span:
        case Block::velocity_u:
        case Block::velocity_v:
        case Block::mass_u:
        case Block::mass_v:
        case Block::inverse_density_u:
        case Block::inverse_density_v:
        case Block::divergence:
        case Block::inverse_diagonal:
        case Block::density:
        case Block::level:
        case Block::coarse_cells:
        case Block::coarse_cut:
        case Block::regions:
        case Block::count: break;
    }
    return false;
}

}  // namespace weir
