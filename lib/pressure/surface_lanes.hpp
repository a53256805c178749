// Density and level of four cells at a time: the plain loop's sums and formulas, and so its bits.
#pragma once

#include "math/four_lanes.hpp"
#include "pressure/some_lanes.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As `level_of_density`: all three pieces, of which each lane takes its own; where all are nearly
/// full, the one for that.
template <class L>
inline typename L::Floats level_of_density_lanes(typename L::Floats density) {
    const auto one = L::all(1.0F);
    const auto full = L::clamp(density, L::all(0.0F), one);
    const auto upper = full > L::all(0.5F);
    const auto g = upper ? one - full : full;
    const auto low = L::all(1.5F) - L::square_root(L::all(8.0F) * g);
    if (L::all_true(upper & (g < L::all(0.03125F)))) {
        return low;
    }
    const auto steep = L::all(1.5F) * g - L::all(0.03125F);
    const auto middle = (L::all(0.875F) - L::square_root(L::maximum(steep, L::all(0.0F)))) *
                        L::all(static_cast<float>(4.0 / 3.0));
    const auto high = L::all(1.5F) - L::square_root(L::all(0.25F) + L::all(4.0F) * g);
    const auto depth = g >= L::all(0.1875F) ? high : (g >= L::all(0.03125F) ? middle : low);
    return upper ? depth : -depth;
}

/// Cells c, c + 1 … as long as enough are left before `end`. Returns the next cell to do.
/// `slivers` grows to hold those that one particle would make liquid.
template <class L>
inline std::int32_t density_cells(const StaggeredGrid<float>& grid, const CutDensity<float>& cut,
                                  float per_face, std::int32_t c, std::int32_t end, Part& slivers,
                                  PressureFields<float>& fields) {
    const std::int32_t up = grid.shape.stride;
    const auto zero = L::all(0.0F);
    const auto empty = L::all(kEmptyLevel<float>);
    const auto head = L::all(least_head(fields));
    for (; c + L::kLanes <= end; c += L::kLanes) {
        const auto mass = (L::load(grid.mass_u + c) + L::load(grid.mass_u + c + 1)) +
                          (L::load(grid.mass_v + c) + L::load(grid.mass_v + c + up));
        const auto wet = mass > zero;
        if (!L::any_true(wet)) {
            L::store(fields.density + c, zero);
            L::store(fields.level + c, empty);
            continue;
        }
        auto density = wet ? mass * L::all(per_face) : zero;
        if (cut.full != nullptr) {
            const auto full = L::load(cut.full + c);
            const auto partly = wet & (full < L::all(1.0F));
            if (L::any_true(partly)) {
                const auto shown =
                    full < L::all(cut.least) ? L::all(kNoRoom<float>) : density / full;
                density = partly ? shown : density;
                if (L::any_true(wet & (full < L::all(cut.sliver)))) {
                    slivers.first = slivers.first == slivers.end ? c : slivers.first;
                    slivers.end = c + L::kLanes;
                }
            }
        }
        L::store(fields.density + c, density);
        const auto level = level_of_density_lanes<L>(density) - head;
        L::store(fields.level + c, wet ? level : empty);
    }
    return c;
}

inline std::int32_t density_row(const StaggeredGrid<float>& grid, const CutDensity<float>& cut,
                                float per_face, std::int32_t c, std::int32_t end, Part& slivers,
                                PressureFields<float>& fields) {
    if (const WideCells* wide = wide_cells()) {
        c = wide->density_cells(grid, cut, per_face, c, end, slivers, fields);
    }
    return density_cells<FourLanes>(grid, cut, per_face, c, end, slivers, fields);
}

