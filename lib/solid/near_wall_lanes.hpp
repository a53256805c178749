// The cases of four particles' cells in one look.
#pragma once

#include "math/lanes.hpp"
#include "math/vec2.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Numbers of four particles' cells in a grid of that stride, less than 2¹⁵ along both axes.
using CellNumbers = std::uint32_t __attribute__((vector_size(16)));
inline CellNumbers cells_of_four(const Vec2<float>* position, std::int32_t stride) {
    const Lanes low = load_lanes(&position[0].x);
    const Lanes high = load_lanes(&position[2].x);
    CellNumbers numbers;
#if defined(__SSE2__)
    using Shorts = short __attribute__((vector_size(16)));
    const auto width = static_cast<short>(stride);
    const Shorts steps{1, width, 1, width, 1, width, 1, width};
    const Shorts columns_and_rows =
        __builtin_ia32_packssdw128(__builtin_convertvector(low, LaneMask),
                                   __builtin_convertvector(high, LaneMask));
    const auto sums = __builtin_ia32_pmaddwd128(columns_and_rows, steps);
    __builtin_memcpy(&numbers, &sums, sizeof numbers);
#else
    const auto width = static_cast<std::uint32_t>(stride);
    const LaneMask i = __builtin_convertvector((shuffle<0, 2, 4, 6>(low, high)), LaneMask);
    const LaneMask j = __builtin_convertvector((shuffle<1, 3, 5, 7>(low, high)), LaneMask);
    numbers = reinterpret_cast<CellNumbers>(j) * width + reinterpret_cast<CellNumbers>(i);
#endif
    return numbers;
}

/// Passes over particles, four at a time, from the last of `count` on as long as there is no solid
/// in their cells: how many are left. `cell_case`: of the tank's first cell.
inline std::int32_t last_four_near_wall(const std::uint8_t* cell_case, std::int32_t stride,
                                        const Vec2<float>* position, std::int32_t count) {
    for (; count >= 4; count -= 4) {
        const CellNumbers at = cells_of_four(position + count - 4, stride);
        std::uint64_t pair[2];
        __builtin_memcpy(pair, &at, sizeof pair);
        const auto cell_of = [&](std::uint64_t number) {
            return cell_case[static_cast<std::uint32_t>(number)];
        };
        if ((cell_of(pair[0]) | cell_of(pair[0] >> 32U) | cell_of(pair[1]) |
             cell_of(pair[1] >> 32U)) != 0) {
            break;
        }
    }
    return count;
}

#endif

}  // namespace weir
