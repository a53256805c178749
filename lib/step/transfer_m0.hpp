// What each particle goes through in both transfers, for a Cortex-M0: its eight registers hold just
// what there is, and compilers spend a quarter of the instructions on moving numbers out of the
// way. What is computed is what transfer_packed.cpp computes, to the bit.
#pragma once

#include "step/places_packed.hpp"

#if defined(WEIR_LOOPS_OF_M0)

namespace weir::packed {

/// `ll`, `at`, `ul` and `ur`: weights of the four faces around a place `at` whose cell's corner is
/// the first face's. `low`: that face's row, `column` how many bytes it stands behind the first one
/// there. (The compiler sets its own syntax again behind.)
#define WEIR_FOUR_FACES(column)                \
    ".syntax unified\n\t"                      \
    "lsrs %[low], %[at], #24\n\t"              \
    "mov %[t], %[row]\n\t"                     \
    "muls %[low], %[t]\n\t"                    \
    "add %[low], %[first]\n\t"                 \
    "lsrs %[ul], %[at], #16\n\t"               \
    "uxtb %[ul], %[ul]\n\t"                    \
    "lsrs %[" column "], %[at], #8\n\t"        \
    "uxtb %[" column "], %[" column "]\n\t"    \
    "lsls %[" column "], %[" column "], #1\n\t" \
    "uxtb %[at], %[at]\n\t"                    \
    "movs %[ur], %[ul]\n\t"                    \
    "muls %[ur], %[at]\n\t"                    \
    "adds %[ur], #128\n\t"                     \
    "lsrs %[ur], %[ur], #8\n\t"                \
    "subs %[ul], %[ul], %[ur]\n\t"             \
    "ldr %[ll], %[all]\n\t"                    \
    "subs %[ll], %[ll], %[at]\n\t"             \
    "subs %[ll], %[ll], %[ul]\n\t"             \
    "subs %[at], %[at], %[ur]\n\t"

/// Sum of the four weights.
inline constexpr std::uint32_t kAllWeights = 256;

/// `seen`: all bits of masses that were there before.
#define WEIR_ADD_MASS(offset, weight)      \
    "ldrh %[t], [%[low], #" offset "]\n\t" \
    "orrs %[seen], %[t]\n\t"               \
    "adds %[t], %[t], %[" weight "]\n\t"   \
    "strh %[t], [%[low], #" offset "]\n\t"
#define WEIR_TAKE_MASS(offset, weight)     \
    "ldrh %[t], [%[low], #" offset "]\n\t" \
    "subs %[t], %[t], %[" weight "]\n\t"   \
    "strh %[t], [%[low], #" offset "]\n\t"
/// `seen` is a velocity here.
#define WEIR_ADD_MOMENTUM(offset, weight) \
    "ldr %[t], [%[low], #" offset "]\n\t" \
    "muls %[" weight "], %[seen]\n\t"     \
    "adds %[t], %[t], %[" weight "]\n\t"  \
    "str %[t], [%[low], #" offset "]\n\t"

#define WEIR_SCATTER(half, up)                                                           \
    __asm__(".syntax unified\n"                                                          \
            "0:\n\t"                                                                     \
            "ldmia %[place]!, {%[at]}\n\t"                                              \
            half                                                                         \
            WEIR_FOUR_FACES("t")                                                         \
            "adds %[low], %[low], %[t]\n\t"                                             \
            "ldrh %[seen], [%[low]]\n\t"                                                \
            "adds %[t], %[seen], %[ll]\n\t"                                             \
            "strh %[t], [%[low]]\n\t"                                                   \
            WEIR_ADD_MASS("2", "at")                                                     \
            "add %[low], %[row]\n\t"                                                    \
            WEIR_ADD_MASS("0", "ul")                                                     \
            WEIR_ADD_MASS("2", "ur")                                                     \
            "lsrs %[seen], %[seen], #13\n\t"                                            \
            "bne 1f\n\t"                                                                \
            "mov %[t], %[tv]\n\t"                                                       \
            "ldrsh %[seen], [%[place], %[t]]\n\t"                                       \
            "lsls %[seen], %[seen], #2\n\t"                                             \
            "lsls %[low], %[low], #1\n\t"                                               \
            "add %[low], %[to]\n\t"                                                     \
            WEIR_ADD_MOMENTUM("0", "ll")                                                 \
            WEIR_ADD_MOMENTUM("4", "at")                                                 \
            up                                                                           \
            WEIR_ADD_MOMENTUM("0", "ul")                                                 \
            WEIR_ADD_MOMENTUM("4", "ur")                                                 \
            "cmp %[place], %[end]\n\t"                                                  \
            "bne 0b\n\t"                                                                \
            "movs %[seen], #0\n\t"                                                      \
            "b 2f\n"                                                                     \
            "1:\n\t"                                                                     \
            WEIR_TAKE_MASS("0", "ul")                                                    \
            WEIR_TAKE_MASS("2", "ur")                                                    \
            "mov %[t], %[row]\n\t"                                                      \
            "subs %[low], %[low], %[t]\n\t"                                             \
            WEIR_TAKE_MASS("0", "ll")                                                    \
            WEIR_TAKE_MASS("2", "at")                                                    \
            "2:\n\t"                                                                     \
            : [place] "+&l"(place), [at] "=&l"(at), [low] "=&l"(low), [ll] "=&l"(ll),    \
              [ul] "=&l"(ul), [ur] "=&l"(ur), [t] "=&l"(t), [seen] "=&l"(seen)           \
            : [end] "h"(last), [first] "h"(first), [row] "h"(row), [tv] "h"(from_next),  \
              [to] "h"(to_lower), [more] "h"(more), [all] "m"(all)                       \
            : "cc", "memory");

/// Mass and momentum of one component of the particles from `place` to `end` to their faces, until
/// one of them meets a face that is full: it gives nothing. `to_velocity`: from
/// a place. `to_momentum`: from twice the address of a mass.
/// @return whether a face was full. `place` is then the next one.
template <bool OnU>
bool add_particles(const char*& place, const char* end, Speed* first, std::int32_t row,
                   std::ptrdiff_t to_velocity, std::uintptr_t to_momentum) {
    const std::ptrdiff_t from_next = to_velocity - 4;
    const std::uint32_t all = kAllWeights;
    // From the upper faces' masses to the lower ones' momenta.
    const std::uintptr_t to_lower = to_momentum - 2 * static_cast<std::uintptr_t>(row);
    register const char* last __asm__("lr") = end;  // else it is not found that there is room
    std::uint32_t at, low, ll, ul, ur, t, seen;
    if (OnU) {
        const std::uint32_t more = kHalf<true>;
        WEIR_SCATTER("add %[at], %[more]\n\t", "add %[low], %[row]\n\tadd %[low], %[row]\n\t");
    } else {
        const std::int32_t more = 2 * row;
        WEIR_SCATTER("adds %[at], #128\n\t", "add %[low], %[more]\n\t");
    }
    return seen != 0;
}

#undef WEIR_SCATTER
#undef WEIR_ADD_MASS
#undef WEIR_TAKE_MASS
#undef WEIR_ADD_MOMENTUM

/// `g`: what is weighed of a field's four faces, 2^−15. `z`: the column of the lower ones, bytes
/// from `low`, which becomes the row of the upper ones.
#define WEIR_WEIGH(right, left)      \
    "ldrsh %[g], [%[low], %[z]]\n\t" \
    "muls %[g], %[ll]\n\t"           \
    right                            \
    "ldrsh %[t], [%[low], %[z]]\n\t" \
    "muls %[t], %[at]\n\t"           \
    "adds %[g], %[g], %[t]\n\t"      \
    "add %[low], %[row]\n\t"         \
    "ldrsh %[t], [%[low], %[z]]\n\t" \
    "muls %[t], %[ur]\n\t"           \
    "adds %[g], %[g], %[t]\n\t"      \
    left                             \
    "ldrsh %[t], [%[low], %[z]]\n\t" \
    "muls %[t], %[ul]\n\t"           \
    "adds %[g], %[g], %[t]\n\t"
/// Of what carries a particle; `low` becomes the first of the upper faces.
#define WEIR_WEIGH_CARRIED                                        \
    WEIR_WEIGH("adds %[z], #2\n\t", "subs %[z], #2\n\t")          \
    "adds %[low], %[low], %[z]\n\t"
/// Of what it gains.
#define WEIR_WEIGH_GAINED                                         \
    "movs %[z], #0\n\t"                                           \
    "add %[low], %[on]\n\t"                                       \
    WEIR_WEIGH("movs %[z], #2\n\t", "movs %[z], #0\n\t")

/// `t`: how far what carries it, `g`, takes a particle (`moves`). `own`: adds to what chance is
/// made of.
#define WEIR_MOVES(own)             \
    "movs %[t], %[g]\n\t"           \
    "adds %[t], #128\n\t"           \
    "asrs %[t], %[t], #8\n\t"       \
    "ldr %[z], %[scale]\n\t"        \
    "muls %[t], %[z]\n\t"           \
    "ldr %[z], %[shift]\n\t"        \
    "asrs %[t], %[z]\n\t"           \
    own                             \
    "ldr %[z], %[chance]\n\t"       \
    "muls %[g], %[z]\n\t"           \
    "lsrs %[g], %[g], #26\n\t"      \
    "adds %[t], %[t], %[g]\n\t"     \
    "asrs %[t], %[t], #6\n\t"

#define WEIR_OWN                \
    "ldr %[z], %[tv]\n\t"       \
    "add %[z], %[place]\n\t"    \
    "ldr %[z], [%[z]]\n\t"      \
    "adds %[g], %[g], %[z]\n\t"

/// Its velocity, `low`, out of what it gains, `g` (`change`), and `low` squared. Seldom it is
/// limited (6), or the fastest (7).
#define WEIR_CHANGE                 \
    "mov %[t], %[place]\n\t"        \
    "ldr %[z], %[tv]\n\t"           \
    "ldrsh %[at], [%[t], %[z]]\n\t" \
    "ldr %[ul], %[flip]\n\t"        \
    "muls %[at], %[ul]\n\t"         \
    "adds %[g], #128\n\t"           \
    "lsls %[g], %[g], #6\n\t"       \
    "adds %[at], %[at], %[g]\n\t"   \
    "asrs %[at], %[at], #14\n\t"    \
    "sxth %[low], %[at]\n\t"        \
    "cmp %[low], %[at]\n\t"         \
    "bne 6f\n"                      \
    "3:\n\t"                        \
    "strh %[low], [%[t], %[z]]\n\t" \
    "muls %[low], %[low]\n\t"
#define WEIR_LIMIT                  \
    "6:\n\t"                        \
    "asrs %[at], %[at], #31\n\t"    \
    "movs %[low], #128\n\t"         \
    "lsls %[low], %[low], #8\n\t"   \
    "subs %[low], #1\n\t"           \
    "eors %[low], %[at]\n\t"        \
    "b 3b\n"

/// What both gathers leave in registers, and what they are told.
#define WEIR_FOUND                                                                          \
    [place] "+&h"(place), [at] "=&l"(at), [low] "=&l"(low), [ll] "=&l"(ll), [ul] "=&l"(ul), \
        [ur] "=&l"(ur), [t] "=&l"(t), [z] "=&l"(z), [g] "=&l"(g)
#define WEIR_TOLD                                                                             \
    [end] "h"(task.end), [first] "h"(task.first), [row] "h"(task.row), [on] "h"(task.on),     \
        [scale] "m"(task.scale), [shift] "m"(task.shift), [chance] "m"(task.chance),          \
        [flip] "m"(task.flip), [tv] "m"(task.to_velocity), [tw] "m"(task.to_way),             \
        [all] "m"(all)

/// What gathers one component of some particles.
struct GatherTask {
    const char* end;             ///< of the places
    const Speed* first;          ///< of the faces
    std::int32_t row;            ///< bytes
    std::ptrdiff_t on;           ///< from the upper faces of a field to the lower ones of the other
    std::int32_t scale;          ///< of the clock
    std::int32_t shift;
    std::int32_t flip;
    std::ptrdiff_t to_velocity;  ///< from a place
    std::ptrdiff_t to_way;
    std::uint32_t chance;        ///< what makes bits as good as random
};

/// Along x: velocities and ways of all. @return the square of the fastest, or `fastest`.
inline std::int32_t gather_along_u(const GatherTask& given, const char* place,
                                   std::int32_t fastest) {
    GatherTask task = given;
    task.to_velocity -= 4;  // from the next place on
    task.to_way -= 4;
    const std::uint32_t all = kAllWeights;
    const std::uint32_t half = kHalf<true>;
    register std::int32_t most __asm__("lr") = fastest;
    std::uint32_t at, low, ll, ul, ur, t, z, g;
    __asm__(".syntax unified\n"
            "0:\n\t"
            "mov %[t], %[place]\n\t"
            "ldmia %[t]!, {%[at]}\n\t"
            "mov %[place], %[t]\n\t"
            "ldr %[t], %[half]\n\t"
            "adds %[at], %[at], %[t]\n\t"
            WEIR_FOUR_FACES("z")
            WEIR_WEIGH_CARRIED
            WEIR_MOVES(WEIR_OWN)
            "mov %[g], %[place]\n\t"
            "ldr %[z], %[tw]\n\t"
            "str %[t], [%[g], %[z]]\n\t"
            WEIR_WEIGH_GAINED
            WEIR_CHANGE
            "cmp %[low], %[fastest]\n\t"
            "bgt 7f\n"
            "4:\n\t"
            "cmp %[place], %[end]\n\t"
            "bne 0b\n\t"
            "b 5f\n"
            WEIR_LIMIT
            "7:\n\t"
            "mov %[fastest], %[low]\n\t"
            "b 4b\n"
            "5:\n\t"
            : WEIR_FOUND, [fastest] "+h"(most) : WEIR_TOLD, [half] "m"(half)
            : "cc", "memory");
    return most;
}

/// What `gather_v` compares words with: what `simply_goes` does.
struct WayBounds {
    std::uint32_t lowest;
    std::uint32_t room;
    std::uint32_t halves;
    std::uint32_t most;
    std::uint32_t far;
};

/// A particle that does not simply go its way, if `stops` is not 0.
struct Stop {
    std::uint32_t stops;
    Vec2<std::int32_t> way;
};

/// Along y, from `place` on: velocities, and there they go, up to one that does not simply go.
/// Where they come from takes the place of the ways along x.
/// Inline: what it is told is addressed by the stack pointer, as no register is left.
WEIR_ALWAYS_INLINE Stop gather_along_v(const GatherTask& task, const WayBounds& bounds,
                                       const char*& place, std::int32_t& fastest) {
    const std::uint32_t all = kAllWeights;
    register std::uint32_t way __asm__("lr");
    std::uint32_t at, low, ll, ul, ur, t, z, g;
    __asm__(".syntax unified\n"
            "0:\n\t"
            "mov %[t], %[place]\n\t"
            "ldr %[at], [%[t]]\n\t"
            "adds %[at], #128\n\t"
            WEIR_FOUR_FACES("z")
            WEIR_WEIGH_CARRIED
            WEIR_MOVES("")
            "mov %[a], %[t]\n\t"
            WEIR_WEIGH_GAINED
            WEIR_CHANGE
            "ldr %[t], %[fastest]\n\t"
            "cmp %[low], %[t]\n\t"
            "bgt 7f\n"
            "4:\n\t"
            "mov %[t], %[place]\n\t"
            "ldr %[ul], %[tw]\n\t"
            "ldr %[at], [%[t]]\n\t"
            "ldr %[ur], [%[t], %[ul]]\n\t"
            "str %[at], [%[t], %[ul]]\n\t"
            "mov %[ll], %[a]\n\t"
            "lsls %[ll], %[ll], #16\n\t"
            "adds %[ll], %[ll], %[ur]\n\t"
            "adds %[z], %[at], %[ll]\n\t"
            "ldr %[ul], %[lowest]\n\t"
            "subs %[low], %[z], %[ul]\n\t"
            "lsrs %[low], %[low], #1\n\t"
            "ldr %[at], %[halves]\n\t"
            "ands %[low], %[at]\n\t"
            "ldr %[g], %[room]\n\t"
            "subs %[g], %[g], %[low]\n\t"
            "bics %[g], %[at]\n\t"
            "ldr %[ul], %[most]\n\t"
            "adds %[ll], %[ll], %[ul]\n\t"
            "ldr %[ul], %[far]\n\t"
            "ands %[ll], %[ul]\n\t"
            "orrs %[g], %[ll]\n\t"
            "bne 5f\n\t"
            "stmia %[t]!, {%[z]}\n\t"
            "mov %[place], %[t]\n\t"
            "cmp %[t], %[end]\n\t"
            "bne 0b\n\t"
            "b 5f\n"
            WEIR_LIMIT
            "7:\n\t"
            "str %[low], %[fastest]\n\t"
            "b 4b\n"
            "5:\n\t"
            : WEIR_FOUND, [a] "=&h"(way), [fastest] "+m"(fastest) : WEIR_TOLD,
              [lowest] "m"(bounds.lowest), [room] "m"(bounds.room), [halves] "m"(bounds.halves),
              [most] "m"(bounds.most), [far] "m"(bounds.far)
            : "cc", "memory");
    return {g, {static_cast<std::int32_t>(ur), static_cast<std::int32_t>(way)}};
}

#undef WEIR_FOUR_FACES
#undef WEIR_WEIGH
#undef WEIR_WEIGH_CARRIED
#undef WEIR_WEIGH_GAINED
#undef WEIR_MOVES
#undef WEIR_OWN
#undef WEIR_CHANGE
#undef WEIR_LIMIT
#undef WEIR_FOUND
#undef WEIR_TOLD

}  // namespace weir::packed

#endif
