// A half sweep over a row, for a Cortex-M with an FPU for single precision: cells side by side are
// loaded together, on the way to those behind them. What is computed is what `relax_cells` does, to
// the bit.
#pragma once

#include <type_traits>

#include "math/fpu.hpp"
#include "pressure/pressure_fields.hpp"

#if WEIR_HAS_FPU_LOOPS

namespace weir {

/// What follows the sum of what is above and below: a cell, those beside it, its divergence and
/// inverse diagonal.
#define WEIR_RELAX(left, here, right, sum, divergence, inverse, place) \
    "vadd.f32 s6, " left ", " right "\n\t"                             \
    "vadd.f32 s6, s6, " sum "\n\t"                                     \
    "vsub.f32 s6, s6, " divergence "\n\t"                              \
    "vmul.f32 s6, s6, " inverse "\n\t"                                 \
    "vsub.f32 s6, s6, " here "\n\t"                                    \
    "vmul.f32 s6, s6, %[omega]\n\t"                                    \
    "vadd.f32 s6, s6, " here "\n\t"                                    \
    "vstr s6, [%[p], #" place "]\n"

/// Sweeps over a row's cells, two at a time, and the last one. `test`: of an inverse diagonal, on
/// to a label if the cell is to be passed over.
#define WEIR_RELAX_ROW(test)                                                                  \
    __asm__ volatile(                                                                         \
        ".syntax unified\n\t"                                                                 \
        "vldr s0, [%[p], #-4]\n\t"                                                            \
        "b 3f\n"                                                                              \
        "0:\n\t"                                                                              \
        "vldmia %[p]!, {s1-s4}\n\t"                                                           \
        "vldmia %[above]!, {s5-s8}\n\t"                                                       \
        "vldmia %[below]!, {s9-s12}\n\t"                                                      \
        "vadd.f32 s5, s5, s9\n\t"                                                             \
        "vadd.f32 s7, s7, s11\n\t"                                                            \
        "vldmia %[inverse]!, {s13-s16}\n\t"                                                   \
        "vldmia %[divergence]!, {s9-s12}\n\t"                                                 \
        "vmov %[some], s13\n\t"                                                               \
        test("1f")                                                                            \
        WEIR_RELAX("s0", "s1", "s2", "s5", "s9", "s13", "-16")                                \
        "1:\n\t"                                                                              \
        "vmov %[some], s15\n\t"                                                               \
        test("2f")                                                                            \
        WEIR_RELAX("s2", "s3", "s4", "s7", "s11", "s15", "-8")                                \
        "2:\n\t"                                                                              \
        "vmov.f32 s0, s4\n"                                                                   \
        "3:\n\t"                                                                              \
        "subs %[left], %[left], #2\n\t"                                                       \
        "bpl 0b\n\t"                                                                          \
        "lsls %[left], %[left], #31\n\t"                                                      \
        "bpl 4f\n\t"                                                                          \
        "ldr %[some], [%[inverse]]\n\t"                                                       \
        test("4f")                                                                            \
        "vmov s13, %[some]\n\t"                                                               \
        "vldmia %[p], {s1-s2}\n\t"                                                            \
        "vldr s5, [%[above]]\n\t"                                                             \
        "vldr s9, [%[below]]\n\t"                                                             \
        "vadd.f32 s5, s5, s9\n\t"                                                             \
        "vldr s9, [%[divergence]]\n\t"                                                        \
        WEIR_RELAX("s0", "s1", "s2", "s5", "s9", "s13", "0")                                  \
        "4:\n\t"                                                                              \
        : [p] "+&r"(p), [above] "+&r"(above), [below] "+&r"(below), [inverse] "+&r"(inverse),  \
          [divergence] "+&r"(divergence), [some] "=&l"(some), [left] "+&r"(left),             \
          [all] "+&r"(all)                                                                    \
        : [omega] "t"(omega)                                                                  \
        : "cc", "memory", "s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8", "s9", "s10",  \
          "s11", "s12", "s13", "s14", "s15", "s16")

#define WEIR_UNLESS_ZERO(label) "cbz %[some], " label "\n\t"
#define WEIR_IF_POSITIVE(label)      \
    "orr %[all], %[all], %[some]\n\t" \
    "cmp %[some], #0\n\t"            \
    "ble " label "\n\t"

/// So many cells of a row, every other one from `c` on, but those whose inverse diagonal is
/// negative. Answers whether there are such.
template <bool Solids>
inline bool relax_row(const PressureFields<float>& fields, std::int32_t c, std::int32_t stride,
                      std::int32_t cells, float omega) {
    const float* p = fields.pressure + c;
    const float* above = p + stride;
    const float* below = p - stride;
    const float* divergence = fields.divergence + c;
    const float* inverse = fields.inverse_diagonal + c;
    std::int32_t left = cells;
    std::int32_t all = 0;
    std::uint32_t some;
    if constexpr (Solids) {
        WEIR_RELAX_ROW(WEIR_IF_POSITIVE);
    } else {
        WEIR_RELAX_ROW(WEIR_UNLESS_ZERO);
    }
    return Solids && all < 0;
}

#undef WEIR_IF_POSITIVE
#undef WEIR_UNLESS_ZERO
#undef WEIR_RELAX_ROW

/// Every other cell of some rows, for one liquid; one(c) does those that a wall touches.
template <bool Solids, class One>
[[gnu::noinline]] inline void relax_rows(std::bool_constant<Solids>, const GridShape& s,
                                         const Part& rows, std::int32_t colour, float omega,
                                         const PressureFields<float>& fields, const One& one) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::int32_t i = (j + colour) & 1;
        std::int32_t c = s.index(i, j);
        if (relax_row<Solids>(fields, c, s.stride, (s.nx - i + 1) / 2, omega)) {
            for (const std::int32_t end = s.index(s.nx, j); c < end; c += 2) {
                if (bound_key(fields.inverse_diagonal[c]) < 0) {
                    one(c);
                }
            }
        }
    }
}

