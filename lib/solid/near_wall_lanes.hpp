// The cases of several particles' cells in one look.
#pragma once

#include "math/four_lanes.hpp"
#include "math/vec2.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Particles of a block in whose cells there is solid, from the last one on.
struct NearWall {
    std::int32_t count = 0;
    std::int32_t* n;      ///< number in the block; room for three more than there are
    std::uint32_t* cell;  ///< from the tank's first one on
};

/// To groups of four: with the first one.
inline void fill_up(const NearWall& near) {
    for (std::int32_t k = near.count; k < near.count + 3; ++k) {
        near.n[k] = near.n[0];
        near.cell[k] = near.cell[0];
    }
}

/// Looks at the last particles of a block, as long as there are enough left. Returns how many are
/// left. `cell_case`: of the tank's first cell, in a grid of less than 2¹⁵ along both axes.
template <class L>
inline std::int32_t find_near_wall(const std::uint8_t* cell_case, std::int32_t stride,
                                   const float* position, std::int32_t count, NearWall& found) {
    const auto factors = L::pairs_of_shorts(1, stride);
    NearWall near = found;
    for (; count >= L::kLanes; count -= L::kLanes) {
        const float* x = position + 2 * (count - L::kLanes);
        const auto cells = L::sums_of_products(L::whole(L::load(x)),
                                               L::whole(L::load(x + L::kLanes)), factors);
        std::uint32_t set = L::set_bytes(cell_case, cells);
        if (set == 0) {
            continue;
        }
        std::uint32_t cell[L::kLanes];
        L::store_halves(cell, cell + L::kLanes / 2, cells);
        do {
            const std::int32_t k = 31 - __builtin_clz(set);
            set ^= 1U << static_cast<std::uint32_t>(k);
            near.n[near.count] = count - L::kLanes + k;
            near.cell[near.count] = cell[k];
            ++near.count;
        } while (set != 0);
    }
    found.count = near.count;
    return count;
}

#if WEIR_HAS_WIDE_LANES
std::int32_t find_near_wall_wide(const std::uint8_t* cell_case, std::int32_t stride,
                                 const float* position, std::int32_t count, NearWall& found);
#endif

inline void find_near_wall(const std::uint8_t* cell_case, std::int32_t stride,
                           const Vec2<float>* position, std::int32_t count, NearWall& found) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        count = find_near_wall_wide(cell_case, stride, &position->x, count, found);
    }
#endif
    count = find_near_wall<FourLanes>(cell_case, stride, &position->x, count, found);
    while (--count >= 0) {
        const Vec2<float> x = position[count];
        const auto cell = static_cast<std::uint32_t>(static_cast<std::int32_t>(x.y) * stride +
                                                     static_cast<std::int32_t>(x.x));
        found.n[found.count] = count;
        found.cell[found.count] = cell;
        found.count += cell_case[cell] != 0 ? 1 : 0;
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
inline std::uint32_t four_clearly_outside(const NearWall& near, std::int32_t next,
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
