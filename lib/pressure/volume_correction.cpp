#include "pressure/volume_correction.hpp"

#include "pressure/patches.hpp"
#include "pressure/volume_lanes.hpp"
#include "pressure/volume_packed.hpp"

namespace weir {

namespace {

template <class Real>
constexpr Real kWindow = Real(1);

/// At the surface the density is that of a few particles: only what exceeds this counts there.
/// Without it the surface of an agitated pool stands 5 % of ten cells too high.
template <class Real>
constexpr Real kSurfaceSlack = Real(0.2);

/// What a single cell may say in the mean of its patch, and what a patch may say.
template <class Real>
constexpr Real kCellWindow = Real(0.2);
template <class Real>
constexpr Real kPatchWindow = Real(0.03);

/// Drift between patches over that between cells, at equal difference. With twice as much a column
/// that starts too dense gains energy by its expansion, with four times waves of one cell grow.
template <class Real>
constexpr Real kPatchGain = Real(1);

/// Just below the surface density is known to this: lattices are no continuum.
template <class Real>
constexpr Real kSubsurfaceSlack = Real(0.03);

/// A patch with that many liquid cells that are too dense by this in the mean has not the room for
/// its liquid. (Of a cell no more than kCellWindow counts.)
template <class Real>
constexpr Real kOverfull = Real(0.15);
constexpr std::int32_t kLeastOverfull = 8;

/// Excess of a patch that a solid fills: no drift towards it, nor from it.
template <class Real>
constexpr Real kSolidPatch = Real(2);

/// A cell below the surface sees less than 1: its kernel reaches 1½ cells up. `lowest`: level of
/// the neighbour that is nearest to the surface, one cell less than its own, at most ½. Counted as
/// a deficit it would make a pool's surface creep; under surface tension that pull is what stills
/// ripples.
template <class Real>
inline Real expected_deficit(Real lowest) {
    const Real missing = Real(0.5) - lowest;
    return Real(0.125) * missing * missing;
}

/// How much too dense a cell is, or too thin where liquid is all around.
template <class Real>
inline Real excess(const GridShape& s, const PressureFields<Real>& f, std::int32_t c) {
    Real e = f.density[c] - Real(1);
    const Real lowest = minimum<Real>(minimum<Real>(f.level[c - 1], f.level[c + 1]),
                                      minimum<Real>(f.level[c - s.stride], f.level[c + s.stride]));
    if (!(f.level[c] > Real(0) && lowest > Real(0))) {
        return clamp<Real>(e - kSurfaceSlack<Real>, Real(0), kWindow<Real>);
    }
    if (lowest < Real(0.5) && !f.on_surface) {
        e += expected_deficit(lowest);
        e -= clamp(e, -kSubsurfaceSlack<Real>, kSubsurfaceSlack<Real>);
    }
    return clamp(e, -kWindow<Real>, kWindow<Real>);
}

/// Whether there is anything but solid in a patch.
template <class Real>
bool has_room(const GridShape& s, const Walls<Real>& walls, const Patch& patch) {
    for (std::int32_t y = 0; y < patch.height; ++y) {
        for (std::int32_t x = 0; x < patch.width; ++x) {
            if (walls.full_density[s.index(patch.i + x, patch.j + y)] > Real(0)) {
                return true;
            }
        }
    }
    return false;
}

/// Mean excess of a patch's liquid cells; 0 in air. `overfull` grows by the patch's liquid cells if
/// they have not the room for what is in them.
template <bool Solids, class Real>
Real average(const GridShape& s, const Walls<Real>& walls, const Patch& patch,
             const PressureFields<Real>& f, std::int32_t& overfull) {
    Real sum = Real(0);
    std::int32_t count = 0;
    for (std::int32_t y = 0; y < patch.height; ++y) {
        for (std::int32_t x = 0; x < patch.width; ++x) {
            const std::int32_t c = s.index(patch.i + x, patch.j + y);
            if (f.level[c] > Real(0)) {
                sum += clamp<Real>(f.divergence[c], -kCellWindow<Real>, kCellWindow<Real>);
                count += 1;
            }
        }
    }
    if (count == 0) {
        return !Solids || has_room(s, walls, patch) ? Real(0) : kSolidPatch<Real>;
    }
    const Real mean = part_of(sum, count);
    overfull += count >= kLeastOverfull && mean >= kOverfull<Real> ? count : 0;
    return clamp(mean, -kPatchWindow<Real>, kPatchWindow<Real>);
}

/// The same of a row of patches, written to the coarse cells.
template <bool Solids, class Real>
void average_row(const GridShape& s, const Walls<Real>& walls, std::int32_t row,
                 const PressureFields<Real>& f, std::int32_t& overfull) {
    const GridShape& big = f.coarse.shape;
    const auto patch_at = [&](std::int32_t column) {
        return patch_of(s, big, column, row);
    };
    Real* const means = f.coarse.correction + big.index(0, row);
    std::int32_t column = 0;
    if constexpr (kHasLanes<Real>) {
        const PatchLimits limits{kCellWindow<Real>, kPatchWindow<Real>, kOverfull<Real>,
                                 static_cast<Real>(kLeastOverfull)};
        const Patch first = patch_at(0);
        column = f.on_surface ? 0
                              : means_of_row(f, limits, s.stride, s.index(0, first.j),
                                             first.height, s.nx / kCoarseEdge, means, overfull,
                                             [&](std::int32_t k) {
                                                 if (Solids && !has_room(s, walls, patch_at(k))) {
                                                     means[k] = kSolidPatch<Real>;
                                                 }
                                             });
    }
    for (; column < big.nx; ++column) {
        means[column] =
            f.on_surface ? Real(0) : average<Solids>(s, walls, patch_at(column), f, overfull);
    }
}

/// By how much the mean excess rises from one patch to the next, times the gain between them.
template <class Real>
inline Real rise(Real from, Real to) {
    const bool solid = from == kSolidPatch<Real> || to == kSolidPatch<Real>;
    return solid ? Real(0) : kPatchGain<Real> * (to - from);
}

/// The same on each of a patch's faces along an axis: between the patches' centres the mean excess
/// is linear, so that the third face, on the centre, has half of both.
template <class Real>
void rises(const Real* excess, std::int32_t q, std::int32_t step, Real* on_face) {
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

    Real of(std::int32_t face, std::int32_t before, Real along) const {
        const VelocityOf<Real>* e = fields.divergence;
        return speed * ((e[face] - e[before]) + along);
    }

    /// visit(face, face before it, drift towards that, column of the patch, on u) for those that
    /// are open, by row.
    template <class Visit>
    void for_each_face(const Visit& visit) const {
        for (std::int32_t y = 0; y < patch.height; ++y) {
            for (std::int32_t x = 0; x < patch.width; ++x) {
                const std::int32_t c = shape.index(patch.i + x, patch.j + y);
                const std::int32_t below = c - shape.stride;
                if ((x > 0 || first_moves_x()) && (!Solids || walls.open_u[c] > Real(0))) {
                    visit(c, c - 1, of(c, c - 1, along_x[x]), x, true);
                }
                if (moves_y(y) && (!Solids || walls.open_v[c] > Real(0))) {
                    visit(c, below, of(c, below, along_y[y]), x, false);
                }
            }
        }
    }
};

/// Fixed point does without: squares of velocities are wider than its numbers.
template <class Real>
constexpr bool kPaysForLifting = sizeof(Product<Real>) == sizeof(Real);

/// Sum of squares of a patch's excess from which on it counts as stirred: 0.025 a cell. A lattice
/// that a wave passes has a tenth of that.
template <class Real>
constexpr Real kStirred = Real(0.01);

/// At most a 64th of a patch's velocity is the price, and not more than a 256th comes back: impacts
/// keep their pressure, and what is at rest stays so.
template <class Real>
constexpr Real kMostPrice = Real(64);
template <class Real>
constexpr Real kMostRefund = Real(256);

/// Which share of its velocity a patch gives for what the drift lifts in it against the pressure,
/// and gets for what it lets down. Liquid in order is not asked: what it does is reversed later.
template <bool Solids, class Real>
Real price_of(const Drift<Solids, Real>& drift, const StaggeredGrid<Real>& grid) {
    const Real* p = drift.fields.pressure;
    Weights<Real> sums;
    bool done = false;
    if constexpr (kHasLanes<Real>) {
        done = drift.patch.width == kCoarseEdge;
        if (done) {
            weigh_rows(drift, grid, sums);
        }
    }
    if (!done) {
        const VelocityOf<Real>* e = drift.fields.divergence;
        drift.for_each_face([&](std::int32_t face, std::int32_t before, Real way, std::int32_t x,
                                bool on_u) {
            const Real now = on_u ? grid.u[face] : grid.v[face];
            sums.lifted[x] += way * (p[face] - p[before]);
            sums.moving[x] += now * now;
        });
        for (std::int32_t y = 0; y < drift.patch.height; ++y) {
            for (std::int32_t x = 0; x < drift.patch.width; ++x) {
                const Real here = e[drift.shape.index(drift.patch.i + x, drift.patch.j + y)];
                sums.disorder[x] += here * here;
            }
        }
    }
    const Real disorder = minimum<Real>(in_turn(sums.disorder), kStirred<Real>);
    const Real work = in_turn(sums.lifted) * (disorder / kStirred<Real>);
    const Real moving = in_turn(sums.moving);
    if (work > Real(0)) {
        return work / (moving + kMostPrice<Real> * work);
    }
    return moving > -kMostRefund<Real> * work ? work / moving : Real(0);
}

template <bool Solids, class Real>
void drift_apart(const Drift<Solids, Real>& drift, bool pays, StaggeredGrid<Real>& grid) {
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
    drift.for_each_face([&](std::int32_t face, std::int32_t, Real way, std::int32_t, bool on_u) {
        VelocityOf<Real>& velocity = on_u ? grid.u[face] : grid.v[face];
        if constexpr (kPaysForLifting<Real>) {
            if (price != Real(0)) {
                (on_u ? grid.mass_u[face] : grid.mass_v[face]) -= price * velocity;
            }
        }
        velocity -= way;
    });
}

template <class Real>
void find_excess(const GridShape& s, const Part& rows, PressureFields<Real>& fields) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        std::int32_t c = s.index(0, j);
        const std::int32_t end = s.index(s.nx, j);
        if constexpr (kHasLanes<Real>) {
            const ExcessLimits limits{kSurfaceSlack<Real>, kSubsurfaceSlack<Real>, kWindow<Real>,
                                      fields.on_surface};
            c = excess_lanes(fields, s.stride, limits, c, end);
        }
        for (; c < end; ++c) {
            fields.divergence[c] = excess(s, fields, c);
        }
    }
}

