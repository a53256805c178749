// The mass matrix some particles, and some faces, at a time: the plain loops' sums, and so bits.
#pragma once

#include "math/four_lanes.hpp"
#include "step/wide_faces.hpp"

namespace weir {

/// So many particles are looked at together.
inline constexpr std::int32_t kMatrixRun = 64;

/// What they give to the edges of a component's faces: along x and along y from the lower left
/// face of their stencil, then along x from the upper left one and along y from the lower right;
/// and to its diagonals, twice.
struct EdgeShares {
    std::uint32_t base[kMatrixRun];  ///< the lower left face, but for a row, or a column, of ghosts
    std::uint32_t same[kMatrixRun];  ///< once more
    std::int32_t near[2 * kMatrixRun];
    std::int32_t far[2 * kMatrixRun];
    std::int32_t across[2 * kMatrixRun];
};

/// 1 / particle, of what edges and diagonals count.
struct MatrixUnits {
    std::int32_t edge;
    std::int32_t diagonal;
};

enum class MassMatrixStep { to_middle, excess, finish };

/// Rows of the flow as it was, each from a face on.
template <class Real>
struct FlowRows {
    const Real* below;
    const Real* here;
    const Real* above;

    FlowRows from(std::int32_t k) const { return {below + k, here + k, above + k}; }
};

#if WEIR_HAS_LANES

/// What `Component` in step/mass_matrix.cpp has of one component's faces.
struct MassMatrixTask {
    const std::uint16_t* right;
    const std::uint16_t* up;
    const std::uint8_t* across;
    std::int32_t stride;
    std::int32_t back;  ///< from a face's cell to the one before it
    const float* level;
    const float* mass;
    float* momentum;
    float* flow;
    bool to_surface;
    MatrixUnits units;
};

/// As the plain loop's `to_middle` and `excess`.
template <class L>
struct MassMatrixLanes {
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    const MassMatrixTask& task;

    static Floats scaled(Ints units, float by) { return L::floats(units) * L::all(by); }

    Floats to_middle(std::int32_t face, const FlowRows<float>& rows) const {
        const Floats here = L::load(rows.here);
        const auto along = [&](Floats before, Floats after, Ints behind, Ints ahead) {
            const Floats back = here - before;
            const Floats on = after - here;
            const Floats one_sided = ahead > 0 ? on + on : back + back;
            const Ints both = (behind > 0) & (ahead > 0);
            const Floats twice = both ? after - before : one_sided;
            return scaled(behind - ahead, 0.5F / static_cast<float>(task.units.edge)) * twice;
        };
        return along(L::load(rows.here - 1), L::load(rows.here + 1),
                     L::shorts(task.right + face - 1), L::shorts(task.right + face)) +
               along(L::load(rows.below), L::load(rows.above),
                     L::shorts(task.up + face - task.stride), L::shorts(task.up + face));
    }

