// The cases of several particles' cells in one look.
#pragma once

#include "math/four_lanes.hpp"
#include "math/vec2.hpp"
#include "math/wide_lanes.hpp"
#include "solid/first_entry.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Particles of a block in whose cells there is solid, or that may have passed a wall, the last one
/// first.
struct NearWall {
    std::int32_t count = 0;
    std::int32_t* n;      ///< number in the block; room for seven more than there are
    std::uint32_t* cell;  ///< from the tank's first one on
};

/// Where the particles of a block are, and came from; the cases of the tank's cells.
struct BlockTask {
    const GridShape& shape;
    const std::uint8_t* cell_case;
    const Vec2<float>* before;
    const Vec2<float>* position;
    bool far;  ///< one of them may have passed a wall that is not in its cell

    const std::uint8_t* origin() const { return cell_case + shape.index(0, 0); }
    bool is_past(std::int32_t n) const {
        return may_pass(shape, cell_case, before[n], position[n]);
    }
};

/// A bit for each of a group from the first on that is past. `lanes`: components of which one is
/// too long, in the first half of them or in the second. Each kind of lanes has its own.
template <class L>
[[gnu::noinline]] std::uint32_t past_in_group(const BlockTask& task, std::int32_t first,
                                              std::uint32_t lanes) {
    std::uint32_t set = 0;
    for (lanes = (lanes | lanes >> 1U) & 0x5555U; lanes != 0; lanes &= lanes - 1U) {
        const std::int32_t low = __builtin_ctz(lanes) / 2;
        for (std::int32_t k = low; k < L::kLanes; k += L::kLanes / 2) {
            set |= task.is_past(first + k) ? 1U << static_cast<std::uint32_t>(k) : 0U;
        }
    }
    return set;
}

/// To groups of eight: with the first one.
inline void fill_up(const NearWall& near) {
    for (std::int32_t k = near.count; k < near.count + 7; ++k) {
        near.n[k] = near.n[0];
        near.cell[k] = near.cell[0];
    }
}

/// Looks at the last particles of a block, as long as there are enough left. Returns how many are
/// left. In a grid of less than 2¹⁵ along both axes. `Far`: some may have passed a wall.
template <class L, bool Far>
inline std::int32_t find_near_wall(const BlockTask& task, std::int32_t count, NearWall& found) {
    const auto factors = L::pairs_of_shorts(1, task.shape.stride);
    const std::uint8_t* cell_case = task.origin();
    const float* position = &task.position->x;
    [[maybe_unused]] const float* before = &task.before->x;
    NearWall near = found;
    for (; count >= L::kLanes; count -= L::kLanes) {
        const std::int32_t first = 2 * (count - L::kLanes);
        const auto low = L::load(position + first);
        const auto high = L::load(position + first + L::kLanes);
        const auto cells = L::sums_of_products(L::whole(low), L::whole(high), factors);
        std::uint32_t set = L::set_bytes(cell_case, cells);
        if constexpr (Far) {
            const auto way = L::maximum(
                L::absolute(low - L::load(before + first)),
                L::absolute(high - L::load(before + first + L::kLanes)));
            const std::uint32_t lanes = L::bits_of(way > L::all(kPastCorner<float>));
            set |= lanes != 0 ? past_in_group<L>(task, count - L::kLanes, lanes) : 0U;
        }
        if (set == 0) {
            continue;
        }
        near.count += L::append(set, count - L::kLanes, cells, near.n + near.count,
                                near.cell + near.count);
    }
    found.count = near.count;
    return count;
}

#if WEIR_HAS_WIDE_LANES
std::int32_t find_near_wall_wide(const BlockTask& task, std::int32_t count, NearWall& found);
#endif

inline void find_near_wall(const BlockTask& task, std::int32_t count, NearWall& found) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        count = find_near_wall_wide(task, count, found);
    }
#endif
    count = task.far ? find_near_wall<FourLanes, true>(task, count, found)
                     : find_near_wall<FourLanes, false>(task, count, found);
    while (--count >= 0) {
        const Vec2<float> x = task.position[count];
        const auto cell = static_cast<std::uint32_t>(
            static_cast<std::int32_t>(x.y) * task.shape.stride + static_cast<std::int32_t>(x.x));
        found.n[found.count] = count;
        found.cell[found.count] = cell;
        found.count += task.origin()[cell] != 0 || (task.far && task.is_past(count)) ? 1 : 0;
    }
    fill_up(found);
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

/// What `clearly_outside` reads, all of the tank's first cell on.
struct ClearTask {
    const std::uint8_t* cell_case;
    const float* distance;
    std::int32_t stride;
    const float* position;  ///< of the block
    const float* before;
    float clear_by;
};

/// Of as many as there are lanes a bit each: `clearly_outside`, and did not go so far as to have
/// come there through a wall.
template <class L>
inline std::uint32_t clear_of_group(const ClearTask& task, const NearWall& near,
                                    std::int32_t next) {
    using Floats = typename L::Floats;
    const std::uint32_t* cell = near.cell + next;
    const auto rules = L::look_up(kClearRules, task.cell_case, cell);
    const auto has = [&](std::int32_t bit) { return (rules & bit) != 0; };
    const auto d = L::squares_at(task.distance, task.distance + task.stride, cell);
    const Floats one = L::all(1.0F);
    const Floats clear = L::all(task.clear_by);
    const auto place = L::places_at(task.position, near.n + next);
    const auto from = L::places_at(task.before, near.n + next);
    const auto is_near = L::maximum(L::absolute(place.x - from.x), L::absolute(place.y - from.y)) <=
                         L::all(kThinnestShown<float>);
    const Floats x = place.x - L::floats(L::whole(place.x));
    const Floats y = place.y - L::floats(L::whole(place.y));
    // Across a corner.
    const auto flip_x = has(kFlipX);
    const auto flip_y = has(kFlipY);
    const Floats low = flip_x ? d.low_right : d.low_left;
    const Floats high = flip_x ? d.high_right : d.high_left;
    const Floats low_beside = flip_x ? d.low_left : d.low_right;
    const Floats high_beside = flip_x ? d.high_left : d.high_right;
    const Floats node = flip_y ? high : low;
    const Floats slope_x = (flip_y ? high_beside : low_beside) - node;
    const Floats slope_y = (flip_y ? low : high) - node;
    const Floats way = slope_x * (flip_x ? one - x : x) + slope_y * (flip_y ? one - y : y);
    const auto past_corner = node + way > clear * (L::absolute(slope_x) + L::absolute(slope_y));
    // Over a line between opposite edges.
    const auto upright = has(kUpright);
    const Floats other = upright ? d.low_right : d.high_left;
    const Floats end = upright ? d.high_left : d.low_right;
    const Floats first = d.low_left / (d.low_left - other);
    const Floats last = end / (end - d.high_right);
    const Floats height = (upright ? x : y) - (first + (last - first) * (upright ? y : x));
    const auto past_line = has(kBehind) ? height < -clear : height > clear;
    return L::bits_of((has(kCorner) ? past_corner : past_line) & ~has(kUnknown) & is_near);
}

#if WEIR_HAS_WIDE_LANES
std::uint32_t clear_of_eight_wide(const ClearTask& task, const NearWall& near, std::int32_t next);
#endif

inline std::uint32_t clear_of_eight(const ClearTask& task, const NearWall& near,
                                    std::int32_t next) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        return clear_of_eight_wide(task, near, next);
    }
#endif
    return clear_of_group<FourLanes>(task, near, next) |
           clear_of_group<FourLanes>(task, near, next + 4) << 4U;
}

#endif

}  // namespace weir
