// Several processors for one step: a hook that the caller fills, usually with the port's.
#pragma once

#include <cstdint>

/// Whether loops can be shared out to threads. Microcontrollers leave the code out, and the fields
/// that it takes. A build may say otherwise, for library and program alike: -DWEIR_PARALLEL=1 where
/// a small chip has two cores.
#ifndef WEIR_PARALLEL
#if (defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M') || \
    (defined(__riscv) && __riscv_xlen == 32)
#define WEIR_PARALLEL 0
#else
#define WEIR_PARALLEL 1
#endif
#endif

namespace weir {

/// Calls task(context, k) once for each k = 0 … count − 1, in any order and on any threads, and
/// returns when all are done, what they wrote being visible to the caller. Tasks of one call touch
/// nothing that another of them writes. Called some 30 times a substep, from the thread that steps.
using ParallelFor = void (*)(void (*task)(void* context, std::int32_t k), void* context,
                             std::int32_t count);

}  // namespace weir
