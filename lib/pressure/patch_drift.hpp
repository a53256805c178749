// The drift of one patch, and what it costs.
#pragma once

#include "pressure/patches.hpp"
#include "pressure/volume_lanes.hpp"

namespace weir {

/// Drift between patches over that between cells, at equal difference. With twice as much a column
/// that starts too dense gains energy by its expansion, with four times waves of one cell grow.
template <class Real>
inline constexpr Real kPatchGain = Real(1);

/// Excess of a patch that a solid fills: no drift towards it, nor from it.
template <class Real>
inline constexpr Real kSolidPatch = Real(2);

/// By how much the mean excess rises from one patch to the next, times the gain between them.
template <class Real>
inline Real rise(Real from, Real to) {
    const bool solid = from == kSolidPatch<Real> || to == kSolidPatch<Real>;
    return solid ? Real(0) : kPatchGain<Real> * (to - from);
}

/// The same on each of a patch's faces along an axis: between the patches' centres the mean excess
/// is linear, so that the third face, on the centre, has half of both.
template <class Real>
inline void rises(const Real* excess, std::int32_t q, std::int32_t step, Real* on_face) {
    const Real before = rise(excess[q - step], excess[q]);
    const Real after = rise(excess[q], excess[q + step]);
    on_face[0] = before;
    on_face[1] = before;
    on_face[2] = Real(0.5) * (before + after);
    on_face[3] = after;
}

/// What the drift needs to know of a patch.
template <bool Solids, class Real>
struct Drift {
    const Borders<Real>& borders;
    const Walls<Real>& walls;
    const PressureFields<Real>& fields;
    const GridShape& shape;
    const Patch& patch;
    Real speed;  ///< where the excess rises by 1 from cell to cell, cells/s
    Real along_x[kCoarseEdge];
    Real along_y[kCoarseEdge];

    bool first_moves_x() const { return patch.i > 0 || borders.wrap_x; }
    bool moves_y(std::int32_t y) const { return patch.j + y > 0 || borders.wrap_y; }
    const Walls<Real>* solids() const { return Solids ? &walls : nullptr; }

    /// visit(face, face before it, drift towards that, on u) for those of a column that are open,
    /// from below; each(excess) for each of its cells.
    template <class Visit, class Each>
    [[gnu::always_inline]] void for_each_face(std::int32_t x, const Visit& visit,
                                              const Each& each) const {
        const VelocityOf<Real>* e = fields.divergence;
        const std::int32_t stride = shape.stride;
        const bool moves_x = x > 0 || first_moves_x();
        const auto open = [](const ShareOf<Real>* share, std::int32_t face) {
            return !Solids || bound_key(Real(share[face])) > bound_key(Real(0));
        };
        std::int32_t c = shape.index(patch.i + x, patch.j);
        Real below = e[c - stride];
        for (std::int32_t y = 0; y < patch.height; ++y, c += stride) {
            const Real here = e[c];
            if (moves_x && open(walls.open_u, c)) {
                visit(c, c - 1, speed * ((here - e[c - 1]) + along_x[x]), true);
            }
            if (moves_y(y) && open(walls.open_v, c)) {
                visit(c, c - stride, speed * ((here - below) + along_y[y]), false);
            }
            each(here);
            below = here;
        }
    }

    /// Whether there is excess in a patch, as `average` noted it, which drops do without.
    bool has_excess(std::int32_t q) const {
        return fields.on_surface || fields.coarse.residual[q] != Real(0);
    }

