// One row of a relaxation sweep where the diagonal itself is kept, in 1/128ths: whole numbers and
// products of 32 bits, but for cells with a diagonal or a weight in between.
#pragma once

#include "pressure/face_weights.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Pressures and residuals stay below these, raw: no sum of four overflows.
inline constexpr std::int32_t kMostPressureRaw = 1 << 28;
inline constexpr std::int32_t kMostResidualRaw = 1 << 21;

/// A pressure to start from. In a tank without a surface that a body presses on it would grow
/// without end, and no fixed-point number could hold the sum of four.
template <class Real>
inline Real bounded(Real pressure) {
    return pressure;
}
template <class S>
inline FixedPoint<16, S> bounded(FixedPoint<16, S> pressure) {
    return FixedPoint<16, S>::of_raw(clamp(pressure.raw, -kMostPressureRaw, kMostPressureRaw));
}

/// share × pressure; share is 0 … 1 in 1/128ths.
inline std::int32_t shared(std::int32_t share, std::int32_t pressure) {
    if (share == 128) {
        return pressure;
    }
    return share == 0 ? 0 : static_cast<std::int32_t>(std::int64_t{pressure} * share / 128);
}

/// Diagonal, in 1/128ths, × pressure.
inline std::int32_t scaled(std::int32_t diagonal, std::int32_t pressure) {
    if (diagonal == 512) {
        return 4 * pressure;
    }
    if (diagonal == 384) {
        return 3 * pressure;
    }
    return fixed::saturate(std::int64_t{pressure} * diagonal / 128);
}

/// Relaxes cells c, c + 2 … before `end`: p += ω (Σ p − divergence − n p) / n. The factor ω / n may
/// be coarse, since where the residual is 0 nothing moves; n may not.
template <bool Solids, class Real>
void relax_packed_row(const PressureFields<Real>& fields, const Walls<Real>& walls, Real omega,
                      std::int32_t stride, std::int32_t c, std::int32_t end) {
    Real* p = fields.pressure;
    const std::int32_t step = omega.raw >> 1;  // ω in 1/2^15ths, so that ω / n has 8 bits
    const std::int32_t step_of_4 = step / 512;
    for (; c < end; c += 2) {
        const std::int32_t kept = fields.inverse_diagonal[c].raw;
        if (kept == 0) {
            continue;
        }
        const std::int32_t up = c + stride;
        const std::int32_t down = c - stride;
        const std::int32_t here = p[c].raw;
        const std::int32_t diagonal = kept < 0 ? -kept : kept;
        std::int32_t sum;
        if (!Solids || kept > 0) {
            sum = (p[c - 1].raw + p[c + 1].raw) + (p[down].raw + p[up].raw);
        } else {
            sum = (shared(walls.open_u[c].raw, p[c - 1].raw) +
                   shared(walls.open_u[c + 1].raw, p[c + 1].raw)) +
                  (shared(walls.open_v[c].raw, p[down].raw) +
                   shared(walls.open_v[up].raw, p[up].raw));
        }
        const std::int32_t flow = std::int32_t{fields.divergence[c].raw} * 512;
        const std::int32_t residual =
            clamp(fixed::subtract(sum - flow, scaled(diagonal, here)), -kMostResidualRaw,
                  kMostResidualRaw);
        const std::int32_t factor =
            diagonal == 512 ? step_of_4 : minimum(step / diagonal, std::int32_t{511});
        const std::int32_t change = (residual * factor + 128) >> 8;
        p[c].raw = clamp(here + change, -kMostPressureRaw, kMostPressureRaw);
    }
}

/// A small world has no coarse grid: so many sweeps take its place.
inline constexpr std::int32_t kSweepsForCoarse = 2;

/// Best for liquid n rows deep, closed below and with its surface on top: 2 / (1 + sin(π / 2n))
/// (Young 1954), and sin x ≈ x. Beyond 32 rows the best factor is too much for a few sweeps.
template <class Real>
Real best_relaxation(std::int32_t rows) {
    const Real n = static_cast<Real>(clamp(rows, 8, 32));
    return Real(2) / (Real(1) + Real(1.5707963) / n);
}

/// One colour of the rows low … high, of the `depth` rows that hold liquid.
template <bool Solids, bool Mixed, class Real>
void relax_packed(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t low,
                  std::int32_t high, std::int32_t depth, std::int32_t colour,
                  PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const Real omega = best_relaxation<Real>(depth);
    for (std::int32_t j = low; j <= high; ++j) {
        relax_packed_row<Solids>(fields, weights.walls, omega, s.stride,
                                 s.index((j + colour) & 1, j), s.index(s.nx, j));
    }
}

}  // namespace weir
