// Density and level of four cells at a time: the plain loop's sums and formulas, and so its bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

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
/// `full_density`: null: no solids; `least_full`: cells of less have no density.
template <class L>
inline std::int32_t density_cells(const StaggeredGrid<float>& grid, const float* full_density,
                                  float least_full, float per_face, std::int32_t c,
                                  std::int32_t end, PressureFields<float>& fields) {
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
        if (full_density != nullptr) {
            const auto full = L::load(full_density + c);
            const auto shown = full < L::all(least_full) ? zero : density / full;
            density = (wet & (full < L::all(1.0F))) ? shown : density;
        }
        L::store(fields.density + c, density);
        const auto level = level_of_density_lanes<L>(density) - head;
        L::store(fields.level + c, wet ? level : empty);
    }
    return c;
}

#if WEIR_HAS_WIDE_LANES
std::int32_t density_wide(const StaggeredGrid<float>& grid, const float* full_density,
                          float least_full, float per_face, std::int32_t c, std::int32_t end,
                          PressureFields<float>& fields);
#endif

inline std::int32_t density_row(const StaggeredGrid<float>& grid, const float* full_density,
                                float least_full, float per_face, std::int32_t c,
                                std::int32_t end, PressureFields<float>& fields) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        c = density_wide(grid, full_density, least_full, per_face, c, end, fields);
    }
#endif
    return density_cells<FourLanes>(grid, full_density, least_full, per_face, c, end, fields);
}

/// Which of four cells are air and have a liquid neighbour; `all_around`: nothing else.
inline LaneMask beside_liquid(const float* level, std::int32_t stride, std::int32_t c,
                              bool all_around) {
    const Lanes zero = all_lanes(0.0F);
    const Lanes left = load_lanes(level + c - 1);
    const Lanes right = load_lanes(level + c + 1);
    const Lanes lower = load_lanes(level + c - stride);
    const Lanes upper = load_lanes(level + c + stride);
    const Lanes highest =
        all_around ? minimum(minimum(left, right), minimum(lower, upper))
                   : maximum(maximum(left, right), maximum(lower, upper));
    return (load_lanes(level + c) <= zero) & (highest > zero);
}

/// What `surrounded` asks of four cells.
struct DimpleTask {
    const float* level;
    const float* open_u;  ///< null: no solids
    const float* open_v;
    const std::uint8_t* cell_case;
    std::int32_t stride;
    float share;         ///< of open faces that liquid must cover
    float share_of_cut;  ///< the same for a cell that a contour crosses
    float filled;        ///< a level that is no evidence
};

/// Which of four cells liquid surrounds. `left` … `upper`: 1 for each face within the tank, or 0.
inline LaneMask surrounded_four(const DimpleTask& task, std::int32_t c, Lanes left, Lanes right,
                                float lower, float upper) {
    Lanes open = all_lanes(0.0F);
    Lanes covered = all_lanes(0.0F);
    const auto face = [&](Lanes inside, const float* share, std::int32_t neighbour) {
        const Lanes fraction = task.open_u != nullptr ? inside * load_lanes(share) : inside;
        const Lanes there = load_lanes(task.level + neighbour);
        const LaneMask liquid = (there > all_lanes(0.0F)) & (there != all_lanes(task.filled));
        open = open + fraction;
        covered = covered + (liquid ? fraction : all_lanes(0.0F));
    };
    face(left, task.open_u + c, c - 1);
    face(right, task.open_u + c + 1, c + 1);
    face(all_lanes(lower), task.open_v + c, c - task.stride);
    face(all_lanes(upper), task.open_v + c + task.stride, c + task.stride);
    Lanes share = all_lanes(task.share);
    if (task.open_u != nullptr) {
        const std::uint8_t* cases = task.cell_case + c;
        const LaneMask cut = LaneMask{cases[0], cases[1], cases[2], cases[3]} != 0;
        share = cut ? all_lanes(task.share_of_cut) : share;
    }
    return (open > all_lanes(0.0F)) & (covered >= share * open);
}

#endif

}  // namespace weir
