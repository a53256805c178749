// The coarse grid's equations: where the liquid of each coarse cell has its centre, and how the
// faces of its cells join it to its neighbours and to the surface.
#pragma once

#include "pressure/coarse_faces_lanes.hpp"
#include "pressure/cut_off.hpp"
#include "pressure/face_weights.hpp"
#include "pressure/patches.hpp"
#include "pressure/projection.hpp"

namespace weir {

inline bool is_square(const Patch& patch) {
    return patch.width == kCoarseEdge && patch.height == kCoarseEdge;
}

/// Centre of a patch's liquid. Returns whether a wall touches some of it.
template <bool Solids, class Real>
bool find_centre(const GridShape& s, const PressureFields<Real>& fields, const Patch& patch,
                 CoarseGrid<Real>& coarse) {
    std::int32_t count = 0;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    bool at_wall = false;
    bool counted = false;
    if constexpr (kHasLanes<Real>) {
        if (patch.width == kCoarseEdge) {
            const auto cells = count_liquid(fields.inverse_diagonal, s.stride,
                                            s.index(patch.i, patch.j), patch.height);
            count = cells.count;
            columns = cells.columns;
            rows = cells.rows;
            at_wall = cells.at_wall;
            counted = true;
        }
    }
    for (std::int32_t y = 0; !counted && y < patch.height; ++y) {
        const auto* inverse = fields.inverse_diagonal + s.index(patch.i, patch.j + y);
        for (std::int32_t x = 0; x < patch.width; ++x) {
            if (!is_zero(Real(inverse[x]))) {
                count += 1;
                columns += x;
                rows += y;
                at_wall |= Solids && inverse[x] < VelocityOf<Real>(0);
            }
        }
    }
    if (count == 0) {
        coarse.residual[patch.q] = Real(0);
        coarse.centre_x[patch.q] = Real(0);
        coarse.centre_y[patch.q] = Real(0);
        return false;
    }
    const bool full = count == patch.width * patch.height;
    coarse.residual[patch.q] = full ? Real(1) : kPartly<Real>;
    put_centre(patch.q, count, columns, rows, coarse);
    return at_wall;
}

template <class Real>
struct CoarseFace {
    Real open;
    Real light;  ///< 1/density
};

/// Faces across one axis, and what belongs to it.
template <class Real>
struct CoarseAxis {
    const PressureFields<Real>& fields;
    CoarseGrid<Real>& coarse;
    std::int32_t back;         ///< from a cell to the one before it
    std::int32_t coarse_back;
    const Real* centre;
    Real* weight;
    Real* reach;
    const Targets& targets;

