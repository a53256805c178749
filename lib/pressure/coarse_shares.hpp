// What cells have in common with the coarse cells around them.
#pragma once

#include "pressure/patches.hpp"

namespace weir {

/// How a patch's cells share in its own and its neighbours' unknowns: linear between the centres,
/// and to the surface.
template <class Real>
struct CoarseShares {
    Real of_beside[kCoarseEdge];  ///< per column
    Real of_above[kCoarseEdge];   ///< per row; or below
    std::int32_t columns_before;  ///< so many share in the patch on the left, others on the right
    std::int32_t rows_before;     ///< in the one below, above

    CoarseShares(const CoarseGrid<Real>& coarse, std::int32_t q) {
        const Real upper = coarse.reach_v[q + coarse.shape.stride];
        columns_before =
            along(coarse.centre_x[q], coarse.reach_u[q], coarse.reach_u[q + 1], of_beside);
        rows_before = along(coarse.centre_y[q], coarse.reach_v[q], upper, of_above);
    }

private:
    static std::int32_t along(Real centre, Real before, Real after, Real* share) {
        constexpr Real kPerEdge = Real(1.0 / kCoarseEdge);
        std::int32_t k = 0;
        Real place = Real(0);
        for (; k < kCoarseEdge && place <= centre; ++k, place = place + Real(1)) {
            share[k] = kPerEdge * (-(place - centre) * before);
        }
        const std::int32_t first_after = k;
        for (; k < kCoarseEdge; ++k, place = place + Real(1)) {
            share[k] = kPerEdge * ((place - centre) * after);
        }
        return first_after;
    }
};

/// visit(x) for the columns of a patch. Most have four, which are not counted.
template <class Visit>
WEIR_ALWAYS_INLINE void for_each_column(const Patch& patch, const Visit& visit) {
    static_assert(kCoarseEdge == 4, "these are all");
    if (patch.width == kCoarseEdge) {
        visit(0);
        visit(1);
        visit(2);
        visit(3);
        return;
    }
    for (std::int32_t x = 0; x < patch.width; ++x) {
        visit(x);
    }
}

}  // namespace weir
