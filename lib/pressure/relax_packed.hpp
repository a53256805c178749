// One row of a relaxation sweep where the diagonal itself is kept, in 1/128ths: whole numbers and
// products of 32 bits, but for cells with a diagonal or a weight in between.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "math/sum_of_products.hpp"
#include "pressure/face_weights.hpp"
#include "pressure/parting.hpp"
#include "pressure/pressure_fields.hpp"
#include "pressure/relax_m0.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Pressures stay below this, raw: no sum of four overflows.
inline constexpr std::int32_t kMostPressureRaw = (1 << 28) - (1 << 23);

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

/// Diagonal, in 128ths, × pressure.
inline std::int32_t times_diagonal(std::int32_t diagonal, std::int32_t pressure) {
    if (diagonal == 512) {
        return 4 * pressure;
    }
    return diagonal == 384 ? 3 * pressure : scaled(diagonal, pressure);
}

/// So much of a face, in 128ths, times what is behind it: most faces are open or closed.
inline std::int32_t through(std::int32_t open, std::int32_t pressure) {
    if (open == 128) {
        return pressure;
    }
#if defined(WEIR_SHORT_PRODUCTS)  // without products of 64 bits
    return (pressure >> 14) * open * 128 + (((pressure & 0x3FFF) * open) >> 7);
#else
    return static_cast<std::int32_t>((std::int64_t{pressure} * open) >> 7);
#endif
}

/// Sum over the neighbours of the cell `at`, each with its face.
template <class Real>
[[gnu::noinline]] std::int32_t neighbours_at_wall(const Real* at, const Walls<Real>& walls,
                                                  std::int32_t c, std::int32_t stride) {
    const ShareOf<Real>* u = walls.open_u + c;
    const ShareOf<Real>* v = walls.open_v + c;
    return (through(u[0].raw, at[-1].raw) + through(u[1].raw, at[1].raw)) +
           (through(v[0].raw, at[-stride].raw) + through(v[stride].raw, at[stride].raw));
}
template <class Real>
inline std::int32_t neighbours_in_open(const Real* at, std::int32_t stride) {
    return (at[-1].raw + at[1].raw) + (at[-stride].raw + at[stride].raw);
}

/// `from` less diagonal × pressure, where that is large.
[[gnu::noinline, gnu::cold]] inline std::int32_t less_much(std::int32_t from,
                                                           std::int32_t diagonal,
                                                           std::int32_t pressure) {
    return fixed::subtract(from, times_diagonal(diagonal, pressure));
}
inline std::int32_t less_diagonal(std::int32_t from, std::int32_t diagonal,
                                  std::int32_t pressure) {
#if defined(WEIR_SHORT_PRODUCTS)
    const std::int32_t high = (pressure >> 14) * diagonal;
    const std::int32_t sign = high >> 22;
    const std::int32_t all = high * 128 + (((pressure & 0x3FFF) * diagonal) >> 7);
#else
    const std::int64_t product = std::int64_t{pressure} * diagonal;
    const auto sign = static_cast<std::int32_t>(product >> 36);
    const auto all = static_cast<std::int32_t>(product >> 7);
#endif
    if (WEIR_SELDOM(static_cast<std::uint32_t>(sign + 1) > 1U)) {
        return less_much(from, diagonal, pressure);
    }
    return from - all;
}

/// Of a cell's neighbours, each with its face, so much more than its diagonal × pressure. `flow`:
/// less so much. `kept`: its diagonal, negative at walls. `first`: of all pressures.
template <bool Solids, class Real>
inline std::int32_t short_of_neighbours(const Real* at, const Walls<Real>& walls,
                                        const Real* first, std::int32_t stride, std::int32_t kept,
                                        std::int32_t flow) {
    const bool in_open = !Solids || kept > 0;
    const std::int32_t around =
        in_open ? neighbours_in_open(at, stride)
                : neighbours_at_wall(at, walls, static_cast<std::int32_t>(at - first), stride);
    return less_diagonal(around - flow, in_open ? kept : -kept, at->raw);
}

/// What a cell's pressure becomes: p += ω (Σ p − divergence − n p) / n. The factor ω / n, in
/// 256ths, may be coarse, since where the residual is 0 nothing moves; n may not.
inline std::int32_t relaxed(std::int32_t here, std::int32_t residual, std::int32_t factor,
                            std::int32_t half = 128) {
    return saturated<29>(here + ((saturated<22>(residual) * factor + half) >> 8));
}

/// A cell with no weight in between: `Sides` of its faces are open, and liquid is behind each.
/// In two's complement: with pressures at their limits sums may wrap around, and are limited.
template <int Sides, class Real>
WEIR_ALWAYS_INLINE void relax_plain(Real* here, std::uint32_t around,
                                    std::int32_t divergence, std::int32_t factor,
                                    std::int32_t half) {
    const std::uint32_t flow = static_cast<std::uint32_t>(divergence) * 512U;
    const std::uint32_t pulled = Sides * static_cast<std::uint32_t>(here->raw);
    here->raw = relaxed(here->raw, static_cast<std::int32_t>(around - flow - pulled),
                        factor, half);
}

