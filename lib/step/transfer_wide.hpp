// Both transfers with eight lanes, for processors that have them.
#pragma once

#include "math/wide_lanes.hpp"
#include "step/transfer_kernels.hpp"

namespace weir {

#if WEIR_HAS_WIDE_LANES
/// As the loops of `EightLanes`; only where `has_wide_lanes()`.
Gathered gather_wide(const GatherTask& task);
void scatter_wide(const float* position, const float* velocity, std::int32_t count,
                  const Pairs<float>& pairs);
void scatter_between_wide(const float* position, const float* velocity, std::int32_t count,
                          const Pairs<float>& pairs, std::int32_t first, std::int32_t end);
void scatter_component_wide(const float* position, const float* velocity, std::int32_t count,
                            const Pairs<float>& pairs, bool on_u);
#endif

}  // namespace weir
