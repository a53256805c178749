// What each particle goes through in both transfers, for a Cortex-M0: its eight registers hold just
// what there is, and compilers spend a quarter of the instructions on moving numbers out of the
// way. What is computed is what transfer_packed.cpp computes, to the bit.
#pragma once

#include "step/places_packed.hpp"

#if defined(WEIR_LOOPS_OF_M0)

namespace weir::packed {

/// `low` becomes the first of four faces, `ll`, `at`, `ul` and `ur` their weights, of a place `at`
/// whose cell's corner is the first face's. (The compiler sets its own syntax again behind.)
#define WEIR_FOUR_FACES             \
    ".syntax unified\n\t"           \
    "lsrs %[low], %[at], #24\n\t"   \
    "mov %[t], %[row]\n\t"          \
    "muls %[low], %[t]\n\t"         \
    "lsrs %[t], %[at], #8\n\t"      \
    "uxtb %[t], %[t]\n\t"           \
    "lsls %[t], %[t], #1\n\t"       \
    "adds %[low], %[low], %[t]\n\t" \
    "add %[low], %[first]\n\t"      \
    "lsrs %[ul], %[at], #16\n\t"    \
    "uxtb %[ul], %[ul]\n\t"         \
    "uxtb %[at], %[at]\n\t"         \
    "movs %[ur], %[ul]\n\t"         \
    "muls %[ur], %[at]\n\t"         \
    "adds %[ur], #128\n\t"          \
    "lsrs %[ur], %[ur], #8\n\t"     \
    "subs %[ul], %[ul], %[ur]\n\t"  \
    "movs %[ll], #128\n\t"          \
    "lsls %[ll], %[ll], #1\n\t"     \
    "subs %[ll], %[ll], %[at]\n\t"  \
    "subs %[ll], %[ll], %[ul]\n\t"  \
    "subs %[at], %[at], %[ur]\n\t"

#define WEIR_ADD_MASS(offset, weight)      \
    "ldrh %[t], [%[low], #" offset "]\n\t" \
    "orrs %[seen], %[t]\n\t"               \
    "adds %[t], %[t], %[" weight "]\n\t"   \
    "strh %[t], [%[low], #" offset "]\n\t"
#define WEIR_TAKE_MASS(offset, weight)     \
    "ldrh %[t], [%[low], #" offset "]\n\t" \
    "subs %[t], %[t], %[" weight "]\n\t"   \
    "strh %[t], [%[low], #" offset "]\n\t"
#define WEIR_ADD_MOMENTUM(offset, weight) \
    "ldr %[t], [%[low], #" offset "]\n\t" \
    "muls %[" weight "], %[v]\n\t"        \
    "adds %[t], %[t], %[" weight "]\n\t"  \
    "str %[t], [%[low], #" offset "]\n\t"

/// `kHalf`.
#define WEIR_HALF_U            \
    "movs %[t], #128\n\t"      \
    "lsls %[t], %[t], #16\n\t" \
    "adds %[at], %[at], %[t]\n\t"
#define WEIR_HALF_V "adds %[at], #128\n\t"

#define WEIR_SCATTER(half)                                                                   \
    __asm__(".syntax unified\n"                                                              \
            "0:\n\t"                                                                         \
            "mov %[t], %[place]\n\t"                                                         \
            "ldmia %[t]!, {%[at]}\n\t"                                                       \
            "mov %[place], %[t]\n\t"                                                         \
            "add %[t], %[tv]\n\t"                                                            \
            "movs %[seen], #0\n\t"                                                           \
            "ldrsh %[v], [%[t], %[seen]]\n\t"                                                \
            "lsls %[v], %[v], #2\n\t"                                                        \
            half                                                                             \
            WEIR_FOUR_FACES                                                                  \
            WEIR_ADD_MASS("0", "ll")                                                         \
            WEIR_ADD_MASS("2", "at")                                                         \
            "add %[low], %[row]\n\t"                                                         \
            WEIR_ADD_MASS("0", "ul")                                                         \
            WEIR_ADD_MASS("2", "ur")                                                         \
            "lsrs %[seen], %[seen], #13\n\t"                                                 \
            "bne 1f\n\t"                                                                     \
            "lsls %[low], %[low], #1\n\t"                                                    \
            "add %[low], %[to]\n\t"                                                          \
            WEIR_ADD_MOMENTUM("0", "ul")                                                     \
            WEIR_ADD_MOMENTUM("4", "ur")                                                     \
            "mov %[t], %[row]\n\t"                                                           \
            "lsls %[t], %[t], #1\n\t"                                                        \
            "subs %[low], %[low], %[t]\n\t"                                                  \
            WEIR_ADD_MOMENTUM("0", "ll")                                                     \
            WEIR_ADD_MOMENTUM("4", "at")                                                     \
            "cmp %[place], %[end]\n\t"                                                       \
            "bne 0b\n\t"                                                                     \
            "b 2f\n"                                                                         \
            "1:\n\t"                                                                         \
            WEIR_TAKE_MASS("0", "ul")                                                        \
            WEIR_TAKE_MASS("2", "ur")                                                        \
            "mov %[t], %[row]\n\t"                                                           \
            "subs %[low], %[low], %[t]\n\t"                                                  \
            WEIR_TAKE_MASS("0", "ll")                                                        \
            WEIR_TAKE_MASS("2", "at")                                                        \
            "2:\n\t"                                                                         \
            : [place] "+&h"(place), [at] "=&l"(at), [low] "=&l"(low), [ll] "=&l"(ll),        \
              [ul] "=&l"(ul), [ur] "=&l"(ur), [t] "=&l"(t), [v] "=&l"(v), [seen] "=&l"(seen) \
            : [end] "h"(last), [first] "h"(first), [row] "h"(row),                           \
              [tv] "h"(from_next), [to] "h"(to_momentum)                                     \
            : "cc", "memory");

/// Mass and momentum of one component of the particles from `place` to `end` to their faces, until
/// one of them meets a face that is full: it gives nothing. `to_velocity`: from
/// a place. `to_momentum`: from twice the address of a mass.
/// @return whether a face was full. `place` is then the next one.
template <bool OnU>
bool add_particles(const char*& place, const char* end, Speed* first, std::int32_t row,
                   std::ptrdiff_t to_velocity, std::uintptr_t to_momentum) {
    const std::ptrdiff_t from_next = to_velocity - 4;
    register const char* last __asm__("lr") = end;  // else it is not found that there is room
    std::uint32_t at, low, ll, ul, ur, t, v, seen;
    if (OnU) {
        WEIR_SCATTER(WEIR_HALF_U);
    } else {
        WEIR_SCATTER(WEIR_HALF_V);
    }
    return seen != 0;
}

#undef WEIR_SCATTER
#undef WEIR_ADD_MASS
#undef WEIR_TAKE_MASS
#undef WEIR_ADD_MOMENTUM

/// `g`: what is weighed of a field's four faces, 2^−15. `low` becomes the first of the upper ones.
#define WEIR_WEIGH                   \
    "ldrsh %[g], [%[low], %[z]]\n\t" \
    "muls %[g], %[ll]\n\t"           \
    "movs %[z], #2\n\t"              \
    "ldrsh %[t], [%[low], %[z]]\n\t" \
    "muls %[t], %[at]\n\t"           \
    "adds %[g], %[g], %[t]\n\t"      \
    "add %[low], %[row]\n\t"         \
    "ldrsh %[t], [%[low], %[z]]\n\t" \
    "muls %[t], %[ur]\n\t"           \
    "adds %[g], %[g], %[t]\n\t"      \
    "movs %[z], #0\n\t"              \
    "ldrsh %[t], [%[low], %[z]]\n\t" \
    "muls %[t], %[ul]\n\t"           \
    "adds %[g], %[g], %[t]\n\t"

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
    "ldr %[ul], %[tv]\n\t"          \
    "adds %[t], %[t], %[ul]\n\t"    \
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
    "strh %[low], [%[t]]\n\t"       \
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
        [flip] "m"(task.flip), [tv] "m"(task.to_velocity), [tw] "m"(task.to_way)

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
    register std::int32_t most __asm__("lr") = fastest;
    std::uint32_t at, low, ll, ul, ur, t, z, g;
    __asm__(".syntax unified\n"
            "0:\n\t"
            "mov %[t], %[place]\n\t"
            "ldmia %[t]!, {%[at]}\n\t"
            "mov %[place], %[t]\n\t"
            WEIR_HALF_U
            WEIR_FOUR_FACES
            "movs %[z], #0\n\t"
            WEIR_WEIGH
            WEIR_MOVES(WEIR_OWN)
            "mov %[g], %[place]\n\t"
            "ldr %[z], %[tw]\n\t"
            "str %[t], [%[g], %[z]]\n\t"
            "movs %[z], #0\n\t"
            "add %[low], %[on]\n\t"
            WEIR_WEIGH
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
            : WEIR_FOUND, [fastest] "+h"(most) : WEIR_TOLD
            : "cc", "memory");
    return most;
}

