// Where the pressure solve starts: from the last pressure, or a share of it.
#pragma once

#include "pressure/relax_packed.hpp"
#include "pressure/system.hpp"

namespace weir {

/// Of a pressure that adds energy packed worlds keep three quarters of what adds none, sixteenths:
/// all of that adds a little where rounding does, in a box that is kicked.
template <class Real>
Real share_in_sixteenths(Product<Real> eight_times, Product<Real> there) {
    const Product<Real> most = (eight_times + eight_times) + eight_times;
    std::int32_t share = 0;
    for (Product<Real> sum = there; share < 12 && most >= sum; sum = sum + there) {
        ++share;
    }
    return static_cast<Real>(share) / Real(16);
}

/// How much of a pressure p to go on with: all if it is no worse than none, otherwise eighths
/// (packed: as above). `wanted`: pᵀb, `there`: pᵀAp.
template <class Real>
Real share_of_start(Product<Real> wanted, Product<Real> there) {
    const Product<Real> twice = wanted + wanted;
    if (twice >= there) {
        return Real(1);
    }
    const Product<Real> eight_times = (twice + twice) + (twice + twice);
    if constexpr (Stored<Real>::shares_momentum) {
        return share_in_sixteenths<Real>(eight_times, there);
    }
    const Real share = eight_times >= (there + there) + there
                           ? Real(0.375)
                           : (eight_times >= there + there ? Real(0.25) : Real(0.125));
    return eight_times >= there ? share : Real(0);
}

/// A pressure of Fixed that is off by so many last digits is kept while liquid settles: sweeps
/// leave as much.
inline constexpr std::uint32_t kKeptRaw = 4;

/// One row's part of pᵀAp, but for the diagonal.
template <bool Solids, bool Mixed, class Real>
Solve<Real> weigh_row(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t j,
                      const PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const Real* p = fields.pressure;
    Solve<Real> row;
    const Part columns = s.columns(j);
    const std::int32_t end = s.index(columns.end, j);
    std::int32_t c = s.index(columns.first, j);
    if constexpr (kHasLanes<Real> && !Mixed) {
        const Walls<Real>& walls = weights.walls;
        c = weigh_lanes(fields, Solids ? walls.open_u : nullptr, walls.open_v, s.stride, c, end,
                        row.there);
    }
    for (; c < end; ++c) {
        const Real inverse = fields.inverse_diagonal[c];
        if (!is_zero(inverse)) {
            const Real sum = weights.weighted(p + c, c, inverse);
            row.there = row.there - product(p[c], sum);
            if constexpr (kSettles<Real>) {
                if (fields.settling) {
                    const Real led_to =
                        times_inverse<Real>(sum - fields.divergence[c], absolute(inverse));
                    row.off = maximum(row.off, fixed::magnitude((led_to - p[c]).raw));
                }
            }
        }
    }
    return row;
}

/// How much of the pressure to go on with: by so many rows, none if it is known to be all.
template <bool Solids, bool Mixed, class Real>
[[gnu::noinline]] void weigh(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t depth,
                             Work work, PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    Solve<Real>& solve = fields.solve;
    const Part weighed = work.take(depth, s.nx);
    const Part rows{solve.first_row + weighed.first, solve.first_row + weighed.end};
    if constexpr (Stored<Real>::coarse) {
        weigh_packed<Solids>(weights.walls, s, rows, fields);
    } else {
        add_rows(work, rows, s, fields,
                 [&](std::int32_t j) { return weigh_row(weights, j, fields); });
    }
    if (work.once(1)) {
        solve.share = share_of_start<Real>(solve.wanted, solve.there);
        const bool solved = Stored<Real>::coarse ? solve.off < 2 * kExactRaw
                                                 : fields.settling && solve.off <= kKeptRaw;
        if (kSettles<Real> && solved && solve.share == Real(1)) {
            solve.cycles = 0;  // sweeps would go on for ever about their last digits
        }
        solve.wanted = {};
        solve.there = {};
    }
}

/// Rows that hold liquid.
template <class Real>
std::int32_t rows_of(const Solve<Real>& solve) {
    return maximum(0, solve.last_row - solve.first_row + 1);
}

/// Leaves so much of the pressure as was found.
template <bool Solids, bool Mixed, class Real>
void scale(const FaceWeights<Solids, Mixed, Real>& weights, Work work,
           PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const Solve<Real>& solve = fields.solve;
    Real* p = fields.pressure;
    const bool all = solve.share == Real(1);
    const Part scaled = work.take(all ? 0 : rows_of(solve), s.nx);
    for (std::int32_t at = scaled.first; at < scaled.end; ++at) {
        const std::int32_t j = solve.first_row + at;
        const Part columns = s.columns(j);
        const std::int32_t end = s.index(columns.end, j);
        std::int32_t c = s.index(columns.first, j);
        if constexpr (kHasLanes<Real>) {
            c = scale_lanes(p, solve.share, c, end);
        }
        for (; c < end; ++c) {
            p[c] = solve.share * p[c];
        }
    }
    if (work.once(s.border()) && !all) {
        extend_cells<!Solids>(weights.borders, s, p);
    }
}

/// The old pressure is where the solve starts, but not if it is further from the solution than no
/// pressure at all, as after an impact: few sweeps would leave most of it, and it would push. The
/// distance is that in kinetic energy, √(eᵀAe), which is shortest at pᵀb/pᵀAp times the old
/// pressure; eighths are near enough. From such a start sweeps leave the velocity with no more
/// energy than it came with. Packed worlds start from all of it, and scale afterwards: at a hole
/// that was drained a sweep or two mend a pressure that is right everywhere else, in all pools.
template <bool Solids, bool Mixed, class Real>
void weigh_start(const FaceWeights<Solids, Mixed, Real>& weights, Work work,
                 PressureFields<Real>& fields) {
    weigh(weights, rows_of(fields.solve), work, fields);
    if constexpr (!Stored<Real>::shares_momentum) {
        scale(weights, work, fields);
    }
}

/// Of a pressure that started further from the solution than none, and was swept: as much as leaves
/// the velocity with no more energy than it came with. One that was nearer stays so by itself.
template <bool Solids, bool Mixed, class Real>
void weigh_end(const FaceWeights<Solids, Mixed, Real>& weights, Work work,
               PressureFields<Real>& fields) {
    const Solve<Real>& solve = fields.solve;
    weigh(weights, solve.share == Real(1) ? 0 : rows_of(solve), work, fields);
    scale(weights, work, fields);
}

/// A much longer step than the last starts from less than the last pressure would suggest. But an
/// equation of state solves for nothing: what liquid is pressed by it has stored, and keeps, as far
/// as last digits of a short step bear it.
template <class Real>
inline constexpr Real kMostStretch = Real(std::is_floating_point<Real>::value ? 1.0e9 : 4096.0);

/// What a solve starts from.
template <class Real>
Solve<Real> begin_solve(std::int32_t rows, Seconds<Real> dt_s, PressureFields<Real>& fields) {
    const bool cold = !(fields.last_dt > Seconds<Real>{});
    const Real most = fields.elasticity != nullptr ? kMostStretch<Real> : kMostRescale<Real>;
    const Real rescale =
        cold ? Real(0) : minimum(fields.change * (dt_s / fields.last_dt), most);
    fields.change = Real(1);
    fields.last_dt = dt_s;
    Solve<Real> solve;
    solve.first_row = rows;
    solve.cycles = cold ? kColdStart : 1;
    solve.rescale = rescale;
    fields.room_turns = static_cast<std::uint8_t>(maximum(fields.room_turns - 1, 0));
    solve.makes_room = fields.room_turns > 0;
    return solve;
}

}  // namespace weir
