// Moments of the liquid in cut cells, some at a time: the plain loops' sums, and so their bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As `OpenMoments`, of as many cells as a group has lanes.
template <class L>
struct MomentsOf {
    using Floats = typename L::Floats;
    Floats area{};
    Floats first_x{};
    Floats first_y{};
    Floats upper_x{};
    Floats upper_y{};
    Floats x_above{};
    Floats y_right{};
    Floats product{};
};

template <class L>
struct PointsOf {
    typename L::Floats x;
    typename L::Floats y;
};

template <class L, class Mask>
inline void add_where(Mask here, typename L::Floats more, typename L::Floats& sum) {
    sum = here ? sum + more : sum;
}

/// As `add_right_edge`.
template <class L, class Mask>
inline void add_right_edges(Mask here, typename L::Floats low, typename L::Floats high,
                            MomentsOf<L>& sums) {
    using Floats = typename L::Floats;
    const Floats half = L::all(0.5F);
    const Floats zero = L::all(0.0F);
    const Floats eighth = L::all(0.125F);
    const auto square = [&](Floats y) { return half * (y * y); };
    const Floats way = high - low;
    const Floats up = square(high) - square(low);
    const Floats above = square(L::maximum(high, zero)) - square(L::maximum(low, zero));
    add_where<L>(here, way, sums.area);
    add_where<L>(here, up, sums.first_y);
    add_where<L>(here, eighth * way, sums.upper_x);
    add_where<L>(here, above, sums.upper_y);
    add_where<L>(here, eighth * up, sums.y_right);
}

/// As `add_piece`, where a piece has a height.
template <class L>
inline void add_pieces(const PointsOf<L>& p, const PointsOf<L>& q, MomentsOf<L>& sums) {
    using Floats = typename L::Floats;
    const Floats a_half = L::all(0.5F);
    const Floats eighth = L::all(0.125F);
    const Floats zero = L::all(0.0F);
    const PointsOf<L> m{a_half * (p.x + q.x), a_half * (p.y + q.y)};
    const auto here = q.y != p.y;
    const Floats way = q.y - p.y;
    const auto along = [&](Floats at_p, Floats at_m, Floats at_q) {
        return way * ((at_p + at_q + L::all(4.0F) * at_m) *
                      L::all(static_cast<float>(1.0 / 6.0)));
    };
    const auto half = [&](Floats x) { return a_half * (x * x) - eighth; };
    const Floats half_p = half(p.x);
    const Floats half_m = half(m.x);
    const Floats half_q = half(q.x);
    const Floats x = along(half_p, half_m, half_q);
    const auto wide = [&](const PointsOf<L>& at) { return (at.x + a_half) * at.y; };
    const Floats y = along(wide(p), wide(m), wide(q));
    const Floats xy = along(half_p * p.y, half_m * m.y, half_q * q.y);
    add_where<L>(here, way * (m.x + a_half), sums.area);
    add_where<L>(here, x, sums.first_x);
    add_where<L>(here, y, sums.first_y);
    add_where<L>(here, xy, sums.product);
    const auto right = here & (m.x > zero);
    add_where<L>(right, x + eighth * way, sums.upper_x);
    add_where<L>(right, xy + eighth * (way * m.y), sums.y_right);
    const auto above = here & (m.y > zero);
    add_where<L>(above, y, sums.upper_y);
    add_where<L>(above, xy, sums.x_above);
}

/// As `passes_zero`.
template <class L>
inline typename L::Floats pass_zero(typename L::Floats from, typename L::Floats to) {
    const auto zero = L::all(0.0F);
    const auto one = L::all(1.0F);
    const auto passes = (from > zero) ^ (to > zero);
    return passes ? from / (passes ? from - to : one) : one;
}

/// As `add_line`.
template <class L>
inline void add_lines(const PointsOf<L>& from, const PointsOf<L>& to, MomentsOf<L>& sums) {
    const auto one = L::all(1.0F);
    const auto on_x = pass_zero<L>(from.x, to.x);
    const auto on_y = pass_zero<L>(from.y, to.y);
    const auto at = [&](typename L::Floats part) {
        const auto within = part < one;
        return PointsOf<L>{within ? from.x + part * (to.x - from.x) : to.x,
                           within ? from.y + part * (to.y - from.y) : to.y};
    };
    const PointsOf<L> first = at(L::minimum(on_x, on_y));
    const PointsOf<L> second = at(L::maximum(on_x, on_y));
    add_pieces<L>(from, first, sums);
    add_pieces<L>(first, second, sums);
    add_pieces<L>(second, to, sums);
}

