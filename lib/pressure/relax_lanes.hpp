// Rows of a relaxation sweep, some cells of a colour at a time. Reads and sums as the
// plain loop in projection.cpp, and so with its bits.
#pragma once

#include "math/four_lanes.hpp"
#include "pressure/parting.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Every other cell of a row, c, c + 2 … before `end`, and then of rows below it.
struct RelaxTask {
    const PressureFields<float>& fields;
    const float* open_u;  ///< open fractions, read beside cells whose inverse diagonal is negative;
    const float* open_v;  ///< elsewhere they are 1. Of two liquids 1/density, read everywhere
    const float* full_density;  ///< null: no liquid may part from walls
    const GridShape& shape;
    bool two_liquids;
    float omega;
    std::int32_t stride;
    std::int32_t c;
    std::int32_t end;
    std::int32_t rows;
};

/// Calls relax(first cell, odd numbers before it, which lanes are asked for) for c, c + 2 … as long
/// as enough are left before `end`; relax returns its odd numbers. Returns the next cell to do.
template <class L, class Relax>
inline std::int32_t each_alternate_group(const float* p, std::int32_t c, std::int32_t end,
                                         const Relax& relax) {
    // A load across the last two stores would wait for both: the other colour is carried along.
    auto before = L::all(p[c - 1]);
    for (; c + 2 * L::kLanes <= end + 1; c += 2 * L::kLanes) {
        before = relax(c, before, L::alternate_from(0));
    }
    return c;
}

/// The same for the last few, beside some that are done. There have to be enough for one group.
template <class L, class Relax>
inline void last_alternate_group(const float* p, std::int32_t c, std::int32_t end,
                                 const Relax& relax) {
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

/// `has_air_around` of the cells of a group. Not inline: few groups have a pull at a wall.
template <class L>
[[gnu::noinline]] typename L::Ints air_around(const RelaxTask& task, std::int32_t c) {
    const GridShape& s = task.shape;
    const std::int32_t j = (c - s.index(0, 0)) / s.stride;
    const std::int32_t i = c - s.index(0, j);
    const auto left = L::alternate_from(i > 0 ? 0 : 1);
    const auto right = ~L::alternate_from((s.nx - i) / 2);
    const auto is_air = [&](std::int32_t n) {
        return (L::load_alternate(task.fields.level + n).even <= L::all(0.0F)) &
               (L::load_alternate(task.full_density + n).even >= L::all(kRoomForAir<float>));
    };
    typename L::Ints air{};
    for (std::int32_t y = j > 0 ? -1 : 0; y <= (j + 1 < s.ny ? 1 : 0); ++y) {
        const std::int32_t n = c + y * s.stride;
        air |= (is_air(n - 1) & left) | is_air(n) | (is_air(n + 1) & right);
    }
    return air;
}

/// What each group asks for, kept in registers: to a compiler a store may change the task.
struct RelaxedFields {
    float* pressure;
    const float* divergence;
    const float* inverse_diagonal;
    std::ptrdiff_t stride;
    float omega;
};

/// Every other cell from c on, as many as there are lanes, of those that are asked for.
template <class L, Weighing Where>
WEIR_ALWAYS_INLINE typename L::Floats relax_group(const RelaxTask& task,
                                                  const RelaxedFields& fields,
                                                  std::int32_t c,
                                                  typename L::Floats before,
                                                  typename L::Ints asked) {
    const std::ptrdiff_t stride = fields.stride;
    float* const p = fields.pressure;
    const auto zero = L::all(0.0F);
    const auto every_second = [](const float* from) { return L::load_alternate(from).even; };
    auto inverse = every_second(fields.inverse_diagonal + c);
    const auto here = L::load_alternate(p + c);
    const auto relaxed = [&](typename L::Floats sum) {
        const auto target = (sum - every_second(fields.divergence + c)) * inverse;
        return here.even + L::all(fields.omega) * (target - here.even);
    };
    // Nearly all are amid liquid: one question for them.
    if (Where != Weighing::everywhere && L::all_true((inverse > zero) & asked)) {
        const auto sum = (L::odd_before(before, here.odd) + here.odd) +
                         (every_second(p + c - stride) + every_second(p + c + stride));
        L::store_alternate(p + c, relaxed(sum), here.odd);
        return here.odd;
    }
    const auto wet = (inverse != zero) & asked;
    if (!L::any_true(wet)) {
        return here.odd;
    }
    const auto left = L::odd_before(before, here.odd);
    const auto lower = every_second(p + c - stride);
    const auto upper = every_second(p + c + stride);
    auto sum = (left + here.odd) + (lower + upper);
    const auto at_wall = inverse < zero;
    if (Where == Weighing::everywhere ||
        (Where == Weighing::at_walls && L::any_negative(inverse))) {
        const auto u = L::load_alternate(task.open_u + c);
        sum = (u.even * left + u.odd * here.odd) +
              (every_second(task.open_v + c) * lower +
               every_second(task.open_v + c + stride) * upper);
        inverse = L::absolute(inverse);
    }
    auto after = relaxed(sum);
    if constexpr (Where == Weighing::at_walls) {
        // No pull at walls where air can come in, as `relax_weighted` has it.
        const auto pulled = at_wall & wet & (after < zero);
        if (task.full_density != nullptr && L::any_true(pulled)) {
            after = (pulled & air_around<L>(task, c)) ? zero : after;
        }
    }
    L::store_alternate(p + c, wet ? after : here.even, here.odd);
    return here.odd;
}

/// `Last`: lanes for what is left at the ends of rows.
template <class L, class Last, Weighing Where>
inline void relax_rows(const RelaxTask& task) {
    const RelaxedFields fields{task.fields.pressure, task.fields.divergence,
                               task.fields.inverse_diagonal, task.stride, task.omega};
    const float* const p = fields.pressure;
    const auto groups = [&](std::int32_t c, typename L::Floats before, typename L::Ints asked)
                            __attribute__((always_inline)) {
        return relax_group<L, Where>(task, fields, c, before, asked);
    };
    const auto rest = [&](std::int32_t c, typename Last::Floats before,
                          typename Last::Ints asked) __attribute__((always_inline)) {
        return relax_group<Last, Where>(task, fields, c, before, asked);
    };
    for (std::int32_t row = 0; row < task.rows; ++row) {
        const std::int32_t end = task.end - row * task.stride;
        std::int32_t c = task.c - row * task.stride;
        c = each_alternate_group<L>(p, c, end, groups);
        if constexpr (L::kLanes != Last::kLanes) {
            c = each_alternate_group<Last>(p, c, end, rest);
        }
        last_alternate_group<Last>(p, c, end, rest);
    }
}

/// `open_u` null: nothing is weighted.
template <class L, class Last = L>
inline void relax_all(const RelaxTask& task) {
    const auto rows = task.open_u == nullptr ? relax_rows<L, Last, Weighing::nowhere>
                      : task.two_liquids     ? relax_rows<L, Last, Weighing::everywhere>
                                             : relax_rows<L, Last, Weighing::at_walls>;
    rows(task);
}

/// False: rows are too short, nothing was done.
inline bool relax_in_lanes(const RelaxTask& task) {
    const WideCells* wide = wide_cells();
    if (wide != nullptr && enough_alternate(task.c, task.end, 8)) {
        wide->relax_all(task);
        return true;
    }
    if (enough_alternate(task.c, task.end, 4)) {
        relax_all<FourLanes>(task);
        return true;
    }
    return false;
}

#endif

}  // namespace weir
