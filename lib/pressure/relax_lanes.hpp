// One row of a relaxation sweep, four cells of a colour at a time. Reads and sums as the plain loop
// in projection.cpp, and so with its bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Relaxes cells c, c + 2 … of a row as long as eight cells are left before `end`. Returns the next
/// cell to do. `open_u` and `open_v`: open fractions, read beside cells whose inverse diagonal is
/// negative; elsewhere they are 1.
template <bool Solids>
std::int32_t relax_row(const PressureFields<float>& fields, const float* open_u,
                       const float* open_v, float omega, std::int32_t stride, std::int32_t c,
                       std::int32_t end);

#if WEIR_HAS_LANES

#if WEIR_HAS_WIDE_LANES
/// `relax_cells` with eight lanes. `open_u` null: no solids.
std::int32_t relax_wide(const PressureFields<float>& fields, const float* open_u,
                        const float* open_v, float omega, std::int32_t stride, std::int32_t c,
                        std::int32_t end);
#endif

template <class L, bool Solids>
inline std::int32_t relax_cells(const PressureFields<float>& fields, const float* open_u,
                                const float* open_v, float omega, std::int32_t stride,
                                std::int32_t c, std::int32_t end) {
    float* p = fields.pressure;
    const auto zero = L::all(0.0F);
    const auto factor = L::all(omega);
    const auto every_second = [](const float* from) { return L::load_alternate(from).even; };
    // A load across the last two stores would wait for both: the other colour is carried along.
    auto odd_before = L::all(p[c - 1]);
    for (; c + 2 * L::kLanes <= end; c += 2 * L::kLanes) {
        auto inverse = every_second(fields.inverse_diagonal + c);
        const auto dry = inverse == zero;
        const auto here = L::load_alternate(p + c);
        const auto left = L::odd_before(odd_before, here.odd);
        odd_before = here.odd;
        if (L::all_true(dry)) {
            continue;
        }
        const auto lower = every_second(p + c - stride);
        const auto upper = every_second(p + c + stride);
        auto sum = (left + here.odd) + (lower + upper);
        if (Solids && L::any_negative(inverse)) {
            const auto u = L::load_alternate(open_u + c);
            sum = (u.even * left + u.odd * here.odd) +
                  (every_second(open_v + c) * lower + every_second(open_v + c + stride) * upper);
            inverse = L::absolute(inverse);
        }
        const auto target = (sum - every_second(fields.divergence + c)) * inverse;
        const auto relaxed = here.even + factor * (target - here.even);
        L::store_alternate(p + c, dry ? here.even : relaxed, here.odd);
    }
    return c;
}

template <bool Solids>
std::int32_t relax_row(const PressureFields<float>& fields, const float* open_u,
                       const float* open_v, float omega, std::int32_t stride, std::int32_t c,
                       std::int32_t end) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        c = relax_wide(fields, Solids ? open_u : nullptr, open_v, omega, stride, c, end);
    }
#endif
    return relax_cells<FourLanes, Solids>(fields, open_u, open_v, omega, stride, c, end);
}

#endif

}  // namespace weir
