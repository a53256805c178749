// Several processors for one step: a hook that the caller fills, usually with the port's.
#pragma once

#include <cstdint>

namespace weir {

/// Calls task(context, k) once for each k = 0 … count − 1, in any order and on any threads, and
/// returns when all are done, what they wrote being visible to the caller. Tasks of one call touch
/// nothing that another of them writes. Called some 30 times a substep, from the thread that steps.
using ParallelFor = void (*)(void (*task)(void* context, std::int32_t k), void* context,
                             std::int32_t count);

}  // namespace weir
