// Density and level of four cells at a time: the plain loop's sums and formulas, and so its bits.
#pragma once

#include "math/lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As `level_of_density`: all three pieces, of which each lane takes its own; where all are nearly
/// full, the one for that.
inline Lanes level_of_density(Lanes density) {
    const Lanes one = all_lanes(1.0F);
    const Lanes full = clamp(density, all_lanes(0.0F), one);
    const LaneMask upper = full > all_lanes(0.5F);
    const Lanes g = upper ? one - full : full;
    const Lanes low = all_lanes(1.5F) - square_root(all_lanes(8.0F) * g);
    if (all_true(upper & (g < all_lanes(0.03125F)))) {
        return low;
    }
    const Lanes steep = all_lanes(1.5F) * g - all_lanes(0.03125F);
    const Lanes middle = (all_lanes(0.875F) - square_root(maximum(steep, all_lanes(0.0F)))) *
                         all_lanes(static_cast<float>(4.0 / 3.0));
    const Lanes high = all_lanes(1.5F) - square_root(all_lanes(0.25F) + all_lanes(4.0F) * g);
    const Lanes depth = g >= all_lanes(0.1875F) ? high : (g >= all_lanes(0.03125F) ? middle : low);
    return upper ? depth : -depth;
}

/// Cells c, c + 1 … as long as four are left before `end`. Returns the next cell to do.
/// `full_density`: null: no solids; `least_full`: cells of less have no density.
inline std::int32_t density_row(const StaggeredGrid<float>& grid, const float* full_density,
                                float least_full, float per_face, std::int32_t c,
                                std::int32_t end, PressureFields<float>& fields) {
    const std::int32_t up = grid.shape.stride;
    const Lanes zero = all_lanes(0.0F);
    for (; c + 4 <= end; c += 4) {
        const Lanes mass = (load_lanes(grid.mass_u + c) + load_lanes(grid.mass_u + c + 1)) +
                           (load_lanes(grid.mass_v + c) + load_lanes(grid.mass_v + c + up));
        const LaneMask wet = mass > zero;
        if (!any_true(wet)) {
            store_lanes(fields.density + c, zero);
            store_lanes(fields.level + c, all_lanes(kEmptyLevel<float>));
            continue;
        }
        Lanes density = wet ? mass * all_lanes(per_face) : zero;
        if (full_density != nullptr) {
            const Lanes full = load_lanes(full_density + c);
            const Lanes shown = full < all_lanes(least_full) ? zero : density / full;
            density = (wet & (full < all_lanes(1.0F))) ? shown : density;
        }
        store_lanes(fields.density + c, density);
        store_lanes(fields.level + c,
                    wet ? level_of_density(density) : all_lanes(kEmptyLevel<float>));
    }
    return c;
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

#endif

}  // namespace weir