/// Of cut cells, saddles excepted: they have two lines.
template <class L>
inline MomentsOf<L> open_moments_of(const float* distance, std::int32_t stride,
                                    const std::int32_t* cell) {
    using Floats = typename L::Floats;
    const auto nodes = L::squares_at(distance, distance + stride, cell);
    const Floats zero = L::all(0.0F);
    const Floats half = L::all(0.5F);
    const auto s0 = nodes.low_left <= zero;
    const auto s1 = nodes.low_right <= zero;
    const auto s2 = nodes.high_right <= zero;
    const auto s3 = nodes.high_left <= zero;
    // Where edges without a crossing have theirs nobody asks.
    const auto crossing = [&](Floats low, Floats high) { return low / (low - high) - half; };
    const PointsOf<L> bottom{crossing(nodes.low_left, nodes.low_right), -half};
    const PointsOf<L> right{half, crossing(nodes.low_right, nodes.high_right)};
    const PointsOf<L> top{crossing(nodes.high_left, nodes.high_right), half};
    const PointsOf<L> left{-half, crossing(nodes.low_left, nodes.high_left)};
    MomentsOf<L> sums;
    const Floats at_right = (s1 ^ s2) != 0 ? right.y : half;
    add_right_edges<L>(~(s1 & s2), s1 ? at_right : -half, s2 ? at_right : half, sums);
    // The solid is on the right: counter-clockwise a line begins where solid does.
    const auto choose = [&](auto on_bottom, auto on_right, auto on_top) {
        return PointsOf<L>{
            on_bottom ? bottom.x : (on_right ? right.x : (on_top ? top.x : left.x)),
            on_bottom ? bottom.y : (on_right ? right.y : (on_top ? top.y : left.y))};
    };
    add_lines<L>(choose(~s0 & s1, ~s1 & s2, ~s2 & s3), choose(s0 & ~s1, s1 & ~s2, s2 & ~s3),
                 sums);
    return sums;
}

/// The kernel of one of `shares_of`'s cells over its liquid, by row; the fourth is 0.
using RowsOfShares = float[3][4];

/// Hats and kernel shares, as `Hats` and `kernel_shares`, of as many cells as a group has lanes.
template <class L>
inline void shares_of_group(const float* distance, std::int32_t stride, const std::int32_t* cell,
                            RowsOfShares* shares) {
    using Floats = typename L::Floats;
    const MomentsOf<L> m = open_moments_of<L>(distance, stride, cell);
    const Floats half = L::all(0.5F);
    const Floats tx[] = {m.upper_x - m.first_x, m.area - ((m.upper_x + m.upper_x) - m.first_x),
                         m.upper_x};
    const Floats ty[] = {m.upper_y - m.first_y, m.area - ((m.upper_y + m.upper_y) - m.first_y),
                         m.upper_y};
    const Floats y_tx[] = {m.y_right - m.product,
                           m.first_y - ((m.y_right + m.y_right) - m.product), m.y_right};
    const Floats x_ty[] = {m.x_above - m.product,
                           m.first_x - ((m.x_above + m.x_above) - m.product), m.x_above};
    for (std::int32_t row = 0; row < 3; ++row) {
        const auto wide = [&](std::int32_t column) {
            return row == 1 ? tx[column]
                            : (row == 0 ? half * tx[column] - y_tx[column]
                                        : half * tx[column] + y_tx[column]);
        };
        const Floats side = half * ty[row];
        const Floats quarter = L::all(0.25F);
        Floats four[4] = {quarter * ((side - x_ty[row]) + wide(0)),
                          quarter * (ty[row] + wide(1)),
                          quarter * ((side + x_ty[row]) + wide(2)), L::all(0.0F)};
        transpose<L>(four);
        for (std::int32_t k = 0; k < 4; ++k) {
            L::each_group([&](auto group) {
                constexpr std::int32_t kGroup = decltype(group)::value;
                const auto lanes = L::template group<kGroup>(four[k]);
                __builtin_memcpy(shares[4 * kGroup + k][row], &lanes, sizeof lanes);
            });
        }
    }
}

#endif

}  // namespace weir