/// What `gather_v` compares words with.
struct WayBounds {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t half;
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
    register std::uint32_t way __asm__("lr");
    std::uint32_t at, low, ll, ul, ur, t, z, g;
    __asm__(".syntax unified\n"
            "0:\n\t"
            "mov %[t], %[place]\n\t"
            "ldr %[at], [%[t]]\n\t"
            WEIR_HALF_V
            WEIR_FOUR_FACES
            "movs %[z], #0\n\t"
            WEIR_WEIGH
            WEIR_MOVES("")
            "mov %[a], %[t]\n\t"
            "movs %[z], #0\n\t"
            "add %[low], %[on]\n\t"
            WEIR_WEIGH
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
            "lsrs %[low], %[z], #1\n\t"
            "ldr %[at], %[half]\n\t"
            "ands %[low], %[at]\n\t"
            "ldr %[ul], %[lowest]\n\t"
            "subs %[g], %[low], %[ul]\n\t"
            "ldr %[ul], %[highest]\n\t"
            "subs %[ul], %[ul], %[low]\n\t"
            "orrs %[g], %[ul]\n\t"
            "bics %[g], %[at]\n\t"
            "ldr %[ul], %[most]\n\t"
            "adds %[ll], %[ll], %[ul]\n\t"
            "ldr %[ul], %[far]\n\t"
            "ands %[ll], %[ul]\n\t"
            "orrs %[g], %[ll]\n\t"
            "bne 5f\n\t"
            "str %[z], [%[t]]\n\t"
            "adds %[t], #4\n\t"
            "mov %[place], %[t]\n\t"
            "cmp %[t], %[end]\n\t"
            "beq 5f\n\t"
            "b 0b\n"
            WEIR_LIMIT
            "7:\n\t"
            "str %[low], %[fastest]\n\t"
            "b 4b\n"
            "5:\n\t"
            : WEIR_FOUND, [a] "=&h"(way), [fastest] "+m"(fastest) : WEIR_TOLD,
              [lowest] "m"(bounds.low), [highest] "m"(bounds.high), [half] "m"(bounds.half),
              [most] "m"(bounds.most), [far] "m"(bounds.far)
            : "cc", "memory");
    return {g, {static_cast<std::int32_t>(ur), static_cast<std::int32_t>(way)}};
}

#undef WEIR_FOUR_FACES
#undef WEIR_HALF_U
#undef WEIR_HALF_V
#undef WEIR_WEIGH
#undef WEIR_MOVES
#undef WEIR_OWN
#undef WEIR_CHANGE
#undef WEIR_LIMIT
#undef WEIR_FOUND
#undef WEIR_TOLD

}  // namespace weir::packed

#endif
