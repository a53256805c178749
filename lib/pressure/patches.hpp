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

/// By row, from below.
template <class Visit>
void for_each_patch(const GridShape& s, const GridShape& big, Visit visit) {
    for (std::int32_t row = 0; row < big.ny; ++row) {
        const std::int32_t j = kCoarseEdge * row;
        for (std::int32_t column = 0; column < big.nx; ++column) {
            const std::int32_t i = kCoarseEdge * column;
            visit(Patch{big.index(column, row), i, j, minimum(kCoarseEdge, s.nx - i),
                        minimum(kCoarseEdge, s.ny - j)});
        }
    }
}

}  // namespace weir
