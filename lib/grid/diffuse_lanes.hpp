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

/// As `PulledFace::is_amid`, of one liquid.
inline auto is_amid(const FaceShare<float>& share, std::int32_t side, std::int32_t face) {
    using L = FourLanes;
    const float* const density = share.density;
    const auto least = [&](std::int32_t cell) {
        return L::minimum(L::load(density + cell), L::minimum(L::load(density + cell - side),
                                                              L::load(density + cell + side)));
    };
    const auto full = [&](std::int32_t at) {
        const auto before = L::load(density + at - share.back);
        const auto after = L::load(density + at);
        return (L::minimum(before, after) > L::all(0.0F)) & !(before + after < L::all(1.0F));
    };
    const auto half = L::all(static_cast<float>(kHalfFull));
    const auto half_full = !(L::minimum(least(face), least(face - share.back)) < half);
    return half_full & full(face - share.back) & full(face + share.back);
}

/// Faces `face`, `face` + 1 … none of which is on a seam, as long as enough are left before `end`;
/// returns the next one to do. Those that are not all amid liquid go to `one`.
template <class One>
inline std::int32_t diffuse_lanes(const FaceShare<float>& share, std::int32_t stride, float amount,
                                  const float* field, std::int32_t face, std::int32_t end,
                                  float* out, One one) {
    using L = FourLanes;
    const std::int32_t side = share.back == 1 ? stride : 1;
    for (; face + L::kLanes <= end; face += L::kLanes) {
        const auto own = shares_at(share, face);
        const auto holds = own > L::all(0.0F);
        if (!L::any_true(holds)) {
            continue;
        }
        if (L::any_true(holds & !is_amid(share, side, face))) {
            for (std::int32_t k = 0; k < L::kLanes; ++k) {
                one(face + k);
            }
            continue;
        }
        const auto here = L::load(field + face);
        const auto pull = [&](std::int32_t neighbour) {
            const auto difference = L::load(field + neighbour) - here;
            if (share.open == nullptr) {
                return difference;
            }
            const auto other = shares_at(share, neighbour);
            return other < own ? difference * (other / own) : difference;
        };
        const auto sum = (pull(face - 1) + pull(face + 1)) +
                         (pull(face - stride) + pull(face + stride));
        L::store(out + face, holds ? here + L::all(amount) * sum : here);
    }
    return face;
}

#endif

}  // namespace weir
