// Faces between cells as the coarse grid's equations want them, a row of a patch at a time: the
// plain loops' sums, in their order, and so their bits.
#pragma once

#include "pressure/coarse_lanes.hpp"
#include "pressure/cut_off.hpp"
#include "pressure/patches.hpp"
#include "pressure/system_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

struct CoarseFacesTask {
    const PressureFields<float>& fields;
    const GridShape& shape;
    const float* open_u;  ///< open fractions; null: all faces are wide open
    const float* open_v;
};

/// Faces across one axis, of patches from q on, one a group.
template <class L>
struct FacesAlong {
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    Lever lever;
    Floats centre;
    Floats centre_before;
    Ints liquid_before;  ///< whether the patch before holds any
    Ints liquid_here;
    Ints liquid_behind;

    FacesAlong(const PressureFields<float>& fields, const float* centres, std::int32_t q,
               std::int32_t back)
        : lever(lever_of(fields)) {
        const auto holds_liquid = [&](std::int32_t at) {
            return L::one_a_group(fields.coarse.residual + at) > L::all(0.0F);
        };
        centre = L::one_a_group(centres + q);
        centre_before = L::one_a_group(centres + q - back);
        liquid_before = holds_liquid(q - back);
        liquid_here = holds_liquid(q);
        liquid_behind = holds_liquid(q + back);
    }

    /// As `add_face` and `hold`, what faces before cells add: to the diagonal and the face of their
    /// patch, the face behind it, and the diagonal of the patch before. `before`, `here`: levels on
    /// both sides; `place`: of the cells in their patch; `first`: faces between two patches.
    WEIR_ALWAYS_INLINE bool find(Floats before, Floats here, Floats open, Floats place, Ints first,
                                 float* terms) const {
        const auto zero = L::all(0.0F);
        const auto wet_before = before > zero;
        const auto wet_here = here > zero;
        const auto between = wet_before & wet_here & first;
        const auto forward = wet_before & ~wet_here;
        const auto backward = wet_here & ~wet_before;
        const auto counts = between | forward | backward;
        if (!L::any_true(counts)) {
            return false;
        }
        const auto outward = forward ? (first ? L::all(kCoarseEdge - 1.0F) - centre_before
                                              : (place - L::all(1.0F)) - centre)
                                     : centre - place;
        const auto apart =
            L::maximum(L::all(1.0F), L::all(kCoarseEdge) + (centre - centre_before));
        const auto surface =
            fraction_between<L>(lever, before, here, open) + L::maximum(zero, outward);
        const auto weight = counts ? open / (between ? apart : surface) : zero;
        const auto to_own = (backward & liquid_before) | (forward & (~first & liquid_behind));
        const auto to_behind = forward & ~(first | liquid_behind);
        const auto to_before = forward & (first & liquid_here);
        Floats cells[] = {to_own ? weight : zero, to_own | to_behind | to_before ? zero : weight,
                          to_behind ? weight : zero, to_before ? weight : zero};
        transpose<L>(cells);
        L::store(terms, cells[0]);
        L::store(terms + L::kLanes, cells[1]);
        L::store(terms + 2 * L::kLanes, cells[2]);
        L::store(terms + 3 * L::kLanes, cells[3]);
        return true;
    }
};

