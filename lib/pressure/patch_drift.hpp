// The drift of one patch.
#pragma once

#include "grid/borders.hpp"
#include "pressure/drift_price.hpp"
#include "pressure/patches.hpp"
#include "pressure/projection.hpp"
#include "pressure/volume_lanes.hpp"

namespace weir {

/// Drift between patches over that between cells, at equal difference. With twice as much a column
/// that starts too dense gains energy by its expansion, with four times waves of one cell grow.
template <class Real>
inline constexpr Real kPatchGain = Real(1);

/// What a patch's mean may say.
template <class Real>
inline constexpr Real kPatchWindow = Real(0.03);

/// Excess of a patch that a solid fills: no drift towards it, nor from it.
template <class Real>
inline constexpr Real kSolidPatch = Real(2);

/// By how much the mean excess rises from one patch to the next, times the gain between them.
template <class Real>
inline Real rise(Real from, Real to) {
    const bool solid = maximum(from, to) >= kSolidPatch<Real>;
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

/// Whether there is excess in a patch, as `average` noted it, which drops do without.
template <class Real>
inline bool has_excess(const PressureFields<Real>& fields, std::int32_t q) {
    return are_drops(fields) || fields.coarse.residual[q] != Real(0);
}

/// Whether a patch and those around it have none, nor a mean. `Drift::still` knows more.
template <class Real>
inline bool is_still(const PressureFields<Real>& fields, std::int32_t q) {
    const std::int32_t up = fields.coarse.shape.stride;
    const Real* mean = fields.coarse.correction + q;
    return !has_excess(fields, q) && !has_excess(fields, q - 1) && !has_excess(fields, q - up) &&
           mean[0] == Real(0) && mean[-1] == Real(0) && mean[1] == Real(0) &&
           mean[-up] == Real(0) && mean[up] == Real(0);
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
    Vec2<Real> weight;  ///< what gravity makes of a velocity in the step
    Vec2<Real> falling;  ///< of which it pays, `share_of_falling`
    Real along_x[kCoarseEdge];
    Real along_y[kCoarseEdge];

    bool first_moves_x() const { return patch.i > 0 || borders.wrap_x; }
    bool moves_y(std::int32_t y) const { return patch.j + y > 0 || borders.wrap_y; }
    const Walls<Real>* solids() const { return Solids ? &walls : nullptr; }

    /// on_u(face, row of the patch), on_v(face, row) for those faces of a column that are open,
    /// from below; first each(cell) of each of its cells.
    template <class OnU, class OnV, class Each>
    WEIR_ALWAYS_INLINE void for_each_face(std::int32_t x, const OnU& on_u, const OnV& on_v,
                                          const Each& each) const {
        const bool moves_x = x > 0 || first_moves_x();
        const auto open = [](const ShareOf<Real>* share, std::int32_t face) {
            return !Solids || is_positive(Real(share[face]));
        };
        std::int32_t c = shape.index(patch.i + x, patch.j);
        for (std::int32_t y = 0; y < patch.height; ++y, c += shape.stride) {
            each(c);
            if (moves_x && open(walls.open_u, c)) {
                on_u(c, y);
            }
            if ((y > 0 || moves_y(0)) && open(walls.open_v, c)) {
                on_v(c, y);
            }
        }
    }

    bool has_excess(std::int32_t q) const { return weir::has_excess(fields, q); }
    Real mean_excess() const { return fields.coarse.correction[patch.q]; }

    /// Whether nothing drifts: no excess in the patch, before it and below it, nor a rise.
    bool still() const {
        return !has_excess(patch.q) && !has_excess(patch.q - 1) &&
               !has_excess(patch.q - fields.coarse.shape.stride) && along_x[0] == Real(0) &&
               along_x[3] == Real(0) && along_y[0] == Real(0) && along_y[3] == Real(0);
    }
};

/// Drift on each of a patch's open faces, column by column, as `for_each_face` meets them.
template <class Real>
struct Ways {
    Real of[2 * kCoarseEdge * kCoarseEdge];
};

/// What the drift of a patch does, summed by column, where `weighed` asks for it.
template <bool Weighed, bool Solids, class Real>
[[gnu::noinline]] void find_ways(const Drift<Solids, Real>& drift, const StaggeredGrid<Real>& grid,
                                 Ways<Real>& ways, Weights<SumOf<Real>>& sums) {
    const VelocityOf<Real>* e = drift.fields.divergence;
    const VelocityOf<Real>* u = grid.u;
    const VelocityOf<Real>* v = grid.v;
    const Real speed = drift.speed;
    const Vec2<Real> falling = drift.falling;
    Real* way = ways.of;
    for (std::int32_t x = 0; x < drift.patch.width; ++x) {
        Vec2<Real> went{};
        SumOf<Real> moving{};
        SumOf<Real> disorder{};
        const Real along_x = drift.along_x[x];
        const std::int32_t under = drift.shape.index(drift.patch.i + x, drift.patch.j - 1);
        Real here = e[under];
        Real below = here;
        const auto add = [&](Real way_here, Real& sum, Real velocity, Real counts) {
            *way++ = way_here;
            if (Weighed) {
                sum = sum + way_here;
                moving += summand(velocity, counts * velocity);
            }
        };
        drift.for_each_face(
            x,
            [&](std::int32_t face, std::int32_t) {
                add(speed * ((here - e[face - 1]) + along_x), went.x, u[face], falling.x);
            },
            [&](std::int32_t face, std::int32_t y) {
                add(speed * ((here - below) + drift.along_y[y]), went.y, v[face], falling.y);
            },
            [&](std::int32_t c) {
                below = here;
                here = e[c];
                if (Weighed) {
                    disorder += summand(here, here);
                }
            });
        if (Weighed) {
            sums.raised[x] = summand(drift.weight.x, went.x) + summand(drift.weight.y, went.y);
            sums.moving[x] = moving;
            sums.disorder[x] = disorder;
        }
    }
}

template <bool Pays, bool Solids, class Real>
inline void drift_columns(const Drift<Solids, Real>& drift, const Ways<Real>& ways,
                          Ratio<Real> price, StaggeredGrid<Real>& grid) {
    const Real* way = ways.of;
    VelocityOf<Real>* const u = grid.u;
    VelocityOf<Real>* const v = grid.v;
    VelocityOf<Real>* const u_before = grid.mass_u;
    VelocityOf<Real>* const v_before = grid.mass_v;
    const Vec2<Real> falling = drift.falling;
    const auto move = [&](VelocityOf<Real>& velocity, VelocityOf<Real>& before, Real pays) {
        const Real now = velocity;
        if constexpr (Pays) {
            before -= price * (pays * now);
        }
        velocity = now - *way++;
    };
    for (std::int32_t x = 0; x < drift.patch.width; ++x) {
        drift.for_each_face(
            x,
            [&](std::int32_t face, std::int32_t) { move(u[face], u_before[face], falling.x); },
            [&](std::int32_t face, std::int32_t) { move(v[face], v_before[face], falling.y); },
            [](std::int32_t) {});
    }
}

/// With less mean excess a patch is not pressed together: what is may always expand. Torn
/// compressible liquid is too dense in one cell beside one that is too thin.
template <class Real>
inline Real least_pressed(const PressureFields<Real>& fields) {
    return fields.sound_speed > Real(0) ? kPatchWindow<Real> : Real(0);
}

/// Whether a patch cannot pay for all of its drift: then it makes less of it.
template <bool Solids, class Real>
inline bool slows_down(Drift<Solids, Real>& drift, const Weights<Real>& sums) {
    const bool pressed = drift.mean_excess() >= least_pressed(drift.fields);
    const Real share = share_of_drift(sums, pressed);
    drift.speed = share * drift.speed;
    return share < Real(1);
}

/// A patch of any kind.
template <bool Solids, class Real>
inline void drift_any(Drift<Solids, Real>& drift, bool pays, StaggeredGrid<Real>& grid) {
    Ways<Real> ways;
    Weights<SumOf<Real>> sums;
    if (!pays) {
        find_ways<false>(drift, grid, ways, sums);
        drift_columns<false>(drift, ways, Ratio<Real>(0), grid);
        return;
    }
    find_ways<true>(drift, grid, ways, sums);
    const Weights<Real> weights = weights_of<Real>(sums);
    const Ratio<Real> price = price_of(weights, most_refund(drift.fields));
    if (slows_down(drift, weights)) {
        find_ways<false>(drift, grid, ways, sums);
    }
    if (price != Ratio<Real>(0)) {
        drift_columns<true>(drift, ways, price, grid);
    } else {
        drift_columns<false>(drift, ways, price, grid);
    }
}

#if WEIR_HAS_LANES
/// A whole patch at once, that lies at none of the tank's walls.
template <bool Closed, class Drift>
inline void drift_at_once(Drift& drift, bool pays, StaggeredGrid<float>& grid) {
    DriftOfPatch way;
    float price = 0.0F;
    if (pays) {
        Weights<float> sums;
        find_drift<true, Closed>(drift, grid, way, sums);
        price = price_of(sums, most_refund(drift.fields));
        pays = !slows_down(drift, sums);
    }
    if (!pays) {
        find_drift<false, Closed>(drift, grid, way, nullptr);
    }
    apply_drift<Closed>(drift, way, price, grid);
}
template <bool Solids>
inline void drift_inner(Drift<Solids, float>& drift, bool pays, StaggeredGrid<float>& grid) {
    if (Solids && !all_open(drift)) {
        drift_at_once<Solids>(drift, pays, grid);
    } else {
        drift_at_once<false>(drift, pays, grid);
    }
}
#endif

template <bool Solids, class Real>
inline void drift_apart(Drift<Solids, Real>& drift, bool pays, StaggeredGrid<Real>& grid) {
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
    if constexpr (kHasLanes<Real>) {
        if (drift.patch.width == kCoarseEdge) {
            Real price = Real(0);
            if (pays) {
                Weights<Real> sums;
                weigh_rows(drift, grid, sums);
                price = price_of(sums, most_refund(drift.fields));
                slows_down(drift, sums);
            }
            drift_rows(drift, price, grid);
            return;
        }
    }
    drift_any(drift, pays, grid);
}

}  // namespace weir
