// The cells of one coarse cell.
#pragma once

#include "pressure/pressure_fields.hpp"

namespace weir {

/// At the tank's far sides a patch may have fewer cells than kCoarseEdge along an axis.
struct Patch {
    std::int32_t q;  ///< the coarse cell
    std::int32_t i;  ///< the lower left cell
    std::int32_t j;
    std::int32_t width;
    std::int32_t height;
};

/// By row, from below: as many rows as the work allows.
template <class Visit>
void for_each_patch(const GridShape& s, const GridShape& big, Work work, Visit visit) {
    const Part rows = work.take(big.ny, kCoarseEdge * s.nx);
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const std::int32_t j = kCoarseEdge * row;
        for (std::int32_t column = 0; column < big.nx; ++column) {
            const std::int32_t i = kCoarseEdge * column;
            visit(Patch{big.index(column, row), i, j, minimum(kCoarseEdge, s.nx - i),
                        minimum(kCoarseEdge, s.ny - j)});
        }
    }
}

}  // namespace weir