/// In place of a diagonal, twice behind a row's liquid: whoever goes by twos meets it.
inline constexpr std::int16_t kRowEnd = 0x7FFF;

/// 2048 / n, and for n = 0 as for 1.
struct Inverses {
    constexpr Inverses() {
        for (std::int32_t n = 1; n <= 64; ++n) {
            of[n] = static_cast<std::uint16_t>(2048 / n);
        }
    }
    std::uint16_t of[65] = {2048};
};
inline constexpr Inverses kInverses;

/// ω / n in 256ths without a division: of a diagonal rounded up to a 32nd of 2048, or an eighth.
inline std::int32_t coarse_factor(std::int32_t step, std::int32_t diagonal) {
    if (WEIR_SELDOM(diagonal > 2048)) {
        return (step * kInverses.of[minimum(((diagonal >> 3) + 31) >> 5, 64)]) >> 19;
    }
    const std::int32_t factor = (step * kInverses.of[(diagonal + 31) >> 5]) >> 16;
    return WEIR_SELDOM(factor > 511) ? 511 : factor;
}

/// What a row's cells are relaxed with. (One place for all of it: five arguments are a call's price
/// on a small chip.)
template <class Real>
struct PackedRelaxTask {
    const PressureFields<Real>& fields;
    const Walls<Real>& walls;
    const GridShape& shape;
    std::int32_t stride;
    std::int32_t step;  ///< ω in 1/2^15ths, so that ω / n has 8 bits
    std::int32_t of_4;  ///< that of cells with four and with three sides
    std::int32_t of_3;

    PackedRelaxTask(const PressureFields<Real>& f, const Walls<Real>& w, const GridShape& s,
                    Real omega)
        : fields(f), walls(w), shape(s), stride(s.stride), step(omega.raw >> 1), of_4(step / 512),
          of_3(step / 384) {}
};

/// Not inline: all other cells would save the registers that it wants.
template <class Real>
[[gnu::noinline]] void part_from_wall(const PackedRelaxTask<Real>& task, Real* at) {
    if (parts_from_wall(task.fields, task.walls.full_density, task.shape,
                        static_cast<std::int32_t>(at - task.fields.pressure))) {
        at->raw = 0;
    }
}

/// A cell at the surface or at a wall, with its diagonal and what flows out of it. Walls do not
/// pull: `relax_weighted` says why.
template <bool Solids, class Real>
[[gnu::noinline]] void relax_rare(const PackedRelaxTask<Real>& task, Real* at, std::int32_t kept,
                                  std::int32_t flow) {
    const std::int32_t residual =
        short_of_neighbours<Solids>(at, task.walls, task.fields.pressure, task.stride, kept,
                                    flow * 512);
    const std::int32_t diagonal = Solids && kept < 0 ? -kept : kept;
    at->raw = relaxed(at->raw, residual, coarse_factor(task.step, diagonal));
    if (Solids && at->raw < 0) {
        part_from_wall(task, at);
    }
}

#if !defined(WEIR_LOOPS_OF_M0)
/// Relaxes cells c, c + 2 … of a row.
template <bool Solids, class Real>
WEIR_ALWAYS_INLINE void relax_packed_row(const PackedRelaxTask<Real>& task,
                                         std::int32_t c) {
    const PressureFields<Real>& fields = task.fields;
    Real* here = fields.pressure + c;
    const VelocityOf<Real>* diagonal = fields.inverse_diagonal + c;
    // Both lie in the caller's memory.
    const std::ptrdiff_t to_divergence = fields.divergence - fields.inverse_diagonal;
    const std::int32_t stride = task.stride;
    const std::int32_t of_4 = task.of_4;
    const std::int32_t amid = kept(512);
    const std::int32_t half = beside_product(128);
    const auto raw = [](Real pressure) { return static_cast<std::uint32_t>(pressure.raw); };
    const auto around = [&] {
        return (raw(here[-1]) + raw(here[1])) +
               (raw(here[-stride]) + raw(here[stride]));
    };
    std::int32_t own = diagonal->raw;
    const auto next = [&] {
        here = whole(here + 2);
#if defined(__thumb2__)  // which steps on as it loads
        __asm__("ldrsh %0, [%1, #4]!" : "=r"(own), "+r"(diagonal) : "m"(diagonal[2]));
#else
        diagonal = whole(diagonal + 2);
        own = diagonal->raw;
#endif
    };
    for (;; next()) {
        while (own == 0) {
            next();
        }
        while (own == amid) {
            relax_plain<4>(here, around(), diagonal[to_divergence].raw, of_4, half);
            next();
        }
        if (own == 384) {
            relax_plain<3>(here, around(), diagonal[to_divergence].raw, task.of_3, half);
        } else if (own == kRowEnd) {
            return;
        } else if (own != 0) {
            relax_rare<Solids>(task, here, own, diagonal[to_divergence].raw);
        }
    }
}
#endif

