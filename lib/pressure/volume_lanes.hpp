// The volume correction four cells at a time: the plain loops' sums, and so their bits.
#pragma once

#include "math/lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// What the excess of a cell is cut to.
struct ExcessLimits {
    float surface_slack;
    float subsurface_slack;
    float window;
    bool exact_below;  ///< no allowance below the surface
};

#if WEIR_HAS_LANES

/// Excess of cells c, c + 1 … as long as four are left before `end`; returns the next one to do.
inline std::int32_t excess_lanes(const PressureFields<float>& f, std::int32_t stride,
                                 const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
    const Lanes zero = all_lanes(0.0F);
    const Lanes half = all_lanes(0.5F);
    const Lanes slack = all_lanes(limits.subsurface_slack);
    const Lanes window = all_lanes(limits.window);
    for (; c + 4 <= end; c += 4) {
        const Lanes e = load_lanes(f.density + c) - all_lanes(1.0F);
        const Lanes lowest =
            minimum(minimum(load_lanes(f.level + c - 1), load_lanes(f.level + c + 1)),
                    minimum(load_lanes(f.level + c - stride), load_lanes(f.level + c + stride)));
        const LaneMask inner = (load_lanes(f.level + c) > zero) & (lowest > zero);
        const Lanes at_surface = clamp(e - all_lanes(limits.surface_slack), zero, window);
        Lanes inside = e;
        const LaneMask below = lowest < half;
        if (!limits.exact_below && any_true(inner & below)) {
            const Lanes missing = half - lowest;
            const Lanes more = e + all_lanes(0.125F) * missing * missing;
            inside = below ? more - clamp(more, -slack, slack) : e;
        }
        store_lanes(f.divergence + c, inner ? clamp(inside, -window, window) : at_surface);
    }
    return c;
}

/// Adds the excess of a row of a patch, four cells of which the liquid ones count, each cut to the
/// window.
inline void add_row_of_patch(const PressureFields<float>& f, float window, std::int32_t c,
                             float& sum, std::int32_t& count) {
    const LaneMask liquid = load_lanes(f.level + c) > all_lanes(0.0F);
    count -= liquid[0] + liquid[1] + liquid[2] + liquid[3];
    const Lanes cut = clamp(load_lanes(f.divergence + c), all_lanes(-window), all_lanes(window));
    const Lanes said = liquid ? cut : all_lanes(0.0F);
    sum = (((sum + said[0]) + said[1]) + said[2]) + said[3];
}

/// velocity −= speed · (difference of the excess + along) on four faces, but for closed ones.
/// `open` null: no solids. `first`: the first of them takes part.
inline void drift_lanes(const float* excess, std::int32_t back, float speed, Lanes along,
                        const float* open, bool first, std::int32_t face, float* velocity) {
    const Lanes now = load_lanes(velocity + face);
    const Lanes rise = (load_lanes(excess + face) - load_lanes(excess + face - back)) + along;
    LaneMask moves{first ? -1 : 0, -1, -1, -1};
    if (open != nullptr) {
        moves &= load_lanes(open + face) > all_lanes(0.0F);
    }
    store_lanes(velocity + face, moves ? now - all_lanes(speed) * rise : now);
}

/// Drift of a row of a patch, four cells with both their faces. `along_x`: four; `walls` null: no
/// solids; `has_left`: of the first cell.
inline void drift_row(const float* excess, std::int32_t stride, float speed, const float* along_x,
                      float along_y, const Walls<float>* walls, bool has_left, bool has_lower,
                      std::int32_t c, StaggeredGrid<float>& grid) {
    drift_lanes(excess, 1, speed, load_lanes(along_x), walls != nullptr ? walls->open_u : nullptr,
                has_left, c, grid.u);
    if (has_lower) {
        drift_lanes(excess, stride, speed, all_lanes(along_y),
                    walls != nullptr ? walls->open_v : nullptr, true, c, grid.v);
    }
}

#endif

}  // namespace weir