template <bool Solids, class Real>
void correct(const Borders<Real>& borders, const Walls<Real>& walls, Real speed, bool pays,
             PressureFields<Real>& fields, StaggeredGrid<Real>& grid, std::int32_t& overfull,
             Work work) {
    const GridShape& s = grid.shape;
    const GridShape& big = fields.coarse.shape;
    work.share(work.take(s.ny, s.nx), s.nx, 1,
               [&](const Part& rows, std::int32_t) { find_excess(s, rows, fields); });
    if (work.once(s.border())) {
        extend_cells(borders, s, fields.divergence);
    }
    // Drops under surface tension are small and keep together without.
    std::int32_t found[kMostPieces] = {};
    const std::int32_t cost = kCoarseEdge * s.nx;
    work.share(work.take(big.ny, cost), cost, 1, [&](const Part& rows, std::int32_t piece) {
        for (std::int32_t row = rows.first; row < rows.end; ++row) {
            average_row<Solids>(s, walls, row, fields, found[piece]);
        }
    });
    for (const std::int32_t some : found) {
        overfull += some;
    }
    if (work.once(big.border())) {
        mirror_cells(borders, big, fields.coarse.correction);
    }
    share_patches(s, big, work, [&](const Patch& patch, std::int32_t) {
        static_assert(kCoarseEdge == 4, "rises() knows four faces");
        Drift<Solids, Real> drift{borders, walls, fields, s, patch, speed, {}, {}};
        rises(fields.coarse.correction, patch.q, 1, drift.along_x);
        rises(fields.coarse.correction, patch.q, big.stride, drift.along_y);
        drift_apart(drift, pays, grid);
    });
}

