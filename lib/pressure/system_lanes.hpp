// The projection's equations four cells at a time, where liquid is all around and no wall is near:
// the plain loops' sums, and so their bits. Elsewhere the plain loops do them.
#pragma once

#include "math/lanes.hpp"
#include "pressure/leap.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// What four cells are and have around them: liquid both, air themselves, or anything else.
enum class Around : std::uint8_t { liquid, air, both };

/// Of cells c … c + 3 and all their neighbours.
inline Around around_four(const float* level, std::int32_t stride, std::int32_t c) {
    const Lanes zero = all_lanes(0.0F);
    const Lanes here = load_lanes(level + c);
    const Lanes least = lowest_around<FourLanes>(level, stride, c);
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

/// The equations of four cells with liquid all around, and where their solve starts. False: the
/// start is no number.
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

/// 1 for each face of four cells that belongs to the tank, 0 for one on its walls.
struct FourFaces {
    Lanes left;
    Lanes right;
    Lanes lower;
    Lanes upper;
};

/// As `liquid_fraction` with open faces, where one of the levels is above 0 and the other not.
inline Lanes fraction_between(Lanes a, Lanes b) {
    const Lanes liquid = maximum(a, b);
    return maximum(all_lanes(0.05F), liquid / (liquid - minimum(a, b)));
}

/// The equations of four cells of any kind whose faces are open, but for the tank's walls. False:
/// the start is no number.
inline bool build_any_four(const StaggeredGrid<float>& grid, const FourFaces& faces,
                           const Leap<float>& leap, float rescale, std::int32_t c,
                           PressureFields<float>& fields, Solve<float>& system) {
    const std::int32_t stride = grid.shape.stride;
    const std::int32_t up = c + stride;
    const Lanes zero = all_lanes(0.0F);
    const Lanes level = load_lanes(fields.level + c);
    const auto coefficient = [&](Lanes weight, std::int32_t at) {
        const Lanes beside = load_lanes(fields.level + at);
        return beside > zero ? weight : weight / fraction_between(level, beside);
    };
    const Lanes diagonal = (coefficient(faces.left, c - 1) + coefficient(faces.right, c + 1)) +
                           (coefficient(faces.lower, c - stride) + coefficient(faces.upper, up));
    const LaneMask wet = (level > zero) & (diagonal > zero);
    Lanes divergence =
        (faces.right * load_lanes(grid.u + c + 1) - faces.left * load_lanes(grid.u + c)) +
        (faces.upper * load_lanes(grid.v + up) - faces.lower * load_lanes(grid.v + c));
    const Lanes least = lowest_around<FourLanes>(fields.level, stride, c);
    const LaneMask straight = (least > zero) & (minimum(minimum(faces.left, faces.right),
                                                        minimum(faces.lower, faces.upper)) > zero);
    if (fields.leaps && any_true(straight)) {
        const Lanes wanted = divergence + wanted_convergence_lanes(grid, c, leap);
        divergence = straight ? wanted : divergence;
    }
    const Lanes scaled = load_lanes(fields.pressure + c) * all_lanes(rescale);
    if (!all_true((absolute(scaled) < all_lanes(__builtin_inff())) | (wet == 0))) {
        return false;
    }
    const Lanes start = wet ? scaled : zero;
    store_lanes(fields.divergence + c, wet ? divergence : load_lanes(fields.divergence + c));
    store_lanes(fields.inverse_diagonal + c,
                wet ? all_lanes(1.0F) / (wet ? diagonal : all_lanes(1.0F)) : zero);
    store_lanes(fields.pressure + c, start);
    system.wanted = subtract_in_order(system.wanted, wet ? start * divergence : zero);
    system.there = add_in_order(system.there, wet ? (start * diagonal) * start : zero);
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

/// velocity −= the pressure's rise across both faces of cells i … in a row, as long as four are
/// left and their faces are open. `has_lower`: otherwise their lower faces are the tank's wall.
/// Returns how many.
inline std::int32_t accelerate_lanes(const PressureFields<float>& fields, const float* open_u,
                                     const float* open_v, const GridShape& s, std::int32_t i,
                                     std::int32_t j, bool has_lower, StaggeredGrid<float>& grid) {
    const Lanes zero = all_lanes(0.0F);
    const Lanes one = all_lanes(1.0F);
    const std::int32_t first = s.index(i, j);
    const std::int32_t end = s.index(s.nx, j);
    std::int32_t c = first;
    const auto at_surface = [&](float* velocity, Lanes here, Lanes before, Lanes rise) {
        const Lanes now = load_lanes(velocity + c);
        const LaneMask both = minimum(here, before) > zero;
        const LaneMask liquid = maximum(here, before) > zero;
        const Lanes answer = both ? rise : rise / fraction_between(here, before);
        store_lanes(velocity + c, liquid ? now - answer : now);
    };
    for (; c + 4 <= end; c += 4) {
        const Lanes here = load_lanes(fields.level + c);
        const Lanes left = load_lanes(fields.level + c - 1);
        const Lanes lower = load_lanes(fields.level + c - s.stride);
        if (!any_true(maximum(here, maximum(left, lower)) > zero)) {
            continue;
        }
        if (open_u != nullptr &&
            !all_true((load_lanes(open_u + c) == one) & (load_lanes(open_v + c) == one))) {
            break;
        }
        const Lanes p = load_lanes(fields.pressure + c);
        const Lanes rise_x = p - load_lanes(fields.pressure + c - 1);
        const Lanes rise_y = p - load_lanes(fields.pressure + c - s.stride);
        if (has_lower && all_true(minimum(here, minimum(left, lower)) > zero)) {
            store_lanes(grid.u + c, load_lanes(grid.u + c) - rise_x);
            store_lanes(grid.v + c, load_lanes(grid.v + c) - rise_y);
            continue;
        }
        at_surface(grid.u, here, left, rise_x);
        if (has_lower) {
            at_surface(grid.v, here, lower, rise_y);
        }
    }
    return c - first;
}

#endif

}  // namespace weir
