// What straight paths ask of the pressure (leap.hpp), in whole numbers.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/leap.hpp"

namespace weir {

/// As `Leap`. A slope in 128ths of 1/s times `scale` · 2^−shift is its part of a step, 2^−14.
struct PackedLeap {
    PackedLeap(bool leaps, Seconds<SmallFixed> dt_s) : scale(leaps ? dt_s.raw : 0) {
        while (scale >= 0x4000) {
            scale >>= 1;
            --shift;
        }
        if (leaps) {
            most = Leap<SmallFixed>(dt_s).most.raw >> 9;
        }
    }

    /// In a step, no more than a half: of more than a quarter the limit is all that is left.
    std::int32_t of_step(std::int32_t slope) const {
        constexpr std::int32_t kHalf = 1 << 13;
        return clamp(rounded_shift(slope * scale, shift), -kHalf, kHalf);
    }

    std::int32_t scale;
    std::int32_t shift = 23;
    std::int32_t most = 0;  ///< 128ths of 1/s
};

/// As `wanted_convergence`, in 128ths of 1/s.
inline std::int32_t wanted_convergence(const StaggeredGrid<SmallFixed>& grid, std::int32_t c,
                                       const PackedLeap& leap) {
    const std::int32_t stride = grid.shape.stride;
    const VelocityOf<SmallFixed>* u = grid.mass_u + c;
    const VelocityOf<SmallFixed>* v = grid.mass_v + c;
    const std::int32_t strain = ((u[1].raw - u[0].raw) - (v[stride].raw - v[0].raw)) / 2;
    const std::int32_t u_over_y =
        ((u[stride].raw + u[stride + 1].raw) - (u[-stride].raw + u[1 - stride].raw)) / 4;
    const std::int32_t v_over_x =
        ((v[1].raw + v[stride + 1].raw) - (v[-1].raw + v[stride - 1].raw)) / 4;
    const std::int32_t det =
        leap.of_step(strain) * strain + leap.of_step(u_over_y) * v_over_x;
    return clamp(-rounded_shift(det, 14), -leap.most, leap.most);
}

}  // namespace weir