    Floats excess(std::int32_t face, const FlowRows<float>& rows) const {
        const std::int32_t s = task.stride;
        const float edge = 1.0F / static_cast<float>(task.units.edge);
        const float diagonal = 1.0F / static_cast<float>(task.units.diagonal);
        const auto x = [&](std::int32_t at) {
            return scaled(L::shorts(task.right + face + at), edge);
        };
        const auto y = [&](std::int32_t at) {
            return scaled(L::shorts(task.up + face + at), edge);
        };
        const auto across = [&](std::int32_t at) {
            return scaled(L::bytes(task.across + face + at), diagonal);
        };
        const Floats here = L::load(rows.here);
        const Floats ahead = here - L::load(rows.here + 1);
        const Floats behind = here - L::load(rows.here - 1);
        const Floats upper = here - L::load(rows.above);
        const Floats lower = here - L::load(rows.below);
        const Floats edges = (x(0) * ahead + x(-1) * behind) + (y(0) * upper + y(-s) * lower);
        const Floats corners =
            (across(0) * ((ahead + upper) - (here - L::load(rows.above + 1))) +
             across(-1) * ((behind + upper) - (here - L::load(rows.above - 1)))) +
            (across(-s) * ((ahead + lower) - (here - L::load(rows.below + 1))) +
             across(-s - 1) * ((behind + lower) - (here - L::load(rows.below - 1))));
        return edges - corners;
    }
};

/// One step of faces `face`, `face` + 1 … as long as enough are left before `end`; returns the next
/// one to do.
template <class L>
inline std::int32_t mass_matrix_faces(const MassMatrixTask& task, MassMatrixStep step,
                                      FlowRows<float> rows, std::int32_t face, std::int32_t end) {
    const MassMatrixLanes<L> lanes{task};
    const auto zero = L::all(0.0F);
    for (; face + L::kLanes <= end; face += L::kLanes) {
        const auto m = L::load(task.mass + face);
        const auto wet = L::load(task.level + face) > zero;
        const auto wet_before = L::load(task.level + face - task.back) > zero;
        const auto deep = wet & wet_before;
        const auto solved = (m > zero) & (task.to_surface ? wet | wet_before : deep);
        if (L::any_true(solved)) {
            const auto more = step == MassMatrixStep::to_middle ? lanes.to_middle(face, rows)
                              : L::any_true(solved & ~deep)
                                  ? (deep ? lanes.excess(face, rows) : lanes.to_middle(face, rows))
                                  : lanes.excess(face, rows);
            const auto momentum = L::load(task.momentum + face);
            const auto sum = momentum + more;
            if (step == MassMatrixStep::finish) {
                L::store(task.momentum + face, solved ? sum : momentum);
            } else {
                L::store(task.flow + face, solved ? sum / m : L::load(task.flow + face));
            }
        }
        rows = rows.from(L::kLanes);
    }
    return face;
}

/// As the plain loop's `scatter`, of so many particles, two a group.
template <class L>
inline void share_edges(bool on_u, std::int32_t stride, MatrixUnits units,
                        const float* position, std::int32_t count, EdgeShares& shares) {
    constexpr std::int32_t kStep = 2 * L::kGroups;
    const auto factors = L::pairs_of_shorts(1, stride);
    const auto middle =
        on_u ? L::repeat(0.0F, 0.5F, 0.0F, 0.5F) : L::repeat(0.5F, 0.0F, 0.5F, 0.0F);
    for (std::int32_t k = 0; k < count; k += kStep) {
        const auto x = k + kStep <= count ? L::load(position + 2 * k)
                                          : L::load_some(position + 2 * k, 2 * (count - k));
        const auto at = x + middle;
        const auto node = L::whole(at);
        const auto f = at - L::floats(node);
        const auto rest = L::all(1.0F) - f;
        const auto both = f * rest;
        const auto along = L::all(static_cast<float>(units.edge)) * both;
        const auto whole = [](typename L::Floats share) {
            return L::whole(share + L::all(0.5F));
        };
        const auto crosswise = [](typename L::Floats of) {
            return L::template shuffle<1, 0, 3, 2>(of, of);
        };
        const auto corner = L::all(static_cast<float>(units.diagonal)) * (both * crosswise(both));
        L::store_halves(shares.base + k, shares.same + k,
                        L::sums_of_products(node, node, factors));
        L::store_whole(shares.near + 2 * k, whole(along * crosswise(rest)));
        L::store_whole(shares.far + 2 * k, whole(along * crosswise(f)));
        L::store_whole(shares.across + 2 * k, whole(corner));
    }
}

/// Both with as many lanes as the processor has.
inline void share_edges_in_lanes(bool on_u, std::int32_t stride, MatrixUnits units,
                                 const float* position, std::int32_t count, EdgeShares& shares) {
    const WideFaces* const wide = wide_faces();
    (wide != nullptr ? wide->share_edges : share_edges<FourLanes>)(on_u, stride, units, position,
                                                                   count, shares);
}
inline std::int32_t mass_matrix_lanes(const MassMatrixTask& task, MassMatrixStep step,
                                      const FlowRows<float>& rows, std::int32_t face,
                                      std::int32_t end) {
    const std::int32_t first = face;
    if (const WideFaces* wide = wide_faces()) {
        face = wide->mass_matrix_faces(task, step, rows, face, end);
    }
    return mass_matrix_faces<FourLanes>(task, step, rows.from(face - first), face, end);
}

#endif

}  // namespace weir
