// Swept collision: where a path first meets the contour of a solid.
#pragma once

#include "solid/contour_hit.hpp"

namespace weir {

/// How far a particle went along an axis.
enum class Went : std::uint8_t {
    near,     ///< at most half a cell: no wall of a cell is passed so, as the nodes show it
    further,  ///< it may have passed a wall
    far,      ///< further than a cell: also one that is in neither of its ends' cells
};

/// As nodes show it a wall of one cell is half a cell thick in places.
template <class Real>
inline constexpr Real kThinnestShown = Real(0.5);

/// Who ends in a cell without solid, and has come through what is drawn as one, went further than
/// two thirds of a cell: past a corner of a saddle whose solids are joined.
template <class Real>
inline constexpr Real kPastCorner = Real(21.0 / 32.0);

template <class Real>
bool goes_further(Vec2<Real> before, Vec2<Real> x, Real than) {
    return absolute(x.x - before.x) > than || absolute(x.y - before.y) > than;
}

template <class Real>
Went went(Vec2<Real> before, Vec2<Real> x) {
    return !goes_further(before, x, kThinnestShown<Real>) ? Went::near
           : goes_further(before, x, Real(1))             ? Went::far
                                                          : Went::further;
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

/// Whether who is in a cell without solid may have passed a wall.
template <class Real>
bool may_pass(const GridShape& s, const std::uint8_t* cell_case, Vec2<Real> from, Vec2<Real> x) {
    return goes_further(from, x, kPastCorner<Real>) && !is_path_open(s, cell_case, from, x);
}

/// The last of some particles that is in a cell with solid or may have passed a wall, or −1.
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
            may_pass(s, cell_case, from, x)) {
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

/// As a particle there would be kept. Rounded past a line it would be taken for one from behind.
template <class Real>
Vec2<Real> as_kept(Vec2<Real> place) {
    return Vec2<Real>(Vec2<PositionOf<Real>>(place));
}

template <class Real>
Entry<Real> first_entry(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> from,
                        Vec2<Real> to) {
    constexpr Real kSamples = Real(4);  // a cell
    constexpr std::int32_t kMostSamples = 16;
    constexpr std::int32_t kHalvings = 8;
    const Vec2<Real> way = to - from;
    const Real longest = larger_part(way);
    const std::int32_t samples = longest * kSamples < static_cast<Real>(kMostSamples)
                                     ? ceil_to_int(longest * kSamples)
                                     : kMostSamples;
    const auto at = [&](Real share) { return as_kept(from + share * way); };
    Entry<Real> entry;
    Real outside = Real(0);
    Real inside = Real(0);
    for (std::int32_t k = 1; k <= samples && !entry.found; ++k) {
        outside = inside;
        inside = ratio_of<Real>(k, samples);
        entry.found = is_inside(shape, walls, at(inside));
    }
    for (std::int32_t k = 0; k < kHalvings && entry.found; ++k) {
        const Real middle = Real(0.5) * (outside + inside);
        (is_inside(shape, walls, at(middle)) ? inside : outside) = middle;
    }
    entry.place = at(outside);
    entry.behind = at(inside);
    return entry;
}

}  // namespace weir