/// What `fill_dimples` asks of the cells of a row.
struct DimpleTask {
    float* level;
    const float* open_u;  ///< null: no solids
    const float* open_v;
    std::int32_t stride;
    float share;              ///< of open faces that liquid must cover
    float share_of_shifting;  ///< the same for a cell with a contour that shifts
    float filled;        ///< a level that is no evidence
    bool has_lower;      ///< whether the rows beside it are the tank's
    bool has_upper;
    std::int32_t first;  ///< cells at the tank's walls; beyond a seam it goes on
    std::int32_t last;
    const Walls<float>& walls;
    /// Of cells c … those with a contour that shifts, a bit each. Null: no solids.
    std::uint32_t (*shifting)(const DimpleTask& task, std::int32_t c, std::uint32_t asked);
};

/// Which cells are air and have a liquid neighbour; `all_around`: nothing else. What lies beyond
/// the tank is not told yet, and after a restore may be no number, nor then is the largest of four.
template <class L>
inline auto beside_liquid(const float* level, std::int32_t stride, std::int32_t c,
                          bool all_around) {
    const auto zero = L::all(0.0F);
    const auto left = L::load(level + c - 1);
    const auto right = L::load(level + c + 1);
    const auto lower = L::load(level + c - stride);
    const auto upper = L::load(level + c + stride);
    const auto liquid =
        all_around ? L::minimum(L::minimum(left, right), L::minimum(lower, upper)) > zero
                   : ((left > zero) | (right > zero)) | ((lower > zero) | (upper > zero));
    return (L::load(level + c) <= zero) & liquid;
}

/// Which of the cells asked for liquid surrounds.
template <class L>
inline auto surrounded_cells(const DimpleTask& task, std::int32_t c, typename L::Ints asked) {
    using Floats = typename L::Floats;
    const auto zero = L::all(0.0F);
    const auto one = L::all(1.0F);
    Floats open = zero;
    Floats covered = zero;
    const auto face = [&](Floats inside, const float* share, std::int32_t at, std::int32_t beside) {
        const Floats fraction = task.open_u != nullptr ? inside * L::load(share + at) : inside;
        const auto there = L::load(task.level + beside);
        const auto liquid = (there > zero) & (there != L::all(task.filled));
        open = open + fraction;
        covered = covered + (liquid ? fraction : zero);
    };
    face(open_before<L>(c == task.first), task.open_u, c, c - 1);
    face(open_behind<L>(c + L::kLanes - 1 == task.last), task.open_u, c + 1, c + 1);
    face(task.has_lower ? one : zero, task.open_v, c, c - task.stride);
    face(task.has_upper ? one : zero, task.open_v, c + task.stride, c + task.stride);
    const auto some = asked & (open > zero);
    auto surrounded = some & (covered >= L::all(task.share) * open);
    if (task.shifting != nullptr) {
        const auto nearly = some & (covered >= L::all(task.share_of_shifting) * open);
        const std::uint32_t left = L::bits_of(nearly & ~surrounded);
        if (left != 0) {
            surrounded |= L::lanes_of(task.shifting(task, c, left));
        }
    }
    return surrounded;
}

/// `fill_dimples` of cells c … as long as enough are left before `end`. Returns the next one to do.
template <class L>
inline std::int32_t fill_cells(const DimpleTask& task, std::int32_t c, std::int32_t end) {
    const bool inner_row = task.open_u == nullptr && task.has_lower && task.has_upper;
    for (; c + L::kLanes <= end; c += L::kLanes) {
        const auto level = L::load(task.level + c);
        if (!L::any_true(level <= L::all(0.0F))) {
            continue;
        }
        // Four open faces want liquid behind all of them.
        const bool inner = inner_row && c > task.first && c + L::kLanes - 1 < task.last;
        const auto beside = beside_liquid<L>(task.level, task.stride, c, inner);
        if (L::any_true(beside)) {
            const auto filled = surrounded_cells<L>(task, c, beside);
            L::store(task.level + c, filled ? L::all(task.filled) : level);
        }
    }
    return c;
}

inline std::int32_t fill_lanes(const DimpleTask& task, std::int32_t c, std::int32_t end) {
    if (const WideCells* wide = wide_cells()) {
        c = wide->fill_cells(task, c, end);
    }
    return fill_cells<FourLanes>(task, c, end);
}

#endif

}  // namespace weir
