// The loops over cells with so many lanes, for a file compiled for processors that have them.
#pragma once

#include "math/eight_lanes.hpp"
#include "pressure/coarse_faces_lanes.hpp"
#include "pressure/coarse_sweep_lanes.hpp"
#include "pressure/excess_lanes.hpp"
#include "pressure/plain_lanes.hpp"
#include "pressure/relax_lanes.hpp"
#include "pressure/surface_lanes.hpp"
#include "pressure/system_lanes.hpp"
#include "pressure/volume_lanes.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

#if WEIR_HAS_WIDE_LANES

/// With L, and what is left with eight.
template <class L>
struct CellsWith {
    static void relax(const RelaxTask& task) {
        // What is loaded next has to lie in one of the last stores: rows of one group take longer.
        const bool long_rows = enough_alternate(task.c, task.end, 2 * L::kLanes);
        const auto relax_rows = long_rows ? relax_all<L, EightLanes> : relax_all<EightLanes>;
        relax_rows(task);
    }
    static std::int32_t correct(const PressureFields<float>& fields, std::int32_t stride,
                                std::int32_t q, std::int32_t c, std::int32_t height,
                                std::int32_t count) {
        const std::int32_t done = correct_patches<L>(fields, stride, q, c, height, 0, count);
        return correct_patches<EightLanes>(fields, stride, q, c, height, done, count);
    }
    static std::int32_t build(RowTask& task, std::int32_t c, std::int32_t end) {
        c = build_groups<L>(task, c, end);
        return build_groups<EightLanes>(task, c, end);
    }
    static std::int32_t accelerate(const PressureFields<float>& fields, const float* open_u,
                                   const float* open_v, bool has_lower, std::int32_t c,
                                   std::int32_t end, StaggeredGrid<float>& grid) {
        c = accelerate_cells<L>(fields, open_u, open_v, has_lower, c, end, grid);
        return accelerate_cells<EightLanes>(fields, open_u, open_v, has_lower, c, end, grid);
    }
    static std::int32_t density(const StaggeredGrid<float>& grid, const CutDensity<float>& cut,
                                float per_face, std::int32_t c, std::int32_t end, Part& slivers,
                                PressureFields<float>& fields) {
        c = density_cells<L>(grid, cut, per_face, c, end, slivers, fields);
        return density_cells<EightLanes>(grid, cut, per_face, c, end, slivers, fields);
    }
    static std::int32_t fill(const DimpleTask& task, std::int32_t c, std::int32_t end) {
        c = fill_cells<L>(task, c, end);
        return fill_cells<EightLanes>(task, c, end);
    }
    static std::int32_t excess(const PressureFields<float>& f, std::int32_t stride,
                               const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
        c = excess_cells<L>(f, stride, limits, c, end);
        return excess_cells<EightLanes>(f, stride, limits, c, end);
    }
    static std::uint32_t word(const Walls<float>& walls, const PressureFields<float>& f,
                              std::int32_t stride, const ExcessLimits& limits, std::int32_t c,
                              std::uint32_t told, std::int32_t end) {
        told = excess_of_word<L>(walls, f, stride, limits, c, told, end - L::kLanes);
        return excess_of_word<EightLanes>(walls, f, stride, limits, c, told, end - 8);
    }

    /// Patches, coarse cells and a sum in the cells' order: more lanes than eight take longer.
    static constexpr WideCells kLoops{relax,
                                      relax_apart<EightLanes>,
                                      find_face_terms<EightLanes>,
                                      find_terms<EightLanes>,
                                      correct,
                                      build,
                                      weigh_cells<EightLanes>,
                                      accelerate,
                                      density,
                                      fill,
                                      excess,
                                      word,
                                      means_of_patches<EightLanes>};
};

#endif

}  // namespace weir
