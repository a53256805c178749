// Where packed particles go, both axes in a word, and how fast they are.
#pragma once

#include "step/places_packed.hpp"
#include "step/tank_walls.hpp"

namespace weir::packed {

/// Halves of the lowest places between the tank's walls.
inline constexpr std::uint32_t kGap = Place(kWallGap<Real>).raw;
inline constexpr std::uint32_t kLowest = (kGap + 1U) / 2U * 0x10001U;

/// How far the highest ones are from there, halves.
inline std::uint32_t room_between_walls(const GridShape& s) {
    const auto highest = [](std::int32_t cells) {
        return (static_cast<std::uint32_t>(cells) * 256U - kGap - 1U) / 2U;
    };
    return highest(s.nx) + highest(s.ny) * 0x10000U - kLowest;
}

/// Of ways and places in a word: halves of both.
inline constexpr std::uint32_t kHalves = 0x7FFF7FFFU;

/// What goes no further than a cell or, among solids, than half a cell: less than kLongWay.
struct Longest {
    std::uint32_t most;
    std::uint32_t far;  ///< bits that the sum of a way and `most` does not have
};
constexpr Longest longest_ways(bool among_solids) {
    return among_solids ? Longest{0x800080U, 0xFF00FF00U} : Longest{0x1000100U, 0xFE00FE00U};
}

/// Whether a particle goes from `from` by `both` to a place inside the tank, no further than
/// `longest` allows: both axes in a word.
inline bool simply_goes(const Longest& longest, std::uint32_t room, std::uint32_t from,
                        std::uint32_t both) {
    const std::uint32_t way = (both + longest.most) & longest.far;
    const std::uint32_t inside = from + both - 2U * kLowest;  // what is below is far above
#if defined(__ARM_FEATURE_SIMD32)
    std::uint32_t out;
    __asm__("uqsub16 %0, %1, %2" : "=r"(out) : "r"(inside), "r"(2U * room + 0x10001U));
    return (way | out) == 0;
#else
    // Halves leave a bit that tells which of them is out.
    return (way | ((room - ((inside >> 1U) & kHalves)) & ~kHalves)) == 0;
#endif
}

inline std::uint32_t both_in_word(std::int32_t x, std::int32_t y) {
    return static_cast<std::uint32_t>(x) + static_cast<std::uint32_t>(y) * 0x10000U;
}

#if defined(__ARM_FEATURE_SIMD32)
/// Who is fastest is looked for once all have moved, two components at once: a register less.
inline constexpr bool kLooksAfter = true;

/// The square of the fastest component.
[[gnu::noinline]] inline std::int32_t fastest_of(const Particles<Real>& particles) {
    std::uint32_t most = 0;
    std::uint32_t least = 0;
    const auto look = [&](std::uint32_t two) {
        std::uint32_t spare;
        __asm__("ssub16 %2, %3, %0\n\tsel %0, %3, %0\n\tssub16 %2, %1, %3\n\tsel %1, %3, %1"
                : "+r"(most), "+r"(least), "=&r"(spare)
                : "r"(two)
                : "cc");
    };
    const Vec2<Speed>* at = particles.velocity;
    const Vec2<Speed>* const end = at + particles.count;
    if (particles.count % 2 != 0) {
        look(word_at(at++));
    }
    for (; at != end; at += 2) {
        look(word_at(at));
        look(word_at(at + 1));
    }
    const auto upper = [](std::uint32_t two) { return static_cast<std::int32_t>(two) >> 16; };
    const std::int32_t up = maximum(upper(most), upper(most << 16U));
    const std::int32_t down = minimum(upper(least), upper(least << 16U));
    return maximum(up * up, down * down);
}
#else
inline constexpr bool kLooksAfter = false;
#endif

}  // namespace weir::packed
