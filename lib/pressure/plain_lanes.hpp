// The projection's equations some cells at a time where all are alike, amid liquid: the
// plain loops' sums, and so their bits.
#pragma once

#include "pressure/leap.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// What the equations of a row are told, and their sums.
struct RowTask {
    const StaggeredGrid<float>& grid;
    const Walls<float>* walls;  ///< null: no solids
    PressureFields<float>& fields;
    Leap<float> leap;
    Solve<float>& system;
    bool has_lower;             ///< whether the rows beside it are the tank's
    bool has_upper;
    std::int32_t first;         ///< cells at the tank's walls; beyond a seam it goes on
    std::int32_t last;
    std::int32_t j;
    /// Adds what walls that move push into cells c … to their divergence; a bit tells which are
    /// asked for, and which have all their faces open. Null: no wall moves.
    void (*add_flow)(const RowTask& task, std::int32_t c, std::uint32_t asked, std::uint32_t wide,
                     float* divergence);
    bool any = false;           ///< whether there was liquid
};

/// Whether all faces of some cells are wide open and no contour that moves is in them.
template <class L>
inline bool are_untouched(const Walls<float>& walls, std::int32_t stride, std::int32_t c) {
    const auto least =
        L::minimum(L::minimum(L::load(walls.open_u + c), L::load(walls.open_u + c + 1)),
                   L::minimum(L::load(walls.open_v + c), L::load(walls.open_v + c + stride)));
    if (!L::all_true(least == L::all(1.0F)) || (walls.moving != nullptr && walls.thin != nullptr)) {
        return false;
    }
    std::uint32_t cases = 0;
    for (std::int32_t k = 0; walls.moving != nullptr && k < L::kLanes; k += 4) {
        std::uint32_t four = 0;
        __builtin_memcpy(&four, walls.cell_case + c + k, sizeof four);
        cases |= four;
    }
    return cases == 0;
}

/// Takes one number of each cell from `wanted` and adds one to `there`, in the cells' order.
template <class L>
inline void add_to_sums(typename L::Floats taken, typename L::Floats given,
                        Solve<float>& system) {
    const auto minus = -taken;
    const auto low = L::template shuffle<0, 4, 1, 5>(minus, given);
    const auto high = L::template shuffle<2, 6, 3, 7>(minus, given);
    typename L::Four sums{system.wanted, system.there, 0.0F, 0.0F};
    L::each_group([&](auto group) {
        const auto a = L::template group<group>(low);
        const auto b = L::template group<group>(high);
        sums += a;
        sums += __builtin_shufflevector(a, a, 2, 3, 2, 3);
        sums += b;
        sums += __builtin_shufflevector(b, b, 2, 3, 2, 3);
    });
    system.wanted = sums[0];
    system.there = sums[1];
}

/// Cells from c on that have liquid all around and open faces. False: the start is no number.
template <class L>
inline bool build_plain(RowTask& task, std::int32_t c) {
    const StaggeredGrid<float>& grid = task.grid;
    PressureFields<float>& fields = task.fields;
    const auto start = L::load(fields.pressure + c) * L::all(task.system.rescale);
    if (!L::all_true(L::absolute(start) < L::all(__builtin_inff()))) {
        return false;
    }
    const std::int32_t up = c + grid.shape.stride;
    const auto divergence = ((L::load(grid.u + c + 1) - L::load(grid.u + c)) +
                             (L::load(grid.v + up) - L::load(grid.v + c))) +
                            wanted_convergence_lanes<L>(grid, c, task.leap);
    L::store(fields.divergence + c, divergence);
    L::store(fields.inverse_diagonal + c, L::all(0.25F));
    L::store(fields.pressure + c, start);
    add_to_sums<L>(start * divergence, (start * L::all(4.0F)) * start, task.system);
    task.any = true;
    return true;
}

#endif

}  // namespace weir
