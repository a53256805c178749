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

/// Particles of a block in whose cells there is solid, from the last one on.
template <std::int32_t Most>
struct NearWall {
    std::int32_t count = 0;
    std::int32_t n[Most + 4];     ///< number in the block; a few more than there are
    std::uint32_t cell[Most + 4]; ///< from the tank's first one on

    void add(std::int32_t number, std::uint32_t in_cell, bool is) {
        n[count] = number;
        cell[count] = in_cell;
        count += is ? 1 : 0;
    }
    /// To groups of four: with the first one.
    void fill_up() {
        for (std::int32_t k = count; k < count + 3; ++k) {
            n[k] = n[0];
            cell[k] = cell[0];
        }
    }
};

/// `cell_case`: of the tank's first cell.
template <std::int32_t Most>
inline void find_near_wall(const std::uint8_t* cell_case, std::int32_t stride,
                           const Vec2<float>* position, std::int32_t count,
                           NearWall<Most>& found) {
    for (; count >= 4; count -= 4) {
        const CellNumbers at = cells_of_four(position + count - 4, stride);
        std::uint64_t pair[2];
        __builtin_memcpy(pair, &at, sizeof pair);
        const std::uint32_t cell[4] = {
            static_cast<std::uint32_t>(pair[0]), static_cast<std::uint32_t>(pair[0] >> 32U),
            static_cast<std::uint32_t>(pair[1]), static_cast<std::uint32_t>(pair[1] >> 32U)};
        if ((cell_case[cell[0]] | cell_case[cell[1]] | cell_case[cell[2]] | cell_case[cell[3]]) !=
            0) {
            for (std::int32_t k = 3; k >= 0; --k) {
                found.add(count - 4 + k, cell[k], cell_case[cell[k]] != 0);
            }
        }
    }
    while (--count >= 0) {
        const Vec2<float> x = position[count];
        const auto cell = static_cast<std::uint32_t>(static_cast<std::int32_t>(x.y) * stride +
                                                     static_cast<std::int32_t>(x.x));
        found.add(count, cell, cell_case[cell] != 0);
    }
}

/// What `clearly_outside` looks at in each case.
enum ClearRule : std::int32_t {
    kFlipX = 1,    ///< the corner is on the right
    kFlipY = 2,    ///< and above
    kCorner = 4,   ///< the line cuts off a corner
    kUpright = 8,  ///< it leads from the lower edge to the upper one
    kBehind = 16,  ///< the solid lies above it, or to its right
    kUnknown = 32
};
constexpr std::int32_t kClearRules[16] = {
    kUnknown,          kCorner,           kCorner | kFlipX,           0,
    kCorner | kFlipX | kFlipY, kUnknown,  kUpright | kBehind,         kCorner | kFlipY,
    kCorner | kFlipY,  kUpright,          kUnknown,                   kCorner | kFlipX | kFlipY,
    kBehind,           kCorner | kFlipX,  kCorner,                    kUnknown};

/// `clearly_outside` of the next four: a bit each. `distance`: of the tank's first node.
template <std::int32_t Most>
inline std::uint32_t four_clearly_outside(const NearWall<Most>& near, std::int32_t next,
                                          const std::uint8_t* cell_case, const float* distance,
                                          std::int32_t stride, const Vec2<float>* position,
                                          float clear_by) {
    const std::uint32_t* cell = near.cell + next;
    const std::int32_t* n = near.n + next;
    const auto rule = [&](std::int32_t k) { return kClearRules[cell_case[cell[k]]]; };
    const LaneMask rules{rule(0), rule(1), rule(2), rule(3)};
    const auto has = [&](std::int32_t bit) { return (rules & bit) != 0; };
    const Squares d = squares_at(distance, distance + stride, cell);
    const auto two = [&](std::int32_t a, std::int32_t b) {
        return shuffle<0, 1, 4, 5>(load_pair(&position[n[a]].x), load_pair(&position[n[b]].x));
    };
    const Lanes one = all_lanes(1.0F);
    const Lanes clear = all_lanes(clear_by);
    const auto within = [](Lanes x) {
        return x - __builtin_convertvector(__builtin_convertvector(x, LaneMask), Lanes);
    };
    const Lanes x = within(shuffle<0, 2, 4, 6>(two(0, 1), two(2, 3)));
    const Lanes y = within(shuffle<1, 3, 5, 7>(two(0, 1), two(2, 3)));
    // Across a corner.
    const LaneMask flip_x = has(kFlipX);
    const LaneMask flip_y = has(kFlipY);
    const Lanes low = flip_x ? d.low_right : d.low_left;
    const Lanes high = flip_x ? d.high_right : d.high_left;
    const Lanes low_beside = flip_x ? d.low_left : d.low_right;
    const Lanes high_beside = flip_x ? d.high_left : d.high_right;
    const Lanes node = flip_y ? high : low;
    const Lanes slope_x = (flip_y ? high_beside : low_beside) - node;
    const Lanes slope_y = (flip_y ? low : high) - node;
    const Lanes way = slope_x * (flip_x ? one - x : x) + slope_y * (flip_y ? one - y : y);
    const LaneMask past_corner = node + way > clear * (absolute(slope_x) + absolute(slope_y));
    // Over a line between opposite edges.
    const LaneMask upright = has(kUpright);
    const Lanes other = upright ? d.low_right : d.high_left;
    const Lanes end = upright ? d.high_left : d.low_right;
    const Lanes first = d.low_left / (d.low_left - other);
    const Lanes last = end / (end - d.high_right);
    const Lanes height = (upright ? x : y) - (first + (last - first) * (upright ? y : x));
    const LaneMask past_line = has(kBehind) ? height < -clear : height > clear;
    return bits_of((has(kCorner) ? past_corner : past_line) & ~has(kUnknown));
}

#endif

}  // namespace weir
