#include "pressure/coarse_correction.hpp"

#include "pressure/coarse_seams.hpp"
#include "pressure/patches.hpp"
#include "pressure/projection.hpp"

namespace weir {

namespace {

/// Sweeps over the coarse cells, from nothing: they see 64 rows of cells as 16.
constexpr std::int32_t kCoarseSweeps = 16;

/// Best for liquid n rows deep, closed below and with its surface on top: 2 / (1 + sin(π / 2n))
/// (Young 1954), and sin x ≈ x. Beyond 32 rows the best factor is too much for a few sweeps.
template <class Real>
Real over_relaxation(std::int32_t rows) {
    return Real(2) / (Real(1) + Real(1.5707963) / static_cast<Real>(clamp(rows, 4, 32)));
}

template <class Real>
void clear(Real* field, const GridShape& shape) {
    clear_rows(shape, {0, shape.ny + 2}, field);
}

/// What `residual` holds during the set-up: 0 for an empty patch, 1 for a full one, and this.
template <class Real>
constexpr Real kPartly = Real(0.5);

/// Centre of a patch's liquid.
template <class Real>
void find_centre(const GridShape& s, const PressureFields<Real>& fields, const Patch& patch,
                 CoarseGrid<Real>& coarse) {
    std::int32_t count = 0;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const Real* inverse = fields.inverse_diagonal + s.index(patch.i, patch.j + y);
        for (std::int32_t x = 0; x < patch.width; ++x) {
            if (inverse[x] != Real(0)) {
                count += 1;
                columns += x;
                rows += y;
            }
        }
    }
    const bool full = count == patch.width * patch.height;
    coarse.residual[patch.q] = full ? Real(1) : (count > 0 ? kPartly<Real> : Real(0));
    coarse.centre_x[patch.q] = part_of(static_cast<Real>(columns), maximum(count, 1));
    coarse.centre_y[patch.q] = part_of(static_cast<Real>(rows), maximum(count, 1));
}

template <class Real>
struct Face {
    Real open;
    Real light;  ///< 1/density
};

/// Faces across one axis, and what belongs to it.
template <class Real>
struct Axis {
    const PressureFields<Real>& fields;
    CoarseGrid<Real>& coarse;
    std::int32_t back;         ///< from a cell to the one before it
    std::int32_t coarse_back;
    const Real* centre;
    Real* weight;
    Real* reach;

    void add(std::int32_t q, Face<Real> face, Real distance) const {
        weight[q] += face.open * face.light / distance;
        if (reach != weight) {
            reach[q] += face.open / distance;
        }
    }
};

/// Where a cell of coarse cell q meets air the pressure is held at 0, as far away as the surface
/// is from q's centre: on q's face if there is only air that way, otherwise (a bubble, a notch) on
/// the diagonal alone.
template <class Real>
void hold(const Axis<Real>& axis, Face<Real> face, std::int32_t cell, std::int32_t air,
          Real outward, std::int32_t q, bool forward) {
    const Real level = axis.fields.level[cell];
    const Real distance =
        liquid_fraction(level, axis.fields.level[air], face.open) + maximum(Real(0), outward);
    const std::int32_t beyond = forward ? q + axis.coarse_back : q - axis.coarse_back;
    if (axis.coarse.residual[beyond] > Real(0)) {
        axis.coarse.inverse_diagonal[q] += face.open * face.light / distance;
    } else {
        axis.add(forward ? beyond : q, face, distance);
    }
}

/// Whether a face matters to the coarse grid: between two of its liquid cells, or at the surface.
inline bool counts(bool wet_before, bool wet, bool between) {
    return wet != wet_before || (wet && between);
}

/// Adds the face between cell `c` and the one before it. `at`: its place in its patch along the
/// axis; `before`: cells along the axis in the patch before, if the face lies between two.
template <class Real>
void add_face(const Axis<Real>& axis, Face<Real> face, std::int32_t c, std::int32_t at,
              std::int32_t before, std::int32_t q) {
    const std::int32_t b = c - axis.back;
    const bool wet_b = axis.fields.level[b] > Real(0);
    const bool wet_c = axis.fields.level[c] > Real(0);
    if (!(face.open > Real(0))) {
        return;
    }
    const bool between = at == 0;
    const std::int32_t p = between ? q - axis.coarse_back : q;
    const std::int32_t at_b = between ? before - 1 : at - 1;
    if (wet_b && wet_c) {
        if (between) {
            const Real distance = static_cast<Real>(before) + (axis.centre[q] - axis.centre[p]);
            axis.add(q, face, maximum(Real(1), distance));
        }
    } else if (wet_b) {
        hold(axis, face, b, c, static_cast<Real>(at_b) - axis.centre[p], p, true);
    } else {
        hold(axis, face, c, b, axis.centre[q] - static_cast<Real>(at), q, false);
    }
}

/// Faces before the cells of a patch. In one that is full or empty only those to the patches before
/// it matter.
template <bool Solids, bool Mixed, class Real>
void add_patch(const FaceWeights<Solids, Mixed, Real>& weights, const PressureFields<Real>& fields,
               const Patch& patch, CoarseGrid<Real>& coarse) {
    const GridShape& s = weights.grid.shape;
    const std::int32_t up = coarse.shape.stride;
    const bool mixed = coarse.residual[patch.q] == kPartly<Real>;
    const Axis<Real> along_x{fields, coarse, 1, 1, coarse.centre_x,
                             coarse.weight_u, coarse.reach_u};
    const Axis<Real> along_y{fields, coarse, s.stride, up, coarse.centre_y,
                             coarse.weight_v, coarse.reach_v};
    // Across a seam the patch before is the last one, which may have fewer cells.
    const std::int32_t left =
        patch.i > 0 ? kCoarseEdge : s.nx - kCoarseEdge * (coarse.shape.nx - 1);
    const std::int32_t below =
        patch.j > 0 ? kCoarseEdge : s.ny - kCoarseEdge * (coarse.shape.ny - 1);
    const auto wet = [&](std::int32_t c) { return fields.level[c] > Real(0); };
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const std::int32_t row = s.index(patch.i, patch.j + y);
        const std::int32_t last = mixed ? patch.width : 1;
        for (std::int32_t x = weights.has_left(patch.i) ? 0 : 1; x < last; ++x) {
            const std::int32_t c = row + x;
            if (counts(wet(c - 1), wet(c), x == 0)) {
                const Face<Real> face{weights.open_u(c), weights.light_u(c)};
                add_face(along_x, face, c, x, left, patch.q);
            }
        }
        if (y > 0 ? !mixed : !weights.has_lower(patch.j)) {
            continue;
        }
        for (std::int32_t x = 0; x < patch.width; ++x) {
            const std::int32_t c = row + x;
            if (counts(wet(c - s.stride), wet(c), y == 0)) {
                const Face<Real> face{weights.open_v(c), weights.light_v(c)};
                add_face(along_y, face, c, y, below, patch.q);
            }
        }
    }
}

