// Swept collision: where a path first meets the contour of a solid.
#pragma once

#include "solid/contour_hit.hpp"

namespace weir {

/// Who goes that far may have passed a wall that is not in its cell.
template <class Real>
bool is_far(Vec2<Real> before, Vec2<Real> x) {
    return absolute(x.x - before.x) > Real(1) || absolute(x.y - before.y) > Real(1);
}

/// Whether all cells that a path can touch are without solid: those between its ends, as
/// `first_entry` comes by them.
template <class Real>
bool is_path_open(const GridShape& s, const std::uint8_t* cell_case, Vec2<Real> from,
                  Vec2<Real> x) {
    const Vec2<Real> to = from + Real(1) * (x - from);
    const auto i0 = static_cast<std::int32_t>(minimum(from.x, to.x));
    const auto i1 = static_cast<std::int32_t>(maximum(from.x, to.x));
    const auto j0 = static_cast<std::int32_t>(minimum(from.y, to.y));
    const auto j1 = static_cast<std::int32_t>(maximum(from.y, to.y));
    for (std::int32_t j = j0; j <= j1; ++j) {
        const std::uint8_t* row = cell_case + s.index(0, j);
        for (std::int32_t i = i0; i <= i1; ++i) {
            if (row[i] != kCellOutside) {
                return false;
            }
        }
    }
    return true;
}

/// The last of some particles, some of which went far, that is in a cell with solid or may have
/// passed one, or −1.
template <class Real>
[[gnu::noinline]] std::int32_t last_past_wall(const GridShape& s, const std::uint8_t* cell_case,
                                              const Vec2<PositionOf<Real>>* before,
                                              const Vec2<Real>* position, std::int32_t count) {
    const std::uint8_t* origin = cell_case + s.index(0, 0);
    while (--count >= 0) {
        const Vec2<Real> from = before[count];
        const Vec2<Real> x = position[count];
        if (origin[static_cast<std::int32_t>(x.y) * s.stride + static_cast<std::int32_t>(x.x)] !=
                kCellOutside ||
            (is_far(from, x) && !is_path_open(s, cell_case, from, x))) {
            break;
        }
    }
    return count;
}

/// First place behind a contour on a path that begins in the open, and the last one before it.
template <class Real>
struct Entry {
    bool found = false;
    Vec2<Real> place;
    Vec2<Real> behind;
};

template <class Real>
Entry<Real> first_entry(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> from,
                        Vec2<Real> to) {
    constexpr Real kSamples = Real(4);  // a cell
    constexpr std::int32_t kMostSamples = 16;
    constexpr std::int32_t kHalvings = 8;
    const Vec2<Real> way = to - from;
    const Real longest = maximum(absolute(way.x), absolute(way.y));
    const std::int32_t samples = longest * kSamples < static_cast<Real>(kMostSamples)
                                     ? ceil_to_int(longest * kSamples)
                                     : kMostSamples;
    Entry<Real> entry;
    Real outside = Real(0);
    Real inside = Real(0);
    for (std::int32_t k = 1; k <= samples && !entry.found; ++k) {
        outside = inside;
        inside = ratio_of<Real>(k, samples);
        entry.found = is_inside(shape, walls, from + inside * way);
    }
    for (std::int32_t k = 0; k < kHalvings && entry.found; ++k) {
        const Real middle = Real(0.5) * (outside + inside);
        (is_inside(shape, walls, from + middle * way) ? inside : outside) = middle;
    }
    entry.place = from + outside * way;
    entry.behind = from + inside * way;
    return entry;
}

}  // namespace weir
