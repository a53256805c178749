// Rows of a relaxation sweep, four or eight cells of a colour at a time. Reads and sums as the
// plain loop in projection.cpp, and so with its bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Every other cell of a row, c, c + 2 … before `end`, and then of rows below it.
struct RelaxTask {
    const PressureFields<float>& fields;
    const float* open_u;  ///< open fractions, read beside cells whose inverse diagonal is negative;
    const float* open_v;  ///< elsewhere they are 1. Of two liquids 1/density, read everywhere
    bool two_liquids;
    float omega;
    std::int32_t stride;
    std::int32_t c;
    std::int32_t end;
    std::int32_t rows;
};

/// Calls relax(first cell, odd numbers before it, which lanes are asked for) until c, c + 2 …
/// before `end` are done, the last few beside some that are; relax returns its odd numbers. There
/// have to be enough for one group.
template <class L, class Relax>
inline void each_alternate_group(const float* p, std::int32_t c, std::int32_t end,
                                 const Relax& relax) {
    // A load across the last two stores would wait for both: the other colour is carried along.
    auto before = L::all(p[c - 1]);
    for (; c + 2 * L::kLanes <= end + 1; c += 2 * L::kLanes) {
        before = relax(c, before, L::alternate_from(0));
    }
    if (c < end) {
        const std::int32_t at = end - 2 * L::kLanes + ((end - c) & 1);
        relax(at, L::all(p[at - 1]), L::alternate_from((c - at) / 2));
    }
}

/// Whether these are enough for a group of so many lanes.
constexpr bool enough_alternate(std::int32_t c, std::int32_t end, std::int32_t lanes) {
    return c + 2 * lanes <= end + 1;
}

/// Which cells' neighbours are weighted: those at walls or, of two liquids, all.
enum class Weighing { nowhere, at_walls, everywhere };

template <class L, Weighing Where>
inline void relax_rows(const RelaxTask& task) {
    const PressureFields<float>& fields = task.fields;
    const std::int32_t stride = task.stride;
    float* const p = fields.pressure;
    const auto zero = L::all(0.0F);
    const auto every_second = [](const float* from) { return L::load_alternate(from).even; };
    // Called twice, and else not inlined.
    const auto group = [&](std::int32_t c, typename L::Floats before, typename L::Ints asked)
                           __attribute__((always_inline)) {
        auto inverse = every_second(fields.inverse_diagonal + c);
        const auto wet = (inverse != zero) & asked;
        const auto here = L::load_alternate(p + c);
        if (!L::any_true(wet)) {
            return here.odd;
        }
        const auto left = L::odd_before(before, here.odd);
        const auto lower = every_second(p + c - stride);
        const auto upper = every_second(p + c + stride);
        auto sum = (left + here.odd) + (lower + upper);
        if (Where == Weighing::everywhere ||
            (Where == Weighing::at_walls && L::any_negative(inverse))) {
            const auto u = L::load_alternate(task.open_u + c);
            sum = (u.even * left + u.odd * here.odd) +
                  (every_second(task.open_v + c) * lower +
                   every_second(task.open_v + c + stride) * upper);
            inverse = L::absolute(inverse);
        }
        const auto target = (sum - every_second(fields.divergence + c)) * inverse;
        const auto relaxed = here.even + L::all(task.omega) * (target - here.even);
        L::store_alternate(p + c, wet ? relaxed : here.even, here.odd);
        return here.odd;
    };
    for (std::int32_t row = 0; row < task.rows; ++row) {
        const std::int32_t below = row * stride;
        each_alternate_group<L>(p, task.c - below, task.end - below, group);
    }
}

/// `open_u` null: nothing is weighted.
template <class L>
inline void relax_all(const RelaxTask& task) {
    const auto rows = task.open_u == nullptr ? relax_rows<L, Weighing::nowhere>
                      : task.two_liquids     ? relax_rows<L, Weighing::everywhere>
                                             : relax_rows<L, Weighing::at_walls>;
    rows(task);
}

#if WEIR_HAS_WIDE_LANES
/// `relax_all` with eight lanes.
void relax_wide(const RelaxTask& task);
#endif

/// False: rows are too short, nothing was done.
inline bool relax_in_lanes(const RelaxTask& task) {
#if WEIR_HAS_WIDE_LANES
    if (enough_alternate(task.c, task.end, 8) && has_wide_lanes()) {
        relax_wide(task);
        return true;
    }
#endif
    if (enough_alternate(task.c, task.end, 4)) {
        relax_all<FourLanes>(task);
        return true;
    }
    return false;
}

#endif

}  // namespace weir