/// How a patch's cells share in its own and its neighbours' unknowns: linear between the centres,
/// and to the surface.
template <class Real>
struct Shares {
    std::int32_t beside[kCoarseEdge];  ///< per column
    std::int32_t above[kCoarseEdge];   ///< per row; or below
    Real of_beside[kCoarseEdge];
    Real of_above[kCoarseEdge];

    Shares(const CoarseGrid<Real>& coarse, std::int32_t q) {
        const std::int32_t up = coarse.shape.stride;
        along(coarse.centre_x[q], coarse.reach_u[q], coarse.reach_u[q + 1], q, 1, beside,
              of_beside);
        along(coarse.centre_y[q], coarse.reach_v[q], coarse.reach_v[q + up], q, up, above,
              of_above);
    }

private:
    static void along(Real centre, Real before, Real after, std::int32_t q, std::int32_t step,
                      std::int32_t* neighbour, Real* share) {
        constexpr Real kPerEdge = Real(1.0 / kCoarseEdge);
        for (std::int32_t k = 0; k < kCoarseEdge; ++k) {
            const Real way = static_cast<Real>(k) - centre;
            neighbour[k] = way > Real(0) ? q + step : q - step;
            share[k] = kPerEdge * (way > Real(0) ? way * after : -way * before);
        }
    }
};

template <bool Solids, bool Mixed, class Real>
void gather_residual(const FaceWeights<Solids, Mixed, Real>& weights,
                     const PressureFields<Real>& fields, const Patch& patch,
                     CoarseGrid<Real>& coarse) {
    const GridShape& s = weights.grid.shape;
    const Shares<Real> to(coarse, patch.q);
    Real own = Real(0);
    for (std::int32_t y = 0; y < patch.height; ++y) {
        for (std::int32_t x = 0; x < patch.width; ++x) {
            const std::int32_t c = s.index(patch.i + x, patch.j + y);
            const Real inverse = fields.inverse_diagonal[c];
            if (inverse == Real(0)) {
                continue;
            }
            const Real held = fields.pressure[c];
            const Real residual =
                (weights.weighted(fields.pressure, c, inverse) - fields.divergence[c]) -
                (inverse == Real(0.25) ? Real(4) * held : held / absolute(inverse));
            const Real beside = to.of_beside[x] * residual;
            const Real above = to.of_above[y] * residual;
            own += residual - (beside + above);
            coarse.residual[to.beside[x]] += beside;
            coarse.residual[to.above[y]] += above;
        }
    }
    coarse.residual[patch.q] += own;
}

