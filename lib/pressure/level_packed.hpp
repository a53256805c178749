// Density and surface level in whole numbers: levels from a table.
#pragma once

#include "math/quotient_packed.hpp"
#include "pressure/domain.hpp"
#include "pressure/slivers.hpp"
#include "solid/moving_walls.hpp"

namespace weir {

/// Depth of the surface below a cell's centre, in 64ths, at densities of 0 … 128/256.
inline constexpr std::int8_t kDepth[] = {
    96, 85, 80, 76, 73, 71, 68, 66, 64, 62, 61, 59, 58, 57, 55, 54, 53, 52, 51, 51, 50, 49, 48,
    47, 46, 46, 45, 44, 44, 43, 42, 42, 41, 40, 40, 39, 38, 38, 37, 37, 36, 36, 35, 35, 34, 34,
    33, 33, 32, 32, 31, 31, 30, 30, 29, 29, 28, 28, 27, 27, 26, 26, 25, 25, 24, 24, 24, 23, 23,
    22, 22, 21, 21, 21, 20, 20, 19, 19, 18, 18, 18, 17, 17, 16, 16, 16, 15, 15, 14, 14, 14, 13,
    13, 12, 12, 12, 11, 11, 11, 10, 10, 9, 9, 9, 8, 8, 8, 7, 7, 7, 6, 6, 5, 5, 5, 4, 4, 4, 3, 3,
    3, 2, 2, 2, 1, 1, 1, 0, 0,
};

/// Level of an air cell that is taken as filled.
inline constexpr std::int32_t kFilledRaw = 32;

static_assert(SmallFixed(LevelOf<SmallFixed>::of_raw(1)).raw == 1024, "levels are 64ths");

/// Levels of densities in 256ths: of what is more than half full, as much above a cell's centre as
/// those of what it lacks are below; less the head.
struct PackedLevels {
    constexpr PackedLevels() {
        for (std::int32_t density = 0; density <= 256; ++density) {
            const std::int32_t height = density <= 128 ? -kDepth[density] : kDepth[256 - density];
            of[density] = static_cast<std::int8_t>(height - kHeadRaw);
        }
    }
    std::int8_t of[257] = {};
};
inline constexpr PackedLevels kPackedLevels;

/// `density` in 256ths.
inline std::int8_t packed_level(std::int32_t density) {
    return kPackedLevels.of[minimum(density, 256)];
}

namespace packed {

/// Of a row's cells whose faces hold so much: density in 256ths of what is full, and level.
struct DensityRow {
    const VelocityOf<SmallFixed>* mass;  ///< on the left face of the first cell
    std::ptrdiff_t to_lower;             ///< from there to that of the lower face
    std::int32_t stride;
    const ShareOf<SmallFixed>* full;     ///< null: no solids
    DensityOf<SmallFixed>* density;
    LevelOf<SmallFixed>* level;
    std::int32_t count;
    std::uint32_t per_face;
    std::int32_t rest_count;
};

/// Of a cell that is cut. `slivers` are those that hold less than a particle when full.
[[gnu::noinline]] inline std::int32_t cut_density(const DensityRow& row, std::int32_t k,
                                                  std::int32_t density, Part& slivers) {
    const std::uint32_t full = row.full[k].raw;
    if (density > 0 && static_cast<std::int32_t>(full) * row.rest_count < 128) {
        slivers = {slivers.empty() ? k : slivers.first, k + 1};
    }
    return full < 3 ? 0
                    : static_cast<std::int32_t>(
                          quotient_of(static_cast<std::uint32_t>(density) * 128U, full));
}

[[gnu::noinline]] inline Part find_densities(const DensityRow& row) {
    Part slivers;
    const VelocityOf<SmallFixed>* face = row.mass;
    const std::ptrdiff_t to_lower = row.to_lower;
    const std::ptrdiff_t to_upper = to_lower + row.stride;
    const ShareOf<SmallFixed>* const full = row.full;
    const std::uint32_t per_face = row.per_face;
    // Known here, since bytes that are stored may be anybody's.
    DensityOf<SmallFixed>* const densities = row.density;
    LevelOf<SmallFixed>* const levels = row.level;
    const std::int32_t count = row.count;
    std::int32_t left = face->raw;
    for (std::int32_t k = 0; k < count; ++k) {
        const std::int32_t right = face[1].raw;
        const auto mass = static_cast<std::uint32_t>((left + right) +
                                                     (face[to_lower].raw + face[to_upper].raw));
        left = right;
        face = whole(face + 1);
        std::int32_t density = 0;
        if (mass != 0) {
            density = static_cast<std::int32_t>((mass * per_face + 0x8000U) >> 16U);
            if (full != nullptr && full[k].raw < 128) {
                density = cut_density(row, k, density, slivers);
            }
        }
        densities[k].raw = static_cast<std::uint8_t>(minimum((density + 1) >> 1, 255));
        levels[k].raw = packed_level(density);
    }
    return slivers;
}

}  // namespace packed

/// Density and level of the cells of some rows. There are no thin walls.
inline void packed_density(const Domain<SmallFixed>& domain, const CutDensity<SmallFixed>& cut,
                           std::int32_t rest_count, EmptySlivers<SmallFixed> empty_slivers,
                           const Part& rows) {
    const StaggeredGrid<SmallFixed>& grid = domain.grid;
    PressureFields<SmallFixed>& fields = domain.fields;
    const GridShape& s = grid.shape;
    // Mass of a face is in 256ths of a particle, four faces a cell.
    const std::uint32_t per_face = 0x4000U / static_cast<std::uint32_t>(rest_count);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::int32_t c = s.index(0, j);
        const Part found = packed::find_densities(
            {grid.mass_u + c, grid.mass_v - grid.mass_u, s.stride,
             cut.full != nullptr ? cut.full + c : nullptr, fields.density + c, fields.level + c,
             s.nx, per_face, rest_count});
        if (!found.empty() && empty_slivers != nullptr) {
            empty_slivers(grid, domain.borders, cut, j, {c + found.first, c + found.end},
                          fields.level);
        }
    }
}

