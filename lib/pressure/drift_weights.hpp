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

/// Bits that each factor leaves off, so that 32 products of the largest numbers fit.
inline constexpr int kLeftOff = 4;

template <class Real>
inline SumOf<Real> summand(Real a, Real b) {
    if constexpr (std::is_floating_point<Real>::value) {
        return a * b;
    } else {
        return std::int64_t{a.raw >> kLeftOff} * (b.raw >> kLeftOff);
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
        std::int64_t lifted = in_turn(sums.lifted);
        std::int64_t raised = in_turn(sums.raised);
        std::int64_t moving = in_turn(sums.moving);
        const auto size = [](std::int64_t sum) { return sum < 0 ? -sum : sum; };
        while ((size(lifted) | size(raised) | moving) >= kLargest) {
            lifted >>= 3;
            raised >>= 3;
            moving >>= 3;
        }
        const auto number = [](std::int64_t sum) {
            return Real::of_raw(static_cast<std::int32_t>(sum));
        };
        Weights<Real> weights;
        weights.lifted[0] = number(lifted);
        weights.raised[0] = number(raised);
        weights.moving[0] = number(moving);
        weights.disorder[0] = number(in_turn(sums.disorder) >> (16 - 2 * kLeftOff));
        return weights;
    }
}

}  // namespace weir
