// Faces four at a time, for the stages between the transfers: the plain loops' sums, and so their
// bits. Each function does faces `face`, `face` + 1 … as long as four are left before `end` and
// returns the next one to do.
#pragma once

#include "math/lanes.hpp"
#include "grid/staggered_grid.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Momentum and mass → velocity, and the velocity before what it `gained`.
inline std::int32_t velocity_lanes(const float* momentum, float* mass, float gained,
                                   std::int32_t face, std::int32_t end, float* velocity) {
    const Lanes zero = all_lanes(0.0F);
    for (; face + 4 <= end; face += 4) {
        const Lanes m = load_lanes(mass + face);
        const LaneMask wet = m > zero;
        if (!any_true(wet)) {
            store_lanes(mass + face, zero);
            store_lanes(velocity + face, zero);
            continue;
        }
        const Lanes before = wet ? load_lanes(momentum + face) / m : zero;
        store_lanes(mass + face, before);
        store_lanes(velocity + face, wet ? before + all_lanes(gained) : zero);
    }
    return face;
}

/// Calls visit(face) for each face that lies between two air cells of which neither is empty, as
/// long as four are left before `end`; returns the next one to ask.
template <class Visit>
inline std::int32_t each_in_spray(const float* level, std::int32_t back, std::int32_t face,
                                  std::int32_t end, const Visit& visit) {
    for (; face + 4 <= end; face += 4) {
        const Lanes here = load_lanes(level + face);
        const Lanes before = load_lanes(level + face - back);
        const LaneMask spray = (maximum(here, before) <= all_lanes(0.0F)) &
                               (minimum(here, before) > all_lanes(kEmptyLevel<float>));
        for_each_true(spray, [&](std::int32_t k) { visit(face + k); });
    }
    return face;
}

/// field − smoothing ∇²field within what the faces around have, where the six cells' levels say
/// that liquid is all around.
inline std::int32_t sharpen_lanes(const float* level, std::int32_t back, std::int32_t stride,
                                  float smoothing, const float* field, std::int32_t face,
                                  std::int32_t end, float* out) {
    const std::int32_t along = back == 1 ? stride : 1;
    const auto depth = [&](std::int32_t at) {
        return minimum(load_lanes(level + at), load_lanes(level + at - back));
    };
    for (; face + 4 <= end; face += 4) {
        const Lanes least = minimum(minimum(depth(face - back), depth(face + back)),
                                    minimum(depth(face - along), depth(face + along)));
        const LaneMask deep = least > all_lanes(0.0F);  // the face's own cells are among them
        if (!any_true(deep)) {
            continue;
        }
        const Lanes here = load_lanes(field + face);
        const Lanes left = load_lanes(field + face - 1);
        const Lanes right = load_lanes(field + face + 1);
        const Lanes lower = load_lanes(field + face - stride);
        const Lanes upper = load_lanes(field + face + stride);
        const Lanes around = (left + right) + (lower + upper);
        const Lanes low = minimum(here, minimum(minimum(left, right), minimum(lower, upper)));
        const Lanes high = maximum(here, maximum(maximum(left, right), maximum(lower, upper)));
        const Lanes sharp =
            here - all_lanes(smoothing) * (around - all_lanes(4.0F) * here);
        store_lanes(out + face, deep ? clamp(sharp, low, high) : here);
    }
    return face;
}

/// before = (now − before) + share · sharp.
inline std::int32_t blend_lanes(const float* now, const float* sharp, float share,
                                std::int32_t face, std::int32_t end, float* before) {
    for (; face + 4 <= end; face += 4) {
        store_lanes(before + face, (load_lanes(now + face) - load_lanes(before + face)) +
                                       all_lanes(share) * load_lanes(sharp + face));
    }
    return face;
}

#endif

}  // namespace weir