template <class Real>
void add_correction(const GridShape& s, const Patch& patch, PressureFields<Real>& fields) {
    const Shares<Real> from(fields.coarse, patch.q);
    const Real* e = fields.coarse.correction;
    const Real own = e[patch.q];
    Real column[kCoarseEdge];
    for (std::int32_t x = 0; x < patch.width; ++x) {
        column[x] = from.of_beside[x] * (e[from.beside[x]] - own);
    }
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const Real row = own + from.of_above[y] * (e[from.above[y]] - own);
        const std::int32_t c = s.index(patch.i, patch.j + y);
        for (std::int32_t x = 0; x < patch.width; ++x) {
            if (fields.inverse_diagonal[c + x] != Real(0)) {
                fields.pressure[c + x] += row + column[x];
            }
        }
    }
}

template <class Real>
void relax(const Borders<Real>& borders, Work work, CoarseGrid<Real>& coarse) {
    const GridShape& s = coarse.shape;
    Real* p = coarse.correction;
    const std::int32_t depth = maximum(0, coarse.last_row - coarse.first_row + 1);
    const Real omega = over_relaxation<Real>(depth);
    const Part part = work.take(2 * kCoarseSweeps * depth, (s.nx + 1) / 2);
    for (std::int32_t at = part.first; at < part.end; ++at) {
        const std::int32_t j = coarse.first_row + at % depth;
        for (std::int32_t i = (j + at / depth) & 1; i < s.nx; i += 2) {
            const std::int32_t q = s.index(i, j);
            const Real inverse = coarse.inverse_diagonal[q];
            if (inverse == Real(0)) {
                continue;
            }
            const std::int32_t up = q + s.stride;
            const Real sum = (coarse.weight_u[q] * p[q - 1] + coarse.weight_u[q + 1] * p[q + 1]) +
                             (coarse.weight_v[q] * p[q - s.stride] + coarse.weight_v[up] * p[up]);
            p[q] += omega * ((sum + coarse.residual[q]) * inverse - p[q]);
        }
        if (j == coarse.last_row) {
            extend_cells(borders, s, p);
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
    }
    share_patches(s, big, work, [&](const Patch& patch, std::int32_t) {
        find_centre(s, fields, patch, coarse);
    });
    if (work.once(3 * big.border())) {
        extend_cells(weights.borders, big, coarse.residual);
        extend_cells(weights.borders, big, coarse.centre_x);
        extend_cells(weights.borders, big, coarse.centre_y);
    }
    for_each_patch(s, big, work,
                   [&](const Patch& patch) { add_patch(weights, fields, patch, coarse); });
    if (work.once(4 * big.border())) {
        join_cells(weights.borders, big, coarse.inverse_diagonal);
        join_faces(weights.borders, big, coarse.weight_u, coarse.weight_v);
        if (Mixed) {
            join_faces(weights.borders, big, coarse.reach_u, coarse.reach_v);
        }
        coarse.first_row = big.ny;
        coarse.last_row = -1;
    }
    const Part rows = work.take(big.ny, big.nx);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        for (std::int32_t i = 0; i < big.nx; ++i) {
            const std::int32_t q = big.index(i, j);
            const Real diagonal =
                coarse.inverse_diagonal[q] +
                ((coarse.weight_u[q] + coarse.weight_u[q + 1]) +
                 (coarse.weight_v[q] + coarse.weight_v[q + big.stride]));
            const bool wet = coarse.residual[q] > Real(0) && diagonal > Real(0);
            coarse.inverse_diagonal[q] = wet ? Real(1) / diagonal : Real(0);
            coarse.first_row = wet ? minimum(coarse.first_row, j) : coarse.first_row;
            coarse.last_row = wet ? j : coarse.last_row;
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
    for_each_patch(s, big, work, [&](const Patch& patch) {
        if (coarse.inverse_diagonal[patch.q] != Real(0)) {
            gather_residual(weights, fields, patch, coarse);
        }
    });
    if (work.once(big.border())) {
        join_cells(weights.borders, big, coarse.residual);
    }
    relax(weights.borders, work, coarse);
    share_patches(s, big, work, [&](const Patch& patch, std::int32_t) {
        if (coarse.inverse_diagonal[patch.q] != Real(0)) {
            add_correction(s, patch, fields);
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
    for_each_patch(shape, coarse.shape, Work(), [&](const Patch& patch) {
        if (coarse.inverse_diagonal[patch.q] != Real(0)) {
            add_correction(shape, patch, fields);
        }
    });
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
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
WEIR_INSTANTIATE(Fixed)
#undef WEIR_INSTANTIATE
#undef WEIR_INSTANTIATE_FOR

}  // namespace weir
