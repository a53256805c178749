// Loops over cells with eight lanes.
#include "math/wide_lanes.hpp"
#include "pressure/coarse_lanes.hpp"
#include "pressure/plain_lanes.hpp"
#include "pressure/relax_lanes.hpp"
#include "pressure/surface_lanes.hpp"
#include "pressure/system_lanes.hpp"
#include "pressure/volume_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

std::int32_t relax_wide(const PressureFields<float>& fields, const float* open_u,
                        const float* open_v, float omega, std::int32_t stride, std::int32_t c,
                        std::int32_t end) {
    const auto cells = open_u != nullptr ? relax_cells<EightLanes, true>
                                         : relax_cells<EightLanes, false>;
    return cells(fields, open_u, open_v, omega, stride, c, end);
}

std::int32_t relax_coarse_wide(const CoarseGrid<float>& coarse, float omega, std::int32_t c,
                               std::int32_t end) {
    return relax_coarse_cells<EightLanes>(coarse, omega, c, end);
}

std::int32_t build_plain_wide(PlainTask& task, std::int32_t c, std::int32_t end, bool inside) {
    return build_plain_cells<EightLanes>(task, c, end, inside);
}

std::int32_t weigh_wide(const PressureFields<float>& fields, const float* open_u,
                        const float* open_v, std::int32_t stride, std::int32_t c,
                        std::int32_t end, float& there) {
    return weigh_cells<EightLanes>(fields, open_u, open_v, stride, c, end, there);
}

std::int32_t accelerate_wide(const PressureFields<float>& fields, const float* open_u,
                             const float* open_v, bool has_lower, std::int32_t c,
                             std::int32_t end, StaggeredGrid<float>& grid) {
    return accelerate_cells<EightLanes>(fields, open_u, open_v, has_lower, c, end, grid);
}

std::int32_t density_wide(const StaggeredGrid<float>& grid, const float* full_density,
                          float least_full, float per_face, std::int32_t c, std::int32_t end,
                          PressureFields<float>& fields) {
    return density_cells<EightLanes>(grid, full_density, least_full, per_face, c, end, fields);
}

std::int32_t excess_wide(const PressureFields<float>& f, std::int32_t stride,
                         const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
    return excess_cells<EightLanes>(f, stride, limits, c, end);
}

std::uint32_t means_wide(const PressureFields<float>& f, const PatchLimits& limits,
                         std::int32_t stride, std::int32_t c, std::int32_t rows, float* means,
                         float* most, std::int32_t& overfull) {
    return means_of_patches<EightLanes>(f, limits, stride, c, rows, means, most, overfull);
}

}  // namespace weir

#endif