/// What all faces before the cells of a patch, or of it and the next one, add: row by row, first
/// across x, then across y; those of one patch beside those of the next. Returns a bit for each
/// four or eight faces of which one adds anything; the terms of others are not written.
template <class L>
inline std::uint32_t find_face_terms(const CoarseFacesTask& task, const Patch& patch,
                                     float* terms) {
    const CoarseGrid<float>& coarse = task.fields.coarse;
    const std::int32_t stride = task.shape.stride;
    const FacesAlong<L> across_x(task.fields, coarse.centre_x, patch.q, 1);
    const FacesAlong<L> across_y(task.fields, coarse.centre_y, patch.q, coarse.shape.stride);
    const auto one = L::all(1.0F);
    const auto columns = L::repeat(0.0F, 1.0F, 2.0F, 3.0F);
    const auto within = open_before<L>(patch.i == 0);
    std::int32_t c = task.shape.index(patch.i, patch.j);
    auto below = L::load(task.fields.level + c - stride);
    std::uint32_t told = 0;
    for (std::int32_t y = 0; y < patch.height; ++y, c += stride, terms += 8 * L::kLanes) {
        const auto here = L::load(task.fields.level + c);
        const auto open_u = task.open_u != nullptr ? L::load(task.open_u + c) : one;
        const auto open_v = task.open_v != nullptr ? L::load(task.open_v + c) : one;
        const bool on_u = across_x.find(L::load(task.fields.level + c - 1), here, within * open_u,
                                        columns, columns == L::all(0.0F), terms);
        // `first` is a constant in either case.
        const bool on_v =
            y > 0 ? across_y.find(below, here, open_v, L::all(static_cast<float>(y)), one != one,
                                  terms + 4 * L::kLanes)
                  : patch.j > 0 && across_y.find(below, here, open_v, L::all(0.0F), one == one,
                                                 terms + 4 * L::kLanes);
        told |= ((on_u ? 1U : 0U) | (on_v ? 2U : 0U)) << static_cast<std::uint32_t>(2 * y);
        below = here;
    }
    return told;
}

/// Takes out what such faces add. `terms`, `step`: as `add_face_terms` has them.
inline void empty_cut_faces(const CutFaces& cut, float* terms, std::int32_t step) {
    const auto empty = [&](std::uint32_t faces, float* first) {
        for (; faces != 0; faces &= faces - 1) {
            const std::int32_t bit = WEIR_TRAILING_ZEROS(faces);
            float* const four = first + (bit % kCoarseEdge + bit / kCoarseEdge * 8) * step;
            four[0] = four[1] = four[2] = four[3] = 0.0F;
        }
    };
    empty(cut.u, terms);
    empty(cut.v, terms + 4 * step);
}

/// Adds what the faces of a patch add, one after the other. `told`: by `find_face_terms`; `step`:
/// from one face's terms to the next one's.
inline void add_face_terms(std::uint32_t told, const float* terms, std::int32_t step,
                           const Patch& patch, const Targets& targets, CoarseGrid<float>& coarse) {
    const std::int32_t up = coarse.shape.stride;
    const bool own_row = targets.has(patch.q);
    float* const held = coarse.inverse_diagonal + patch.q;
    float* const left = coarse.weight_u + patch.q;
    float* const lower = coarse.weight_v + patch.q;
    Lanes along{};
    Lanes upward{};
    if (own_row) {
        along = Lanes{held[0], left[0], left[1], held[-1]};
        upward[1] = lower[0];
    }
    if (targets.has(patch.q + up)) {
        upward[2] = lower[up];
    }
    if (targets.has(patch.q - up)) {
        upward[3] = held[-up];
    }
    const auto add_four = [step](const float* of_row, Lanes& sums) {
        sums += load_lanes(of_row);
        sums += load_lanes(of_row + step);
        sums += load_lanes(of_row + 2 * step);
        sums += load_lanes(of_row + 3 * step);
    };
    for (; told != 0; told >>= 2U) {
        if ((told & 1U) != 0) {
            add_four(terms, along);
        }
        if ((told & 2U) != 0) {
            upward[0] = along[0];
            add_four(terms + 4 * step, upward);
            along[0] = upward[0];
        }
        terms += 8 * step;
    }
    if (own_row) {
        held[0] = along[0];
        left[0] = along[1];
        left[1] = along[2];
        held[-1] = along[3];
        lower[0] = upward[1];
    }
    if (targets.has(patch.q + up)) {
        lower[up] = upward[2];
    }
    if (targets.has(patch.q - up)) {
        held[-up] = upward[3];
    }
}

#endif

}  // namespace weir
