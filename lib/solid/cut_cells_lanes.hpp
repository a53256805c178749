// Cut cells some at a time: the plain loops' sums, and so their bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As `open_fraction`.
template <class L>
inline typename L::Floats open_fractions(typename L::Floats a, typename L::Floats b) {
    const auto zero = L::all(0.0F);
    const auto one = L::all(1.0F);
    const auto outside = L::maximum(a, b);
    const auto inside = L::minimum(a, b);
    const auto cut = (outside > zero) & (inside <= zero);
    const auto share = outside / (cut ? outside - inside : one);
    return outside > zero ? (inside > zero ? one : share) : zero;
}

/// Fields of nodes and cells whose contour is told.
struct CutTask {
    std::int32_t stride;
    const float* distance;
    std::uint8_t* cell_case;
    float* open_u;
    float* open_v;
};

/// Cases of cells c … end − 1, and their left and lower faces, if there are enough for a group.
/// Returns the next cell to do.
template <class L>
inline std::int32_t contour_groups(const CutTask& task, std::int32_t c, std::int32_t end) {
    const auto zero = L::all(0.0F);
    const std::int32_t last = end - L::kLanes;
    for (const std::int32_t first = c; c < end && last >= first; c += L::kLanes) {
        c = c < last ? c : last;  // some twice
        const float* low = task.distance + c;
        const float* high = low + task.stride;
        const auto low_left = L::load(low);
        const auto low_right = L::load(low + 1);
        const auto high_left = L::load(high);
        L::store_bytes(task.cell_case + c, ((low_left <= zero) & 1) | ((low_right <= zero) & 2) |
                                               ((L::load(high + 1) <= zero) & 4) |
                                               ((high_left <= zero) & 8));
        L::store(task.open_u + c, open_fractions<L>(low_left, high_left));
        L::store(task.open_v + c, open_fractions<L>(low_left, low_right));
    }
    return c;
}

/// A number below 16 for each of eight cells.
using EightCells = std::uint64_t;

/// 1 for those that are cut.
inline EightCells cut_of_eight(const std::uint8_t* cell_case) {
    constexpr EightCells kOnes = 0x0101010101010101U;
    EightCells cases;
    __builtin_memcpy(&cases, cell_case, sizeof cases);
    // Of a number below 16, more than 0 and less than 15.
    return ((cases + 0x7F * kOnes) & ((cases ^ 0x0F * kOnes) + 0x7F * kOnes)) >> 7U & kOnes;
}

/// 1 for cut cells of which more than one node is in the solid.
inline EightCells narrow_of_eight(const std::uint8_t* cell_case) {
    constexpr EightCells kOnes = 0x0101010101010101U;
    EightCells cases;
    __builtin_memcpy(&cases, cell_case, sizeof cases);
    // Without the lowest node of each, something is left. (Nothing is borrowed from a neighbour.)
    const EightCells others = cases & ((cases | 0x80 * kOnes) - kOnes) & 0x0F * kOnes;
    return (others + 0x7F * kOnes) >> 7U & cut_of_eight(cell_case);
}

/// Cells of which there are enough for all lanes.
struct CutList {
    static constexpr std::int32_t kMost = 64;
    std::int32_t count = 0;
    std::int32_t i[kMost + 8];
    std::int32_t j[kMost + 8];
    std::int32_t cell[kMost + 8];

    bool has_room() const { return count <= kMost - 8; }
    /// Up to a multiple of eight: with the first one.
    void fill_up() {
        for (std::int32_t k = count; k < count + 8; ++k) {
            cell[k] = cell[0];
        }
    }
};

/// A row of cells.
struct CutRow {
    const std::uint8_t* cell_case;  ///< of column 0
    std::int32_t first;             ///< number of the cell there
    std::int32_t j;
    bool narrow;  ///< only `narrow_of_eight` is asked for
};

/// Lists those of columns i … i1 of a row that are cut, as long as there is room. The row has eight
/// columns at least up to i1. Returns the next column to look at.
template <class L>
inline std::int32_t list_groups(const CutRow& row, std::int32_t i, std::int32_t i1,
                                CutList& list) {
    for (; i <= i1 && list.has_room(); i += 8) {
        const std::int32_t at = i < i1 - 7 ? i : i1 - 7;
        const auto seen = static_cast<std::uint32_t>(8 * (i - at));
        EightCells cut = row.narrow ? narrow_of_eight(row.cell_case + at)
                                    : cut_of_eight(row.cell_case + at);
        cut = cut >> seen << seen;
        if (cut == 0) {
            continue;
        }
        if constexpr (L::kLanes == 8) {
            // A bit for each, the highest for the first.
            L::store_set(static_cast<std::uint32_t>(cut * 0x8040201008040201U >> 56U), at,
                         list.i + list.count);
            L::store_whole(list.cell + list.count,
                           L::load_whole(list.i + list.count) + row.first);
            L::store_whole(list.j + list.count, typename L::Ints{} + row.j);
            list.count += __builtin_popcountll(cut);
        } else {
            for (; cut != 0; cut &= cut - 1U) {
                list.i[list.count] = at + __builtin_ctzll(cut) / 8;
                list.j[list.count] = row.j;
                list.cell[list.count] = row.first + list.i[list.count];
                ++list.count;
            }
        }
    }
    return i;
}

