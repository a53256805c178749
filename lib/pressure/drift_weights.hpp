// What decides what a patch pays for its drift, summed: in fixed point in 64 bits, since squares of
// velocities are wider than its numbers.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/scalar.hpp"
#include "pressure/volume_lanes.hpp"

namespace weir {

/// Of products of two numbers.
template <class Real>
using SumOf = std::conditional_t<std::is_floating_point<Real>::value, Real, std::int64_t>;

/// Bits that a product leaves off, so that 32 of the largest fit. None of its factors: what is cut
/// off a slow drift, always the same way, would be work against a pressure that stands still.
inline constexpr int kLeftOff = 8;

template <class Real>
inline SumOf<Real> summand(Real a, Real b) {
    if constexpr (std::is_floating_point<Real>::value) {
        return a * b;
    } else {
        return fixed::shifted(fixed::wide_product(a.raw, b.raw), kLeftOff);
    }
}

/// Disorder is in this unit: squares of an excess of some hundredths are few last digits.
template <class Real>
inline constexpr double kOfDisorder = std::is_floating_point<Real>::value ? 1.0 : 1 << kLeftOff;

/// part / whole, of which the part is small.
template <class Real>
inline Ratio<Real> share_of(Real part, SameAs<Real> whole) {
    if constexpr (std::is_floating_point<Real>::value) {
        return part / whole;
    } else {
        return Ratio<Real>::of_raw(fixed::quotient(part.raw, whole.raw, Ratio<Real>::fraction));
    }
}

/// Works and squares of velocities in a unit of their own, so that the largest is below 32 and 256
/// of it are a number: only what they are to each other counts.
template <class Real>
inline Weights<Real> weights_of(const Weights<SumOf<Real>>& sums) {
    if constexpr (std::is_floating_point<Real>::value) {
        return sums;
    } else {
        constexpr std::int64_t kLargest = std::int64_t{32} << 16;
        std::int64_t raised = in_turn(sums.raised);
        std::int64_t moving = in_turn(sums.moving);
        const auto size = [](std::int64_t sum) { return sum < 0 ? -sum : sum; };
        while ((size(raised) | moving) >= kLargest) {
            raised >>= 3;
            moving >>= 3;
        }
        const auto number = [](std::int64_t sum) {
            return Real::of_raw(static_cast<std::int32_t>(sum));
        };
        Weights<Real> weights;
        weights.raised[0] = number(raised);
        weights.moving[0] = number(moving);
        weights.disorder[0] = Real::of_raw(fixed::saturate(in_turn(sums.disorder)));
        return weights;
    }
}

}  // namespace weir
