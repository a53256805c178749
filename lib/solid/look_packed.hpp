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

/// `weir::last_near_wall`. By itself, so that its loop has all registers.
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

/// `weir::is_far`, told from words.
[[gnu::always_inline]] inline bool goes_far(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t along_x = (to & 0xFFFFU) - (from & 0xFFFFU);
    const std::uint32_t along_y = (to >> 16U) - (from >> 16U);
    return along_x + 256U > 512U || along_y + 256U > 512U;
}

/// The same, or the last one that went far.
[[gnu::noinline]] inline std::int32_t last_near_wall_or_far(const CasesAt& at,
                                                            const PlaceOfParticle* places,
                                                            const PlaceOfParticle* before,
                                                            std::int32_t count) {
    for (std::int32_t n = count - 1; n >= 0; --n) {
        const std::uint32_t place = word_at(places + n);
        if (at.cases[at.cell(place)] != kCellOutside || goes_far(word_at(before + n), place)) {
            return n;
        }
    }
    return -1;
}

/// What a particle's place says by itself: clearly in the open, or to be asked, or that the way
/// there has to be asked, too.
enum class Look : std::uint8_t { open, near, far };

/// `before`: null: it did not go further than a cell. `tested` counts those that are in the open.
[[gnu::noinline]] inline Look look_at(const CasesAt& at, const PlaceOfParticle* place,
                                      const PlaceOfParticle* before, std::int32_t& tested) {
    const std::uint32_t to = word_at(place);
    const std::int32_t cell = at.cell(to);
    const std::uint8_t which = at.cases[cell];
    if (before != nullptr && goes_far(word_at(before), to) &&
        !is_path_open(at, word_at(before), to)) {
        return Look::far;
    }
    if (which == kCellOutside) {
        return Look::open;
    }
    const auto* low = at.distance + cell;
    const auto* high = low + at.stride;
    if (side_of_line(which, {{low[0].raw, low[1].raw, high[1].raw, high[0].raw},
                             4 * low_byte(to), 4 * low_byte(to >> 16U)}) > 0) {
        ++tested;
        return Look::open;
    }
    return Look::near;
}

struct Found {
    std::int32_t n;  ///< −1: none
    bool far;
};

/// The last of `count` particles that is not clearly in the open. `before`: null: none of them went
/// further than a cell. By itself: what it needs is off the stack when a contour is asked.
[[gnu::noinline]] inline Found next_at_wall(const GridShape& s, const Walls<SmallFixed>& walls,
                                            const PlaceOfParticle* places,
                                            const PlaceOfParticle* before, std::int32_t count,
                                            std::int32_t& tested) {
    const CasesAt at(s, walls);
    for (std::int32_t n = count; n > 0;) {
        n = before != nullptr ? last_near_wall_or_far(at, places, before, n)
                              : last_near_wall(at, places, n);
        const Look look = n < 0 ? Look::open
                                : look_at(at, places + n, before != nullptr ? before + n : nullptr,
                                          tested);
        if (look != Look::open) {
            return {n, look == Look::far};
        }
    }
    return {-1, false};
}

}  // namespace weir::packed
