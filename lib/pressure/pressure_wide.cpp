// Loops over cells with eight lanes.
#include "math/wide_lanes.hpp"
#include "pressure/coarse_lanes.hpp"
#include "pressure/coarse_sweep_lanes.hpp"
#include "pressure/excess_lanes.hpp"
#include "pressure/plain_lanes.hpp"
#include "pressure/relax_lanes.hpp"
#include "pressure/surface_lanes.hpp"
#include "pressure/system_lanes.hpp"
#include "pressure/volume_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

void relax_wide(const RelaxTask& task) {
    relax_all<EightLanes>(task);
}

void relax_apart_wide(const CoarseGrid<float>& coarse, float omega, std::int32_t i,
                      const Part& rows) {
    relax_apart<EightLanes>(coarse, omega, i, rows);
}

void find_terms_wide(const PressureFields<float>& fields, const float* open_u,
                     const float* open_v, std::int32_t stride, std::int32_t q, std::int32_t c,
                     std::int32_t rows, float* terms) {
    find_terms<EightLanes>(fields, open_u, open_v, stride, q, c, rows, terms);
}

std::int32_t correct_wide(const PressureFields<float>& fields, std::int32_t stride,
                          std::int32_t q, std::int32_t c, std::int32_t height,
                          std::int32_t count) {
    return correct_patches<EightLanes>(fields, stride, q, c, height, 0, count);
}

std::int32_t build_wide(RowTask& task, std::int32_t c, std::int32_t end) {
    while (c + 8 <= end && build_group<EightLanes>(task, c)) {
        c += 8;
    }
    return c;
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

std::int32_t density_wide(const StaggeredGrid<float>& grid, const CutDensity<float>& cut,
                          float per_face, std::int32_t c, std::int32_t end, Part& slivers,
                          PressureFields<float>& fields) {
    return density_cells<EightLanes>(grid, cut, per_face, c, end, slivers, fields);
}

std::int32_t fill_wide(const DimpleTask& task, std::int32_t c, std::int32_t end) {
    return fill_cells<EightLanes>(task, c, end);
}

std::int32_t excess_wide(const PressureFields<float>& f, std::int32_t stride,
                         const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
    return excess_cells<EightLanes>(f, stride, limits, c, end);
}

std::uint32_t excess_of_word_wide(const Walls<float>& walls, const PressureFields<float>& f,
                                  std::int32_t stride, const ExcessLimits& limits, std::int32_t c,
                                  std::uint32_t told, std::int32_t last) {
    return excess_of_word<EightLanes>(walls, f, stride, limits, c, told, last);
}

std::uint32_t means_wide(const PressureFields<float>& f, const PatchLimits& limits,
                         std::int32_t stride, std::int32_t c, std::int32_t rows, float* means,
                         float* most, std::int32_t& overfull) {
    return means_of_patches<EightLanes>(f, limits, stride, c, rows, means, most, overfull);
}

}  // namespace weir

#endif
