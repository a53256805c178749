// A row of faces that are blended, for a Cortex-M0: what blend_packed.hpp computes, to the bit, in
// a loop that does not move numbers out of the way.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "step/places_packed.hpp"

#if defined(WEIR_LOOPS_OF_M0)

namespace weir::packed {

/// Whether the diagonal in `d` is that of a cell `amid`, 384 or 128 more, which is in `t`; if not:
/// on to 4.
#define WEIR_AMID(d)             \
    "subs %[" d "], #192\n\t"    \
    "subs %[" d "], #192\n\t"    \
    "bics %[" d "], %[t]\n\t"    \
    "bne 4f\n\t"

/// `t` becomes this number, if it is `more`.
#define WEIR_IF(more, number)          \
    "cmp %[" number "], %[t]\n\t"      \
    "b" more " .+4\n\t"                \
    "movs %[t], %[" number "]\n\t"

/// `right`, `now` and, `low`, a diagonal. All of them 0: on to 6.
#define WEIR_LOOK                        \
    "0:\n\t"                             \
    "movs %[low], #2\n\t"                \
    "ldrsh %[right], [%[f], %[low]]\n\t" \
    "mov %[low], %[to_now]\n\t"          \
    "ldrsh %[t], [%[f], %[low]]\n\t"     \
    "mov %[low], %[to_diagonal]\n\t"     \
    "ldrsh %[low], [%[f], %[low]]\n\t"   \
    "mov %[now], %[t]\n\t"               \
    "orrs %[t], %[here]\n\t"             \
    "orrs %[t], %[low]\n\t"              \
    "beq 6f\n\t"

/// `sharp` becomes what stands here, and amid liquid that sharpened: no further than what is around
/// (7). On to 4.
#define WEIR_SHARPEN                       \
    "movs %[sharp], %[here]\n\t"           \
    "movs %[t], #128\n\t"                  \
    WEIR_AMID("low")                       \
    "ldr %[up], %[to_before]\n\t"          \
    "ldrsh %[up], [%[f], %[up]]\n\t"       \
    WEIR_AMID("up")                        \
    "ldr %[low], %[to_lower]\n\t"          \
    "ldrsh %[low], [%[f], %[low]]\n\t"     \
    "ldr %[up], %[to_upper]\n\t"           \
    "ldrsh %[up], [%[f], %[up]]\n\t"       \
    "adds %[sharp], %[left], %[right]\n\t" \
    "adds %[sharp], %[sharp], %[low]\n\t"  \
    "adds %[sharp], %[sharp], %[up]\n\t"   \
    "lsls %[t], %[here], #2\n\t"           \
    "subs %[sharp], %[sharp], %[t]\n\t"    \
    "movs %[t], #171\n\t"                  \
    "muls %[sharp], %[t]\n\t"              \
    "asrs %[t], %[sharp], #31\n\t"         \
    "adds %[sharp], %[sharp], %[t]\n\t"    \
    "ldr %[t], %[half]\n\t"                \
    "adds %[sharp], %[sharp], %[t]\n\t"    \
    "asrs %[sharp], %[sharp], #10\n\t"     \
    "subs %[sharp], %[here], %[sharp]\n\t" \
    "cmp %[sharp], %[here]\n\t"            \
    "beq 4f\n\t"                           \
    "cmp %[sharp], %[left]\n\t"            \
    "blt 1f\n\t"                           \
    "cmp %[sharp], %[right]\n\t"           \
    "blt 4f\n\t"                           \
    "b 2f\n"                               \
    "1:\n\t"                               \
    "cmp %[sharp], %[right]\n\t"           \
    "bge 4f\n"                             \
    "2:\n\t"                               \
    "cmp %[sharp], %[low]\n\t"             \
    "blt 3f\n\t"                           \
    "cmp %[sharp], %[up]\n\t"              \
    "bge 7f\n\t"                           \
    "b 4f\n"                               \
    "3:\n\t"                               \
    "cmp %[sharp], %[up]\n\t"              \
    "blt 7f\n"

/// `sharp`, which is between no two neighbours, within those and what stands here.
#define WEIR_WITHIN           \
    "7:\n\t"                  \
    "movs %[t], %[here]\n\t"  \
    WEIR_IF("ge", "left")     \
    WEIR_IF("ge", "right")    \
    WEIR_IF("ge", "low")      \
    WEIR_IF("ge", "up")       \
    "cmp %[sharp], %[t]\n\t"  \
    "blt 11f\n\t"             \
    "movs %[t], %[here]\n\t"  \
    WEIR_IF("le", "left")     \
    WEIR_IF("le", "right")    \
    WEIR_IF("le", "low")      \
    WEIR_IF("le", "up")       \
    "cmp %[sharp], %[t]\n\t"  \
    "ble 4b\n"                \
    "11:\n\t"                 \
    "movs %[sharp], %[t]\n\t" \
    "b 4b\n"

/// `sharp`, what stands here and `now` make what is left there. On to 8 if it is no number of 16
/// bits.
#define WEIR_BLEND                      \
    "4:\n\t"                            \
    "mov %[t], %[to_was]\n\t"           \
    "strh %[here], [%[f], %[t]]\n\t"    \
    "mov %[t], %[now]\n\t"              \
    "lsls %[low], %[t], #2\n\t"         \
    "adds %[low], %[low], %[sharp]\n\t" \
    "ldr %[up], %[chances]\n\t"         \
    "muls %[low], %[up]\n\t"            \
    "lsrs %[low], %[low], #18\n\t"      \
    "mov %[up], %[share]\n\t"           \
    "muls %[sharp], %[up]\n\t"          \
    "adds %[low], %[low], %[sharp]\n\t" \
    "asrs %[low], %[low], #14\n\t"      \
    "subs %[t], %[t], %[here]\n\t"      \
    "adds %[t], %[t], %[low]\n\t"       \
    "sxth %[low], %[t]\n\t"             \
    "cmp %[low], %[t]\n\t"              \
    "bne 8f\n"                          \
    "10:\n\t"                           \
    "strh %[low], [%[f]]\n\t"           \
    "movs %[left], %[here]\n\t"         \
    "movs %[here], %[right]\n\t"        \
    "adds %[f], #2\n\t"                 \
    "cmp %[f], %[end]\n\t"              \
    "bne 0b\n\t"                        \
    "b 9f\n"

/// The faces from `field` to `end`, some of them with nothing but liquid around.
/// Not inline: in a larger function there are not enough registers.
/// @return what stood in the last one.
[[gnu::noinline]] inline std::int32_t blend_faces(const FacesAround& told, Speed* field,
                                                  const Speed* end, std::int32_t share) {
    const FacesAround at = told;
    const std::uint32_t chances = kChance;
    const std::uint32_t half = 512;  // of what is cut off
    std::int32_t left = field[-1].raw;
    std::int32_t here = field[0].raw;
    std::int32_t right, sharp, t, low, up;
    register std::uint32_t now __asm__("lr");
    __asm__(".syntax unified\n"
            WEIR_LOOK
            WEIR_SHARPEN
            WEIR_BLEND
            "6:\n\t"  // in the air
            "mov %[low], %[to_was]\n\t"
            "strh %[t], [%[f], %[low]]\n\t"
            "movs %[left], %[here]\n\t"
            "movs %[here], %[right]\n\t"
            "adds %[f], #2\n\t"
            "cmp %[f], %[end]\n\t"
            "bne 0b\n\t"
            "b 9f\n"
            WEIR_WITHIN
            "8:\n\t"  // no number of 16 bits
            "asrs %[t], %[t], #31\n\t"
            "movs %[low], #128\n\t"
            "lsls %[low], %[low], #8\n\t"
            "subs %[low], #1\n\t"
            "eors %[low], %[t]\n\t"
            "b 10b\n"
            "9:\n\t"
            : [f] "+&l"(field), [here] "+&l"(here), [left] "+&l"(left), [right] "=&l"(right),
              [sharp] "=&l"(sharp), [t] "=&l"(t), [low] "=&l"(low), [up] "=&l"(up),
              [now] "=&h"(now)
            : [end] "h"(end), [to_now] "h"(at.now), [to_diagonal] "h"(at.diagonal),
              [to_was] "h"(at.was), [share] "h"(share), [to_before] "m"(at.before),
              [to_lower] "m"(at.lower), [to_upper] "m"(at.upper), [chances] "m"(chances),
              [half] "m"(half)
            : "cc", "memory");
    return here;
}

#undef WEIR_AMID
#undef WEIR_IF
#undef WEIR_LOOK
#undef WEIR_SHARPEN
#undef WEIR_WITHIN
#undef WEIR_BLEND

}  // namespace weir::packed

#endif
