// The projection's equations some cells at a time: the plain loops' sums, and so their
// bits.
#pragma once

#include "pressure/plain_lanes.hpp"
#include "pressure/some_lanes.hpp"
#include "pressure/wall_flow_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

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

/// The equations of cells of any kind, `Pushed`: by walls that move. False: the start is no number.
template <class L, bool Pushed>
inline bool build_any(RowTask& task, std::int32_t c) {
    using Floats = typename L::Floats;
    const StaggeredGrid<float>& grid = task.grid;
    PressureFields<float>& fields = task.fields;
    const std::int32_t stride = grid.shape.stride;
    const std::int32_t up = c + stride;
    const auto zero = L::all(0.0F);
    const auto one = L::all(1.0F);
    Floats left = open_before<L>(c == task.first);
    Floats right = open_behind<L>(c + L::kLanes - 1 == task.last);
    Floats lower = task.has_lower ? one : zero;
    Floats upper = task.has_upper ? one : zero;
    auto wide = one == one;
    Floats open_left = one;
    Floats open_right = one;
    Floats open_lower = one;
    Floats open_upper = one;
    if (task.walls != nullptr) {
        open_left = L::load(task.walls->open_u + c);
        open_right = L::load(task.walls->open_u + c + 1);
        open_lower = L::load(task.walls->open_v + c);
        open_upper = L::load(task.walls->open_v + up);
        wide = L::minimum(L::minimum(open_left, open_right),
                          L::minimum(open_lower, open_upper)) == one;
        left = left * open_left;
        right = right * open_right;
        lower = lower * open_lower;
        upper = upper * open_upper;
    }
    const auto level = L::load(fields.level + c);
    const Lever lever = lever_of(fields);
    const auto coefficient = [&](Floats weight, std::int32_t at) {
        const auto beside = L::load(fields.level + at);
        return beside > zero ? weight
                             : weight / fraction_between<L>(lever, level, beside, weight);
    };
    const auto diagonal = (coefficient(left, c - 1) + coefficient(right, c + 1)) +
                          (coefficient(lower, c - stride) + coefficient(upper, up));
    const auto wet = (level > zero) & (diagonal > zero);
    const auto scaled = L::load(fields.pressure + c) * L::all(task.system.rescale);
    if (!L::all_true((L::absolute(scaled) < L::all(__builtin_inff())) | ~wet)) {
        return false;
    }
    Floats divergence =
        (open_right * L::load(grid.u + c + 1) - open_left * L::load(grid.u + c)) +
        (open_upper * L::load(grid.v + up) - open_lower * L::load(grid.v + c));
    const auto straight =
        (lowest_around<L>(fields.level, stride, c) > zero) &
        (L::minimum(L::minimum(left, right), L::minimum(lower, upper)) == one);
    if (fields.leaps && L::any_true(straight)) {
        const auto wanted = divergence + wanted_convergence_lanes<L>(grid, c, task.leap);
        divergence = straight ? wanted : divergence;
    }
    if constexpr (Pushed) {
        float flow[L::kLanes];
        L::store(flow, divergence);
        if (task.walls->thin == nullptr) {
            add_wall_flows<L>(task, c, L::bits_of(wet), L::bits_of(wide), flow);
        } else {
            task.add_flow(task, c, L::bits_of(wet), L::bits_of(wide), flow);
        }
        divergence = L::load(flow);
    }
    const auto start = wet ? scaled : zero;
    L::store(fields.divergence + c, wet ? divergence : L::load(fields.divergence + c));
    L::store(fields.inverse_diagonal + c,
             wet ? (wide ? one : -one) / (wet ? diagonal : one) : zero);
    L::store(fields.pressure + c, start);
    add_to_sums<L>(wet ? start * divergence : zero, wet ? (start * diagonal) * start : zero,
                   task.system);
    task.any = task.any || L::any_true(wet);
    return true;
}

/// Not inline: the other kind wants the registers.
template <class L>
[[gnu::noinline]] bool build_pushed(RowTask& task, std::int32_t c) {
    return build_any<L, true>(task, c);
}

