// The projection's equations four cells at a time: the plain loops' sums, and so their bits.
#pragma once

#include "pressure/plain_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

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

/// The open share of each face of four cells; 0 on the tank's walls.
struct FourFaces {
    Lanes left;
    Lanes right;
    Lanes lower;
    Lanes upper;
};

inline Lanes least_of(const FourFaces& faces) {
    return minimum(minimum(faces.left, faces.right), minimum(faces.lower, faces.upper));
}

/// As `liquid_fraction`, where one of the levels is above 0 and the other not.
inline Lanes fraction_between(Lanes a, Lanes b, Lanes open) {
    const Lanes liquid = maximum(a, b);
    const Lanes least = maximum(all_lanes(0.05F), all_lanes(1.0F) - all_lanes(4.0F) * open);
    return maximum(least, liquid / (liquid - minimum(a, b)));
}

/// What four cells are to their equations.
struct FourKinds {
    LaneMask wide;      ///< all faces are open, but for the tank's walls
    LaneMask straight;  ///< and the pressure sees to what straight paths do (`goes_straight`)
};

/// The equations of four cells of any kind. add_flow(c, divergence, which of them are wet): what
/// moving walls push into them. `any`: whether one of them is wet. False: the start is no number.
template <class Flow>
inline bool build_any_four(const StaggeredGrid<float>& grid, const FourFaces& faces,
                           const FourKinds& kinds, const Leap<float>& leap, float rescale,
                           std::int32_t c, PressureFields<float>& fields, Solve<float>& system,
                           const Flow& add_flow, bool& any) {
    const std::int32_t stride = grid.shape.stride;
    const std::int32_t up = c + stride;
    const Lanes zero = all_lanes(0.0F);
    const Lanes level = load_lanes(fields.level + c);
    const auto coefficient = [&](Lanes weight, std::int32_t at) {
        const Lanes beside = load_lanes(fields.level + at);
        return beside > zero ? weight : weight / fraction_between(level, beside, weight);
    };
    const Lanes diagonal = (coefficient(faces.left, c - 1) + coefficient(faces.right, c + 1)) +
                           (coefficient(faces.lower, c - stride) + coefficient(faces.upper, up));
    const LaneMask wet = (level > zero) & (diagonal > zero);
    const Lanes scaled = load_lanes(fields.pressure + c) * all_lanes(rescale);
    if (!all_true((absolute(scaled) < all_lanes(__builtin_inff())) | (wet == 0))) {
        return false;
    }
    Lanes divergence =
        (faces.right * load_lanes(grid.u + c + 1) - faces.left * load_lanes(grid.u + c)) +
        (faces.upper * load_lanes(grid.v + up) - faces.lower * load_lanes(grid.v + c));
    if (any_true(kinds.straight)) {
        const Lanes wanted = divergence + wanted_convergence_lanes<FourLanes>(grid, c, leap);
        divergence = kinds.straight ? wanted : divergence;
    }
    add_flow(c, divergence, wet);
    const Lanes start = wet ? scaled : zero;
    const Lanes one = all_lanes(1.0F);
    store_lanes(fields.divergence + c, wet ? divergence : load_lanes(fields.divergence + c));
    store_lanes(fields.inverse_diagonal + c,
                wet ? (kinds.wide ? one : -one) / (wet ? diagonal : one) : zero);
    store_lanes(fields.pressure + c, start);
    system.wanted = subtract_in_order(system.wanted, wet ? start * divergence : zero);
    system.there = add_in_order(system.there, wet ? (start * diagonal) * start : zero);
    any = any_true(wet);
    return true;
}

/// Takes pᵀ(neighbours of p) from `there`, cells c … as long as four are left before `end`.
/// `open_u` null: no solids. Returns the next cell to do.
inline std::int32_t weigh_lanes(const PressureFields<float>& fields, const float* open_u,
                                const float* open_v, std::int32_t stride, std::int32_t c,
                                std::int32_t end, float& there) {
    const Lanes zero = all_lanes(0.0F);
    for (; c + 4 <= end; c += 4) {
        const Lanes inverse = load_lanes(fields.inverse_diagonal + c);
        const LaneMask wet = inverse != zero;
        if (!any_true(wet)) {
            continue;
        }
        const float* at = fields.pressure + c;
        Lanes around = neighbours_of_four(fields.pressure, stride, c);
        if (open_u != nullptr && any_negative(inverse)) {
            const Lanes weighted = (load_lanes(open_u + c) * load_lanes(at - 1) +
                                    load_lanes(open_u + c + 1) * load_lanes(at + 1)) +
                                   (load_lanes(open_v + c) * load_lanes(at - stride) +
                                    load_lanes(open_v + c + stride) * load_lanes(at + stride));
            around = inverse < zero ? weighted : around;
        }
        there = subtract_in_order(there, wet ? load_lanes(at) * around : zero);
    }
    return c;
}

/// velocity −= the pressure's rise across both faces of cells i … in a row, as long as four are
/// left. `has_lower`: otherwise their lower faces are the tank's wall. `open_u` null: no solids.
/// Returns how many.
inline std::int32_t accelerate_lanes(const PressureFields<float>& fields, const float* open_u,
                                     const float* open_v, const GridShape& s, std::int32_t i,
                                     std::int32_t j, bool has_lower, StaggeredGrid<float>& grid) {
    const Lanes zero = all_lanes(0.0F);
    const Lanes one = all_lanes(1.0F);
    const std::int32_t first = s.index(i, j);
    const std::int32_t end = s.index(s.nx, j);
    std::int32_t c = first;
    const auto any_kind = [&](float* velocity, Lanes here, Lanes before, Lanes rise, Lanes open) {
        const Lanes now = load_lanes(velocity + c);
        const LaneMask both = minimum(here, before) > zero;
        const LaneMask moves = (maximum(here, before) > zero) & (open > zero);
        const Lanes answer = both ? rise : rise / fraction_between(here, before, open);
        const LaneMask pushes = (now > zero) == (answer < zero);
        const Lanes share = pushes ? minimum(one, all_lanes(4.0F) * open) : one;
        store_lanes(velocity + c, moves ? now - share * answer : now);
    };
    for (; c + 4 <= end; c += 4) {
        const Lanes here = load_lanes(fields.level + c);
        const Lanes left = load_lanes(fields.level + c - 1);
        const Lanes lower = load_lanes(fields.level + c - s.stride);
        if (!any_true(maximum(here, maximum(left, lower)) > zero)) {
            continue;
        }
        const Lanes wide_u = open_u != nullptr ? load_lanes(open_u + c) : one;
        const Lanes wide_v = open_u != nullptr ? load_lanes(open_v + c) : one;
        const Lanes p = load_lanes(fields.pressure + c);
        const Lanes rise_x = p - load_lanes(fields.pressure + c - 1);
        const Lanes rise_y = p - load_lanes(fields.pressure + c - s.stride);
        const LaneMask liquid = minimum(here, minimum(left, lower)) > zero;
        if (has_lower && all_true(liquid & (minimum(wide_u, wide_v) >= all_lanes(0.25F)))) {
            store_lanes(grid.u + c, load_lanes(grid.u + c) - rise_x);
            store_lanes(grid.v + c, load_lanes(grid.v + c) - rise_y);
            continue;
        }
        any_kind(grid.u, here, left, rise_x, wide_u);
        if (has_lower) {
            any_kind(grid.v, here, lower, rise_y, wide_v);
        }
    }
    return c - first;
}

#endif

}  // namespace weir