/// Whether liquid surrounds an air cell: it covers four fifths of the cell's open faces, three
/// fifths where a wall shifts. A level just set by this rule is no evidence.
[[gnu::noinline]] inline bool packed_surrounded(const GridShape& s,
                                                const Borders<SmallFixed>& borders,
                                                const Walls<SmallFixed>& walls,
                                                const LevelOf<SmallFixed>* level, std::int32_t i,
                                                std::int32_t j) {
    const std::int32_t c = s.index(i, j);
    const ShareOf<SmallFixed>* open_u = walls.active ? walls.open_u : nullptr;
    const ShareOf<SmallFixed>* open_v = walls.active ? walls.open_v : nullptr;
    std::int32_t open = 0;
    std::int32_t covered = 0;
    const auto face = [&](bool inside, const ShareOf<SmallFixed>* shares, std::int32_t at,
                          std::int32_t neighbour) {
        const std::int32_t share = !inside ? 0 : shares != nullptr ? shares[at].raw : 128;
        open += share;
        covered += level[neighbour].raw > 0 && level[neighbour].raw != kFilledRaw ? share : 0;
    };
    face(i > 0 || borders.wrap_x, open_u, c, c - 1);
    face(i + 1 < s.nx || borders.wrap_x, open_u, c + 1, c + 1);
    face(j > 0 || borders.wrap_y, open_v, c, c - s.stride);
    face(j + 1 < s.ny || borders.wrap_y, open_v, c + s.stride, c + s.stride);
    return open > 0 && (5 * covered >= 4 * open ||
                        (5 * covered >= 3 * open && walls.moving != nullptr &&
                         walls.moving->shifts(walls, c, c + s.stride)));
}

/// Most air cells are far from any liquid.
template <class Level>
inline bool beside_liquid(const Level* level, std::int32_t stride, std::int32_t c) {
    const auto wet = [&](std::int32_t cell) { return is_positive(level[cell]); };
    return wet(c - 1) || wet(c + 1) || wet(c - stride) || wet(c + stride);
}

}  // namespace weir
