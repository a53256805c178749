// Velocities out of momenta and masses, for a Cortex-M0: what grid_update.cpp computes for packed
// worlds, to the bit, in a loop that keeps all it needs in registers.
#pragma once

#include "math/quotient_packed.hpp"
#include "step/places_packed.hpp"

#if defined(WEIR_LOOPS_OF_M0)

namespace weir::packed {

/// `s`, the size of a momentum, half of the divisor added, `sign`, and `m`, the divisor.
#define WEIR_OPERANDS              \
    "1:\n\t"                       \
    "lsls %[t], %[at], #1\n\t"     \
    "add %[t], %[to]\n\t"          \
    "ldr %[s], [%[t]]\n\t"         \
    "asrs %[sign], %[s], #31\n\t"  \
    "eors %[s], %[sign]\n\t"       \
    "subs %[s], %[s], %[sign]\n\t" \
    "lsls %[m], %[m], #1\n\t"      \
    "adds %[s], %[s], %[m]\n\t"    \
    "lsls %[m], %[m], #1\n\t"

/// `q`: `short_quotient`. On to 9 if it is none, to 5 if the divisor is below 2^8, to 7 as long as
/// it is too small.
#define WEIR_SHORT_QUOTIENT        \
    "lsrs %[t], %[s], #15\n\t"     \
    "cmp %[t], %[m]\n\t"           \
    "bcs 9f\n\t"                   \
    "lsrs %[t], %[m], #8\n\t"      \
    "beq 5f\n\t"                   \
    "cmp %[t], #255\n\t"           \
    "bhi 9f\n"                     \
    "2:\n\t"                       \
    "lsls %[t], %[t], #1\n\t"      \
    "ldrh %[i], [%[of], %[t]]\n\t" \
    "cmp %[t], #255\n\t"           \
    "bhi 3f\n\t"                   \
    "lsls %[m], %[i]\n\t"          \
    "lsls %[s], %[i]\n\t"          \
    "lsrs %[t], %[m], #8\n\t"      \
    "lsls %[t], %[t], #1\n\t"      \
    "ldrh %[i], [%[of], %[t]]\n"   \
    "3:\n\t"                       \
    "lsrs %[q], %[s], #16\n\t"     \
    "muls %[q], %[i]\n\t"          \
    "lsrs %[q], %[q], #8\n\t"      \
    "movs %[t], %[q]\n\t"          \
    "muls %[t], %[m]\n\t"          \
    "subs %[s], %[s], %[t]\n\t"    \
    "lsrs %[t], %[s], #8\n\t"      \
    "muls %[t], %[i]\n\t"          \
    "lsrs %[t], %[t], #16\n\t"     \
    "adds %[q], %[q], %[t]\n\t"    \
    "muls %[t], %[m]\n\t"          \
    "subs %[s], %[s], %[t]\n"      \
    "4:\n\t"                       \
    "cmp %[s], %[m]\n\t"           \
    "bcs 7f\n\t"

/// Of the faces from `mass` to `end`: the velocity takes the place of the mass, and that with
/// `faster` stands so many bytes behind it. Momenta lie twice as far apart, so many bytes behind
/// twice a mass' address. Stops before a face whose quotient is not short (`is_short`).
/// @return that face, or `end`.
inline Speed* velocities_of(Speed* mass, const Speed* end, std::uintptr_t to_momentum,
                            std::ptrdiff_t to_velocity, std::int32_t faster) {
    std::uint32_t m, s, sign, q, inverse, t;  // t: the divisor's upper byte, twice
    __asm__(".syntax unified\n"
            "0:\n\t"
            "ldrh %[m], [%[at]]\n\t"
            "cmp %[m], #0\n\t"
            "beq 6f\n"
            WEIR_OPERANDS
            WEIR_SHORT_QUOTIENT
            "eors %[q], %[sign]\n\t"
            "subs %[q], %[q], %[sign]\n\t"
            "strh %[q], [%[at]]\n\t"
            "add %[q], %[faster]\n\t"
            "sxth %[t], %[q]\n\t"
            "cmp %[t], %[q]\n\t"
            "bne 8f\n"
            "10:\n\t"
            "mov %[i], %[behind]\n\t"
            "strh %[t], [%[at], %[i]]\n\t"
            "adds %[at], #2\n\t"
            "cmp %[at], %[end]\n\t"
            "bne 0b\n\t"
            "b 9f\n"
            "5:\n\t"
            "movs %[t], %[m]\n\t"
            "lsls %[m], %[m], #8\n\t"
            "lsls %[s], %[s], #8\n\t"
            "b 2b\n"
            "6:\n\t"  // faces without mass
            "mov %[i], %[behind]\n"
            "11:\n\t"
            "strh %[m], [%[at], %[i]]\n\t"
            "adds %[at], #2\n\t"
            "cmp %[at], %[end]\n\t"
            "beq 9f\n\t"
            "ldrh %[m], [%[at]]\n\t"
            "cmp %[m], #0\n\t"
            "beq 11b\n\t"
            "b 1b\n"
            "7:\n\t"
            "adds %[q], #1\n\t"
            "subs %[s], %[s], %[m]\n\t"
            "b 4b\n"
            "8:\n\t"  // no number of 16 bits
            "asrs %[q], %[q], #31\n\t"
            "movs %[t], #128\n\t"
            "lsls %[t], %[t], #8\n\t"
            "subs %[t], #1\n\t"
            "eors %[t], %[q]\n\t"
            "b 10b\n"
            "9:\n\t"
            : [at] "+&l"(mass), [m] "=&l"(m), [s] "=&l"(s), [sign] "=&l"(sign), [q] "=&l"(q),
              [i] "=&l"(inverse), [t] "=&l"(t)
            : [of] "l"(kShortInverses.of), [end] "h"(end), [to] "h"(to_momentum),
              [behind] "h"(to_velocity), [faster] "h"(faster)
            : "cc", "memory");
    return mass;
}

#undef WEIR_OPERANDS
#undef WEIR_SHORT_QUOTIENT

}  // namespace weir::packed

#endif