/// Diagonal × pressure less the neighbours'.
template <bool Solids, class Real>
[[gnu::noinline]] std::int32_t pull_rare(const PressureFields<Real>& fields,
                                         const Walls<Real>& walls, std::int32_t stride,
                                         std::int32_t c) {
    return fixed::subtract(0, short_of_neighbours<Solids>(fields.pressure + c, walls,
                                                          fields.pressure, stride,
                                                          fields.inverse_diagonal[c].raw, 0));
}

/// A residual of so little, raw, moves no velocity by a unit, nor does a column of 32 of them.
inline constexpr std::int32_t kExactRaw = 8;

/// Sums pᵀb and pᵀAp over the cells of some rows, in the same unit and as fine as 32-bit products
/// allow: eighths are asked for. Notes whether a residual is worth a sweep. Not inline: it wants
/// all registers.
template <bool Solids, class Real>
[[gnu::noinline]] void weigh_packed(const Walls<Real>& walls, const GridShape& s, const Part& rows,
                                    PressureFields<Real>& fields) {
    const std::int32_t stride = s.stride;
    const std::ptrdiff_t to_divergence = fields.divergence - fields.inverse_diagonal;
    std::uint32_t off = fields.solve.off;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        SumOfProducts wanted;
        SumOfProducts there;
        const VelocityOf<Real>* diagonal = fields.inverse_diagonal + s.index(0, j);
        const Real* at = fields.pressure + s.index(0, j);
        for (;; at = whole(at + 1), diagonal = whole(diagonal + 1)) {
            const std::int32_t kept = diagonal->raw;
            std::int32_t pull;  // four pressures of 29 bits less four others are one of 32
            if (kept == 512) {
                pull = 4 * at->raw - neighbours_in_open(at, stride);
            } else if (kept == 0) {
                continue;
            } else if (kept == 384) {
                pull = 3 * at->raw - neighbours_in_open(at, stride);
            } else if (kept == kRowEnd) {
                break;
            } else {
                pull = pull_rare<Solids>(fields, walls, stride,
                                         static_cast<std::int32_t>(at - fields.pressure));
            }
            const std::int32_t p = saturated<16>(rounded_shift(at->raw, 10));
            const std::int32_t flow = diagonal[to_divergence].raw;
            off |= static_cast<std::uint32_t>(pull) + kExactRaw +
                   static_cast<std::uint32_t>(flow) * 512U;
            wanted.add(p, flow);
            there.add(p, saturated<16>(rounded_shift(saturated<25>(pull), 9)));
        }
        fields.solve.wanted.raw -= wanted.whole();
        fields.solve.there.raw += there.whole();
    }
    fields.solve.off = off;
}

/// A small world has no coarse grid: so many sweeps take its place.
inline constexpr std::int32_t kSweepsForCoarse = 2;

/// What is deeper than 24 rows wants more sweeps than asked for, a part of the depth's square, and
/// most of all from nothing: what they left of its weight made it collapse, from 40 rows on at
/// rest, from 32 when it was kicked.
constexpr std::int32_t sweeps_of_depth(std::int32_t rows, std::int32_t sweeps, bool from_nothing) {
    if (rows <= 24) {
        return sweeps;
    }
    return sweeps + (from_nothing ? rows * rows / 5 : rows * rows / 192 - 3);
}

/// Best for liquid n rows deep, closed below and with its surface on top: 2 / (1 + sin(π / 2n))
/// (Young 1954), and sin x ≈ x. Beyond 32 rows the best factor is too much for a few sweeps, and
/// for fewer than 12 for less. What a step leaves stays in the pressure that the next one starts
/// from, and the flow asks for it once more: e becomes R (2e − the one before), which grows where k
/// sweeps turn e round by more than a third. They do where (ω − 1)^k = e^(−πk/n) is more.
template <class Real>
Real best_relaxation(std::int32_t rows, std::int32_t sweeps) {
    const std::int32_t most = minimum(32, 11 * sweeps / 4);
    const Real n = static_cast<Real>(maximum(minimum(rows, most), 8));
    return Real(2) / (Real(1) + Real(1.5707963) / n);
}

/// One colour of some rows. By itself, so that its loop has all registers.
template <bool Solids, bool Mixed, class Real>
[[gnu::noinline]] void relax_packed(const FaceWeights<Solids, Mixed, Real>& weights,
                                    const Part& rows, std::int32_t colour, Real omega,
                                    PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const PackedRelaxTask<Real> task(fields, weights.walls, s, omega);
    const std::int32_t i = (rows.first + colour) & 1;
    std::int32_t on = s.stride + 1 - 2 * i;  // to where the next row begins
#if defined(WEIR_LOOPS_OF_M0)
    CellsOfRow row(fields, s.stride, s.index(i, rows.first));
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        CellsOfRow cells = row;
        while (relax_plain_cells(cells, task.of_4, task.of_3) != kRowEnd) {
            relax_rare<Solids>(task, cells.here(), *cells.diagonal, cells.divergence());
            cells.go(2);
        }
        row.go(on);
        on = 2 * s.stride - on;
    }
#else
    std::int32_t c = s.index(i, rows.first);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        relax_packed_row<Solids>(task, c);
        c += on;
        on = 2 * s.stride - on;
    }
#endif
}

}  // namespace weir
