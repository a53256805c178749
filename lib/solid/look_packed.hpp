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
WEIR_ALWAYS_INLINE bool goes_further(std::uint32_t from, std::uint32_t to) {
    return ((to - from + 0x00800080U) & 0xFF00FF00U) != 0;
}

/// Whether it went further than `than` along an axis, 256ths.
WEIR_ALWAYS_INLINE bool goes_beyond(std::uint32_t from, std::uint32_t to,
                                    std::uint32_t than) {
    const std::uint32_t along_x = (to & 0xFFFFU) - (from & 0xFFFFU);
    const std::uint32_t along_y = (to >> 16U) - (from >> 16U);
    return along_x + than > 2 * than || along_y + than > 2 * than;
}

/// The last of some particles that is in a cell with solid, or −1. By itself, so that its loop has
/// all registers.
[[gnu::noinline]] inline std::int32_t last_near_wall(const CasesAt& at,
                                                     const PlaceOfParticle* places,
                                                     std::int32_t count) {
    const std::uint8_t* const cases = at.cases;
    const std::int32_t stride = at.stride;
    for (const PlaceOfParticle* one = places + count; one != places;) {
        one = whole(one - 1);
        const std::uint32_t place = word_at(one);
        if (cases[CasesAt::row(place) * stride + CasesAt::column(place)] != kCellOutside) {
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

/// As `last_near_wall`, or the last that may have passed a wall, as `weir::may_pass` says.
[[gnu::noinline]] inline std::int32_t last_past_wall(const CasesAt& at,
                                                     const PlaceOfParticle* places,
                                                     const PlaceOfParticle* before,
                                                     std::int32_t count) {
    constexpr auto kPast = static_cast<std::uint32_t>(kPastCorner<SmallFixed>.raw >> 8);
    for (std::int32_t n = count - 1; n >= 0; --n) {
        const std::uint32_t place = word_at(places + n);
        const std::uint32_t from = word_at(before + n);
        if (at.cases[at.cell(place)] != kCellOutside ||
            (goes_further(from, place) && goes_beyond(from, place, kPast) &&
             !is_path_open(at, from, place))) {
            return n;
        }
    }
    return -1;
}

/// Whether a place is clearly in front of the contour of its cell.
inline bool is_clear(const CasesAt& at, std::uint32_t place, std::uint8_t which) {
    const auto* low = at.distance + at.cell(place);
    const auto* high = low + at.stride;
    return side_of_line(which, {{low[0].raw, low[1].raw, high[1].raw, high[0].raw},
                                4 * low_byte(place), 4 * low_byte(place >> 16U)}) > 0;
}

/// Whether solid may be at a place: cells without any are told at once.
inline bool may_be_in(const CasesAt& at, std::uint32_t place) {
    const std::uint8_t which = at.cases[at.cell(place)];
    return which != kCellOutside && !is_clear(at, place, which);
}

/// `weir::is_crossed`.
inline bool is_crossed(const CasesAt& at, std::uint32_t from, std::uint32_t to) {
    const auto third = [](std::uint32_t a, std::uint32_t b) {
        const std::int32_t way =
            static_cast<std::int32_t>(b & 0xFFFFU) - static_cast<std::int32_t>(a & 0xFFFFU);
        return static_cast<std::uint32_t>(rounded_shift(85 * way, 8));
    };
    const std::uint32_t way = third(from, to) + (third(from >> 16U, to >> 16U) << 16U);
    return may_be_in(at, from + way) || may_be_in(at, to - way);
}

/// `weir::went`.
[[gnu::noinline]] inline Went went(std::uint32_t from, std::uint32_t to) {
    return !goes_further(from, to) ? Went::near
           : goes_beyond(from, to, 256) ? Went::far
                                        : Went::further;
}

/// The same of who is in the open and went further than half a cell, but near also if there is no
/// solid on its way. By itself: few are.
[[gnu::noinline]] inline Went went_through(const CasesAt& at, bool moving, std::uint32_t from,
                                           std::uint32_t to) {
    const Went how = went(from, to);
    return how == Went::far || moving || is_crossed(at, from, to) ? how : Went::near;
}

struct Found {
    std::int32_t n;  ///< −1: none
    Went went;       ///< near also if there is no solid on its way
};

/// Where particles were before the step.
struct Before {
    const PlaceOfParticle* places;
    bool far;  ///< one of them went further than kLongWay
};

/// The last of `count` particles that is not clearly in the open, or may have passed a wall.
/// `tested` counts those in cells with solid that are in the open. By itself: what it needs is off
/// the stack when a contour is asked.
[[gnu::noinline]] inline Found next_at_wall(const GridShape& s, const Walls<SmallFixed>& walls,
                                            const PlaceOfParticle* places,
                                            const Before& before, std::int32_t count,
                                            std::int32_t& tested) {
    const CasesAt at(s, walls);
    for (std::int32_t n = count; n > 0;) {
        n = before.far ? last_past_wall(at, places, before.places, n)
                       : last_near_wall(at, places, n);
        if (n < 0) {
            break;
        }
        const std::uint32_t to = word_at(places + n);
        const std::uint32_t from = word_at(before.places + n);
        const std::uint8_t which = at.cases[at.cell(to)];
        if (which != kCellOutside && !is_clear(at, to, which)) {
            return {n, went(from, to)};
        }
        if (goes_further(from, to)) {
            const Went how = went_through(at, walls.moving != nullptr, from, to);
            if (how != Went::near) {
                return {n, how};
            }
        }
        tested += which != kCellOutside ? 1 : 0;
    }
    return {-1, Went::near};
}

}  // namespace weir::packed
