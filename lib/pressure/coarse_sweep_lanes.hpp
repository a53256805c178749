// Sweeps over the coarse cells in lanes: the plain loop's sums, and so its bits. As long as they
// last, each row's numbers stand apart by columns: first those of columns 0, 2 …, then those of
// −1, 1, 3 …, ghosts included. Cells of a colour, and those beside them, then lie side by side.
#pragma once

#include "grid/borders.hpp"
#include "math/four_lanes.hpp"
#include "pressure/some_lanes.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Where the odd columns begin.
constexpr std::int32_t evens_of(const GridShape& s) { return s.nx / 2 + 1; }

/// Every other cell of some rows: in the lowest one from column `i` on, in the next one from the
/// other column on, and so forth. Behind an end of a row lanes load and store what they leave.
template <class L>
inline void relax_apart(const CoarseGrid<float>& coarse, float omega, std::int32_t i,
                        const Part& rows) {
    const GridShape& s = coarse.shape;
    const std::int32_t width = s.nx + 1;
    const std::int32_t stride = s.stride;
    const std::int32_t evens = evens_of(s);
    float* const p = coarse.correction;
    std::int32_t row = s.index(-1, rows.first);
    const std::int32_t end = s.index(-1, rows.end);
    for (; row < end; row += stride, i = 1 - i) {
        const std::int32_t count = (width - i) / 2;
        std::int32_t c = row + (i == 0 ? 0 : evens + 1);
        std::int32_t left = row + (i == 0 ? evens : 0);
        for (std::int32_t k = 0; k < count; k += L::kLanes, c += L::kLanes, left += L::kLanes) {
            const auto inverse = L::load(coarse.inverse_diagonal + c);
            auto wet = inverse != L::all(0.0F);
            if (count - k < L::kLanes) {
                wet &= ~lanes_from<L>(count - k);
            }
            if (!L::any_true(wet)) {
                continue;
            }
            const auto here = L::load(p + c);
            const auto sum = (L::load(coarse.weight_u + c) * L::load(p + left) +
                              L::load(coarse.weight_u + left + 1) * L::load(p + left + 1)) +
                             (L::load(coarse.weight_v + c) * L::load(p + c - stride) +
                              L::load(coarse.weight_v + c + stride) * L::load(p + c + stride));
            const auto relaxed =
                here + L::all(omega) * ((sum + L::load(coarse.residual + c)) * inverse - here);
            L::store(p + c, wet ? relaxed : here);
        }
    }
}

inline void relax_apart_lanes(const CoarseGrid<float>& coarse, float omega, std::int32_t i,
                              const Part& rows) {
    const WideCells* wide = wide_cells();
    const auto relax = wide != nullptr ? wide->relax_apart : relax_apart<FourLanes>;
    relax(coarse, omega, i, rows);
}

/// So many half sweeps over the rows that hold liquid. The correction is 0 before them.
void sweep_apart(const Borders<float>& borders, std::int32_t count, float omega,
                 CoarseGrid<float>& coarse);

#endif

}  // namespace weir