    /// Whether nothing drifts: no excess in the patch, before it and below it, nor a rise.
    bool still() const {
        return !has_excess(patch.q) && !has_excess(patch.q - 1) &&
               !has_excess(patch.q - fields.coarse.shape.stride) && along_x[0] == Real(0) &&
               along_x[3] == Real(0) && along_y[0] == Real(0) && along_y[3] == Real(0);
    }
};

/// Fixed point does without: squares of velocities are wider than its numbers.
template <class Real>
inline constexpr bool kPaysForLifting = sizeof(Product<Real>) == sizeof(Real);

/// Sum of squares of a patch's excess from which on it counts as stirred: 0.025 a cell. A lattice
/// that a wave passes has a tenth of that.
template <class Real>
inline constexpr Real kStirred = Real(0.01);

/// At most a 64th of a patch's velocity is the price, and not more than a 256th comes back: impacts
/// keep their pressure, and what is at rest stays so.
template <class Real>
inline constexpr Real kMostPrice = Real(64);
template <class Real>
inline constexpr Real kMostRefund = Real(256);

/// Which share of its velocity a patch gives for what the drift lifts in it against the pressure,
/// and gets for what it lets down. Liquid in order is not asked: what it does is reversed later.
template <class Real>
inline Real price_of(const Weights<Real>& sums) {
    const Real disorder = minimum<Real>(in_turn(sums.disorder), kStirred<Real>);
    const Real work = in_turn(sums.lifted) * (disorder / kStirred<Real>);
    const Real moving = in_turn(sums.moving);
    if (work > Real(0)) {
        return work / (moving + kMostPrice<Real> * work);
    }
    return moving > -kMostRefund<Real> * work ? work / moving : Real(0);
}

template <bool Solids, class Real>
inline Real price_of(const Drift<Solids, Real>& drift, const StaggeredGrid<Real>& grid) {
    const Real* p = drift.fields.pressure;
    Weights<Real> sums;
    bool done = false;
    if constexpr (kHasLanes<Real>) {
        done = drift.patch.width == kCoarseEdge;
        if (done) {
            weigh_rows(drift, grid, sums);
        }
    }
    for (std::int32_t x = 0; !done && x < drift.patch.width; ++x) {
        Real lifted = Real(0);
        Real moving = Real(0);
        Real disorder = Real(0);
        drift.for_each_face(
            x,
            [&](std::int32_t face, std::int32_t before, Real way, bool on_u) {
                const Real now = on_u ? grid.u[face] : grid.v[face];
                lifted += way * (p[face] - p[before]);
                moving += now * now;
            },
            [&](Real excess) { disorder += excess * excess; });
        sums.lifted[x] = lifted;
        sums.moving[x] = moving;
        sums.disorder[x] = disorder;
    }
    return price_of(sums);
}

template <bool Pays, bool Solids, class Real>
inline void drift_columns(const Drift<Solids, Real>& drift, Real price,
                          StaggeredGrid<Real>& grid) {
    for (std::int32_t x = 0; x < drift.patch.width; ++x) {
        drift.for_each_face(
            x,
            [&](std::int32_t face, std::int32_t, Real way, bool on_u) {
                VelocityOf<Real>& velocity = on_u ? grid.u[face] : grid.v[face];
                if constexpr (Pays) {
                    (on_u ? grid.mass_u[face] : grid.mass_v[face]) -= price * velocity;
                }
                velocity -= way;
            },
            [](Real) {});
    }
}

#if WEIR_HAS_LANES
/// A whole patch at once, that lies at none of the tank's walls.
template <bool Closed, class Drift>
inline void drift_at_once(const Drift& drift, bool pays, StaggeredGrid<float>& grid) {
    DriftOfPatch way;
    float price = 0.0F;
    if (pays) {
        Weights<float> sums;
        find_drift<true, Closed>(drift, grid, way, sums);
        price = price_of(sums);
    } else {
        find_drift<false, Closed>(drift, grid, way, nullptr);
    }
    apply_drift<Closed>(drift, way, price, grid);
}
template <bool Solids>
inline void drift_inner(const Drift<Solids, float>& drift, bool pays, StaggeredGrid<float>& grid) {
    if (Solids && !all_open(drift)) {
        drift_at_once<Solids>(drift, pays, grid);
    } else {
        drift_at_once<false>(drift, pays, grid);
    }
}
#endif

template <bool Solids, class Real>
inline void drift_apart(const Drift<Solids, Real>& drift, bool pays, StaggeredGrid<Real>& grid) {
    if (drift.still()) {
        return;
    }
    pays = pays && drift.has_excess(drift.patch.q);  // without disorder nothing is paid
    if constexpr (kHasLanes<Real>) {
        if (is_inner(drift)) {
            drift_inner(drift, pays, grid);
            return;
        }
    }
    Real price = Real(0);
    if constexpr (kPaysForLifting<Real>) {
        price = pays ? price_of(drift, grid) : Real(0);
    }
    if constexpr (kHasLanes<Real>) {
        if (drift.patch.width == kCoarseEdge) {
            drift_rows(drift, price, grid);
            return;
        }
    }
    if constexpr (kPaysForLifting<Real>) {
        if (price != Real(0)) {
            drift_columns<true>(drift, price, grid);
            return;
        }
    }
    drift_columns<false>(drift, price, grid);
}

}  // namespace weir