/// Equations of some cells from c on. False: they are to be done otherwise.
template <class L>
inline bool build_group(RowTask& task, std::int32_t c) {
    PressureFields<float>& fields = task.fields;
    const std::int32_t stride = task.grid.shape.stride;
    const auto zero = L::all(0.0F);
    if (!fields.on_surface && !L::any_true(L::load(fields.level + c) > zero)) {
        L::store(fields.inverse_diagonal + c, zero);
        L::store(fields.pressure + c, zero);
        return true;
    }
    const bool alike = task.has_lower && task.has_upper && c > task.first &&
                       c + L::kLanes - 1 < task.last &&
                       L::all_true(lowest_around<L>(fields.level, stride, c) > zero);
    if (alike && (task.walls == nullptr || are_untouched<L>(*task.walls, stride, c))) {
        return build_plain<L>(task, c);
    }
    return !fields.on_surface && (task.add_flow == nullptr ? build_any<L, false>(task, c)
                                                           : build_pushed<L>(task, c));
}

/// The same of cells c … as long as they are done, and enough are left before `end`. Returns the
/// next one to do.
template <class L>
inline std::int32_t build_groups(RowTask& task, std::int32_t c, std::int32_t end) {
    while (c + L::kLanes <= end && build_group<L>(task, c)) {
        c += L::kLanes;
    }
    return c;
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
    const auto fall = L::all(elastic ? 0.0F : fields.cell_weight);
    const bool limits = elastic || (fields.cell_weight > 0.0F && !fields.on_surface);
    const auto weighs = (limits ? one : zero) > zero;
    const Lever lever = lever_of(fields);
    const auto any_kind = [&](float* velocity, Floats here, Floats before, std::int32_t back,
                              Floats rise, Floats open) {
        const auto now = L::load(velocity + c);
        const auto both = L::minimum(here, before) > zero;
        const auto moves = (L::maximum(here, before) > zero) & (open > zero);
        const auto fraction = fraction_between<L>(lever, here, before, open);
        const auto answer = both ? rise : rise / fraction;
        const auto width = width_of_lanes<L>(open);  // as `push_through`
        const auto pushes = (now > zero) == (answer < zero);
        const auto through = pushes ? (both ? width : (elastic ? open : width)) : one;
        const auto pushed = through * answer;
        // As `jet_share`.
        const auto density = L::load(fields.density + c - back) + L::load(fields.density + c);
        const auto mass = elastic ? L::all(0.5F) * density : density - L::all(0.5F);
        const auto pressure = here > zero ? rise : zero - rise;
        const auto weight = L::all(fields.cell_weight) * L::maximum(here, before);
        const auto jets = (mass > fraction) & (pressure > weight) & weighs;
        const auto jet = pressure < weight + weight ? (pressure - weight) / weight : one;
        const auto share = jets ? (one - jet) + jet * (fraction / mass) : one;
        const auto stop = L::minimum(L::maximum(pushed, L::minimum(now, zero) - fall),
                                     L::maximum(now, zero) + fall);
        const auto limited = share < one ? stop + share * (pushed - stop) : pushed;
        L::store(velocity + c, moves ? now - (both ? pushed : limited) : now);
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
        any_kind(grid.u, here, left, 1, rise_x, wide_u);
        if (has_lower) {
            any_kind(grid.v, here, lower, stride, rise_y, wide_v);
        }
    }
    return c;
}

inline std::int32_t weigh_lanes(const PressureFields<float>& fields, const float* open_u,
                                const float* open_v, std::int32_t stride, std::int32_t c,
                                std::int32_t end, float& there) {
    if (const WideCells* wide = wide_cells()) {
        c = wide->weigh_cells(fields, open_u, open_v, stride, c, end, there);
    }
    return weigh_cells<FourLanes>(fields, open_u, open_v, stride, c, end, there);
}

/// Cells c … times a number, as long as four are left before `end`. Returns the next cell to do.
inline std::int32_t scale_lanes(float* p, float by, std::int32_t c, std::int32_t end) {
    for (; c + 4 <= end; c += 4) {
        store_lanes(p + c, all_lanes(by) * load_lanes(p + c));
    }
    return c;
}

inline std::int32_t accelerate_lanes(const PressureFields<float>& fields, const float* open_u,
                                     const float* open_v, bool has_lower, std::int32_t c,
                                     std::int32_t end, StaggeredGrid<float>& grid) {
    if (const WideCells* wide = wide_cells()) {
        c = wide->accelerate_cells(fields, open_u, open_v, has_lower, c, end, grid);
    }
    return accelerate_cells<FourLanes>(fields, open_u, open_v, has_lower, c, end, grid);
}

#endif

}  // namespace weir
