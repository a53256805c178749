#include "pressure/coarse_correction.hpp"

#include <cstring>

#include "pressure/coarse_faces.hpp"
#include "pressure/coarse_residual.hpp"
#include "pressure/coarse_seams.hpp"
#include "pressure/coarse_shares.hpp"
#include "pressure/coarse_sweep_lanes.hpp"
#include "pressure/patches.hpp"
#include "pressure/projection.hpp"
#include "pressure/relax_fpu.hpp"

namespace weir {

namespace {

/// Sweeps over the coarse cells, from nothing: they see 64 rows of cells as 16.
constexpr std::int32_t kCoarseSweeps = 16;

/// Best for liquid n cells deep, closed below and with its surface on top: 2 / (1 + sin(π / 2n))
/// (Young 1954), and sin x ≈ x. Beyond 32 cells the best factor is too much for a few sweeps.
template <class Real>
Real over_relaxation(std::int32_t depth) {
    return Real(2) / (Real(1) + Real(1.5707963) / static_cast<Real>(clamp(depth, 4, 32)));
}

template <class Real>
void clear(Real* field, const GridShape& shape) {
    clear_rows(shape, {0, shape.ny + 2}, field);
}

#if WEIR_HAS_LANES
/// `gather_residual` of the patches of a row that are of full width. Returns how many they are.
template <bool Solids>
std::int32_t gather_in_lanes(const FaceWeights<Solids, false, float>& weights,
                             const PressureFields<float>& fields, std::int32_t row,
                             const Targets& targets, CoarseGrid<float>& coarse) {
    static_assert(kCoarseEdge == 4, "a row of a patch is four lanes");
    const GridShape& s = weights.grid.shape;
    const float* open_u = Solids ? weights.walls.open_u : nullptr;
    const float* open_v = Solids ? weights.walls.open_v : nullptr;
    return for_whole_patches<kTerms>(
        s, coarse.shape, row,
        [&](const Patch& patch) { return coarse.inverse_diagonal[patch.q] != 0.0F; },
        [&](const Patch& patch, bool two, float* terms) {
            const auto find = two ? wide_cells()->find_terms : find_terms<FourLanes>;
            find(fields, open_u, open_v, s.stride, patch.q, s.index(patch.i, patch.j),
                 patch.height, terms);
        },
        [&](const Patch& patch, const float* terms, std::int32_t step) {
            add_terms(terms, step, patch, targets, coarse);
            move_cut_off(weights, fields, patch, targets, coarse);
        });
}
#endif

template <bool Solids, bool Mixed, class Real>
void gather_residual(const FaceWeights<Solids, Mixed, Real>& weights,
                     const PressureFields<Real>& fields, const Patch& patch,
                     const Targets& targets, CoarseGrid<Real>& coarse) {
    const GridShape& s = weights.grid.shape;
    const CoarseShares<Real> to(coarse, patch.q);
    const bool own_row = targets.has(patch.q);
    Real* const sums = coarse.residual + patch.q;
    Real own = Real(0);
    Real left = own_row ? sums[-1] : Real(0);
    Real right = own_row ? sums[1] : Real(0);
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const std::int32_t up = y < to.rows_before ? -coarse.shape.stride : coarse.shape.stride;
        const bool counted = targets.has(patch.q + up);
        const std::int32_t row = s.index(patch.i, patch.j + y);
        const Real of_above = to.of_above[y];
        Real vertical = counted ? sums[up] : Real(0);
        const VelocityOf<Real>* const diagonal = whole(fields.inverse_diagonal + row);
        const VelocityOf<Real>* const flow = whole(fields.divergence + row);
        const Real* const p = whole(fields.pressure + row);
        const auto add = [&](std::int32_t x) {
            const Real inverse = diagonal[x];
            if (is_zero(inverse)) {
                return;
            }
            const Real residual = residual_of(weights, p + x, row + x, inverse, flow[x]);
            const Real beside = to.of_beside[x] * residual;
            const Real above = of_above * residual;
            own += residual - (beside + above);
            (x < to.columns_before ? left : right) += beside;
            vertical += above;
        };
        if constexpr (Solids || Mixed) {  // too much to be there four times
            for (std::int32_t x = 0; x < patch.width; ++x) {
                add(x);
            }
        } else {
            for_each_column(patch, add);
        }
        if (counted) {
            sums[up] = vertical;
        }
    }
    if (own_row) {
        sums[-1] = left;
        sums[0] += own;
        sums[1] = right;
    }
    move_cut_off(weights, fields, patch, targets, coarse);
}

/// Of some rows of patches.
template <bool Solids, bool Mixed, class Real>
void gather_residuals(const FaceWeights<Solids, Mixed, Real>& weights,
                      const PressureFields<Real>& fields, const Part& rows,
                      const Targets& targets, CoarseGrid<Real>& coarse) {
    const GridShape& s = weights.grid.shape;
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const Part columns = patches_in(s, coarse.shape, row);
        std::int32_t column = columns.first;
        if constexpr (kHasLanes<Real> && !Mixed) {
            column = gather_in_lanes(weights, fields, row, targets, coarse);
        }
        for (; column < columns.end; ++column) {
            const Patch patch = patch_of(s, coarse.shape, column, row);
            if (coarse.inverse_diagonal[patch.q] != Real(0)) {
                gather_residual(weights, fields, patch, targets, coarse);
            }
        }
    }
}

