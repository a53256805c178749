#include "step/transfer_wide.hpp"

#include "math/eight_lanes.hpp"
#include "step/quiet_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

Gathered gather_wide(const GatherTask& task) {
    return gather_all<EightLanes>(task);
}

void scatter_wide(const float* position, const float* velocity, std::int32_t count,
                  const Pairs<float>& pairs) {
    scatter_all<EightLanes>(position, velocity, count, pairs, EveryRow());
}

void scatter_between_wide(const float* position, const float* velocity, std::int32_t count,
                          const Pairs<float>& pairs, std::int32_t first, std::int32_t end) {
    scatter_all<EightLanes>(position, velocity, count, pairs, RowsBetween(pairs, first, end));
}

void scatter_component_wide(const float* position, const float* velocity, std::int32_t count,
                            const Pairs<float>& pairs, bool on_u) {
    const auto some = on_u ? scatter_component<EightLanes, true>
                           : scatter_component<EightLanes, false>;
    some(position, velocity, count, pairs);
}

std::int32_t find_sharing_wide(const SharedCells& cells, const float* position,
                               std::int32_t count, std::int32_t* number, std::int32_t& found) {
    return find_sharing<EightLanes>(cells, position, count, number, found);
}

}  // namespace weir

#endif