/// What is around cells; of 16 bytes the first eight count.
struct EightAround {
    using Bytes = std::uint8_t __attribute__((vector_size(16)));
    Bytes in_32nds;  ///< shares of the density kernel that are in open cells
    Bytes near;      ///< all around it is not of one kind
};
/// Of eight cells, of which none is at the tank's left or right wall. `below`, `above`: to the cell
/// there, or 0 at the tank's wall.
inline EightAround around_eight(const std::uint8_t* cell_case, std::int32_t below,
                                std::int32_t above) {
    using Bytes = EightAround::Bytes;
    const auto load = [&](std::int32_t at) {
        std::uint64_t eight;
        __builtin_memcpy(&eight, cell_case + at, sizeof eight);
        using Halves = std::uint64_t __attribute__((vector_size(16)));
        return reinterpret_cast<Bytes>(Halves{eight, 0});
    };
    struct Column {
        Bytes any, all;
        Bytes own, ends;  ///< how many are open, as 0, -1, -2
    };
    const auto column = [&](std::int32_t i) {
        const Bytes low = load(below + i);
        const Bytes here = load(i);
        const Bytes high = load(above + i);
        const auto open = [](Bytes cases) { return reinterpret_cast<Bytes>(cases == 0); };
        return Column{low | here | high, low & here & high, open(here), open(low) + open(high)};
    };
    const Column left = column(-1);
    const Column middle = column(0);
    const Column right = column(1);
    const Bytes any = left.any | middle.any | right.any;
    const Bytes all = left.all & middle.all & right.all;
    const Bytes sides = left.own + right.own + middle.ends;
    const Bytes two = sides + sides;
    return {(middle.own & 12) - (two + two) - (left.ends + right.ends),
            reinterpret_cast<Bytes>((any != 0) & (all != 15))};
}
inline std::uint64_t first_eight(EightAround::Bytes bytes) {
    using Halves = std::uint64_t __attribute__((vector_size(16)));
    return reinterpret_cast<Halves>(bytes)[0];
}
/// A bit for each byte that is set.
inline std::uint32_t bits_of_eight(EightAround::Bytes bytes) {
    return static_cast<std::uint32_t>(
        ((first_eight(bytes) & 0x8080808080808080U) >> 7U) * 0x0102040810204080U >> 56U);
}

/// Of which faces, from those nodes to others, the mirror writes: a bit each.
struct MirroredFaces {
    std::uint32_t closed;  ///< and not too deep
    std::uint32_t beside;  ///< open, and so near to a wall that the liquid may stick
};
template <class L>
inline MirroredFaces mirrored_of_eight(const float* open, const float* distance,
                                       std::int32_t to_other, float deepest, float beside) {
    MirroredFaces faces{0, 0};
    const auto zero = L::all(0.0F);
    for (std::int32_t k = 0; k < 8; k += L::kLanes) {
        const auto is_open = L::load(open + k);
        const auto middle =
            L::all(0.5F) * (L::load(distance + k) + L::load(distance + to_other + k));
        faces.closed |= L::bits_of((is_open <= zero) & (middle >= L::all(deepest))) << k;
        faces.beside |= L::bits_of((is_open > zero) & (middle < L::all(beside))) << k;
    }
    return faces;
}

/// Full densities and mirrored faces of eight cells.
struct AroundTask {
    std::int32_t below;
    std::int32_t above;
    float deepest;  ///< of mirrored faces
    float beside;   ///< where the liquid may stick
    float corner;   ///< share of a cell at a corner in a cell's density
    float* full_density;
};
struct AroundEight {
    std::uint32_t near;
    MirroredFaces u;
    MirroredFaces v;
};
template <class L>
inline AroundEight look_at_eight(const CutTask& task, const AroundTask& around, std::int32_t c) {
    const EightAround cells = around_eight(task.cell_case + c, around.below, around.above);
    std::uint8_t in_32nds[8];
    const std::uint64_t eight = first_eight(cells.in_32nds);
    __builtin_memcpy(in_32nds, &eight, sizeof in_32nds);
    for (std::int32_t k = 0; k < 8; k += L::kLanes) {
        L::store(around.full_density + c + k,
                 L::all(around.corner) * L::floats(L::bytes(in_32nds + k)));
    }
    const std::uint32_t near = bits_of_eight(cells.near);
    if (near == 0) {
        return {0, {0, 0}, {0, 0}};
    }
    return {near,
            mirrored_of_eight<L>(task.open_u + c, task.distance + c, task.stride, around.deepest,
                                 around.beside),
            mirrored_of_eight<L>(task.open_v + c, task.distance + c, 1, around.deepest,
                                 around.beside)};
}

/// Open areas of so many cells; not of saddles, nor of cells with one node in the solid.
template <class L>
inline void areas_of_group(const CutTask& task, const std::int32_t* cell, float* area) {
    const auto nodes = L::squares_at(task.distance, task.distance + task.stride, cell);
    const auto zero = L::all(0.0F);
    const auto half = L::all(0.5F);
    const auto bottom = open_fractions<L>(nodes.low_left, nodes.low_right);
    const auto right = open_fractions<L>(nodes.low_right, nodes.high_right);
    const auto top = open_fractions<L>(nodes.high_left, nodes.high_right);
    const auto left = open_fractions<L>(nodes.low_left, nodes.high_left);
    const auto s0 = nodes.low_left <= zero;
    const auto s1 = nodes.low_right <= zero;
    const auto s2 = nodes.high_right <= zero;
    const auto s3 = nodes.high_left <= zero;
    const auto level = (s0 == s1) & (s2 == s3);
    const auto upright = (s1 == s2) & (s0 == s3);
    const auto corner = half * (((s0 & s1) ? top : bottom) * ((s0 & s3) ? right : left));
    L::store(area, level ? half * (left + right) : (upright ? half * (bottom + top) : corner));
}

#endif

}  // namespace weir
