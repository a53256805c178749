// Cells without a weight in between that are relaxed, for a Cortex-M0: what relax_packed.hpp
// computes, to the bit. A cell and those beside it are loaded at once.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/pressure_fields.hpp"

#if defined(WEIR_LOOPS_OF_M0)

namespace weir {

/// Every other cell of a row.
struct CellsOfRow {
    CellsOfRow(const PressureFields<SmallFixed>& fields, std::int32_t stride, std::int32_t c)
        : left(fields.pressure + c - 1), diagonal(&fields.inverse_diagonal[c].raw),
          to_divergence(reinterpret_cast<const char*>(fields.divergence) -
                        reinterpret_cast<const char*>(fields.inverse_diagonal)),
          above(4 * stride - 8), below(-4 * stride - 8) {}

    SmallFixed* here() const { return left + 1; }
    std::int32_t divergence() const {
        return *reinterpret_cast<const std::int16_t*>(reinterpret_cast<const char*>(diagonal) +
                                                      to_divergence);
    }
    void go(std::int32_t cells) {
        left += cells;
        diagonal += cells;
    }

    SmallFixed* left;              ///< of the one that is next
    const std::int16_t* diagonal;  ///< its own
    std::ptrdiff_t to_divergence;  ///< bytes from there
    std::ptrdiff_t above;          ///< bytes from the second cell on its right
    std::ptrdiff_t below;
};

/// A cell with so many sides, `some` of which becomes its own pressure times them. On to `wide` if
/// what it is short of is no number of 22 bits, to `high` if its pressure is none of 29.
#define WEIR_RELAX_CELL(again, pull, factor, wide, high) \
    "ldmia %[at]!, {%[sum], %[here], %[some]}\n\t"       \
    "adds %[sum], %[sum], %[some]\n\t"                   \
    "ldr %[some], [%[at], %[below]]\n\t"                 \
    "adds %[sum], %[sum], %[some]\n\t"                   \
    "ldr %[some], [%[at], %[above]]\n\t"                 \
    "adds %[sum], %[sum], %[some]\n\t"                   \
    pull                                                 \
    "subs %[sum], %[sum], %[some]\n\t"                   \
    "ldrsh %[some], [%[diagonal], %[to]]\n\t"            \
    "lsls %[some], %[some], #9\n\t"                      \
    "subs %[sum], %[sum], %[some]\n\t"                   \
    "lsls %[some], %[sum], #10\n\t"                      \
    "asrs %[some], %[some], #10\n\t"                     \
    "cmp %[some], %[sum]\n\t"                            \
    "bne " wide "f\n"                                    \
    again ":\n\t"                                        \
    "mov %[sum], %[" factor "]\n\t"                      \
    "muls %[some], %[sum]\n\t"                           \
    "adds %[some], #128\n\t"                             \
    "asrs %[some], %[some], #8\n\t"                      \
    "adds %[here], %[here], %[some]\n\t"                 \
    "lsls %[some], %[here], #3\n\t"                      \
    "asrs %[some], %[some], #3\n\t"                      \
    "cmp %[some], %[here]\n\t"                           \
    "bne " high "f\n\t"                                  \
    "subs %[at], #8\n\t"                                 \
    "stmia %[at]!, {%[some]}\n\t"                        \
    "adds %[diagonal], #4\n\t"                           \
    "ldrh %[sum], [%[diagonal]]\n\t"

/// The nearest number of 22 bits, on to `again`; of 29, which is stored.
#define WEIR_LIMIT_CELL(again, wide, high) \
    wide ":\n\t"                           \
    "asrs %[some], %[sum], #31\n\t"        \
    "movs %[sum], #1\n\t"                  \
    "lsls %[sum], %[sum], #21\n\t"         \
    "subs %[sum], #1\n\t"                  \
    "eors %[some], %[sum]\n\t"             \
    "b " again "b\n"                       \
    high ":\n\t"                           \
    "asrs %[some], %[here], #31\n\t"       \
    "movs %[here], #1\n\t"                 \
    "lsls %[here], %[here], #28\n\t"       \
    "subs %[here], #1\n\t"                 \
    "eors %[some], %[here]\n\t"            \
    "subs %[at], #8\n\t"                   \
    "stmia %[at]!, {%[some]}\n\t"          \
    "adds %[diagonal], #4\n\t"             \
    "ldrh %[sum], [%[diagonal]]\n\t"       \
    "b 1b\n"

/// Goes to every other cell, as long as its diagonal is that of air or of a cell whose four or
/// three sides are open (`relax_plain`).
/// @return the first other diagonal, without its sign.
WEIR_ALWAYS_INLINE std::int32_t relax_plain_cells(CellsOfRow& cells, std::int32_t of_4,
                                                  std::int32_t of_3) {
    register std::uint32_t sum __asm__("r0") =
        reinterpret_cast<const std::uint16_t&>(*cells.diagonal);
    register std::uint32_t here __asm__("r1");
    register std::uint32_t some __asm__("r2");
    const std::uint32_t four = 512;
    const std::uint32_t three = 384;
    __asm__(".syntax unified\n\t"
            "b 1f\n"
            "0:\n\t"
            WEIR_RELAX_CELL("2", "lsls %[some], %[here], #2\n\t", "of_4", "5", "6")
            "cmp %[sum], %[four]\n\t"
            "beq 0b\n"
            "1:\n\t"
            "cmp %[sum], #0\n\t"
            "beq 4f\n\t"
            "cmp %[sum], %[four]\n\t"
            "beq 0b\n\t"
            "cmp %[sum], %[three]\n\t"
            "bne 9f\n\t"
            WEIR_RELAX_CELL("3", "lsls %[some], %[here], #1\n\tadds %[some], %[some], %[here]\n\t",
                            "of_3", "7", "8")
            "b 1b\n"
            "4:\n\t"
            "adds %[at], #8\n\t"
            "adds %[diagonal], #4\n\t"
            "ldrh %[sum], [%[diagonal]]\n\t"
            "b 1b\n"
            WEIR_LIMIT_CELL("2", "5", "6")
            WEIR_LIMIT_CELL("3", "7", "8")
            "9:\n\t"
            : [at] "+&l"(cells.left), [diagonal] "+&l"(cells.diagonal), [sum] "+&l"(sum),
              [here] "=&l"(here), [some] "=&l"(some)
            : [to] "l"(cells.to_divergence), [above] "l"(cells.above), [below] "l"(cells.below),
              [of_4] "h"(of_4), [of_3] "h"(of_3), [four] "h"(four), [three] "h"(three)
            : "cc", "memory");
    return static_cast<std::int32_t>(sum);
}

#undef WEIR_RELAX_CELL
#undef WEIR_LIMIT_CELL

}  // namespace weir

#endif
