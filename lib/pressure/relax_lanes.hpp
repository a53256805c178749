// One row of a relaxation sweep, four cells of a colour at a time. Reads and sums as the plain loop
// in projection.cpp, and so with its bits.
#pragma once

#include "math/lanes.hpp"
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

template <bool Solids>
std::int32_t relax_row(const PressureFields<float>& fields, const float* open_u,
                       const float* open_v, float omega, std::int32_t stride, std::int32_t c,
                       std::int32_t end) {
    float* p = fields.pressure;
    const Lanes factor = all_lanes(omega);
    // A load across the last two stores would wait for both: the other colour is carried along.
    Lanes odd_before = all_lanes(p[c - 1]);
    for (; c + 8 <= end; c += 8) {
        Lanes inverse = load_eight(fields.inverse_diagonal + c).even;
        const LaneMask dry = inverse == all_lanes(0.0F);
        const EvenOdd here = load_eight(p + c);
        const Lanes left = shuffle<3, 4, 5, 6>(odd_before, here.odd);
        odd_before = here.odd;
        if (all_true(dry)) {
            continue;
        }
        const Lanes lower = load_eight(p + c - stride).even;
        const Lanes upper = load_eight(p + c + stride).even;
        Lanes sum = (left + here.odd) + (lower + upper);
        if (Solids && any_negative(inverse)) {
            const EvenOdd u = load_eight(open_u + c);
            const Lanes v_lower = load_eight(open_v + c).even;
            const Lanes v_upper = load_eight(open_v + c + stride).even;
            sum = (u.even * left + u.odd * here.odd) + (v_lower * lower + v_upper * upper);
            inverse = absolute(inverse);
        }
        const Lanes target = (sum - load_eight(fields.divergence + c).even) * inverse;
        const Lanes relaxed = here.even + factor * (target - here.even);
        const Lanes even = dry ? here.even : relaxed;
        store_lanes(p + c, shuffle<0, 4, 1, 5>(even, here.odd));
        store_lanes(p + c + 4, shuffle<2, 6, 3, 7>(even, here.odd));
    }
    return c;
}

#endif

}  // namespace weir
