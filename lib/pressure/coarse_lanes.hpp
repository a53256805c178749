// The rows of a coarse cell four cells at a time: the plain loops' sums, in their order, and so
// their bits. For patches that are four cells wide.
#pragma once

#include "math/lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Whether all cells of a patch of so many rows from cell c are liquid.
inline bool all_liquid(const float* inverse, std::int32_t stride, std::int32_t c,
                       std::int32_t rows) {
    LaneMask dry{};
    for (std::int32_t y = 0; y < rows; ++y) {
        dry |= load_lanes(inverse + c + y * stride) == all_lanes(0.0F);
    }
    return !any_true(dry);
}

/// What is left of the equations of cells c … c + 3; 0 in air. `open_u` and `open_v`: open
/// fractions, read beside cells whose inverse diagonal is negative; null: there are none.
inline Lanes residual_of_four(const PressureFields<float>& fields, const float* open_u,
                              const float* open_v, std::int32_t stride, std::int32_t c) {
    const float* p = fields.pressure + c;
    const Lanes inverse = load_lanes(fields.inverse_diagonal + c);
    const Lanes held = load_lanes(p);
    const Lanes left = load_lanes(p - 1);
    const Lanes right = load_lanes(p + 1);
    const Lanes lower = load_lanes(p - stride);
    const Lanes upper = load_lanes(p + stride);
    const Lanes divergence = load_lanes(fields.divergence + c);
    Lanes sum = (left + right) + (lower + upper);
    if (all_true(inverse == all_lanes(0.25F))) {
        return (sum - divergence) - all_lanes(4.0F) * held;
    }
    if (open_u != nullptr && any_negative(inverse)) {
        const Lanes weighted =
            (load_lanes(open_u + c) * left + load_lanes(open_u + c + 1) * right) +
            (load_lanes(open_v + c) * lower + load_lanes(open_v + c + stride) * upper);
        sum = inverse < all_lanes(0.0F) ? weighted : sum;
    }
    const Lanes zero = all_lanes(0.0F);
    const LaneMask wet = inverse != zero;
    const Lanes residual =
        (sum - divergence) - held / (wet ? absolute(inverse) : all_lanes(1.0F));
    return wet ? residual : zero;  // whose sum does not change
}

/// Sums that a patch's residuals are added to: its own, those of the patches left, right, and
/// below or above.
struct ResidualSums {
    Lanes sums;

    /// Of four cells, one after the other. `of_beside`: the share of each in the patch beside it,
    /// `on_right`: which are those on the right; `of_above`: the share of all in the patch below
    /// or above.
    void add(Lanes residual, Lanes of_beside, LaneMask on_right, Lanes of_above) {
        const Lanes zero = all_lanes(0.0F);
        const Lanes beside = of_beside * residual;
        const Lanes above = of_above * residual;
        const Lanes own = residual - (beside + above);
        const Lanes left = on_right ? zero : beside;
        const Lanes right = on_right ? beside : zero;
        const Lanes a = shuffle<0, 4, 1, 5>(own, left);
        const Lanes b = shuffle<0, 4, 1, 5>(right, above);
        const Lanes c = shuffle<2, 6, 3, 7>(own, left);
        const Lanes d = shuffle<2, 6, 3, 7>(right, above);
        sums += shuffle<0, 1, 4, 5>(a, b);
        sums += shuffle<2, 3, 6, 7>(a, b);
        sums += shuffle<0, 1, 4, 5>(c, d);
        sums += shuffle<2, 3, 6, 7>(c, d);
    }
};

/// Adds `what` to the pressure of those of cells c … c + 3 that are liquid.
inline void correct_four(const PressureFields<float>& fields, Lanes what, std::int32_t c) {
    const Lanes now = load_lanes(fields.pressure + c);
    const LaneMask wet = load_lanes(fields.inverse_diagonal + c) != all_lanes(0.0F);
    store_lanes(fields.pressure + c, wet ? now + what : now);
}

/// Relaxes cells c, c + 2 … of a row of coarse cells as long as eight are left before `end`;
/// returns the next one to do.
inline std::int32_t relax_coarse_row(const CoarseGrid<float>& coarse, float omega,
                                     std::int32_t c, std::int32_t end) {
    const std::int32_t stride = coarse.shape.stride;
    float* p = coarse.correction;
    // A load across the last two stores would wait for both: the other colour is carried along.
    Lanes odd_before = all_lanes(p[c - 1]);
    for (; c + 8 <= end; c += 8) {
        const Lanes inverse = load_eight(coarse.inverse_diagonal + c).even;
        const LaneMask dry = inverse == all_lanes(0.0F);
        const EvenOdd here = load_eight(p + c);
        const Lanes left = shuffle<3, 4, 5, 6>(odd_before, here.odd);
        odd_before = here.odd;
        if (all_true(dry)) {
            continue;
        }
        const Lanes lower = load_eight(p + c - stride).even;
        const Lanes upper = load_eight(p + c + stride).even;
        const EvenOdd u = load_eight(coarse.weight_u + c);
        const Lanes v_lower = load_eight(coarse.weight_v + c).even;
        const Lanes v_upper = load_eight(coarse.weight_v + c + stride).even;
        const Lanes sum = (u.even * left + u.odd * here.odd) + (v_lower * lower + v_upper * upper);
        const Lanes residual = load_eight(coarse.residual + c).even;
        const Lanes relaxed =
            here.even + all_lanes(omega) * ((sum + residual) * inverse - here.even);
        const Lanes even = dry ? here.even : relaxed;
        store_lanes(p + c, shuffle<0, 4, 1, 5>(even, here.odd));
        store_lanes(p + c + 4, shuffle<2, 6, 3, 7>(even, here.odd));
    }
    return c;
}

#endif

}  // namespace weir
