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

constexpr bool has_all(std::uint32_t bits, std::uint32_t wanted) {
    return (bits & wanted) == wanted;
}

/// What processor and operating system have registers for (Intel's manual, volume 1, 14.3 and
/// 15.3).
std::int32_t ask() {
    constexpr std::uint32_t kAvxAndXgetbv = 3U << 27U;  // leaf 1, c
    constexpr std::uint32_t kAvx2 = 1U << 5U;           // leaf 7, b
    constexpr std::uint32_t kAvx512 = 1U << 16U | 1U << 17U | 1U << 30U | 1U << 31U;  // F DQ BW VL
    constexpr std::uint32_t kSaved = 0x06U;  // SSE and AVX state is kept when threads change,
    constexpr std::uint32_t kSavedToo = 0xE0U;  // that of masks and of all 32 registers, too
    if (cpuid(0).a < 7 || !has_all(cpuid(1).c, kAvxAndXgetbv)) {
        return 4;
    }
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    const std::uint32_t has = cpuid(7).b;
    if (!has_all(low, kSaved) || !has_all(has, kAvx2)) {
        return 4;
    }
    return WEIR_HAS_WIDEST_LANES && has_all(low, kSavedToo) && has_all(has, kAvx512) ? 16 : 8;
}

}  // namespace

std::int32_t lanes_known = 0;

std::int32_t ask_for_lanes() {
    const std::int32_t found = ask();
    __atomic_store_n(&lanes_known, found, __ATOMIC_RELAXED);
    return found;
}

}  // namespace weir

#endif
