// What each particle goes through in both transfers, for a Cortex-M with an FPU for single
// precision: faces side by side are loaded and stored together, and places become numbers of faces
// two at a time, neither of which compilers do. What is computed is what the plain loops compute,
// to the bit.
#pragma once

#include <cstdint>

#include "fluid/particles.hpp"
#include "math/fpu.hpp"

#if WEIR_HAS_FPU_LOOPS

namespace weir {

namespace fpu {

/// Where the numbers of faces are. mass_v is as far from v as mass_u from u (weir/memory.hpp).
struct Faces {
    explicit Faces(const StaggeredGrid<float>& grid)
        : u(grid.u + 1), v(grid.v + grid.shape.stride),
          row(grid.shape.stride * static_cast<std::int32_t>(sizeof(float))),
          apart(reinterpret_cast<std::intptr_t>(grid.mass_u) -
                reinterpret_cast<std::intptr_t>(grid.u)) {}

    float* u;             ///< what the stencils of places in row and column 0 begin with
    float* v;
    std::int32_t row;     ///< bytes from a face to the one above it
    std::intptr_t apart;  ///< bytes from u to mass_u, and from v to mass_v
};

/// s4, s5: weights of a place on the u faces; s6, s7: numbers of a face's column and row among the
/// v faces; i: the first of four u faces. s0, s1: the place; s2, s3: the same, half a cell on.
#define WEIR_FIND_U                          \
    "vadd.f32 s2, s1, %[half]\n\t"           \
    "vadd.f32 s3, s0, %[half]\n\t"           \
    "vcvt.s32.f32 s4, s0\n\t"                \
    "vcvt.s32.f32 s5, s2\n\t"                \
    "vcvt.s32.f32 s6, s3\n\t"                \
    "vcvt.s32.f32 s7, s1\n\t"                \
    "vmov %[i], %[j], s4, s5\n\t"            \
    "vcvt.f32.s32 s4, s4\n\t"                \
    "vcvt.f32.s32 s5, s5\n\t"                \
    "vsub.f32 s4, s0, s4\n\t"                \
    "vsub.f32 s5, s2, s5\n\t"                \
    "mla %[j], %[j], %[row], %[u]\n\t"       \
    "add %[i], %[j], %[i], lsl #2\n\t"
/// The same of the v faces.
#define WEIR_FIND_V                          \
    "vmov %[i], %[j], s6, s7\n\t"            \
    "vcvt.f32.s32 s6, s6\n\t"                \
    "vcvt.f32.s32 s7, s7\n\t"                \
    "vsub.f32 s6, s3, s6\n\t"                \
    "vsub.f32 s7, s1, s7\n\t"                \
    "mla %[j], %[j], %[row], %[v]\n\t"       \
    "add %[i], %[j], %[i], lsl #2\n\t"

/// Between two of s8, s9 (lower) and s10, s11 (upper faces).
#define WEIR_BETWEEN(fx, fy, value)          \
    "vsub.f32 s9, s9, s8\n\t"                \
    "vsub.f32 s11, s11, s10\n\t"             \
    "vmul.f32 s9, s9, " fx "\n\t"            \
    "vmul.f32 s11, s11, " fx "\n\t"          \
    "vadd.f32 s8, s8, s9\n\t"                \
    "vadd.f32 s10, s10, s11\n\t"             \
    "vsub.f32 s10, s10, s8\n\t"              \
    "vmul.f32 s10, s10, " fy "\n\t"          \
    "vadd.f32 " value ", s8, s10\n\t"
/// Of both fields of a component.
#define WEIR_SAMPLE(fx, fy, velocity, change) \
    "vldmia %[i], {s8-s9}\n\t"                \
    "add %[i], %[i], %[row]\n\t"              \
    "vldmia %[i], {s10-s11}\n\t"              \
    WEIR_BETWEEN(fx, fy, velocity)            \
    "add %[i], %[i], %[apart]\n\t"            \
    "vldmia %[i], {s10-s11}\n\t"              \
    "sub %[i], %[i], %[row]\n\t"              \
    "vldmia %[i], {s8-s9}\n\t"                \
    WEIR_BETWEEN(fx, fy, change)

/// What a gather is told beside the fields; keys as in `magnitude_key` and `bound_key`.
struct GatherTask {
    float dt;
    float flip_ratio;
    std::uint32_t limit;
    std::uint32_t near;
    std::int32_t span_x;  ///< from the lowest place, `kWallGap`, to the highest
    std::int32_t span_y;
};

/// Of a particle.
struct Found {
    Vec2<float> along;
    Vec2<float> velocity;
};

/// Moves the particles from `place` to `end`, at least one, up to one that does not simply go its
/// way. Answers which; `found` is what it would go along with, and its velocity.
[[gnu::noinline]] inline Vec2<float>* gather(const Faces& faces, const GatherTask& task,
                                             Vec2<float>* place, Vec2<float>* velocity,
                                             const Vec2<float>* end, std::uint32_t& fastest_yet,
                                             Found& found) {
    const std::uint32_t limit = task.limit;
    std::uint32_t fastest = fastest_yet;
    Found* const out = &found;
    register const Vec2<float>* last __asm__("lr") = end;  // else there is no room
    std::uint32_t i, j;
    __asm__ volatile(".syntax unified\n"
            "0:\n\t"
            "vldmia %[x], {s0-s1}\n\t"
            WEIR_FIND_U
            WEIR_SAMPLE("s4", "s5", "s12", "s14")
            WEIR_FIND_V
            WEIR_SAMPLE("s6", "s7", "s13", "s15")
            "vldmia %[w], {s2-s3}\n\t"
            "vmul.f32 s8, s12, %[dt]\n\t"
            "vmul.f32 s9, s13, %[dt]\n\t"
            "vmul.f32 s2, s2, %[flip]\n\t"
            "vmul.f32 s3, s3, %[flip]\n\t"
            "vmov %[i], %[j], s12, s13\n\t"
            "vadd.f32 s8, s8, s0\n\t"
            "vadd.f32 s9, s9, s1\n\t"
            "vadd.f32 s14, s14, s2\n\t"
            "vadd.f32 s15, s15, s3\n\t"
            "cmp %[near], %[i], lsl #1\n\t"
            "it hs\n\t"
            "cmphs %[near], %[j], lsl #1\n\t"
            "vmov %[i], %[j], s8, s9\n\t"
            "sub %[i], %[i], %[low]\n\t"
            "sub %[j], %[j], %[low]\n\t"
            "itt hs\n\t"
            "cmphs %[span_x], %[i]\n\t"
            "cmphs %[span_y], %[j]\n\t"
            "blo 3f\n\t"
            "vmov %[i], %[j], s14, s15\n\t"
            "cmp %[fastest], %[i], lsl #1\n\t"
            "it hs\n\t"
            "cmphs %[fastest], %[j], lsl #1\n\t"
            "blo 2f\n"
            "1:\n\t"
            "vstmia %[x]!, {s8-s9}\n\t"
            "vstmia %[w]!, {s14-s15}\n\t"
            "cmp %[x], %[end]\n\t"
            "bne 0b\n\t"
            "b 3f\n"
            "2:\n\t"
            "lsl %[i], %[i], #1\n\t"
            "lsl %[j], %[j], #1\n\t"
            "cmp %[i], %[j]\n\t"
            "it lo\n\t"
            "movlo %[i], %[j]\n\t"
            "ldr %[j], %[limit]\n\t"
            "cmp %[i], %[j]\n\t"
            "itt ls\n\t"
            "movls %[fastest], %[i]\n\t"
            "bls 1b\n"
            "3:\n\t"
            "ldr %[i], %[out]\n\t"
            "vstmia %[i], {s12-s15}\n\t"
            : [x] "+&r"(place), [w] "+&r"(velocity), [i] "=&r"(i), [j] "=&r"(j),
              [fastest] "+&r"(fastest)
            : [u] "r"(faces.u), [v] "r"(faces.v), [row] "r"(faces.row), [end] "r"(last),
              [apart] "r"(faces.apart), [near] "r"(task.near), [span_x] "r"(task.span_x),
              [span_y] "r"(task.span_y), [low] "n"(0x3C800000), [limit] "m"(limit),
              [out] "m"(out), [dt] "t"(task.dt), [flip] "t"(task.flip_ratio), [half] "t"(0.5F)
            : "cc", "memory", "s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8", "s9", "s10",
              "s11", "s12", "s13", "s14", "s15");
    fastest_yet = fastest;
    return place;
}

#undef WEIR_BETWEEN
#undef WEIR_SAMPLE

/// Shares of two faces' masses and momenta, and on to the upper ones.
#define WEIR_ADD_ROW(left, right, v)         \
    "vldmia %[i], {s8-s9}\n\t"               \
    "vldmia %[j], {s10-s11}\n\t"             \
    "vadd.f32 s10, s10, " left "\n\t"        \
    "vmul.f32 " left ", " left ", " v "\n\t" \
    "vadd.f32 s11, s11, " right "\n\t"       \
    "vmul.f32 " right ", " right ", " v "\n\t" \
    "vadd.f32 s8, s8, " left "\n\t"          \
    "vadd.f32 s9, s9, " right "\n\t"         \
    "vstmia %[j], {s10-s11}\n\t"             \
    "vstmia %[i], {s8-s9}\n\t"
#define WEIR_ADD(fx, fy, v)                  \
    "vmul.f32 s12, " fx ", " fy "\n\t"       \
    "add %[j], %[i], %[apart]\n\t"           \
    "vsub.f32 s14, %[one], " fx "\n\t"       \
    "vsub.f32 " fx ", " fx ", s12\n\t"       \
    "vsub.f32 " fy ", " fy ", s12\n\t"       \
    "vsub.f32 s14, s14, " fy "\n\t"          \
    WEIR_ADD_ROW("s14", fx, v)               \
    "add %[i], %[i], %[row]\n\t"             \
    "add %[j], %[j], %[row]\n\t"             \
    WEIR_ADD_ROW(fy, "s12", v)

/// Mass and momentum of the particles from `place` to `end`, at least one, to their faces; u and v
/// are momenta.
[[gnu::noinline]] inline void scatter(const Faces& faces, const Vec2<float>* place,
                                      const Vec2<float>* velocity, const Vec2<float>* end) {
    std::uint32_t i, j;
    __asm__ volatile(".syntax unified\n"
            "0:\n\t"
            "vldmia %[x]!, {s0-s1}\n\t"
            WEIR_FIND_U
            "vldmia %[w]!, {s13}\n\t"
            WEIR_ADD("s4", "s5", "s13")
            WEIR_FIND_V
            "vldmia %[w]!, {s13}\n\t"
            WEIR_ADD("s6", "s7", "s13")
            "cmp %[x], %[end]\n\t"
            "bne 0b\n\t"
            : [x] "+&r"(place), [w] "+&r"(velocity), [i] "=&r"(i), [j] "=&r"(j)
            : [u] "r"(faces.u), [v] "r"(faces.v), [row] "r"(faces.row),
              [apart] "r"(faces.apart), [end] "r"(end), [half] "t"(0.5F), [one] "t"(1.0F)
            : "cc", "memory", "s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8", "s9", "s10",
              "s11", "s12", "s13", "s14", "s15");
}

#undef WEIR_ADD
#undef WEIR_ADD_ROW
#undef WEIR_FIND_U
#undef WEIR_FIND_V

}  // namespace fpu

/// change = (now − change) + share · sharp, so many of them. Returns how many are done: all but up
/// to three.
inline std::int32_t blend_with_fpu(const float* now, const float* sharp, float share,
                                   std::int32_t count, float* change) {
    std::int32_t left = count;
    __asm__ volatile(".syntax unified\n\t"
            "b 1f\n"
            "0:\n\t"
            "vldmia %[now]!, {s0-s3}\n\t"
            "vldmia %[change], {s4-s7}\n\t"
            "vldmia %[sharp]!, {s8-s11}\n\t"
            "vsub.f32 s0, s0, s4\n\t"
            "vsub.f32 s1, s1, s5\n\t"
            "vsub.f32 s2, s2, s6\n\t"
            "vsub.f32 s3, s3, s7\n\t"
            "vmul.f32 s8, s8, %[share]\n\t"
            "vmul.f32 s9, s9, %[share]\n\t"
            "vmul.f32 s10, s10, %[share]\n\t"
            "vmul.f32 s11, s11, %[share]\n\t"
            "vadd.f32 s0, s0, s8\n\t"
            "vadd.f32 s1, s1, s9\n\t"
            "vadd.f32 s2, s2, s10\n\t"
            "vadd.f32 s3, s3, s11\n\t"
            "vstmia %[change]!, {s0-s3}\n"
            "1:\n\t"
            "subs %[left], %[left], #4\n\t"
            "bhs 0b\n\t"
            : [now] "+r"(now), [sharp] "+r"(sharp), [change] "+r"(change), [left] "+r"(left)
            : [share] "t"(share)
            : "cc", "memory", "s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8", "s9", "s10",
              "s11");
    return count - (left + 4);
}

inline void scatter_with_fpu(const Particles<float>& particles, const StaggeredGrid<float>& grid) {
    if (particles.count > 0) {
        fpu::scatter(fpu::Faces(grid), particles.position, particles.velocity,
                     particles.position + particles.count);
    }
}

}  // namespace weir

#endif