    void add(std::int32_t q, CoarseFace<Real> face, Real distance) const {
        if (!targets.has(q)) {
            return;
        }
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
void hold(const CoarseAxis<Real>& axis, CoarseFace<Real> face, std::int32_t cell, std::int32_t air,
          Real outward, std::int32_t q, bool forward) {
    const Real level = axis.fields.level[cell];
    const Real beside = axis.fields.level[air];
    const Real distance = liquid_fraction(axis.fields, level, beside, face.open) +
                          maximum(Real(0), outward);
    const std::int32_t beyond = forward ? q + axis.coarse_back : q - axis.coarse_back;
    if (axis.coarse.residual[beyond] > Real(0)) {
        if (!axis.targets.has(q)) {
            return;
        }
        axis.coarse.inverse_diagonal[q] += face.open * face.light / distance;
    } else {
        axis.add(forward ? beyond : q, face, distance);
    }
}

/// Of a patch: whether it is neither full nor empty, and whether it has others before it.
struct PatchSides {
    bool mixed;
    bool has_left;
    bool has_lower;
    CutFaces cut;
};

/// Calls add_u(c, column) and add_v(c, row) for those faces before cells of a patch that the coarse
/// grid asks for: at the surface, and between liquid cells of two patches. liquid(c): which cells
/// of a row from c on hold liquid, a bit each; c0: the patch's first cell.
template <class Level, class Liquid, class AddU, class AddV>
inline void each_face_that_counts(const Patch& patch, const Level* level, std::int32_t stride,
                                  std::int32_t c0, PatchSides sides, const Liquid& liquid,
                                  const AddU& add_u, const AddV& add_v) {
    const std::uint32_t behind_others = (1U << static_cast<std::uint32_t>(patch.width)) - 2U;
    std::uint32_t under = sides.has_lower ? liquid(c0 - stride) : 0;
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const std::int32_t c = c0 + y * stride;
        const std::uint32_t here = liquid(c);
        std::uint32_t on_u = sides.mixed ? (here ^ (here << 1U)) & behind_others : 0;
        if (sides.has_left && ((here & 1U) != 0 || is_positive(level[c - 1]))) {
            on_u |= 1U;
        }
        std::uint32_t on_v = sides.mixed ? here ^ under : 0;
        if (y == 0) {
            on_v = sides.has_lower ? here | under : 0;
        }
        if (WEIR_SELDOM((sides.cut.u | sides.cut.v) != 0)) {
            on_u &= ~(sides.cut.u >> static_cast<std::uint32_t>(kCoarseEdge * y));
            on_v &= ~(sides.cut.v >> static_cast<std::uint32_t>(kCoarseEdge * y));
        }
        for (; on_u != 0; on_u &= on_u - 1) {
            const std::int32_t x = WEIR_TRAILING_ZEROS(on_u);
            add_u(c + x, x);
        }
        for (; on_v != 0; on_v &= on_v - 1) {
            add_v(c + WEIR_TRAILING_ZEROS(on_v), y);
        }
        under = here;
    }
}

/// Adds the face between cell `c` and the one before it. `at`: its place in its patch along the
/// axis; `before`: cells along the axis in the patch before, if the face lies between two.
template <class Real>
void add_face(const CoarseAxis<Real>& axis, CoarseFace<Real> face, std::int32_t c, std::int32_t at,
              std::int32_t before, std::int32_t q) {
    const std::int32_t b = c - axis.back;
    const bool wet_b = is_positive(Real(axis.fields.level[b]));
    const bool wet_c = is_positive(Real(axis.fields.level[c]));
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

/// Whether a patch and the two before it are full: nothing but faces between them is to be found.
template <class Real>
bool among_full(const Patch& patch, const CoarseGrid<Real>& coarse) {
    const Real* full = coarse.residual;
    return full[patch.q] == Real(1) && full[patch.q - 1] == Real(1) &&
           full[patch.q - coarse.shape.stride] == Real(1) && is_square(patch) && patch.i > 0 &&
           patch.j > 0;
}

/// Whether there is no liquid in a patch and the two before it: no face of it matters.
template <class Real>
bool among_empty(const Patch& patch, const CoarseGrid<Real>& coarse) {
    const Real* full = coarse.residual;
    return !(full[patch.q] > Real(0) || full[patch.q - 1] > Real(0) ||
             full[patch.q - coarse.shape.stride] > Real(0));
}

/// Such a patch: its faces lie four cells from middle to middle.
template <bool Solids, bool Mixed, class Real>
void join_full(const FaceWeights<Solids, Mixed, Real>& weights, const Patch& patch,
               CoarseGrid<Real>& coarse) {
    if constexpr (!Solids && !Mixed) {
        coarse.weight_u[patch.q] = coarse.weight_v[patch.q] = Real(1);
        return;
    }
    const GridShape& s = weights.grid.shape;
    const std::int32_t first = s.index(patch.i, patch.j);
    const auto sum_of_four = [&](const auto& share, std::int32_t step) {
        Real sum = Real(0);
        for (std::int32_t k = 0; k < kCoarseEdge; ++k) {
            sum += share(first + k * step) / Real(kCoarseEdge);
        }
        return sum;
    };
    const auto u = [&](std::int32_t face) { return weights.u(face); };
    const auto v = [&](std::int32_t face) { return weights.v(face); };
    coarse.weight_u[patch.q] = sum_of_four(u, s.stride);
    coarse.weight_v[patch.q] = sum_of_four(v, 1);
    if constexpr (Mixed) {
        const auto open_u = [&](std::int32_t face) { return weights.open_u(face); };
        const auto open_v = [&](std::int32_t face) { return weights.open_v(face); };
        coarse.reach_u[patch.q] = sum_of_four(open_u, s.stride);
        coarse.reach_v[patch.q] = sum_of_four(open_v, 1);
    }
}

/// Faces before the cells of a patch. In one that is full or empty only those to the patches before
/// it matter.
template <bool Solids, bool Mixed, class Real>
WEIR_ALWAYS_INLINE void add_patch(const FaceWeights<Solids, Mixed, Real>& weights,
                                  const PressureFields<Real>& fields, const Patch& patch,
                                  const Targets& targets, CoarseGrid<Real>& coarse) {
    const GridShape& s = weights.grid.shape;
    const std::int32_t up = coarse.shape.stride;
    if (among_empty(patch, coarse)) {
        return;
    }
    const bool mixed = coarse.residual[patch.q] == kPartly<Real>;
    const CoarseAxis<Real> along_x{fields,          coarse,         1,      1, coarse.centre_x,
                                   coarse.weight_u, coarse.reach_u, targets};
    const CoarseAxis<Real> along_y{fields,          coarse,         s.stride, up, coarse.centre_y,
                                   coarse.weight_v, coarse.reach_v, targets};
    // With faces of many kinds not worth its code where that is scarce.
    if ((kHasLanes<Real> || (!Solids && !Mixed)) && among_full(patch, coarse)) {
        if (targets.has(patch.q)) {
            join_full(weights, patch, coarse);
        }
        return;
    }
    // Across a seam the patch before is the last one, which may have fewer cells.
    const std::int32_t left =
        patch.i > 0 ? kCoarseEdge : s.nx - kCoarseEdge * (coarse.shape.nx - 1);
    const std::int32_t below =
        patch.j > 0 ? kCoarseEdge : s.ny - kCoarseEdge * (coarse.shape.ny - 1);
    const auto add_u = [&](std::int32_t c, std::int32_t x) {
        const CoarseFace<Real> face{weights.open_u(c), weights.light_u(c)};
        add_face(along_x, face, c, x, left, patch.q);
    };
    const auto add_v = [&](std::int32_t c, std::int32_t y) {
        const CoarseFace<Real> face{weights.open_v(c), weights.light_v(c)};
        add_face(along_y, face, c, y, below, patch.q);
    };
    const bool has_left = weights.has_left(patch.i);
    const bool has_lower = weights.has_lower(patch.j);
    const std::int32_t first = s.index(patch.i, patch.j);
    const PatchSides sides{mixed, has_left, has_lower,
                           Solids && coarse.parted ? cut_faces(coarse, patch.q)
                                                  : CutFaces{}};
    if constexpr (kHasLanes<Real>) {
        if (patch.width == kCoarseEdge) {
            each_face_that_counts(
                patch, fields.level, s.stride, first, sides,
                [&](std::int32_t c) { return liquid_bits(fields.level + c); }, add_u, add_v);
            return;
        }
    }
    const auto liquid = [&](std::int32_t c) {
        std::uint32_t bits = 0;
        for (std::int32_t k = c + patch.width - 1; k >= c; --k) {
            bits = bits + bits + (is_positive(Real(fields.level[k])) ? 1U : 0U);
        }
        return bits;
    };
    each_face_that_counts(patch, fields.level, s.stride, first, sides, liquid, add_u, add_v);
}

#if WEIR_HAS_LANES
/// `add_patch` of the patches of a row that are of full width. Returns how many they are.
template <bool Solids>
std::int32_t add_patches_in_lanes(const FaceWeights<Solids, false, float>& weights,
                                  const PressureFields<float>& fields, std::int32_t row,
                                  const Targets& targets, CoarseGrid<float>& coarse) {
    const CoarseFacesTask task{fields, weights.grid.shape,
                               Solids ? weights.walls.open_u : nullptr,
                               Solids ? weights.walls.open_v : nullptr};
    std::uint32_t told = 0;
    return for_whole_patches<8 * kCoarseEdge * kCoarseEdge>(
        task.shape, coarse.shape, row,
        [&](const Patch& patch) {
            if (!among_full(patch, coarse)) {
                return !among_empty(patch, coarse);
            }
            if (targets.has(patch.q)) {
                join_full(weights, patch, coarse);
            }
            return false;
        },
        [&](const Patch& patch, bool two, float* terms) {
            const auto find = two ? wide_cells()->find_face_terms : find_face_terms<FourLanes>;
            told = find(task, patch, terms);
        },
        [&](const Patch& patch, float* terms, std::int32_t step) {
            if (Solids && coarse.parted) {
                empty_cut_faces(cut_faces(coarse, patch.q), terms, step);
            }
            add_face_terms(told, terms, step, patch, targets, coarse);
        });
}
#endif

/// Of some rows of patches.
template <bool Solids, bool Mixed, class Real>
void add_patches(const FaceWeights<Solids, Mixed, Real>& weights,
                 const PressureFields<Real>& fields, const Part& rows, const Targets& targets,
                 CoarseGrid<Real>& coarse) {
    const GridShape& s = weights.grid.shape;
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const Part columns = patches_in(s, coarse.shape, row);
        std::int32_t column = columns.first;
        if constexpr (kHasLanes<Real> && !Mixed) {
            if (!weights.borders.wrap_x && !weights.borders.wrap_y) {
                column = add_patches_in_lanes(weights, fields, row, targets, coarse);
            }
        }
        for (; column < columns.end; ++column) {
            add_patch(weights, fields, patch_of(s, coarse.shape, column, row), targets, coarse);
        }
    }
}

}  // namespace weir
