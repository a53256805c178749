// What each particle goes through in both transfers, for a Cortex-M0: its eight registers hold just
// what there is, and compilers spend a quarter of the instructions on moving numbers out of the
// way. What is computed is what transfer_packed.cpp computes, to the bit.
#pragma once

#include "step/places_packed.hpp"

#if defined(__ARM_ARCH_6M__)

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

#define WEIR_ADD_MASS(offset, weight)           \
    "ldrh %[t], [%[low], #" offset "]\n\t"      \
    "orrs %[seen], %[t]\n\t"                    \
    "adds %[t], %[t], %[" weight "]\n\t"        \
    "strh %[t], [%[low], #" offset "]\n\t"
#define WEIR_TAKE_MASS(offset, weight)          \
    "ldrh %[t], [%[low], #" offset "]\n\t"      \
    "subs %[t], %[t], %[" weight "]\n\t"        \
    "strh %[t], [%[low], #" offset "]\n\t"
#define WEIR_ADD_MOMENTUM(offset, weight)       \
    "ldr %[t], [%[low], #" offset "]\n\t"       \
    "muls %[" weight "], %[v]\n\t"              \
    "adds %[t], %[t], %[" weight "]\n\t"        \
    "str %[t], [%[low], #" offset "]\n\t"

/// Along x and along y: `at` becomes the corner of the cell that the first face is in the middle of.
#define WEIR_HALF_U "movs %[t], #128\n\t" "lsls %[t], %[t], #16\n\t" "adds %[at], %[at], %[t]\n\t"
#define WEIR_HALF_V "adds %[at], #128\n\t"

#define WEIR_SCATTER(half) \
    __asm__(".syntax unified\n" \
            "0:\n\t" \
            "mov %[t], %[place]\n\t" \
            "ldr %[at], [%[t]]\n\t" \
            "add %[t], %[tv]\n\t" \
            "movs %[seen], #0\n\t" \
            "ldrsh %[v], [%[t], %[seen]]\n\t" \
            "lsls %[v], %[v], #2\n\t" \
            "movs %[t], #4\n\t" \
            "add %[place], %[t]\n\t" \
            half \
            WEIR_FOUR_FACES \
            WEIR_ADD_MASS("0", "ll") \
            WEIR_ADD_MASS("2", "at") \
            "add %[low], %[row]\n\t" \
            WEIR_ADD_MASS("0", "ul") \
            WEIR_ADD_MASS("2", "ur") \
            "lsrs %[seen], %[seen], #13\n\t" \
            "bne 1f\n\t" \
            "lsls %[low], %[low], #1\n\t" \
            "add %[low], %[to]\n\t" \
            WEIR_ADD_MOMENTUM("0", "ul") \
            WEIR_ADD_MOMENTUM("4", "ur") \
            "mov %[t], %[row]\n\t" \
            "lsls %[t], %[t], #1\n\t" \
            "subs %[low], %[low], %[t]\n\t" \
            WEIR_ADD_MOMENTUM("0", "ll") \
            WEIR_ADD_MOMENTUM("4", "at") \
            "ldr %[t], %[end]\n\t" \
            "cmp %[place], %[t]\n\t" \
            "bne 0b\n\t" \
            "b 2f\n" \
            "1:\n\t" \
            WEIR_TAKE_MASS("0", "ul") \
            WEIR_TAKE_MASS("2", "ur") \
            "mov %[t], %[row]\n\t" \
            "subs %[low], %[low], %[t]\n\t" \
            WEIR_TAKE_MASS("0", "ll") \
            WEIR_TAKE_MASS("2", "at") \
            "2:\n\t" \
            : [place] "+&h"(place), [at] "=&l"(at), [low] "=&l"(low), [ll] "=&l"(ll), \
              [ul] "=&l"(ul), [ur] "=&l"(ur), [t] "=&l"(t), [v] "=&l"(v), [seen] "=&l"(seen) \
            : [end] "m"(end), [first] "h"(first), [row] "h"(row), \
              [tv] "h"(to_velocity), [to] "h"(to_momentum) \
            : "cc", "memory");

/// Mass and momentum of one component of the particles from `place` to `end` to their faces, until
/// one of them meets a face that is full: it gives nothing. `to_velocity`: from
/// a place. `to_momentum`: from twice the address of a mass.
/// @return whether a face was full. `place` is then the next one.
template <bool OnU>
bool add_particles(const char*& place, const char* end, Speed* first, std::int32_t row,
                   std::ptrdiff_t to_velocity, std::uintptr_t to_momentum) {
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

}  // namespace weir::packed

#endif
