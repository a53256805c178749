// The projection's equations four cells at a time, where liquid is all around and no wall is near:
// the plain loops' sums, and so their bits. Elsewhere the plain loops do them.
#pragma once

#include "math/lanes.hpp"
#include "pressure/leap.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// What four cells have around them.
enum class Around : std::uint8_t { liquid, air, both };

/// Of cells c … c + 3 and, if `behind` only, their left and lower neighbours, otherwise all four.
inline Around around_four(const float* level, std::int32_t stride, std::int32_t c, bool behind) {
    const Lanes zero = all_lanes(0.0F);
    const Lanes here = load_lanes(level + c);
    const Lanes left = load_lanes(level + c - 1);
    const Lanes lower = load_lanes(level + c - stride);
    Lanes least = minimum(here, minimum(left, lower));
    if (behind) {
        const Lanes most = maximum(here, maximum(left, lower));
        return all_true(least > zero) ? Around::liquid
                                      : (any_true(most > zero) ? Around::both : Around::air);
    }
    least = minimum(least, minimum(load_lanes(level + c + 1), load_lanes(level + c + stride)));
    return all_true(least > zero) ? Around::liquid
                                  : (any_true(here > zero) ? Around::both : Around::air);
}

/// Whether all faces of four cells are wide open and no contour is in them. `nothing_moves`: then
/// contours do not matter.
inline bool four_untouched(const Walls<float>& walls, std::int32_t stride, std::int32_t c,
                           bool nothing_moves) {
    const Lanes least = minimum(
        minimum(load_lanes(walls.open_u + c), load_lanes(walls.open_u + c + 1)),
        minimum(load_lanes(walls.open_v + c), load_lanes(walls.open_v + c + stride)));
    std::uint32_t cases = 0;
    __builtin_memcpy(&cases, walls.cell_case + c, sizeof cases);
    return all_true(least == all_lanes(1.0F)) && (nothing_moves || cases == 0);
}

/// Sum of the four neighbours of each of four cells.
inline Lanes neighbours_of_four(const float* p, std::int32_t stride, std::int32_t c) {
    return (load_lanes(p + c - 1) + load_lanes(p + c + 1)) +
           (load_lanes(p + c - stride) + load_lanes(p + c + stride));
}

/// Adds lane after lane.
inline float add_in_order(float sum, Lanes what) {
    return (((sum + what[0]) + what[1]) + what[2]) + what[3];
}
inline float subtract_in_order(float sum, Lanes what) {
    return (((sum - what[0]) - what[1]) - what[2]) - what[3];
}

/// The equations of four inner cells, and where their solve starts. False: the start is no number.
inline bool build_four(const StaggeredGrid<float>& grid, const Leap<float>& leap, float rescale,
                       std::int32_t c, PressureFields<float>& fields, Solve<float>& system) {
    const std::int32_t up = c + grid.shape.stride;
    const Lanes divergence = ((load_lanes(grid.u + c + 1) - load_lanes(grid.u + c)) +
                              (load_lanes(grid.v + up) - load_lanes(grid.v + c))) +
                             wanted_convergence_lanes(grid, c, leap);
    const Lanes start = load_lanes(fields.pressure + c) * all_lanes(rescale);
    if (!all_true(absolute(start) < all_lanes(__builtin_inff()))) {
        return false;
    }
    store_lanes(fields.divergence + c, divergence);
    store_lanes(fields.inverse_diagonal + c, all_lanes(0.25F));
    store_lanes(fields.pressure + c, start);
    system.wanted = subtract_in_order(system.wanted, start * divergence);
    system.there = add_in_order(system.there, (start * all_lanes(4.0F)) * start);
    return true;
}

/// Takes pᵀ(neighbours of p) from `there`, cells c … as long as four are alike before `end`:
/// inner liquid or air. Returns the next cell to do.
inline std::int32_t weigh_lanes(const PressureFields<float>& fields, std::int32_t stride,
                                std::int32_t c, std::int32_t end, float& there) {
    const Lanes zero = all_lanes(0.0F);
    for (; c + 4 <= end; c += 4) {
        const Lanes inverse = load_lanes(fields.inverse_diagonal + c);
        if (all_true(inverse > zero)) {
            const Lanes p = load_lanes(fields.pressure + c);
            there = subtract_in_order(there, p * neighbours_of_four(fields.pressure, stride, c));
        } else if (!all_true(inverse == zero)) {
            return c;
        }
    }
    return c;
}

/// velocity −= the pressure's rise across both faces of cells i … in a row, as long as four of them
/// and those before them are alike, liquid with open faces or air. Returns how many.
inline std::int32_t accelerate_lanes(const PressureFields<float>& fields, const float* open_u,
                                     const float* open_v, const GridShape& s, std::int32_t i,
                                     std::int32_t j, StaggeredGrid<float>& grid) {
    const Lanes one = all_lanes(1.0F);
    const std::int32_t first = s.index(i, j);
    std::int32_t c = first;
    for (; c + 4 <= s.index(s.nx, j); c += 4) {
        const Around around = around_four(fields.level, s.stride, c, true);
        if (around == Around::air) {
            continue;
        }
        if (around == Around::both ||
            (open_u != nullptr &&
             !all_true((load_lanes(open_u + c) == one) & (load_lanes(open_v + c) == one)))) {
            break;
        }
        const Lanes p = load_lanes(fields.pressure + c);
        const Lanes rise_x = p - load_lanes(fields.pressure + c - 1);
        const Lanes rise_y = p - load_lanes(fields.pressure + c - s.stride);
        store_lanes(grid.u + c, load_lanes(grid.u + c) - rise_x);
        store_lanes(grid.v + c, load_lanes(grid.v + c) - rise_y);
    }
    return c - first;
}

#endif

}  // namespace weir
