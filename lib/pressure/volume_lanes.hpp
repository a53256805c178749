// The volume correction four cells at a time: the plain loops' sums, and so their bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"
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

/// Excess of cells c, c + 1 … as long as enough are left before `end`; returns the next one to do.
template <class L>
inline std::int32_t excess_cells(const PressureFields<float>& f, std::int32_t stride,
                                 const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
    const auto zero = L::all(0.0F);
    const auto half = L::all(0.5F);
    const auto slack = L::all(limits.subsurface_slack);
    const auto window = L::all(limits.window);
    for (; c + L::kLanes <= end; c += L::kLanes) {
        const auto e = L::load(f.density + c) - L::all(1.0F);
        const auto lowest =
            L::minimum(L::minimum(L::load(f.level + c - 1), L::load(f.level + c + 1)),
                       L::minimum(L::load(f.level + c - stride), L::load(f.level + c + stride)));
        const auto inner = (L::load(f.level + c) > zero) & (lowest > zero);
        const auto at_surface = L::clamp(e - L::all(limits.surface_slack), zero, window);
        auto inside = e;
        const auto below = lowest < half;
        if (!limits.exact_below && L::any_true(inner & below)) {
            const auto missing = half - lowest;
            const auto more = e + L::all(0.125F) * missing * missing;
            inside = below ? more - L::clamp(more, -slack, slack) : e;
        }
        L::store(f.divergence + c, inner ? L::clamp(inside, -window, window) : at_surface);
    }
    return c;
}

#if WEIR_HAS_WIDE_LANES
std::int32_t excess_wide(const PressureFields<float>& f, std::int32_t stride,
                         const ExcessLimits& limits, std::int32_t c, std::int32_t end);
#endif

inline std::int32_t excess_lanes(const PressureFields<float>& f, std::int32_t stride,
                                 const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        c = excess_wide(f, stride, limits, c, end);
    }
#endif
    return excess_cells<FourLanes>(f, stride, limits, c, end);
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