template <bool Solids, class Real>
void keep_volume(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                 Real gain, bool pays, PressureFields<Real>& fields, StaggeredGrid<Real>& grid,
                 std::int32_t& overfull, Work work) {
    if (work.once(1)) {
        overfull = 0;
    }
    if constexpr (Stored<Real>::coarse) {
        correct_packed<Solids>(borders, walls, gain / dt_s, fields, grid, overfull, work);
    } else {
        correct<Solids>(borders, walls, gain / dt_s, pays, fields, grid, overfull, work);
    }
}

}  // namespace

template <class Real>
void volume_correction(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                       Real gain, bool pays, PressureFields<Real>& fields,
                       StaggeredGrid<Real>& grid, std::int32_t& overfull, Work work) {
    const auto stage = walls.active ? keep_volume<true, Real> : keep_volume<false, Real>;
    stage(borders, walls, dt_s, gain, pays, fields, grid, overfull, work);
}

template <class Real>
void volume_correction_in_open(const Borders<Real>& borders, const Walls<Real>& walls,
                               Seconds<Real> dt_s, Real gain, bool pays,
                               PressureFields<Real>& fields, StaggeredGrid<Real>& grid,
                               std::int32_t& overfull, Work work) {
    keep_volume<false, Real>(borders, walls, dt_s, gain, pays, fields, grid, overfull, work);
}

#define WEIR_INSTANTIATE(Real)                                                          \
    template void volume_correction(const Borders<Real>&, const Walls<Real>&,           \
                                    Seconds<Real>, Real, bool, PressureFields<Real>&,   \
                                    StaggeredGrid<Real>&, std::int32_t&, Work);         \
    template void volume_correction_in_open(const Borders<Real>&, const Walls<Real>&,   \
                                            Seconds<Real>, Real, bool, PressureFields<Real>&, \
                                            StaggeredGrid<Real>&, std::int32_t&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