template <class Real>
void add_correction(const GridShape& s, const Patch& patch, PressureFields<Real>& fields) {
    const CoarseShares<Real> from(fields.coarse, patch.q);
    const Real* const e = fields.coarse.correction + patch.q;
    const std::int32_t up = fields.coarse.shape.stride;
    const Real own = e[0];
    Real column[kCoarseEdge];
    for_each_column(patch, [&](std::int32_t x) {
        column[x] = from.of_beside[x] * (e[x < from.columns_before ? -1 : 1] - own);
    });
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const Real row = own + from.of_above[y] * (e[y < from.rows_before ? -up : up] - own);
        const std::int32_t c = s.index(patch.i, patch.j + y);
        const VelocityOf<Real>* const inverse = whole(fields.inverse_diagonal + c);
        Real* const p = whole(fields.pressure + c);
        for_each_column(patch, [&](std::int32_t x) {
            if (!is_zero(Real(inverse[x]))) {
                p[x] += row + column[x];
            }
        });
    }
}

/// Of some rows of patches.
template <class Real>
void add_corrections(const GridShape& s, const Part& rows, PressureFields<Real>& fields) {
    const GridShape& big = fields.coarse.shape;
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const Part columns = patches_in(s, big, row);
        std::int32_t column = columns.first;
        if constexpr (kHasLanes<Real>) {
            const Patch first = patch_of(s, big, column, row);
            column += correct_in_lanes(fields, s.stride, first.q, s.index(first.i, first.j),
                                       first.height, whole_patches(s, row));
        }
        for (; column < columns.end; ++column) {
            const Patch patch = patch_of(s, big, column, row);
            if (fields.coarse.inverse_diagonal[patch.q] != Real(0)) {
                add_correction(s, patch, fields);
            }
        }
    }
}

/// Every other coarse cell of some rows.
template <class Real>
void relax(const Part& rows, std::int32_t colour, Real omega, CoarseGrid<Real>& coarse) {
    const GridShape& s = coarse.shape;
    if constexpr (kHasFpuLoops<Real>) {
        relax_coarse(coarse, (rows.first + colour) & 1, rows.first, rows.end - rows.first, omega);
        return;
    }
    Real* p = coarse.correction;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::int32_t end = s.index(s.nx, j);
        for (std::int32_t q = s.index((j + colour) & 1, j); q < end; q += 2) {
            const Real inverse = coarse.inverse_diagonal[q];
            if (is_zero(inverse)) {
                continue;
            }
            const std::int32_t up = q + s.stride;
            const Real sum = (coarse.weight_u[q] * p[q - 1] + coarse.weight_u[q + 1] * p[q + 1]) +
                             (coarse.weight_v[q] * p[q - s.stride] + coarse.weight_v[up] * p[up]);
            p[q] += omega * ((sum + coarse.residual[q]) * inverse - p[q]);
        }
    }
}

