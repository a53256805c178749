// Loops over cells with more lanes than every processor has.
#pragma once

#include "math/wide_lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "pressure/slivers.hpp"
#include "solid/walls.hpp"

namespace weir {

struct CoarseFacesTask;
struct DimpleTask;
struct ExcessLimits;
struct Patch;
struct PatchLimits;
struct RelaxTask;
struct RowTask;

/// As the loops in `..._lanes.hpp` that have their names, with as many lanes as possible: where a
/// group does not fit in, with fewer, but for four.
struct WideCells {
    void (*relax_all)(const RelaxTask& task);
    void (*relax_apart)(const CoarseGrid<float>& coarse, float omega, std::int32_t i,
                        const Part& rows);
    /// Of a patch and the next one.
    std::uint32_t (*find_face_terms)(const CoarseFacesTask& task, const Patch& patch, float* terms);
    void (*find_terms)(const PressureFields<float>& fields, const float* open_u,
                       const float* open_v, std::int32_t stride, std::int32_t q, std::int32_t c,
                       std::int32_t rows, float* terms);
    std::int32_t (*correct_patches)(const PressureFields<float>& fields, std::int32_t stride,
                                    std::int32_t q, std::int32_t c, std::int32_t height,
                                    std::int32_t count);
    std::int32_t (*build_groups)(RowTask& task, std::int32_t c, std::int32_t end);
    std::int32_t (*weigh_cells)(const PressureFields<float>& fields, const float* open_u,
                                const float* open_v, std::int32_t stride, std::int32_t c,
                                std::int32_t end, float& there);
    std::int32_t (*accelerate_cells)(const PressureFields<float>& fields, const float* open_u,
                                     const float* open_v, bool has_lower, std::int32_t c,
                                     std::int32_t end, StaggeredGrid<float>& grid);
    std::int32_t (*density_cells)(const StaggeredGrid<float>& grid, const CutDensity<float>& cut,
                                  float per_face, std::int32_t c, std::int32_t end, Part& slivers,
                                  PressureFields<float>& fields);
    std::int32_t (*fill_cells)(const DimpleTask& task, std::int32_t c, std::int32_t end);
    std::int32_t (*excess_cells)(const PressureFields<float>& f, std::int32_t stride,
                                 const ExcessLimits& limits, std::int32_t c, std::int32_t end);
    std::uint32_t (*excess_of_word)(const Walls<float>& walls, const PressureFields<float>& f,
                                    std::int32_t stride, const ExcessLimits& limits,
                                    std::int32_t c, std::uint32_t told, std::int32_t end);
    /// Of eight.
    std::uint32_t (*means_of_patches)(const PressureFields<float>& f, const PatchLimits& limits,
                                      std::int32_t stride, std::int32_t c, std::int32_t rows,
                                      float* means, float* most, std::int32_t& overfull);
};
extern const WideCells cells_by_eight;
extern const WideCells cells_by_sixteen;

/// Those of this processor; null: it has no more than four lanes.
inline const WideCells* wide_cells() {
    return loops_of_processor<WideCells, cells_by_eight, cells_by_sixteen>();
}

}  // namespace weir
