// A viscous pull some faces at a time: the plain loop's sums, and so its bits.
#pragma once

#include "grid/diffuse.hpp"
#include "math/four_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As `FaceShare::at`.
inline Lanes shares_at(const FaceShare<float>& share, std::int32_t face) {
    using L = FourLanes;
    const auto zero = L::all(0.0F);
    const auto before = L::load(share.density + face - share.back);
    const auto after = L::load(share.density + face);
    auto full = L::minimum(before + after, L::all(1.0F));
    if (share.open != nullptr) {
        full = full * L::load(share.open + face);
    }
    return ((before > zero) & (after > zero)) ? full : zero;
}

/// Faces `face`, `face` + 1 … none of which is on a seam, as long as enough are left before `end`;
/// returns the next one to do.
inline std::int32_t diffuse_lanes(const FaceShare<float>& share, std::int32_t stride, float amount,
                                  const float* field, std::int32_t face, std::int32_t end,
                                  float* out) {
    using L = FourLanes;
    for (; face + L::kLanes <= end; face += L::kLanes) {
        const auto own = shares_at(share, face);
        const auto holds = own > L::all(0.0F);
        if (!L::any_true(holds)) {
            continue;
        }
        const auto here = L::load(field + face);
        const auto pull = [&](std::int32_t neighbour) {
            const auto other = shares_at(share, neighbour);
            const auto difference = L::load(field + neighbour) - here;
            return other < own ? difference * (other / own) : difference;
        };
        const auto sum = (pull(face - 1) + pull(face + 1)) +
                         (pull(face - stride) + pull(face + stride));
        L::store(out + face, holds ? here + L::all(amount) * sum : L::load(out + face));
    }
    return face;
}

#endif

}  // namespace weir