template <class Real>
void sweep(const Borders<Real>& borders, const Solve<Real>& solve, Work work,
           CoarseGrid<Real>& coarse) {
    const GridShape& s = coarse.shape;
    const std::int32_t lowest = coarse.first_row;
    const std::int32_t rows = maximum(0, coarse.last_row - lowest + 1);
    const Real omega = over_relaxation<Real>(solve.depth(rows));
    const Part part = work.take(2 * kCoarseSweeps * rows, (s.nx + 1) / 2);
    if constexpr (kHasLanes<Real>) {
        if (part.first == 0 && part.end == 2 * kCoarseSweeps * rows && rows > 0) {
            sweep_apart(borders, 2 * kCoarseSweeps, omega, coarse);
            return;
        }
    }
    for (std::int32_t at = part.first; at < part.end;) {
        const std::int32_t colour = at / rows;
        const std::int32_t begin = colour * rows;
        const std::int32_t end = minimum(part.end, begin + rows);
        relax({lowest + at - begin, lowest + end - begin}, colour, omega, coarse);
        if (end == begin + rows) {
            extend_cells(borders, s, coarse.correction);
        }
        at = end;
    }
}

/// Centres of the patches' liquid, and what of them walls cut off.
template <bool Solids, bool Mixed, class Real>
void find_centres(const FaceWeights<Solids, Mixed, Real>& weights, PressureFields<Real>& fields,
                  Work work) {
    CoarseGrid<Real>& coarse = fields.coarse;
    const GridShape& s = weights.grid.shape;
    const GridShape& big = coarse.shape;
    share_patches(s, big, work, [&](const Patch& patch, std::int32_t) {
        if (find_centre<Solids>(s, fields, patch, coarse) && Solids) {
            cut_patch(weights.walls, s, fields, patch, coarse);
        }
    });
    if constexpr (Solids) {
        if (work.once(big.size())) {
            coarse.parted = any_cut_off(coarse);
        }
        if (coarse.parted || work.foreseeing()) {
            work.share(work.take(big.ny, big.nx), big.nx, 1, [&](const Part& rows, std::int32_t) {
                for_each_parted(s, coarse, rows, [&](const Patch& patch) {
                    join_cut_off(weights.walls, fields, s, patch);
                });
            });
        }
    }
}

}  // namespace

template <bool Solids, bool Mixed, class Real>
void set_up_coarse(const FaceWeights<Solids, Mixed, Real>& weights, PressureFields<Real>& fields,
                   Work work) {
    CoarseGrid<Real>& coarse = fields.coarse;
    const GridShape& s = weights.grid.shape;
    const GridShape& big = coarse.shape;
    if (work.once(8 * big.size())) {
        Real* const fresh[] = {coarse.residual, coarse.inverse_diagonal, coarse.weight_u,
                               coarse.weight_v, coarse.centre_x,         coarse.centre_y};
        for (Real* field : fresh) {
            clear(field, big);
        }
        if (Mixed) {
            clear(coarse.reach_u, big);
            clear(coarse.reach_v, big);
        }
        coarse.parted = false;
        if constexpr (Solids) {
            clear(coarse.cut_off, big);
        }
    }
    find_centres(weights, fields, work);
    if (work.once(3 * big.border())) {
        extend_cells(weights.borders, big, coarse.residual);
        extend_cells(weights.borders, big, coarse.centre_x);
        extend_cells(weights.borders, big, coarse.centre_y);
    }
    // Patches add to the faces before them.
    const bool seam = weights.borders.wrap_y;
    const Part beside_liquid{seam ? 0 : fields.solve.first_row / kCoarseEdge,
                             seam ? big.ny : fields.solve.last_row / kCoarseEdge + 2};
    share_sums_of_patches(s, big, beside_liquid, work, [&](const Part& rows,
                                                           const Targets& targets) {
        add_patches(weights, fields, rows, targets, coarse);
    });
    if (work.once(4 * big.border())) {
        join_cells(weights.borders, big, coarse.inverse_diagonal);
        join_faces(weights.borders, big, coarse.weight_u, coarse.weight_v);
        if (Mixed) {
            join_faces(weights.borders, big, coarse.reach_u, coarse.reach_v);
        }
        coarse.first_row = static_cast<std::int16_t>(big.ny);
        coarse.last_row = -1;
    }
    std::int16_t& longest = fields.solve.longest_row;
    const Part rows = work.take(big.ny, big.nx);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        std::int32_t first = -1;
        std::int32_t last = -1;
        for (std::int32_t i = 0; i < big.nx; ++i) {
            const std::int32_t q = big.index(i, j);
            const Real diagonal =
                coarse.inverse_diagonal[q] +
                ((coarse.weight_u[q] + coarse.weight_u[q + 1]) +
                 (coarse.weight_v[q] + coarse.weight_v[q + big.stride]));
            const bool wet = coarse.residual[q] > Real(0) && diagonal > Real(0);
            coarse.inverse_diagonal[q] = wet ? Real(1) / diagonal : Real(0);
            if (wet) {
                coarse.last_row = static_cast<std::int16_t>(j);
                coarse.first_row = minimum(coarse.first_row, coarse.last_row);
                first = first < 0 ? i : first;
                last = i;
            }
        }
        if (last >= 0 && longest != Solve<Real>::kNotAsked) {
            longest = maximum(longest, static_cast<std::int16_t>(last - first + 1));
        }
    }
}

