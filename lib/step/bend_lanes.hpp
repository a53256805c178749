// Paths bent some faces at a time: the plain loop's sums, and so its bits.
#pragma once

#include "pressure/leap.hpp"
#include "step/wide_faces.hpp"

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
    std::int32_t first;  ///< cells of the row that touch neither side of the tank
    std::int32_t last;
    std::int32_t before;  ///< from their row down to that of the cells before its faces
};

/// No level is above it, but for the sixteen in the middle.
constexpr float kNone = __builtin_inff();
constexpr float kOnlyMiddle[] = {
    kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone,
    kNone, kNone, kNone, kNone, 0.0F,  0.0F,  0.0F,  0.0F,  0.0F,  0.0F,  0.0F,  0.0F,
    0.0F,  0.0F,  0.0F,  0.0F,  0.0F,  0.0F,  0.0F,  0.0F,  kNone, kNone, kNone, kNone,
    kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};

/// What the levels about some cells have to exceed, if paths may go straight at all there.
template <class L>
inline auto least_inside(std::int32_t cell, std::int32_t first, std::int32_t last, bool leaps) {
    if (!leaps || (cell >= first && cell + L::kLanes - 1 <= last)) {
        return L::all(leaps ? 0.0F : kNone);
    }
    const std::int32_t low = clamp(first - cell, 0, 16);
    const std::int32_t high = clamp(cell + L::kLanes - 1 - last, 0, 16);
    return L::maximum(L::load(kOnlyMiddle + 16 - low),
                      L::load(kOnlyMiddle + 32 - L::kLanes + high));
}

/// Of some cells, those of which all faces are wide open.
template <class L>
inline auto wide_open(const BendTask& task, std::int32_t c) {
    const auto least =
        L::minimum(L::minimum(L::load(task.open_u + c), L::load(task.open_u + c + 1)),
                   L::minimum(L::load(task.open_v + c), L::load(task.open_v + c + task.stride)));
    return least == L::all(1.0F);
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

/// Bends a group of faces but for the first few, which are done, and those beside solids.
template <class L>
inline void bend_group(const BendTask& task, std::int32_t face, std::int32_t done) {
    const std::int32_t back = task.back;
    const std::int32_t side = back == 1 ? task.stride : 1;
    const std::int32_t beyond = face - back;
    const auto level = [&](std::int32_t at) { return L::load(task.level + at); };
    // Both cells of a face have one another for a neighbour.
    const auto own = L::minimum(level(face), level(beyond));
    auto kept = own > L::all(kEmptyLevel<float>);
    if (done > 0) {
        kept &= L::load(kOnlyMiddle + 16 - done) == L::all(0.0F);
    }
    const auto around = [&](std::int32_t cell, std::int32_t next) {
        return L::minimum(L::minimum(own, level(next)),
                          L::minimum(level(cell - side), level(cell + side)));
    };
    const auto here = around(face, face + back) >
                      least_inside<L>(face, task.first, task.last, task.leaps);
    const auto before = around(beyond, beyond - back) >
                        least_inside<L>(beyond, task.first - task.before, task.last - task.before,
                                        task.leapt);
    auto bent = kept & ~(here & before);
    if (!L::any_true(bent)) {
        return;
    }
    if (task.open_u != nullptr) {
        bent &= wide_open<L>(task, face) & wide_open<L>(task, beyond);
        if (!L::any_true(bent)) {
            return;
        }
    }
    const float* across = task.across + face;
    const auto mean =
        L::all(0.25F) * ((L::load(across) + L::load(across - back)) +
                         (L::load(across + side) + L::load(across + side - back)));
    const auto turned = L::load(task.along + face) * slope_of_faces<L>(task, face, back) +
                        mean * slope_of_faces<L>(task, face, side);
    const auto share = (here | before) ? L::all(0.5F * task.bend_s) : L::all(task.bend_s);
    const auto now = L::load(task.out + face);
    L::store(task.out + face, bent ? now + share * turned : now);
}

/// Soon told, and most of what there is: faces in air, and, `amid` a row whose cells may be
/// straight, those between straight cells.
template <class L>
inline bool no_bend(const BendTask& task, std::int32_t face, bool amid) {
    const std::ptrdiff_t back = task.back;
    const std::ptrdiff_t side = back == 1 ? task.stride : 1;
    const float* here = task.level + face;
    const float* before = here - back;
    const auto lower = [](const float* a, const float* b) {
        return L::minimum(L::load(a), L::load(b));
    };
    const auto own = lower(here, before);
    if (!L::any_true(own > L::all(kEmptyLevel<float>))) {
        return true;
    }
    if (!amid) {
        return false;
    }
    const auto along = L::minimum(own, lower(here + back, before - back));
    const auto sides = L::minimum(lower(here - side, here + side),
                                  lower(before - side, before + side));
    return !L::any_true(L::minimum(along, sides) <= L::all(0.0F));
}

/// Bends faces `face`, `face` + 1 … of a row, the last few beside some that are done; faces from
/// `row` on exist. Returns the next one to do: there may be too few for a group.
template <class L>
inline std::int32_t bend_faces(const BendTask& task, std::int32_t row, std::int32_t face,
                               std::int32_t end) {
    const std::int32_t last = end - L::kLanes;
    if (last < row) {
        return face;
    }
    const std::int32_t first_amid = task.first + task.back - task.before;
    const std::int32_t last_amid = task.leaps && task.leapt ? task.last - L::kLanes + 1 : -1;
    for (; face < end; face += L::kLanes) {
        const std::int32_t at = minimum(face, last);
        if (!no_bend<L>(task, at, at >= first_amid && at <= last_amid)) {
            bend_group<L>(task, at, face - at);
        }
    }
    return end;
}

inline std::int32_t bend_lanes(const BendTask& task, std::int32_t row, std::int32_t face,
                               std::int32_t end) {
    if (const WideFaces* wide = wide_faces()) {
        face = wide->bend_faces(task, row, face, end);
    }
    return bend_faces<FourLanes>(task, row, face, end);
}

#endif

}  // namespace weir
