// Cut cells found, and done in groups.
#pragma once

#include "solid/cut_parts.hpp"
#include "solid/wide_cuts.hpp"

namespace weir {

#if WEIR_HAS_LANES

inline CutTask cut_task(const GridShape& s, const Walls<float>& walls) {
    return {s.stride, walls.distance, walls.cell_case, walls.open_u, walls.open_v};
}

/// As `list_groups`, of fewer than eight columns. All of them are listed.
inline std::int32_t list_few(const CutRow& row, std::int32_t i, std::int32_t i1, CutList& list) {
    for (; i <= i1; ++i) {
        const std::uint8_t solid_nodes = row.cell_case[i];
        if (is_cut(solid_nodes) && !(row.narrow && is_roomy(solid_nodes))) {
            list.i[list.count] = i;
            list.j[list.count] = row.j;
            list.cell[list.count] = row.first + i;
            ++list.count;
        }
    }
    return i;
}

/// Calls visit(list) for the cut ones of some cells, row by row, so many at a time. `narrow`: but
/// for those with one node in the solid.
template <class Visit>
void list_cut(const GridShape& s, const NodeBox& cells, const std::uint8_t* cell_case, bool narrow,
              Visit visit) {
    const CutLoops& loops = cut_loops();
    CutList list;
    const auto flush = [&] {
        if (list.count > 0) {
            list.fill_up();
            visit(list);
            list.count = 0;
        }
    };
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        const std::int32_t first = s.index(0, j);
        const CutRow row{cell_case + first, first, j, narrow};
        for (std::int32_t i = cells.i0; i <= cells.i1;) {
            i = cells.i0 + 7 <= cells.i1 ? loops.list(row, i, cells.i1, list)
                                         : list_few(row, i, cells.i1, list);
            if (!list.has_room()) {
                flush();
            }
        }
    }
    flush();
}

constexpr bool is_saddle(std::uint8_t solid_nodes) {
    return solid_nodes == 5 || solid_nodes == 10;
}

/// Closes cut cells that are slivers.
inline void close_sliver_groups(const GridShape& s, const NodeBox& cells, Walls<float>& walls) {
    const CutLoops& loops = cut_loops();
    const CutTask task = cut_task(s, walls);
    list_cut(s, cells, walls.cell_case, true, [&](const CutList& list) {
        float area[CutList::kMost + 8];
        for (std::int32_t k = 0; k < list.count; k += loops.lanes) {
            loops.areas(task, list.cell + k, area + k);
        }
        for (std::int32_t k = 0; k < list.count; ++k) {
            const std::int32_t c = list.cell[k];
            const bool saddle = is_saddle(walls.cell_case[c]);
            if ((saddle ? open_area(corners_of(s, walls, c).distance) : area[k]) <
                kSliver<float>) {
                close_faces(s, c, walls);
            }
        }
    });
}

/// Adds the shares of a cell, of which all cells around are among those asked.
inline void add_all_shares(const RowsOfShares& shares, std::int32_t stride, float* full) {
    for (std::int32_t row = 0; row < 3; ++row) {
        float* to = full + (row - 1) * stride - 1;
        store_lanes(to, load_lanes(to) + load_lanes(shares[row]));
    }
}

/// Cut cells among those around some cells add their shares of the density kernel to these.
inline void add_cut_groups(const GridShape& s, const NodeBox& cells, const NodeBox& around,
                           Walls<float>& walls) {
    const CutLoops& loops = cut_loops();
    list_cut(s, around, walls.cell_case, false, [&](const CutList& list) {
        RowsOfShares shares[CutList::kMost + 8];
        for (std::int32_t k = 0; k < list.count; k += loops.lanes) {
            loops.shares(walls.distance, s.stride, list.cell + k, shares + k);
        }
        for (std::int32_t k = 0; k < list.count; ++k) {
            const std::int32_t c = list.cell[k];
            const std::int32_t i = list.i[k];
            const std::int32_t j = list.j[k];
            if (is_saddle(walls.cell_case[c])) {
                const OpenMoments<float> m = open_moments(corners_of(s, walls, c).distance);
                add_within(s, cells, i, j, kernel_shares(Hats<float>(m)), walls);
            } else if (i > cells.i0 && i < cells.i1 && j > cells.j0 && j < cells.j1) {
                add_all_shares(shares[k], s.stride, walls.full_density + c);
            } else {
                const auto& of = shares[k];
                add_within(s, cells, i, j,
                           Shares<float>{{{of[0][0], of[0][1], of[0][2]},
                                          {of[1][0], of[1][1], of[1][2]},
                                          {of[2][0], of[2][1], of[2][2]}}},
                           walls);
            }
        }
    });
}

/// `MarksNear` for cells i … i + 7.
inline void mark_eight(const Walls<float>& walls, const GridShape& shape, std::int32_t i,
                       std::int32_t j, std::uint32_t near) {
    const std::int32_t column = shape.i0 + i;
    std::uint32_t* word = walls.near + (shape.j0 + j) * near_words(shape) + column / 32;
    const auto bit = static_cast<std::uint32_t>(column) % 32U;
    word[0] = (word[0] & ~(0xFFU << bit)) | near << bit;
    if (bit > 24U) {
        word[1] = (word[1] & ~(0xFFU >> (32U - bit))) | near >> (32U - bit);
    }
}

/// What is around cells i0 … i1 of a row, away from the tank's left and right wall. Returns the
/// next cell to do.
inline std::int32_t look_around_eights(const GridShape& s, std::int32_t j, std::int32_t i0,
                                       std::int32_t i1, bool thin, Walls<float>& walls) {
    const CutLoops& loops = cut_loops();
    const CutTask task = cut_task(s, walls);
    const AroundTask around{j > 0 ? -s.stride : 0, j + 1 < s.ny ? s.stride : 0,
                            kDeepestMirror<float>, kBoundLayer<float>, kCornerShare<float>,
                            walls.full_density};
    const std::int32_t last = minimum(i1, s.nx - 2);
    std::int32_t i = i0;
    for (; i <= last && last - 7 >= i0; i += 8) {
        i = minimum(i, last - 7);  // some twice
        const std::int32_t c = s.index(i, j);
        const AroundEight eight = loops.look_at_eight(task, around, c);
        std::uint32_t mirrored = eight.u.closed | eight.v.closed;
        const auto add_sticking = [&](std::uint32_t beside, std::int32_t to_other) {
            for (std::uint32_t left = eight.near & beside; left != 0; left &= left - 1U) {
                const std::int32_t k = __builtin_ctz(left);
                if (sticking_body(walls, c + k, c + k + to_other) != kNoBody) {
                    mirrored |= 1U << static_cast<std::uint32_t>(k);
                }
            }
        };
        if (walls.any_sticking && !thin) {
            add_sticking(eight.u.beside, s.stride);
            add_sticking(eight.v.beside, 1);
        }
        mark_eight(walls, s, i, j, thin ? eight.near : eight.near & mirrored);
    }
    return i;
}

#endif

}  // namespace weir
