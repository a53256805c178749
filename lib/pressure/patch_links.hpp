// How the liquid cells of a patch hang together: through faces that walls leave open.
#pragma once

#include "pressure/patches.hpp"
#include "solid/walls.hpp"

namespace weir {

static_assert(kCoarseEdge == 4, "a patch is a word of 16 bits, 4 a row");

/// How the cells of a patch hang together, a bit each.
struct PatchLinks {
    std::uint32_t liquid = 0;
    std::uint32_t right = 0;  ///< to the next cell, which holds liquid, too
    std::uint32_t up = 0;

    /// All that hangs together with the first of some cells.
    std::uint32_t part_of(std::uint32_t cells) const {
        std::uint32_t part = cells & (0U - cells);
        for (std::uint32_t before = 0; part != before && part != liquid;) {
            before = part;
            part = spread_up(part, right << 1U, 1);
            part = spread_up(part, up << 4U, 4);
            part = spread_down(part, right, 1);
            part = spread_down(part, up, 4);
        }
        return part;
    }

private:
    /// Along a row or a column, to all cells that `joined` leads to from the one before or behind.
    static std::uint32_t spread_up(std::uint32_t part, std::uint32_t joined, std::uint32_t step) {
        part |= joined & (part << step);
        return part | (joined & (joined << step) & (part << 2 * step));
    }
    static std::uint32_t spread_down(std::uint32_t part, std::uint32_t joined, std::uint32_t step) {
        part |= joined & (part >> step);
        return part | (joined & (joined >> step) & (part >> 2 * step));
    }
};

#if WEIR_HAS_LANES
/// Which of four numbers are not 0.
inline std::uint32_t bits_that_are_set(const float* four) {
    return bits_of(load_lanes(four) != all_lanes(0.0F));
}
#endif

template <class Real>
PatchLinks links_of(const Walls<Real>& walls, const PressureFields<Real>& fields,
                    const GridShape& s, const Patch& patch) {
    PatchLinks links;
    std::uint32_t open_right = 0;
    std::uint32_t open_up = 0;
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const std::int32_t row = s.index(patch.i, patch.j + y);
        const auto first = static_cast<std::uint32_t>(kCoarseEdge * y);
        if constexpr (kHasLanes<Real>) {
            if (patch.width == kCoarseEdge) {
                links.liquid |= bits_that_are_set(fields.inverse_diagonal + row) << first;
                open_right |= bits_that_are_set(walls.open_u + row + 1) << first;
                open_up |= bits_that_are_set(walls.open_v + row + s.stride) << first;
                continue;
            }
        }
        std::uint32_t bit = 1U << first;
        for (std::int32_t c = row; c < row + patch.width; ++c, bit <<= 1U) {
            links.liquid |= is_zero(Real(fields.inverse_diagonal[c])) ? 0 : bit;
            open_right |= is_zero(Real(walls.open_u[c + 1])) ? 0 : bit;
            open_up |= is_zero(Real(walls.open_v[c + s.stride])) ? 0 : bit;
        }
    }
    constexpr std::uint32_t kButLast = 0x7777;
    links.right = open_right & links.liquid & (links.liquid >> 1U) & kButLast;
    links.up = open_up & links.liquid & (links.liquid >> 4U);
    return links;
}

inline std::int32_t count_bits(std::uint32_t bits) {
    std::int32_t count = 0;
    for (; bits != 0; bits &= bits - 1) {
        ++count;
    }
    return count;
}

/// Cells of a patch that are not its coarse cell's own.
inline std::uint32_t cells_cut_off(const PatchLinks& links) {
    std::uint32_t own = links.part_of(links.liquid);
    for (std::uint32_t rest = links.liquid & ~own; rest != 0;) {
        const std::uint32_t part = links.part_of(rest);
        rest &= ~part;
        if (count_bits(part) > count_bits(own)) {
            own = part;
        }
    }
    return links.liquid & ~own;
}

}  // namespace weir
