#include "math/wide_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

namespace {

struct Registers {
    std::uint32_t a, b, c, d;
};

Registers cpuid(std::uint32_t leaf) {
    Registers r{};
    __asm__("cpuid" : "=a"(r.a), "=b"(r.b), "=c"(r.c), "=d"(r.d) : "a"(leaf), "c"(0));
    return r;
}

/// Whether processor and operating system have AVX2 registers (Intel's manual, volume 1, 14.3).
bool ask() {
    constexpr std::uint32_t kAvxAndXgetbv = 3U << 27U;  // leaf 1, c
    constexpr std::uint32_t kAvx2 = 1U << 5U;           // leaf 7, b
    constexpr std::uint32_t kSaved = 6U;  // SSE and AVX state is kept when threads change
    if (cpuid(0).a < 7 || (cpuid(1).c & kAvxAndXgetbv) != kAvxAndXgetbv) {
        return false;
    }
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return (low & kSaved) == kSaved && (cpuid(7).b & kAvx2) != 0;
}

}  // namespace

std::int32_t wide_lanes_known = 0;

bool ask_for_wide_lanes() {
    const bool found = ask();
    __atomic_store_n(&wide_lanes_known, found ? 1 : -1, __ATOMIC_RELAXED);
    return found;
}

}  // namespace weir

#endif
