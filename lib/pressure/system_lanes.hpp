// The projection's equations four cells at a time: the plain loops' sums, and so their bits.
#pragma once

#include "pressure/plain_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

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

/// As `width_of`.
template <class L, class Floats>
inline Floats width_of_lanes(Floats open) {
    return L::minimum(L::all(1.0F), L::all(4.0F) * open);
}

/// What `liquid_fraction` asks of the pressure.
struct Lever {
    float least;
    float head;
};
inline Lever lever_of(const PressureFields<float>& fields) {
    return {least_fraction(fields), least_head(fields)};
}

/// As `liquid_fraction`, where one of the levels is above 0 and the other not.
template <class L, class Floats>
inline Floats fraction_between(Lever lever, Floats a, Floats b, Floats open) {
    const auto liquid = L::maximum(a, b);
    const auto least =
        L::maximum(L::all(lever.least), L::all(1.0F) - width_of_lanes<L>(open));
    const auto fraction =
        (liquid + L::all(lever.head)) / (liquid - L::minimum(a, b));
    return L::clamp(fraction, least, L::all(kLargestFraction<float>));
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
        return beside > zero ? weight
                             : weight / fraction_between<FourLanes>(lever_of(fields), level,
                                                                    beside, weight);
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
    add_to_sums<FourLanes>(wet ? start * divergence : zero,
                           wet ? (start * diagonal) * start : zero, system);
    any = any_true(wet);
    return true;
}

/// Takes pᵀ(neighbours of p) from `there`, cells c … as long as enough are left before `end`.
/// `open_u` null: no solids. Returns the next cell to do.
template <class L>
inline std::int32_t weigh_cells(const PressureFields<float>& fields, const float* open_u,
                                const float* open_v, std::int32_t stride, std::int32_t c,
                                std::int32_t end, float& there) {
    const auto zero = L::all(0.0F);
    for (; c + L::kLanes <= end; c += L::kLanes) {
        const auto inverse = L::load(fields.inverse_diagonal + c);
        const auto wet = inverse != zero;
        if (!L::any_true(wet)) {
            continue;
        }
        const float* at = fields.pressure + c;
        const auto left = L::load(at - 1);
        const auto right = L::load(at + 1);
        const auto lower = L::load(at - stride);
        const auto upper = L::load(at + stride);
        auto around = (left + right) + (lower + upper);
        if (open_u != nullptr && L::any_negative(inverse)) {
            const auto weighted =
                (L::load(open_u + c) * left + L::load(open_u + c + 1) * right) +
                (L::load(open_v + c) * lower + L::load(open_v + c + stride) * upper);
            around = inverse < zero ? weighted : around;
        }
        const auto taken = wet ? L::load(at) * around : zero;
        L::each_group([&](auto group) {
            const auto four = L::template group<group>(taken);
            there = (((there - four[0]) - four[1]) - four[2]) - four[3];
        });
    }
    return c;
}

/// velocity −= the pressure's rise across both faces of cells c … of a row, as long as enough are
/// left before `end`. `has_lower`: otherwise their lower faces are the tank's wall. `open_u` null:
/// no solids. Returns the next cell to do.
template <class L>
inline std::int32_t accelerate_cells(const PressureFields<float>& fields, const float* open_u,
                                     const float* open_v, bool has_lower, std::int32_t c,
                                     std::int32_t end, StaggeredGrid<float>& grid) {
    using Floats = typename L::Floats;
    const std::int32_t stride = grid.shape.stride;
    const auto zero = L::all(0.0F);
    const auto one = L::all(1.0F);
    const bool elastic = fields.sound_speed > 0.0F;
    const Lever lever = lever_of(fields);
    const auto any_kind = [&](float* velocity, Floats here, Floats before, Floats rise,
                              Floats open) {
        const auto now = L::load(velocity + c);
        const auto both = L::minimum(here, before) > zero;
        const auto moves = (L::maximum(here, before) > zero) & (open > zero);
        const auto answer =
            both ? rise : rise / fraction_between<L>(lever, here, before, open);
        const auto pushes = (now > zero) == (answer < zero);
        const auto width = width_of_lanes<L>(open);
        const auto through = elastic ? (both ? width : open) : width;
        const auto share = pushes ? through : one;
        L::store(velocity + c, moves ? now - share * answer : now);
    };
    for (; c + L::kLanes <= end; c += L::kLanes) {
        const auto here = L::load(fields.level + c);
        const auto left = L::load(fields.level + c - 1);
        const auto lower = L::load(fields.level + c - stride);
        if (!L::any_true(L::maximum(here, L::maximum(left, lower)) > zero)) {
            continue;
        }
        const auto wide_u = open_u != nullptr ? L::load(open_u + c) : one;
        const auto wide_v = open_u != nullptr ? L::load(open_v + c) : one;
        const auto p = L::load(fields.pressure + c);
        const auto rise_x = p - L::load(fields.pressure + c - 1);
        const auto rise_y = p - L::load(fields.pressure + c - stride);
        const auto liquid = L::minimum(here, L::minimum(left, lower)) > zero;
        if (has_lower && L::all_true(liquid & (L::minimum(wide_u, wide_v) >= L::all(0.25F)))) {
            L::store(grid.u + c, L::load(grid.u + c) - rise_x);
            L::store(grid.v + c, L::load(grid.v + c) - rise_y);
            continue;
        }
        any_kind(grid.u, here, left, rise_x, wide_u);
        if (has_lower) {
            any_kind(grid.v, here, lower, rise_y, wide_v);
        }
    }
    return c;
}

#if WEIR_HAS_WIDE_LANES
std::int32_t weigh_wide(const PressureFields<float>& fields, const float* open_u,
                        const float* open_v, std::int32_t stride, std::int32_t c,
                        std::int32_t end, float& there);
std::int32_t accelerate_wide(const PressureFields<float>& fields, const float* open_u,
                             const float* open_v, bool has_lower, std::int32_t c,
                             std::int32_t end, StaggeredGrid<float>& grid);
#endif

inline std::int32_t weigh_lanes(const PressureFields<float>& fields, const float* open_u,
                                const float* open_v, std::int32_t stride, std::int32_t c,
                                std::int32_t end, float& there) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        c = weigh_wide(fields, open_u, open_v, stride, c, end, there);
    }
#endif
    return weigh_cells<FourLanes>(fields, open_u, open_v, stride, c, end, there);
}

inline std::int32_t accelerate_lanes(const PressureFields<float>& fields, const float* open_u,
                                     const float* open_v, bool has_lower, std::int32_t c,
                                     std::int32_t end, StaggeredGrid<float>& grid) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        c = accelerate_wide(fields, open_u, open_v, has_lower, c, end, grid);
    }
#endif
    return accelerate_cells<FourLanes>(fields, open_u, open_v, has_lower, c, end, grid);
}

#endif

}  // namespace weir