template <bool Solids, bool Mixed, class Real>
void correct_coarse(const FaceWeights<Solids, Mixed, Real>& weights, PressureFields<Real>& fields,
                    Work work) {
    CoarseGrid<Real>& coarse = fields.coarse;
    const GridShape& s = weights.grid.shape;
    const GridShape& big = coarse.shape;
    if (work.once(2 * big.size())) {
        clear(coarse.residual, big);
        clear(coarse.correction, big);
    }
    const Part filled{coarse.first_row, coarse.last_row + 1};
    share_sums_of_patches(s, big, filled, work, [&](const Part& rows, const Targets& targets) {
        gather_residuals(weights, fields, rows, targets, coarse);
    });
    if (work.once(big.border())) {
        join_cells(weights.borders, big, coarse.residual);
    }
    sweep(weights.borders, fields.solve, work, coarse);
    const std::int32_t cost = kCoarseEdge * s.nx;
    work.share(work.take(big.ny, cost), cost, 1,
               [&](const Part& rows, std::int32_t) {
        add_corrections(s, rows, fields);
        if (Solids && coarse.parted) {
            correct_cut_off(s, rows, fields);
        }
    });
}

template <class Real>
void add_again(const GridShape& shape, Real factor, PressureFields<Real>& fields) {
    CoarseGrid<Real>& coarse = fields.coarse;
    for_each_run(coarse.shape, {0, coarse.shape.ny + 2}, [&](const Part& run) {
        for (std::int32_t q = run.first; q < run.end; ++q) {
            coarse.correction[q] = factor * coarse.correction[q];
        }
    });
    const Part all{0, coarse.shape.ny};
    add_corrections(shape, all, fields);
    if (coarse.parted) {
        correct_cut_off(shape, all, fields);
    }
}

#define WEIR_INSTANTIATE_FOR(Solids, Mixed, Real)                                                \
    template void set_up_coarse(const FaceWeights<Solids, Mixed, Real>&, PressureFields<Real>&,  \
                                Work);                                                           \
    template void correct_coarse(const FaceWeights<Solids, Mixed, Real>&, PressureFields<Real>&, \
                                 Work);
#define WEIR_INSTANTIATE(Real)                                              \
    template void add_again(const GridShape&, Real, PressureFields<Real>&); \
    WEIR_INSTANTIATE_FOR(false, false, Real)                                \
    WEIR_INSTANTIATE_FOR(true, false, Real)                                 \
    WEIR_INSTANTIATE_FOR(false, true, Real)                                 \
    WEIR_INSTANTIATE_FOR(true, true, Real)
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE
#undef WEIR_INSTANTIATE_FOR

}  // namespace weir
