// Whether there are loops of assembly for worlds in float: for a Cortex-M with an FPU for single
// precision. Without optimisation compilers have no registers for them.
#pragma once

#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M' && defined(__ARM_FP) && \
    (__ARM_FP & 4) && defined(__OPTIMIZE__)
#define WEIR_HAS_FPU_LOOPS 1
#else
#define WEIR_HAS_FPU_LOOPS 0
#endif

namespace weir {

template <class Real>
inline constexpr bool kHasFpuLoops = false;
#if WEIR_HAS_FPU_LOOPS
template <>
inline constexpr bool kHasFpuLoops<float> = true;
#endif

}  // namespace weir
