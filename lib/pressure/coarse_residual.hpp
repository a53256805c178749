// Residuals of single cells, for the coarse grid: those of cells that are cut off go elsewhere.
#pragma once

#include "pressure/cut_off.hpp"
#include "pressure/face_weights.hpp"

namespace weir {

/// What is left of a cell's equation.
template <bool Solids, bool Mixed, class Real>
WEIR_ALWAYS_INLINE Real residual_of(const FaceWeights<Solids, Mixed, Real>& weights, const Real* p,
                                    std::int32_t c, Real inverse, Real flow) {
    const bool wide = bound_key(inverse) == bound_key(stored_quarter<Real>());
    return (weights.weighted(p, c, inverse) - flow) -
           (wide ? Real(4) * *p : over_inverse<Real>(*p, Solids ? absolute(inverse) : inverse));
}

/// Residuals of a patch's cells that are cut off: from its coarse cell, where all go at first.
template <bool Solids, bool Mixed, class Real>
WEIR_ALWAYS_INLINE void move_cut_off(const FaceWeights<Solids, Mixed, Real>& weights,
                                     const PressureFields<Real>& fields, const Patch& patch,
                                     const Targets& targets, CoarseGrid<Real>& coarse) {
    if (!Solids || !is_parted(coarse, patch.q)) {
        return;
    }
    const GridShape& s = weights.grid.shape;
    const std::uint32_t cells = coarse.cut_off[patch.q].cells;
    for_each_of_patch(cells, [&](std::int32_t bit, std::int32_t x, std::int32_t y) {
        const std::int32_t c = s.index(patch.i + x, patch.j + y);
        const Real residual = residual_of(weights, fields.pressure + c, c,
                                          Real(fields.inverse_diagonal[c]),
                                          Real(fields.divergence[c]));
        move_residual(patch.q, bit, residual, targets, coarse);
    });
}

}  // namespace weir
