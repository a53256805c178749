// The unit of time inside a world: a second, but in packed ones a power of two that suits the top
// speed of the definition. What moves is the same in any unit: where it is T seconds, speeds are T
// times as many cells in it, accelerations T² times. So velocities fill their format, stages know
// nothing of it, and a second has the bits of a world without such a unit.
#pragma once

#include "math/scalar.hpp"
#include "world/validate.hpp"

namespace weir {

/// Exponents of the units that there are.
inline constexpr std::int32_t kLongestUnit = 8;
inline constexpr std::int32_t kShortestUnit = -3;
static_assert(kMaxTopSpeedSmallFixed == 8.0F * kMaxSpeedSmallFixed);

/// 2^n; |n| < 127.
inline float power_of_two(std::int32_t n) {
    const std::uint32_t bits = static_cast<std::uint32_t>(127 + n) << 23U;
    float value = 0.0F;
    WEIR_COPY_BYTES(&value, &bits, sizeof value);
    return value;
}

/// Of the longest unit in which the top speed has room. Of a definition that is not checked yet.
template <class Real>
std::int32_t unit_exponent_of(const WorldDef& def) {
    if (!Stored<Real>::coarse || !(def.top_speed_mps > 0.0F)) {
        return 0;
    }
    const float room = kMaxSpeedSmallFixed * def.cell_m / def.top_speed_mps;
    std::uint32_t bits = 0;
    WEIR_COPY_BYTES(&bits, &room, sizeof bits);
    return clamp(static_cast<std::int32_t>(bits >> 23U) - 127, kShortestUnit, kLongestUnit);
}

/// What an arithmetic bears, in cells and seconds, where the unit of time is 2^n s.
template <class Real>
Reach reach_of(std::int32_t n) {
    Reach reach = kReach<Real>;
    if constexpr (Stored<Real>::coarse) {
        reach.speed *= power_of_two(-n);
        reach.spin *= power_of_two(-n);
        reach.gravity *= power_of_two(-2 * n);
    }
    return reach;
}

}  // namespace weir
