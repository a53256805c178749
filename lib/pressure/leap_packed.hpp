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

/// As `wanted_convergence`, in 128ths of 1/s, of the cell behind two faces. Not inline: it wants
/// all registers.
[[gnu::noinline]] inline std::int32_t wanted_convergence(const VelocityOf<SmallFixed>* u,
                                                         const VelocityOf<SmallFixed>* v,
                                                         std::int32_t stride,
                                                         const PackedLeap& leap) {
    const VelocityOf<SmallFixed>* above = whole(u + stride);
    const VelocityOf<SmallFixed>* below = whole(u - stride);
    const VelocityOf<SmallFixed>* upper = whole(v + stride);
    const std::int32_t twice_strain = (u[1].raw - u[0].raw) - (upper[0].raw - v[0].raw);
    const std::int32_t four_u_over_y =
        (above[0].raw + above[1].raw) - (below[0].raw + below[1].raw);
    const std::int32_t four_v_over_x = (v[1].raw + upper[1].raw) - (v[-1].raw + upper[-1].raw);
    const std::int32_t four_times = leap.product(twice_strain, twice_strain, 0) +
                                    leap.product(four_u_over_y, four_v_over_x, 2);
    return clamp(((1 << 15) - four_times) >> 16, -leap.most, leap.most);
}

inline std::int32_t wanted_convergence(const StaggeredGrid<SmallFixed>& grid, std::int32_t c,
                                       const PackedLeap& leap) {
    return wanted_convergence(grid.mass_u + c, grid.mass_v + c, grid.shape.stride, leap);
}

}  // namespace weir
