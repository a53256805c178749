#include "step/transfer_wide.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

float gather_wide(const GatherTask& task) {
    return gather_all<EightLanes>(task);
}

void scatter_wide(const float* position, const float* velocity, std::int32_t count,
                  const Pairs<float>& pairs) {
    scatter_all<EightLanes>(position, velocity, count, pairs);
}

}  // namespace weir

#endif
