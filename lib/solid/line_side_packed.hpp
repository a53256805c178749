// On which side of its cell's contour line a point lies, in whole numbers: places in 1024ths of a
// cell, distances in 256ths, no division.
#pragma once

#include "math/packed_arithmetic.hpp"

namespace weir::packed {

/// So much nearer to the line, in 1024ths, is left to who computes it.
inline constexpr std::int32_t kUnclear = 8;

/// Distances whose differences are larger are not those of a contour: products would not fit.
inline constexpr std::int32_t kSteepest = 1024;

struct LinePoint {
    std::int32_t d[4];
    std::int32_t x, y;  ///< in the cell

    /// Where the line cuts off a node: the distance is linear from that node on.
    std::int32_t off_corner(std::int32_t node, std::int32_t beside, std::int32_t over,
                            std::int32_t along, std::int32_t up) const {
        const std::int32_t sx = d[beside] - d[node];
        const std::int32_t sy = d[over] - d[node];
        const std::int32_t margin = kUnclear * (absolute(sx) + absolute(sy));
        return side(d[node] * 1024 + sx * along + sy * up, margin);
    }

    /// Over the line between the crossings of two opposite edges, times what these were divided by.
    std::int32_t over(std::int32_t low, std::int32_t high, std::int32_t low_end,
                      std::int32_t high_end, std::int32_t along, std::int32_t up) const {
        const std::int32_t first = d[low] - d[high];
        const std::int32_t last = d[low_end] - d[high_end];
        if (absolute(first) > kSteepest || absolute(last) > kSteepest) {
            return 0;
        }
        const std::int32_t line = d[low] * last * (1024 - along) + d[low_end] * first * along;
        return side(first * last * up - line, kUnclear * first * last);
    }

private:
    static std::int32_t absolute(std::int32_t value) { return value < 0 ? -value : value; }
    static std::int32_t side(std::int32_t value, std::int32_t margin) {
        return value > margin ? 1 : (value < -margin ? -1 : 0);
    }
};

/// 1: clearly in the open, −1: clearly in the solid, 0: near the line, or there is not just one.
[[gnu::noinline]] inline std::int32_t side_of_line(std::uint8_t which, const LinePoint& p) {
    constexpr std::int32_t kOne = 1024;
    switch (which) {
        case 1:
        case 14: return p.off_corner(0, 1, 3, p.x, p.y);
        case 2:
        case 13: return p.off_corner(1, 0, 2, kOne - p.x, p.y);
        case 4:
        case 11: return p.off_corner(2, 3, 1, kOne - p.x, kOne - p.y);
        case 8:
        case 7: return p.off_corner(3, 2, 0, p.x, kOne - p.y);
        case 3: return p.over(0, 3, 1, 2, p.x, p.y);
        case 12: return -p.over(0, 3, 1, 2, p.x, p.y);
        case 9: return p.over(0, 1, 3, 2, p.y, p.x);
        case 6: return -p.over(0, 1, 3, 2, p.y, p.x);
        default: return 0;
    }
}
inline std::int32_t side_of_line(std::uint8_t which, const SmallFixed (&d)[4],
                                 Vec2<SmallFixed> f) {
    return side_of_line(which, {{d[0].raw >> 8, d[1].raw >> 8, d[2].raw >> 8, d[3].raw >> 8},
                                f.x.raw >> 6, f.y.raw >> 6});
}

}  // namespace weir::packed
