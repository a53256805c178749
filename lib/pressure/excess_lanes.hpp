// How much too dense cells are, some at a time: the plain loops' sums, and so their bits.
#pragma once

#include "math/four_lanes.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

/// What the excess of a cell is cut to.
struct ExcessLimits {
    float surface_slack;
    float subsurface_slack;
    float window;
    bool exact_below;    ///< no allowance below the surface
    float held_at_rest;  ///< as `Held`
    float held_rise;
    const float* light_u;  ///< as `Held`
    const float* light_v;
};

#if WEIR_HAS_LANES

/// As `Held::pressed`.
template <class L>
inline typename L::Floats pressed_cells(const PressureFields<float>& f, const ExcessLimits& limits,
                                        std::int32_t stride, std::int32_t c) {
    const auto pressure = L::load(f.pressure + c);
    if (limits.light_u == nullptr) {
        return pressure;
    }
    const auto light = (L::load(limits.light_u + c) + L::load(limits.light_u + c + 1)) +
                       (L::load(limits.light_v + c) + L::load(limits.light_v + c + stride));
    return (L::all(0.25F) * light) * pressure;
}

/// As `excess`; `lowest`: level of the lowest cell next to each.
template <class L>
inline typename L::Floats excess_of_cells(const PressureFields<float>& f,
                                          const ExcessLimits& limits, std::int32_t stride,
                                          std::int32_t c, typename L::Floats lowest) {
    const auto zero = L::all(0.0F);
    const auto one = L::all(1.0F);
    const auto slack = L::all(limits.subsurface_slack);
    const auto window = L::all(limits.window);
    const auto e = L::load(f.density + c) - one;
    const auto inner = (L::load(f.level + c) > zero) & (lowest > zero);
    const auto at_surface = L::clamp(e - L::all(limits.surface_slack), zero, window);
    auto inside = e;
    const auto missing = L::all(0.5F) - (lowest + L::all(least_head(f)));
    const auto below = missing > zero;
    if (!limits.exact_below && L::any_true(inner & below)) {
        const auto more = e + L::all(0.125F) * missing * missing;
        inside = below ? more - L::clamp(more, -slack, slack) : e;
    }
    const auto rise = L::all(limits.held_rise) * pressed_cells<L>(f, limits, stride, c);
    const auto share = L::clamp(L::all(limits.held_at_rest) + rise, zero, one);
    inside = inside < zero ? share * inside : inside;
    return inner ? L::clamp(inside, -window, window) : at_surface;
}

/// Of cells c, c + 1 … as long as enough are left before `end`; returns the next one to do.
template <class L>
inline std::int32_t excess_cells(const PressureFields<float>& f, std::int32_t stride,
                                 const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
    for (; c + L::kLanes <= end; c += L::kLanes) {
        const auto lowest =
            L::minimum(L::minimum(L::load(f.level + c - 1), L::load(f.level + c + 1)),
                       L::minimum(L::load(f.level + c - stride), L::load(f.level + c + stride)));
        L::store(f.divergence + c, excess_of_cells<L>(f, limits, stride, c, lowest));
    }
    return c;
}

/// Of those cells beside closed faces that a bit tells, if they are liquid.
template <class L>
inline void excess_beside_walls_lanes(const Walls<float>& walls, const PressureFields<float>& f,
                                      std::int32_t stride, const ExcessLimits& limits,
                                      std::int32_t c, std::uint32_t bits) {
    const auto zero = L::all(0.0F);
    const auto level = L::load(f.level + c);
    const auto wet = (level > zero) & L::lanes_of(bits);
    if (!L::any_true(wet)) {
        return;
    }
    auto lowest = level;
    const auto look = [&](const float* open, std::int32_t neighbour) {
        lowest = L::load(open) > zero ? L::minimum(lowest, L::load(f.level + neighbour)) : lowest;
    };
    look(walls.open_u + c, c - 1);
    look(walls.open_u + c + 1, c + 1);
    look(walls.open_v + c, c - stride);
    look(walls.open_v + c + stride, c + stride);
    const auto e = excess_of_cells<L>(f, limits, stride, c, lowest);
    const auto slack = L::all(limits.subsurface_slack);
    const auto dense = L::maximum(L::all(1.0F), L::load(f.density + c) - L::all(1.0F));
    const auto room = L::minimum(L::all(1.0F), dense * L::load(walls.full_density + c));
    const auto counts = (e - L::clamp(e, -slack, slack)) * room;
    L::store(f.divergence + c, wet ? counts : L::load(f.divergence + c));
}

/// The same of up to 32 cells from c on that bits tell, by groups of which none begins later than
/// `last`. Returns the bits that are left.
template <class L>
inline std::uint32_t excess_of_word(const Walls<float>& walls, const PressureFields<float>& f,
                                    std::int32_t stride, const ExcessLimits& limits,
                                    std::int32_t c, std::uint32_t told, std::int32_t last) {
    constexpr auto kLanes = static_cast<std::uint32_t>(L::kLanes);
    constexpr std::uint32_t kGroup = (1U << kLanes) - 1U;
    while (told != 0) {
        const std::uint32_t at =
            static_cast<std::uint32_t>(__builtin_ctz(told)) & ~(kLanes - 1U);
        const std::int32_t first = c + static_cast<std::int32_t>(at);
        if (first > last) {
            break;
        }
        excess_beside_walls_lanes<L>(walls, f, stride, limits, first, told >> at & kGroup);
        told &= ~(kGroup << at);
    }
    return told;
}

inline std::int32_t excess_lanes(const PressureFields<float>& f, std::int32_t stride,
                                 const ExcessLimits& limits, std::int32_t c, std::int32_t end) {
    if (const WideCells* wide = wide_cells()) {
        c = wide->excess_cells(f, stride, limits, c, end);
    }
    return excess_cells<FourLanes>(f, stride, limits, c, end);
}

#endif

}  // namespace weir
