#include "pressure/make_room.hpp"

#include "pressure/patches.hpp"

namespace weir {

namespace {

/// Mean excess of a patch up to which it is left to the drift: waves, and cells that bodies cut,
/// make as much.
template <class Real>
constexpr Real kLooseEnough = Real(0.02);
/// Excess beyond that which is answered at most: what is caught between bodies does not fling them.
template <class Real>
constexpr Real kMostTight = Real(0.1);
/// Nothing more is asked for under a column of so many tanks of liquid: where nothing yields, as in
/// a tank that is full, the pressure would rise for ever.
constexpr std::int32_t kMostColumns = 4;

/// By how much a patch's liquid cells are too full, in the mean, of what is answered.
template <class Real>
Real tightness(const GridShape& s, const Patch& patch, const PressureFields<Real>& fields) {
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

}  // namespace

template <class Real>
void make_room(const GridShape& s, Real gain, Work work, PressureFields<Real>& fields) {
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

#define WEIR_INSTANTIATE(Real) \
    template void make_room(const GridShape&, Real, Work, PressureFields<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
