// Asks the pressure for room: what bodies have pressed together does.
#pragma once

#include "pressure/patches.hpp"

namespace weir {

/// Mean excess of a patch up to which it is left to the drift: waves, and cells that bodies cut,
/// make as much.
template <class Real>
inline constexpr Real kLooseEnough = Real(0.02);
/// Excess beyond that which is answered at most: what is caught between bodies does not fling them.
template <class Real>
inline constexpr Real kMostTight = Real(0.1);
/// Share of it that a patch gives up in a substep, if all around yields: 0.3 % of its volume at
/// most, which no particle feels as a blow.
template <class Real>
inline constexpr Real kRoomGain = Real(0.03);
/// The same around a body that was put into the liquid, which takes a second for it and no longer.
template <class Real>
inline constexpr Real kRoomGainAround = Real(0.1);
/// Nothing more is asked for under a column of so many tanks of liquid: where nothing yields, as in
/// a tank that is full, the pressure would rise for ever.
inline constexpr std::int32_t kMostColumns = 4;

/// What may be asked for in a substep is so much in one in which gravity moves something by 1/8192
/// of a cell, or in a 64th of a second if that is shorter; in a shorter one in proportion. The same
/// volume in ever less time would fling the liquid.
template <class Real>
inline Real pace_of_room(const PressureFields<Real>& fields) {
    const Real fallen = square_root(fields.last_dt * fields.cell_weight);
    return minimum(Real(1), Real(64) * maximum(fallen, static_cast<Real>(fields.last_dt)));
}

/// By how much a patch's liquid cells are too full, in the mean, of what is answered.
template <class Real>
inline Real tightness(const GridShape& s, const Patch& patch, const PressureFields<Real>& fields) {
    constexpr Real kWindow = Real(0.5);  // slivers have any density
    Real sum = Real(0);
    std::int32_t count = 0;
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const std::int32_t first = s.index(patch.i, patch.j + y);
        for (std::int32_t c = first; c < first + patch.width; ++c) {
            if (!is_zero(Real(fields.inverse_diagonal[c]))) {
                sum += clamp<Real>(Real(fields.density[c]) - Real(1), -kWindow, kWindow);
                count += 1;
            }
        }
    }
    const Real mean = count > 0 ? part_of(sum, count) : Real(0);
    return clamp<Real>(mean - kLooseEnough<Real>, Real(0), kMostTight<Real>);
}

/// The equation of a cell with liquid wants so much to flow out of it, cells/s.
template <class Real>
inline void ask_for_outflow(std::int32_t c, Real outflow, PressureFields<Real>& fields) {
    fields.divergence[c] = Real(fields.divergence[c]) - outflow;
    fields.solve.wanted = fields.solve.wanted + product(Real(fields.pressure[c]), outflow);
}

/// The drift moves particles, not bodies: liquid that a crowd of them covers cannot rise by it, and
/// is pressed together by their weight until they lie on each other; nor does it soon lift what a
/// body that was put into a pool pressed together. So each patch of 4 × 4 cells that is too full
/// asks for an outflow, which lifts both; the less the more pressure it has.
/// Between the equations and their solve. Without gravity nothing is asked for.
template <class Real>
[[gnu::noinline]] void make_room(const GridShape& s, Real gain, Work work,
                                 PressureFields<Real>& fields) {
    const std::int32_t most_heads = kMostColumns * maximum(s.nx, s.ny);
    const Real weight = fields.cell_weight;
    const Real pace = pace_of_room(fields);
    const auto yields = [&](Real pressure) {
        const Real heads = part_of(maximum<Real>(pressure, Real(0)), most_heads) / weight;
        return maximum<Real>(Real(1) - heads, Real(0));
    };
    for_each_patch(s, fields.coarse.shape, work, [&](const Patch& patch) {
        const Real tight = tightness(s, patch, fields);
        if (!(tight > Real(0) && weight > Real(0))) {
            return;
        }
        const Real outflow = (pace * (gain * tight)) / fields.last_dt;
        for (std::int32_t y = 0; y < patch.height; ++y) {
            const std::int32_t first = s.index(patch.i, patch.j + y);
            for (std::int32_t c = first; c < first + patch.width; ++c) {
                if (is_zero(Real(fields.inverse_diagonal[c]))) {
                    continue;
                }
                ask_for_outflow<Real>(c, yields(fields.pressure[c]) * outflow, fields);
            }
        }
    });
}

}  // namespace weir
