// Swept collision: where a path first meets the contour of a solid.
#pragma once

#include "solid/contour_hit.hpp"

namespace weir {

/// Who goes that far may have passed a wall that is not in its cell.
template <class Real>
bool is_far(Vec2<Real> before, Vec2<Real> x) {
    return absolute(x.x - before.x) > Real(1) || absolute(x.y - before.y) > Real(1);
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
        inside = static_cast<Real>(k) / static_cast<Real>(samples);
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
