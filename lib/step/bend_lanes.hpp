// Paths bent four or eight faces at a time: the plain loop's sums, and so its bits.
#pragma once

#include "math/wide_lanes.hpp"
#include "pressure/leap.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// What bends the faces of one component; `back` as in Bending.
struct BendTask {
    const float* level;
    const float* open_u;  ///< null: no solids
    const float* open_v;
    const float* along;
    const float* across;
    float* out;
    float bend_s;
    std::int32_t back;
    std::int32_t stride;
    bool leaps;   ///< the row's cells may be straight
    bool leapt;   ///< those before its faces
};

/// Whether all faces of some cells are wide open.
template <class L>
inline bool wide_open(const BendTask& task, std::int32_t c) {
    const auto least =
        L::minimum(L::minimum(L::load(task.open_u + c), L::load(task.open_u + c + 1)),
                   L::minimum(L::load(task.open_v + c), L::load(task.open_v + c + task.stride)));
    return L::all_true(least == L::all(1.0F));
}

/// As `Bending::slope`, where the faces before and after are `step` entries away.
template <class L>
inline auto slope_of_faces(const BendTask& task, std::int32_t face, std::int32_t step) {
    const auto zero = L::all(0.0F);
    const auto wet = [&](std::int32_t at) {
        return L::maximum(L::load(task.level + at), L::load(task.level + at - task.back)) > zero;
    };
    const auto low = wet(face - step);
    const auto high = wet(face + step);
    const auto here = L::load(task.along + face);
    const auto below = low ? here - L::load(task.along + face - step) : zero;
    const auto above = high ? L::load(task.along + face + step) - here : zero;
    const auto sum = below + above;
    return (low & high) ? L::all(0.5F) * sum : sum;
}

/// Bends faces `face`, `face` + 1 … of a row as long as enough are left before `end` and no solid
/// touches their cells; two cells and more from the row's ends. Returns the next one to do.
template <class L>
inline std::int32_t bend_faces(const BendTask& task, std::int32_t face, std::int32_t end) {
    for (; face + L::kLanes <= end; face += L::kLanes) {
        const auto kept = L::minimum(L::load(task.level + face),
                                     L::load(task.level + face - task.back)) >
                          L::all(kEmptyLevel<float>);
        if (!L::any_true(kept)) {
            continue;
        }
        if (task.open_u != nullptr &&
            !(wide_open<L>(task, face) && wide_open<L>(task, face - task.back))) {
            break;
        }
        const auto above = [](bool asked) { return L::all(asked ? 0.0F : __builtin_inff()); };
        const auto here = lowest_around<L>(task.level, task.stride, face) > above(task.leaps);
        const auto before =
            lowest_around<L>(task.level, task.stride, face - task.back) > above(task.leapt);
        const auto bent = kept & ~(here & before);
        if (!L::any_true(bent)) {
            continue;
        }
        const std::int32_t side = task.back == 1 ? task.stride : 1;
        const float* across = task.across + face;
        const auto mean =
            L::all(0.25F) * ((L::load(across) + L::load(across - task.back)) +
                             (L::load(across + side) + L::load(across + side - task.back)));
        const auto turned =
            L::load(task.along + face) * slope_of_faces<L>(task, face, task.back) +
            mean * slope_of_faces<L>(task, face, side);
        const auto share =
            (here | before) ? L::all(0.5F * task.bend_s) : L::all(task.bend_s);
        const auto now = L::load(task.out + face);
        L::store(task.out + face, bent ? now + share * turned : now);
    }
    return face;
}

#if WEIR_HAS_WIDE_LANES
std::int32_t bend_wide(const BendTask& task, std::int32_t face, std::int32_t end);
#endif

inline std::int32_t bend_lanes(const BendTask& task, std::int32_t face, std::int32_t end) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        face = bend_wide(task, face, end);
    }
#endif
    return bend_faces<FourLanes>(task, face, end);
}

#endif

}  // namespace weir
