// The rows of a coarse cell four cells at a time: the plain loops' sums, in their order, and so
// their bits. For patches that are four cells wide.
#pragma once

#include "math/four_lanes.hpp"
#include "pressure/patches.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// How many cells of a patch are liquid, and the sums of their columns and rows.
struct LiquidCells {
    std::int32_t count;
    std::int32_t columns;
    std::int32_t rows;
    bool at_wall;  ///< a wall touches some of them
};
inline LiquidCells count_liquid(const float* inverse, std::int32_t stride, std::int32_t c,
                                std::int32_t rows) {
    LaneMask liquid{};  // by column
    LaneMask of_rows{};
    Lanes least{};
    for (std::int32_t y = 0; y < rows; ++y) {
        const Lanes of_row = load_lanes(inverse + c + y * stride);
        const LaneMask wet = of_row != all_lanes(0.0F);
        least = minimum(of_row, least);
        liquid -= wet;  // 0 or −1
        of_rows += wet & (LaneMask{} + y);
    }
    if (all_true(liquid == 0)) {
        return {0, 0, 0, false};
    }
    const bool touched = any_negative(least);
    if (all_true(liquid == kCoarseEdge)) {
        constexpr std::int32_t kSum = kCoarseEdge * (kCoarseEdge - 1) / 2 * kCoarseEdge;
        return {kCoarseEdge * kCoarseEdge, kSum, kSum, touched};
    }
    return {(liquid[0] + liquid[1]) + (liquid[2] + liquid[3]),
            (liquid[1] + 2 * liquid[2]) + 3 * liquid[3],
            (of_rows[0] + of_rows[1]) + (of_rows[2] + of_rows[3]), touched};
}

/// Which cells of a patch's row hold liquid, a bit each.
inline std::uint32_t liquid_bits(const float* level) {
    return bits_of(load_lanes(level) > all_lanes(0.0F));
}

/// For those patches of a row that are of full width and that asks(patch) names: what find(patch,
/// two, terms) finds, of two side by side where lanes suffice, is added by add(patch, terms, step
/// from one cell's terms to the next one's). `Terms`: of a patch. Returns how many are of full
/// width.
template <std::int32_t Terms, class Asks, class Find, class Add>
inline std::int32_t for_whole_patches(const GridShape& s, const GridShape& big, std::int32_t row,
                                      const Asks& asks, const Find& find, const Add& add) {
    Patch patch = patch_of(s, big, patches_in(s, big, row).first, row);
    const std::int32_t end = patch.q + whole_patches(s, row);
    float terms[2 * Terms];
    const bool wide = wide_cells() != nullptr;
    while (patch.q < end) {
        Patch next = patch;
        next.q += 1;
        next.i += kCoarseEdge;
        const bool two = wide && next.q < end;
        const bool first_asked = asks(patch);
        const bool next_asked = two && asks(next);
        if (first_asked || next_asked) {
            find(patch, two, terms);
        }
        const std::int32_t step = two ? 8 : 4;
        if (first_asked) {
            add(patch, terms, step);
        }
        if (next_asked) {
            add(next, terms + 4, step);
        }
        patch.q += step / 4;
        patch.i += step;
    }
    return patch.i / kCoarseEdge;
}

/// What is left of the equations of cells from c on; 0 in air. `open_u` and `open_v`: open
/// fractions, read beside cells whose inverse diagonal is negative; null: there are none.
template <class L>
inline typename L::Floats residual_of_cells(const PressureFields<float>& fields,
                                            const float* open_u, const float* open_v,
                                            std::int32_t stride, std::int32_t c) {
    const float* p = fields.pressure + c;
    const auto inverse = L::load(fields.inverse_diagonal + c);
    const auto held = L::load(p);
    const auto left = L::load(p - 1);
    const auto right = L::load(p + 1);
    const auto lower = L::load(p - stride);
    const auto upper = L::load(p + stride);
    const auto divergence = L::load(fields.divergence + c);
    auto sum = (left + right) + (lower + upper);
    if (L::all_true(inverse == L::all(0.25F))) {
        return (sum - divergence) - L::all(4.0F) * held;
    }
    const auto zero = L::all(0.0F);
    if (open_u != nullptr && L::any_negative(inverse)) {
        const auto weighted = (L::load(open_u + c) * left + L::load(open_u + c + 1) * right) +
                              (L::load(open_v + c) * lower + L::load(open_v + c + stride) * upper);
        sum = inverse < zero ? weighted : sum;
    }
    const auto wet = inverse != zero;
    const auto residual = (sum - divergence) - held / (wet ? L::absolute(inverse) : L::all(1.0F));
    return wet ? residual : zero;  // whose sum does not change
}

/// Along one axis of a patch: how much rows or columns `way` from the centre share in the patch
/// before or behind it.
template <class L, class Floats>
inline Floats share_beside(Floats way, Floats before, Floats after) {
    return L::all(1.0F / kCoarseEdge) * (way > L::all(0.0F) ? way * after : -way * before);
}
template <class L>
inline auto ways_of_columns(const CoarseGrid<float>& coarse, std::int32_t q) {
    return L::repeat(0.0F, 1.0F, 2.0F, 3.0F) - L::one_a_group(coarse.centre_x + q);
}

/// What the cells of a patch add: to its own coarse cell, to those left, right, and below or above.
inline constexpr std::int32_t kTerms = 4 * kCoarseEdge * kCoarseEdge;

