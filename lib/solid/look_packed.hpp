// Which particles of a packed world have to do with a contour: their places are looked at as words.
#pragma once

#include "solid/contour_hit.hpp"
#include "solid/first_entry.hpp"

namespace weir::packed {

/// Cases and distances by the cells that places are in.
struct CasesAt {
    const std::uint8_t* cases;
    const DistanceOf<SmallFixed>* distance;
    std::int32_t stride;

    CasesAt(const GridShape& s, const Walls<SmallFixed>& walls)
        : cases(walls.cell_case + s.index(0, 0)), distance(walls.distance + s.index(0, 0)),
          stride(s.stride) {}

    static std::int32_t column(std::uint32_t place) { return low_byte(place >> 8U); }
    static std::int32_t row(std::uint32_t place) { return static_cast<std::int32_t>(place >> 24U); }
    std::int32_t cell(std::uint32_t place) const { return row(place) * stride + column(place); }
};

using PlaceOfParticle = Vec2<PositionOf<SmallFixed>>;

/// Whether a particle went further than half a cell, or as far up or right: both axes at once.
[[gnu::always_inline]] inline bool goes_further(std::uint32_t from, std::uint32_t to) {
    return ((to - from + 0x00800080U) & 0xFF00FF00U) != 0;
}

/// The last of some particles that is in a cell with solid, or went further than half a cell; −1:
/// none. By itself, so that its loop has all registers.
[[gnu::noinline]] inline std::int32_t last_to_ask(const CasesAt& at, const PlaceOfParticle* places,
                                                  const PlaceOfParticle* before,
                                                  std::int32_t count) {
    const std::uint8_t* const cases = at.cases;
    const std::int32_t stride = at.stride;
    const std::ptrdiff_t to_before = whole(reinterpret_cast<const char*>(before) -
                                           reinterpret_cast<const char*>(places));
    for (const PlaceOfParticle* one = places + count; one != places;) {
        one = whole(one - 1);
        const std::uint32_t place = word_at(one);
        const std::uint32_t from = word_at(reinterpret_cast<const char*>(one) + to_before);
        if (goes_further(from, place) ||
            cases[CasesAt::row(place) * stride + CasesAt::column(place)] != kCellOutside) {
            return static_cast<std::int32_t>(one - places);
        }
    }
    return -1;
}

/// Whether all cells that a path can touch are without solid.
inline bool is_path_open(const CasesAt& at, std::uint32_t from, std::uint32_t to) {
    const std::int32_t first = minimum(CasesAt::column(from), CasesAt::column(to));
    const std::int32_t last = maximum(CasesAt::column(from), CasesAt::column(to));
    const std::int32_t top = maximum(CasesAt::row(from), CasesAt::row(to));
    for (std::int32_t j = minimum(CasesAt::row(from), CasesAt::row(to)); j <= top; ++j) {
        for (std::int32_t i = first; i <= last; ++i) {
            if (at.cases[j * at.stride + i] != kCellOutside) {
                return false;
            }
        }
    }
    return true;
}

/// Whether it went further than a cell.
inline bool goes_far(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t along_x = (to & 0xFFFFU) - (from & 0xFFFFU);
    const std::uint32_t along_y = (to >> 16U) - (from >> 16U);
    return along_x + 256U > 512U || along_y + 256U > 512U;
}

/// Whether a place is clearly in front of the contour of its cell.
inline bool is_clear(const CasesAt& at, std::uint32_t place, std::uint8_t which) {
    const auto* low = at.distance + at.cell(place);
    const auto* high = low + at.stride;
    return side_of_line(which, {{low[0].raw, low[1].raw, high[1].raw, high[0].raw},
                                4 * low_byte(place), 4 * low_byte(place >> 16U)}) > 0;
}

struct Found {
    std::int32_t n;  ///< −1: none
    Went went;       ///< near also if there is no solid on its way
};

/// The last of `count` particles that is not clearly in the open, or may have passed a wall.
/// `tested` counts those in cells with solid that are in the open. By itself: what it needs is off
/// the stack when a contour is asked.
[[gnu::noinline]] inline Found next_at_wall(const GridShape& s, const Walls<SmallFixed>& walls,
                                            const PlaceOfParticle* places,
                                            const PlaceOfParticle* before, std::int32_t count,
                                            std::int32_t& tested) {
    const CasesAt at(s, walls);
    for (std::int32_t n = count; n > 0;) {
        n = last_to_ask(at, places, before, n);
        if (n < 0) {
            break;
        }
        const std::uint32_t from = word_at(before + n);
        const std::uint32_t to = word_at(places + n);
        if (goes_further(from, to) && !is_path_open(at, from, to)) {
            return {n, goes_far(from, to) ? Went::far : Went::further};
        }
        const std::uint8_t which = at.cases[at.cell(to)];
        if (which == kCellOutside) {
            continue;
        }
        if (!is_clear(at, to, which)) {
            return {n, Went::near};
        }
        ++tested;
    }
    return {-1, Went::near};
}

}  // namespace weir::packed