#undef WEIR_RELAX

/// Every other coarse cell of so many rows, the first one in column `i` of row j.
[[gnu::noinline]] inline void relax_coarse(const CoarseGrid<float>& coarse, std::int32_t i,
                                           std::int32_t j, std::int32_t rows, float omega) {
    const GridShape& s = coarse.shape;
    const std::int32_t q = s.index(i, j);
    const float* p = coarse.correction + q;
    const float* above = p + s.stride;
    const float* below = p - s.stride;
    const float* inverse = coarse.inverse_diagonal + q;
    const float* residual = coarse.residual + q;
    const float* beside = coarse.weight_u + q;
    const float* lower = coarse.weight_v + q;
    const float* upper = lower + s.stride;
    // Of every other row: cells, and bytes from behind them to those of the next row.
    alignas(16) std::int32_t row[4];
    for (std::int32_t k = 0; k < 2; ++k) {
        const std::int32_t column = i ^ k;
        const std::int32_t cells = (s.nx - column + 1) / 2;
        row[2 * k] = cells;
        row[2 * k + 1] = 4 * (s.stride + 1 - 2 * (column + cells));
    }
    const std::int32_t* at = row;
    std::int32_t cells;
    std::uint32_t some;
    __asm__ volatile(".syntax unified\n"
            "2:\n\t"
            "ldr %[cells], [%[at]]\n\t"
            "cbz %[cells], 3f\n\t"
            "vldr s0, [%[p], #-4]\n"
            "0:\n\t"
            "ldr %[some], [%[inverse]], #8\n\t"
            "vldmia %[p]!, {s1-s2}\n\t"
            "vldmia %[above]!, {s3-s4}\n\t"
            "vldmia %[upper]!, {s5-s6}\n\t"
            "vldmia %[below]!, {s7-s8}\n\t"
            "vldmia %[lower]!, {s9-s10}\n\t"
            "vldmia %[beside]!, {s11-s12}\n\t"
            "vldmia %[residual]!, {s13-s14}\n\t"
            "cbz %[some], 1f\n\t"
            "vmul.f32 s0, s0, s11\n\t"
            "vmul.f32 s12, s2, s12\n\t"
            "vmul.f32 s7, s7, s9\n\t"
            "vmul.f32 s3, s3, s5\n\t"
            "vadd.f32 s0, s0, s12\n\t"
            "vadd.f32 s7, s7, s3\n\t"
            "vmov s12, %[some]\n\t"
            "vadd.f32 s0, s0, s7\n\t"
            "vadd.f32 s0, s0, s13\n\t"
            "vmul.f32 s0, s0, s12\n\t"
            "vsub.f32 s0, s0, s1\n\t"
            "vmul.f32 s0, s0, %[omega]\n\t"
            "vadd.f32 s0, s0, s1\n\t"
            "vstr s0, [%[p], #-8]\n"
            "1:\n\t"
            "vmov.f32 s0, s2\n\t"
            "subs %[cells], %[cells], #1\n\t"
            "bne 0b\n"
            "3:\n\t"
            "ldr %[cells], [%[at], #4]\n\t"
            "eor %[at], %[at], #8\n\t"
            "add %[p], %[p], %[cells]\n\t"
            "add %[above], %[above], %[cells]\n\t"
            "add %[below], %[below], %[cells]\n\t"
            "add %[inverse], %[inverse], %[cells]\n\t"
            "add %[residual], %[residual], %[cells]\n\t"
            "add %[beside], %[beside], %[cells]\n\t"
            "add %[lower], %[lower], %[cells]\n\t"
            "add %[upper], %[upper], %[cells]\n\t"
            "subs %[rows], %[rows], #1\n\t"
            "bne 2b\n\t"
            : [p] "+&r"(p), [above] "+&r"(above), [below] "+&r"(below), [inverse] "+&r"(inverse),
              [residual] "+&r"(residual), [beside] "+&r"(beside), [lower] "+&r"(lower),
              [upper] "+&r"(upper), [rows] "+&r"(rows), [at] "+&r"(at), [cells] "=&l"(cells),
              [some] "=&l"(some)
            : [omega] "t"(omega)
            : "cc", "memory", "s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8", "s9", "s10",
              "s11", "s12", "s13", "s14");
}

}  // namespace weir

#endif
