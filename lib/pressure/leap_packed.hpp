// What straight paths ask of the pressure (leap.hpp), in whole numbers.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/leap.hpp"

namespace weir {

/// As `Leap`. A slope in 128ths of 1/s times `scale` · 2^−shift is its part of a step, 2^−14.
struct PackedLeap {
    PackedLeap(bool leaps, Seconds<SmallFixed> dt_s) : scale(leaps ? dt_s.raw : 0) {
        while (scale >= 0x8000) {
            scale >>= 1;
            --shift;
        }
        if (leaps) {
            most = Leap<SmallFixed>(dt_s).most.raw >> 9;
        }
    }

    /// Two slopes' product over a step times 2^−less, 2^−21. Of the first one no more than 1 in a
    /// step counts: a quarter is at the limit.
    std::int32_t product(std::int32_t a, std::int32_t b, std::int32_t less) const {
        return saturated<15>((saturated<16>(a) * scale) >> (shift + less)) * saturated<16>(b);
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
    const std::int32_t twice_strain = (u[1].raw - u[0].raw) - (v[stride].raw - v[0].raw);
    const std::int32_t four_u_over_y =
        (u[stride].raw + u[stride + 1].raw) - (u[-stride].raw + u[1 - stride].raw);
    const std::int32_t four_v_over_x =
        (v[1].raw + v[stride + 1].raw) - (v[-1].raw + v[stride - 1].raw);
    const std::int32_t four_times = leap.product(twice_strain, twice_strain, 0) +
                                    leap.product(four_u_over_y, four_v_over_x, 2);
    return clamp(((1 << 15) - four_times) >> 16, -leap.most, leap.most);
}

}  // namespace weir
