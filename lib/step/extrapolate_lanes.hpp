// Velocity carried on into the air, some faces at a time: the plain loop's sums, and so
// its bits. One liquid, no thin walls.
#pragma once

#include "math/four_lanes.hpp"
#include "pressure/system_lanes.hpp"
#include "step/wide_faces.hpp"

namespace weir {

/// How much faster than the liquid beside it a push on that liquid may make spray.
template <class Real>
struct ReachOfPush {
    Real factor;  ///< of the liquid's speed
    Real beyond;  ///< and so much more
};

/// What turns is faster beyond its surface, by the curvature. Where the surface leans the liquid's
/// faces do not agree, within a quarter of what gravity gives in a step, on what it takes to carry
/// the spray above them. What a compressible liquid stores is no rotation's: it squeezes out jets,
/// which its push would follow.
template <class Real>
inline ReachOfPush<Real> reach_of_push(const PressureFields<Real>& fields) {
    if (fields.sound_speed > Real(0)) {
        return {Real(1), Real(0)};
    }
    return {Real(1.2F), fields.on_surface ? Real(0) : Real(0.25F) * fields.cell_weight};
}

#if WEIR_HAS_LANES

/// A row of one component's faces.
struct ExtrapolateTask {
    const float* level;
    const float* pressure;
    const float* open;  ///< null: no solids
    float* velocity;
    std::int32_t back;
    std::int32_t stride;
    Lever lever;
    ReachOfPush<float> reach;
    float fall;   ///< what gravity makes of a velocity in the step
    bool velocity_itself;
    bool has_lower;      ///< whether the rows beside it are the tank's
    bool has_upper;
    std::int32_t first;  ///< face of the row
    std::int32_t end;
};

/// As `push_on_spray`.
template <class L>
inline auto push_on_spray_lanes(typename L::Floats push, typename L::Floats liquid,
                                typename L::Floats spray, ReachOfPush<float> most,
                                float fall, typename L::Floats open) {
    const auto zero = L::all(0.0F);
    const auto reach = L::all(most.factor) * liquid;
    const auto speed = L::absolute(spray);
    const auto beyond = L::all(most.beyond);
    const auto faster = L::minimum(push, (L::maximum(speed, reach) + beyond) - spray);
    const auto back = L::maximum(push, (L::minimum(zero - speed, reach) - beyond) - spray);
    const auto gained = push > zero ? faster : back;
    const auto stops = gained > zero
                           ? L::minimum(gained, L::maximum(zero, L::all(fall) - spray))
                           : L::maximum(gained, L::minimum(zero, (zero - L::all(fall)) - spray));
    return gained - (L::all(1.0F) - open) * (gained - stops);
}

/// Sum and count of what goes on from the faces beside some faces.
template <class L>
struct Beside {
    typename L::Floats own;  ///< velocity of those faces
    typename L::Floats sum = L::all(0.0F);
    typename L::Floats count = L::all(0.0F);

    void look(const ExtrapolateTask& task, std::int32_t at, typename L::Ints exists) {
        const auto zero = L::all(0.0F);
        const auto level = L::load(task.level + at);
        const auto before = L::load(task.level + at - task.back);
        const auto open = task.open != nullptr ? L::load(task.open + at) : L::all(1.0F);
        const auto goes_on = exists & (L::maximum(level, before) > zero) & (open > zero);
        if (!L::any_true(goes_on)) {
            return;
        }
        count += goes_on ? L::all(1.0F) : zero;
        const auto velocity = L::load(task.velocity + at);
        if (task.velocity_itself) {
            sum += goes_on ? velocity : zero;
            return;
        }
        const auto rise = L::load(task.pressure + at) - L::load(task.pressure + at - task.back);
        const auto both = L::minimum(level, before) > zero;
        const auto push =
            zero - (both ? rise
                         : rise / fraction_between<L>(task.lever, level, before, open));
        const auto handed_on =
            push_on_spray_lanes<L>(push, velocity, own, task.reach, task.fall, open);
        sum += goes_on ? handed_on : zero;
    }
};

/// Which faces lie between two air cells of which neither is empty.
template <class L>
inline auto is_spray(const ExtrapolateTask& task, std::int32_t face) {
    const auto here = L::load(task.level + face);
    const auto before = L::load(task.level + face - task.back);
    return (L::maximum(here, before) <= L::all(0.0F)) &
           (L::minimum(here, before) > L::all(kEmptyLevel<float>));
}

/// Of L::kLanes faces those that `spray` names.
template <class L>
inline void extend_faces(const ExtrapolateTask& task, std::int32_t face,
                         typename L::Ints spray) {
    const auto now = L::load(task.velocity + face);
    Beside<L> beside{now};
    beside.look(task, face - 1, face == task.first ? spray & lanes_from<L>(1) : spray);
    const std::int32_t last = task.end - 1 - face;
    beside.look(task, face + 1, last < L::kLanes ? spray & ~lanes_from<L>(last) : spray);
    if (task.has_lower) {
        beside.look(task, face - task.stride, spray);
    }
    if (task.has_upper) {
        beside.look(task, face + task.stride, spray);
    }
    const auto some = beside.count > L::all(0.0F);
    if (!L::any_true(some)) {
        return;
    }
    const auto mean = beside.sum / (some ? beside.count : L::all(1.0F));
    L::store(task.velocity + face,
             some ? (task.velocity_itself ? mean : now + mean) : now);
}

/// All faces of a row, the last few beside some that are done. False: there are not enough of
/// them, nothing was done.
template <class L>
inline bool extrapolate_faces(const ExtrapolateTask& task) {
    std::int32_t face = task.first;
    if (task.end - face < L::kLanes) {
        return false;
    }
    for (; face < task.end; face += L::kLanes) {
        const std::int32_t at = face + L::kLanes <= task.end ? face : task.end - L::kLanes;
        const auto spray = is_spray<L>(task, at) & lanes_from<L>(face - at);
        if (L::any_true(spray)) {
            extend_faces<L>(task, at, spray);
        }
    }
    return true;
}

inline bool extrapolate_lanes(const ExtrapolateTask& task) {
    const WideFaces* wide = wide_faces();
    return (wide != nullptr && wide->extrapolate_faces(task)) || extrapolate_faces<FourLanes>(task);
}

#endif

}  // namespace weir