/// Of patches q, q + 1 …, one a group, `rows` high, from cell c on: those of one patch beside those
/// of the next, cell by cell.
template <class L>
inline void find_terms(const PressureFields<float>& fields, const float* open_u,
                       const float* open_v, std::int32_t stride, std::int32_t q, std::int32_t c,
                       std::int32_t rows, float* terms) {
    const CoarseGrid<float>& coarse = fields.coarse;
    const auto zero = L::all(0.0F);
    const auto ways = ways_of_columns<L>(coarse, q);
    const auto of_beside = share_beside<L>(ways, L::one_a_group(coarse.reach_u + q),
                                           L::one_a_group(coarse.reach_u + q + 1));
    const auto on_right = ways > zero;
    const auto centre = L::one_a_group(coarse.centre_y + q);
    const auto before = L::one_a_group(coarse.reach_v + q);
    const auto after = L::one_a_group(coarse.reach_v + q + coarse.shape.stride);
    for (std::int32_t y = 0; y < rows; ++y, c += stride) {
        const auto residual = residual_of_cells<L>(fields, open_u, open_v, stride, c);
        const auto beside = of_beside * residual;
        const auto above =
            share_beside<L>(L::all(static_cast<float>(y)) - centre, before, after) * residual;
        typename L::Floats cells[] = {residual - (beside + above), on_right ? zero : beside,
                                      on_right ? beside : zero, above};
        transpose<L>(cells);
        L::store(terms, cells[0]);
        L::store(terms + L::kLanes, cells[1]);
        L::store(terms + 2 * L::kLanes, cells[2]);
        L::store(terms + 3 * L::kLanes, cells[3]);
        terms += 4 * L::kLanes;
    }
}

/// Adds what the cells of a patch add, one after the other. `step`: from one cell's terms to the
/// next one's.
inline void add_terms(const float* terms, std::int32_t step, const Patch& patch,
                      const Targets& targets, CoarseGrid<float>& coarse) {
    float* const own = coarse.residual + patch.q;
    const std::int32_t up = coarse.shape.stride;
    const bool own_row = targets.has(patch.q);
    // Rows from here on lie above the centre.
    const std::int32_t turn =
        minimum(patch.height, static_cast<std::int32_t>(coarse.centre_y[patch.q]) + 1);
    Lanes sums{0.0F, own_row ? own[-1] : 0.0F, own_row ? own[1] : 0.0F, 0.0F};
    for (std::int32_t y = 0; y < patch.height;) {
        const bool below = y < turn;
        const std::int32_t end = below ? turn : patch.height;
        const std::int32_t vertical = below ? patch.q - up : patch.q + up;
        const bool counted = targets.has(vertical);
        sums[3] = counted ? coarse.residual[vertical] : 0.0F;
        for (; y < end; ++y, terms += 4 * step) {
            sums += load_lanes(terms);
            sums += load_lanes(terms + step);
            sums += load_lanes(terms + 2 * step);
            sums += load_lanes(terms + 3 * step);
        }
        if (counted) {
            coarse.residual[vertical] = sums[3];
        }
    }
    if (own_row) {
        *own += sums[0];
        own[-1] = sums[1];
        own[1] = sums[2];
    }
}

/// Adds the corrections of coarse cells to the pressure of their liquid cells: of patches `k`,
/// k + 1 … of `count` in a row, as long as enough are left. Returns the next one to do. `first_q`,
/// `first_c`: coarse cell and first cell of patch 0.
template <class L>
inline std::int32_t correct_patches(const PressureFields<float>& fields, std::int32_t stride,
                                    std::int32_t first_q, std::int32_t first_c,
                                    std::int32_t height, std::int32_t k, std::int32_t count) {
    using Floats = typename L::Floats;
    const CoarseGrid<float>& coarse = fields.coarse;
    const std::int32_t up = coarse.shape.stride;
    const auto zero = L::all(0.0F);
    for (; k + L::kGroups <= count; k += L::kGroups) {
        const std::int32_t q = first_q + k;
        const auto known = L::one_a_group(coarse.inverse_diagonal + q) != zero;
        if (!L::any_true(known)) {
            continue;
        }
        const auto correction = [&](std::int32_t at) {
            return L::one_a_group(coarse.correction + at);
        };
        const auto own = correction(q);
        const auto shared = [&](Floats way, Floats before, Floats after, Floats last,
                                Floats next) {
            return share_beside<L>(way, before, after) * ((way > zero ? next : last) - own);
        };
        const auto column =
            shared(ways_of_columns<L>(coarse, q), L::one_a_group(coarse.reach_u + q),
                   L::one_a_group(coarse.reach_u + q + 1), correction(q - 1), correction(q + 1));
        const auto centre = L::one_a_group(coarse.centre_y + q);
        const auto before = L::one_a_group(coarse.reach_v + q);
        const auto after = L::one_a_group(coarse.reach_v + q + up);
        const auto last = correction(q - up);
        const auto next = correction(q + up);
        std::int32_t c = first_c + kCoarseEdge * k;
        for (std::int32_t y = 0; y < height; ++y, c += stride) {
            const auto wet = known & (L::load(fields.inverse_diagonal + c) != zero);
            const auto row = own + shared(L::all(static_cast<float>(y)) - centre, before, after,
                                          last, next);
            const auto now = L::load(fields.pressure + c);
            L::store(fields.pressure + c, wet ? now + (row + column) : now);
        }
    }
    return k;
}

/// All of them.
inline std::int32_t correct_in_lanes(const PressureFields<float>& fields, std::int32_t stride,
                                     std::int32_t q, std::int32_t c, std::int32_t height,
                                     std::int32_t count) {
    const WideCells* wide = wide_cells();
    const std::int32_t done =
        wide != nullptr ? wide->correct_patches(fields, stride, q, c, height, count) : 0;
    return correct_patches<FourLanes>(fields, stride, q, c, height, done, count);
}

#endif

}  // namespace weir
