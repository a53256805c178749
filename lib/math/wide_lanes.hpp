// With how many floats side by side loops go on a processor of which a build does not know how many
// it has: files compiled for more of them (`..._wide.cpp`: eight, with AVX2; `..._widest.cpp`:
// sixteen, with AVX-512) lie beside those for all.
#pragma once

#include <cstdint>

#include "base/compiler.hpp"

/// WEIR_WIDE: how many lanes the build has such files for.
#if defined(WEIR_WIDE) && defined(__x86_64__) && !defined(WEIR_PLAIN_LOOPS) && \
    WEIR_GNU_COMPILER && (defined(__clang__) || __GNUC__ >= 12)
#define WEIR_HAS_WIDE_LANES 1
#else
#define WEIR_HAS_WIDE_LANES 0
#endif
#if WEIR_HAS_WIDE_LANES && WEIR_WIDE >= 16
#define WEIR_HAS_WIDEST_LANES 1
#else
#define WEIR_HAS_WIDEST_LANES 0
#endif

namespace weir {

/// Most lanes of which the build has loops.
inline constexpr std::int32_t kMostLanes =
    WEIR_HAS_WIDEST_LANES ? 16 : (WEIR_HAS_WIDE_LANES ? 8 : 4);

/// 0: not asked yet. Every thread finds the same. Tests set less than there are.
extern std::int32_t lanes_known;
std::int32_t ask_for_lanes();

/// How many this processor has: 4, 8 or 16.
inline std::int32_t lanes_of_processor() {
#if WEIR_HAS_WIDE_LANES
    const std::int32_t known = __atomic_load_n(&lanes_known, __ATOMIC_RELAXED);
    return known != 0 ? known : ask_for_lanes();
#else
    return 4;
#endif
}
inline bool has_wide_lanes() {
    return lanes_of_processor() >= 8;
}

/// What it has of two tables of loops; null: neither.
template <class Loops, const Loops& ByEight, const Loops& BySixteen>
inline const Loops* loops_of_processor() {
    [[maybe_unused]] const std::int32_t lanes = lanes_of_processor();
    if constexpr (kMostLanes >= 16) {
        if (lanes >= 16) {
            return &BySixteen;
        }
    }
    if constexpr (kMostLanes >= 8) {
        if (lanes >= 8) {
            return &ByEight;
        }
    }
    return nullptr;
}

}  // namespace weir
