// Cut cells four at a time: the plain loops' sums, and so their bits.
#pragma once

#include "math/lanes.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As `open_fraction`.
inline Lanes open_fractions(Lanes a, Lanes b) {
    const Lanes zero = all_lanes(0.0F);
    const Lanes one = all_lanes(1.0F);
    const Lanes outside = maximum(a, b);
    const Lanes inside = minimum(a, b);
    const LaneMask cut = (outside > zero) & (inside <= zero);
    const Lanes share = outside / (cut ? outside - inside : one);
    return outside > zero ? (inside > zero ? one : share) : zero;
}

/// Cases of cells first, first + 1 … end − 1, and their left and lower faces, if there are four.
/// Returns the next cell to do.
inline std::int32_t contour_fours(std::int32_t stride, std::int32_t first, std::int32_t end,
                                  Walls<float>& walls) {
    using Bytes = std::uint8_t __attribute__((vector_size(4)));
    const Lanes zero = all_lanes(0.0F);
    std::int32_t c = first;
    for (; c < end && end - 4 >= first; c += 4) {
        c = minimum(c, end - 4);  // some twice
        const float* low = walls.distance + c;
        const float* high = low + stride;
        const Lanes low_left = load_lanes(low);
        const Lanes low_right = load_lanes(low + 1);
        const Lanes high_left = load_lanes(high);
        const LaneMask nodes = ((low_left <= zero) & 1) | ((low_right <= zero) & 2) |
                               ((load_lanes(high + 1) <= zero) & 4) | ((high_left <= zero) & 8);
        const Bytes cases = __builtin_convertvector(nodes, Bytes);
        __builtin_memcpy(walls.cell_case + c, &cases, sizeof cases);
        store_lanes(walls.open_u + c, open_fractions(low_left, high_left));
        store_lanes(walls.open_v + c, open_fractions(low_left, low_right));
    }
    return c;
}

/// Whether one of four cells is cut.
inline bool any_cut(const std::uint8_t* cell_case) {
    std::uint32_t four;
    __builtin_memcpy(&four, cell_case, sizeof four);
    return four != 0 && four != 0x0F0F0F0FU;
}

/// A number below 16 for each of eight cells.
using EightCells = std::uint64_t;
inline EightCells cases_of_eight(const std::uint8_t* cell_case) {
    EightCells cases;
    __builtin_memcpy(&cases, cell_case, sizeof cases);
    return cases;
}

/// 1 where a case is 0, else 0.
inline EightCells open_of_eight(EightCells cases) {
    constexpr EightCells kOnes = 0x0101010101010101U;
    return ((cases + 0x7F * kOnes) >> 7U & kOnes) ^ kOnes;
}

/// What is around four cells, of which none is at the tank's left or right wall.
struct FourAround {
    Lanes in_32nds;      ///< shares of the density kernel that are in open cells
    std::uint32_t near;  ///< a bit for each: all around it is not of one kind
};
/// `below`, `above`: to the cell there, or 0 at the tank's wall.
inline FourAround around_four(const std::uint8_t* cell_case, std::int32_t below,
                              std::int32_t above) {
    constexpr EightCells kSolid = 0x0F0F0F0F0F0F0F0FU;
    const EightCells low = cases_of_eight(cell_case - 1 + below);
    const EightCells here = cases_of_eight(cell_case - 1);
    const EightCells high = cases_of_eight(cell_case - 1 + above);
    // Bytes 0 … 5 are columns: each cell has one more, its own and the next.
    const auto three = [](EightCells a) { return a | a >> 8U | a >> 16U; };
    const EightCells alike = open_of_eight(three(low | here | high)) |
                             open_of_eight(three((low ^ kSolid) | (here ^ kSolid) |
                                                 (high ^ kSolid)));
    const auto apart = static_cast<std::uint32_t>(alike) ^ 0x01010101U;
    const EightCells own = open_of_eight(here);
    const EightCells ends = open_of_eight(low) + open_of_eight(high);
    const EightCells in_32nds = 12U * (own >> 8U) +
                                4U * (own + (own >> 16U) + (ends >> 8U)) + (ends + (ends >> 16U));
    using Bytes = std::uint8_t __attribute__((vector_size(4)));
    Bytes four;
    __builtin_memcpy(&four, &in_32nds, sizeof four);
    return {__builtin_convertvector(four, Lanes),
            (apart | apart >> 7U | apart >> 14U | apart >> 21U) & 0xFU};
}

/// Adds a cut cell's shares of the density kernel to the nine cells around it, the middle one of
/// which is `full`. Hats as in `Hats`.
inline void add_shares(const float* tx, const float* ty, const float* y_tx, const float* x_ty,
                       std::int32_t stride, float* full) {
    const Lanes half = all_lanes(0.5F);
    const Lanes columns{tx[0], tx[1], tx[2], 0.0F};
    const Lanes moments{y_tx[0], y_tx[1], y_tx[2], 0.0F};
    const auto add = [&](std::int32_t row, Lanes wide) {
        const float side = 0.5F * ty[row];
        const Lanes of_row{side - x_ty[row], ty[row], side + x_ty[row], 0.0F};
        float* to = full + (row - 1) * stride - 1;
        store_lanes(to, load_lanes(to) + all_lanes(0.25F) * (of_row + wide));
    };
    add(0, half * columns - moments);
    add(1, columns);
    add(2, half * columns + moments);
}

/// Of which of four faces, from those nodes to others, the mirror writes: a bit each.
struct FourMirrored {
    std::uint32_t closed;  ///< and not too deep
    std::uint32_t beside;  ///< open, and so near to a wall that the liquid may stick
};
inline FourMirrored mirrored_of_four(const float* open, const float* distance,
                                     std::int32_t to_other) {
    const Lanes is_open = load_lanes(open);
    const Lanes zero = all_lanes(0.0F);
    const Lanes middle = all_lanes(0.5F) * (load_lanes(distance) + load_lanes(distance + to_other));
    return {bits_of((is_open <= zero) & (middle >= all_lanes(kDeepestMirror<float>))),
            bits_of((is_open > zero) & (middle < all_lanes(kBoundLayer<float>)))};
}

/// `mark_near` for cells i … i + 3.
inline void mark_four(const Walls<float>& walls, const GridShape& shape, std::int32_t i,
                      std::int32_t j, std::uint32_t near) {
    const std::int32_t column = shape.i0 + i;
    std::uint32_t* word = walls.near + (shape.j0 + j) * near_words(shape) + column / 32;
    const auto bit = static_cast<std::uint32_t>(column) % 32U;
    word[0] = (word[0] & ~(0xFU << bit)) | near << bit;
    if (bit > 28U) {
        word[1] = (word[1] & ~(0xFU >> (32U - bit))) | near >> (32U - bit);
    }
}

#endif

}  // namespace weir
