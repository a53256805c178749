// Faces some at a time, for the stages between the transfers: the plain loops' sums, and
// so their bits. Each function does faces `face`, `face` + 1 … as long as enough are left before
// `end` and returns the next one to do.
#pragma once

#include "grid/staggered_grid.hpp"
#include "math/four_lanes.hpp"
#include "step/wide_faces.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Momentum and mass → velocity, and the velocity before what it `gained`.
template <class L>
inline std::int32_t velocity_faces(const float* momentum, float* mass, float gained,
                                   std::int32_t face, std::int32_t end, float* velocity) {
    const auto zero = L::all(0.0F);
    const auto none = L::all(kNoVelocity<float>);
    for (; face + L::kLanes <= end; face += L::kLanes) {
        const auto m = L::load(mass + face);
        const auto wet = m > zero;
        if (!L::any_true(wet)) {
            L::store(mass + face, none);
            L::store(velocity + face, zero);
            continue;
        }
        const auto before = wet ? L::load(momentum + face) / m : none;
        L::store(mass + face, before);
        L::store(velocity + face, wet ? before + L::all(gained) : zero);
    }
    return face;
}

/// Lowest level of the cells of some faces and of the faces around each.
template <class L>
inline auto least_around(const float* level, std::int32_t back, std::int32_t stride,
                         std::int32_t face) {
    const std::int32_t along = back == 1 ? stride : 1;
    const auto depth = [&](std::int32_t at) {
        return L::minimum(L::load(level + at), L::load(level + at - back));
    };
    // The faces' own cells are among them.
    return L::minimum(L::minimum(depth(face - back), depth(face + back)),
                      L::minimum(depth(face - along), depth(face + along)));
}

/// field − smoothing ∇²field within what the faces around have, where the six cells' levels say
/// that liquid is all around, and the field elsewhere. All of them, the last few with some that are
/// done, if there are enough for a group.
template <class L>
inline std::int32_t sharpen_faces(const float* level, std::int32_t back, std::int32_t stride,
                                  float smoothing, const float* field, std::int32_t face,
                                  std::int32_t end, float* out) {
    if (face + L::kLanes > end) {
        return face;
    }
    for (; face < end; face += L::kLanes) {
        const std::int32_t at = face + L::kLanes <= end ? face : end - L::kLanes;
        const auto here = L::load(field + at);
        if (!L::any_true(L::load(level + at) > L::all(0.0F))) {  // soon told
            L::store(out + at, here);
            continue;
        }
        const auto deep = least_around<L>(level, back, stride, at) > L::all(0.0F);
        if (!L::any_true(deep)) {
            L::store(out + at, here);
            continue;
        }
        const auto left = L::load(field + at - 1);
        const auto right = L::load(field + at + 1);
        const auto lower = L::load(field + at - stride);
        const auto upper = L::load(field + at + stride);
        const auto around = (left + right) + (lower + upper);
        const auto low =
            L::minimum(here, L::minimum(L::minimum(left, right), L::minimum(lower, upper)));
        const auto high =
            L::maximum(here, L::maximum(L::maximum(left, right), L::maximum(lower, upper)));
        const auto sharp = here - L::all(smoothing) * (around - L::all(4.0F) * here);
        L::store(out + at, deep ? L::clamp(sharp, low, high) : here);
    }
    return end;
}

/// before = (now − before) + share · sharp.
template <class L>
inline std::int32_t blend_faces(const float* now, const float* sharp, float share,
                                std::int32_t face, std::int32_t end, float* before) {
    for (; face + L::kLanes <= end; face += L::kLanes) {
        L::store(before + face, (L::load(now + face) - L::load(before + face)) +
                                    L::all(share) * L::load(sharp + face));
    }
    return face;
}

inline std::int32_t velocity_lanes(const float* momentum, float* mass, float gained,
                                   std::int32_t face, std::int32_t end, float* velocity) {
    if (const WideFaces* wide = wide_faces()) {
        face = wide->velocity_faces(momentum, mass, gained, face, end, velocity);
    }
    return velocity_faces<FourLanes>(momentum, mass, gained, face, end, velocity);
}

inline std::int32_t sharpen_lanes(const float* level, std::int32_t back, std::int32_t stride,
                                  float smoothing, const float* field, std::int32_t face,
                                  std::int32_t end, float* out) {
    if (const WideFaces* wide = wide_faces()) {
        face = wide->sharpen_faces(level, back, stride, smoothing, field, face, end, out);
    }
    return sharpen_faces<FourLanes>(level, back, stride, smoothing, field, face, end, out);
}

inline std::int32_t blend_lanes(const float* now, const float* sharp, float share,
                                std::int32_t face, std::int32_t end, float* before) {
    if (const WideFaces* wide = wide_faces()) {
        face = wide->blend_faces(now, sharp, share, face, end, before);
    }
    return blend_faces<FourLanes>(now, sharp, share, face, end, before);
}

#endif

}  // namespace weir
