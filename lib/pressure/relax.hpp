// Half a relaxation sweep: every other cell of rows, as a chessboard has them.
#pragma once

#include "pressure/face_weights.hpp"
#include "pressure/parting.hpp"
#include "pressure/relax_fpu.hpp"
#include "pressure/relax_lanes.hpp"

namespace weir {

/// The coarse grid takes care of what is smooth: sweeps only have to smooth what is left.
template <class Real>
inline constexpr Real kRelaxation = Real(1.4);

/// p[c] is led to what its equation says. `sum`: of the neighbours, each with its face.
template <class Real>
inline void relax_cell(Real& p, Real sum, Real divergence, Real inverse) {
    const Real target = times_inverse<Real>(sum - divergence, inverse);
    p += kRelaxation<Real> * (target - p);
}

/// A cell that a wall touches, or two liquids. A wall does not pull at liquid that air can come to:
/// it parts from the wall instead, and the flow out of its cell is not stopped (Batty, Bertails &
/// Bridson 2007: p >= 0). Not inline: most cells are not such.
template <bool Solids, bool Mixed, class Real>
[[gnu::noinline]] void relax_weighted(const FaceWeights<Solids, Mixed, Real>& weights,
                                      std::int32_t c, PressureFields<Real>& fields) {
    const Real inverse = fields.inverse_diagonal[c];
    if (inverse != Real(0)) {
        Real& p = fields.pressure[c];
        relax_cell<Real>(p, weights.weighted(fields.pressure + c, c, inverse),
                         fields.divergence[c], Solids ? absolute(inverse) : inverse);
        if (Solids && p < Real(0) &&
            parts_from_wall(fields, weights.walls.full_density, weights.grid.shape, c)) {
            p = Real(0);
        }
    }
}

/// Every other cell of a row.
template <bool Solids, bool Mixed, class Real>
inline void relax_cells(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t c,
                        std::int32_t end, PressureFields<Real>& fields) {
    const std::int32_t up = weights.grid.shape.stride;
    const VelocityOf<Real>* inverses = fields.inverse_diagonal + c;
    const VelocityOf<Real>* divergence = fields.divergence + c;
    Real* p = fields.pressure + c;
    Real* above = p + up;
    Real* below = p - up;
    const auto one = [&](std::int32_t k) {
        const Real inverse = inverses[k];
        if (!Mixed && is_positive(inverse)) {
            relax_cell<Real>(p[k], (p[k - 1] + p[k + 1]) + (below[k] + above[k]), divergence[k],
                             inverse);
        } else if ((Mixed || Solids) && inverse != Real(0)) {
            relax_weighted(weights, c + k, fields);
        }
    };
    const auto advance = [&](std::int32_t cells) {
        c += cells;
        inverses += cells;
        divergence += cells;
        p += cells;
        above += cells;
        below += cells;
    };
    while (c + 8 <= end) {
        one(0);
        one(2);
        one(4);
        one(6);
        advance(8);
    }
    while (c < end) {
        one(0);
        advance(2);
    }
}

/// Every other cell of row j from column `i` on to the end of its columns, then of as many rows
/// below it as make `rows`. Not inline: the loop wants all registers.
template <bool Solids, bool Mixed, class Real>
[[gnu::noinline]] void relax_rows_down(const FaceWeights<Solids, Mixed, Real>& weights,
                                       std::int32_t i, std::int32_t j, std::int32_t rows,
                                       PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const std::int32_t c = s.index(i, j);
    const std::int32_t end = s.index(s.columns(j).end, j);
#if WEIR_HAS_LANES
    if constexpr (kHasLanes<Real> && !(Solids && Mixed)) {
        const float* on_u = Solids ? weights.walls.open_u : weights.grid.inverse_density_u;
        const float* on_v = Solids ? weights.walls.open_v : weights.grid.inverse_density_v;
        const float* full = Solids && may_part(fields) ? weights.walls.full_density : nullptr;
        if (relax_in_lanes(
                {fields, on_u, on_v, full, s, Mixed, kRelaxation<Real>, s.stride, c, end, rows})) {
            return;
        }
    }
#endif
    for (std::int32_t below = 0; below < rows * s.stride; below += s.stride) {
        relax_cells(weights, c - below, end - below, fields);
    }
}

/// Every other cell of row j from its first or second column on, and of rows below it.
template <bool Solids, bool Mixed, class Real>
void relax_down(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t colour,
                std::int32_t j, std::int32_t rows, PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    if (!s.has_spans()) {
        relax_rows_down(weights, colour, j, rows, fields);
        return;
    }
    while (rows > 0) {
        const std::int32_t alike = minimum(rows, s.rows_alike(j));
        relax_rows_down(weights, s.columns(j).first + colour, j, alike, fields);
        rows -= alike;
        j -= alike;
    }
}

/// Every other cell of some rows.
template <bool Solids, bool Mixed, class Real>
void relax(const FaceWeights<Solids, Mixed, Real>& weights, const Part& rows,
           std::int32_t colour, PressureFields<Real>& fields) {
    if constexpr (kHasFpuLoops<Real> && !Mixed) {
        relax_rows(std::bool_constant<Solids>{}, weights.grid.shape, rows, colour,
                   kRelaxation<Real>, fields,
                   [&](std::int32_t c) { relax_weighted(weights, c, fields); });
        return;
    }
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        relax_down(weights, (j + colour) & 1, j, 1, fields);
    }
}

}  // namespace weir
