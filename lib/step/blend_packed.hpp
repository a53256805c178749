// blend_change in whole numbers, in one pass. There are no thin walls.
#pragma once

#include "grid/borders.hpp"
#include "math/packed_arithmetic.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

namespace packed {

/// Between two numbers of unlike size.
inline bool between(std::int32_t value, std::int32_t one, std::int32_t other) {
    return ((value - one) ^ (value - other)) < 0;
}

/// A face less a sixth of its ∇², within what is around; 171/1024 for a sixth.
inline std::int32_t sharpened(std::int32_t here, std::int32_t left, std::int32_t right,
                              std::int32_t lower, std::int32_t upper) {
    const std::int32_t bend = (left + right) + (lower + upper) - 4 * here;
    const std::int32_t sharp = here - rounded_shift(171 * bend, 10);
    if (sharp == here || between(sharp, left, right) || between(sharp, lower, upper)) {
        return sharp;
    }
    const std::int32_t low = minimum(here, minimum(minimum(left, right), minimum(lower, upper)));
    const std::int32_t high = maximum(here, maximum(maximum(left, right), maximum(lower, upper)));
    return clamp(sharp, low, high);
}

/// Tells along a row which faces have liquid all around: in their own two cells and in those of
/// the four faces beside them. Looks at each column once.
template <bool OnU>
class Deep {
public:
    /// From face i of row j on; the cell that lies two before the seam is on its other side.
    Deep(const GridShape& s, const LevelOf<SmallFixed>* level, std::int32_t i, std::int32_t j,
         bool wraps)
        : at_(level + s.index(i, j)), stride_(s.stride) {
        if (OnU) {
            before_ = at_[-1].raw > 0;
            two_before_ = wraps && at_[s.nx - 2].raw > 0;
            wide_before_ = wraps && tall(-1);
        } else {
            two_before_at_ = (j > 0 ? -2 : s.ny - 2) * stride_;
            wide_before_ = wet(-1);
            here_ = wet(0);
        }
    }

    /// Of the next face.
    bool next() {
        bool deep = false;
        if (OnU) {
            const bool wide = tall(0);
            deep = wide && wide_before_ && two_before_ && at_[1].raw > 0;
            two_before_ = before_;
            before_ = at_[0].raw > 0;
            wide_before_ = wide;
        } else {
            const bool ahead = wet(1);
            deep = here_ && wide_before_ && ahead && at_[stride_].raw > 0 &&
                   at_[two_before_at_].raw > 0;
            wide_before_ = here_;
            here_ = ahead;
        }
        ++at_;
        return deep;
    }

private:
    bool tall(std::int32_t i) const {
        return at_[i].raw > 0 && at_[i + stride_].raw > 0 && at_[i - stride_].raw > 0;
    }
    bool wet(std::int32_t i) const { return at_[i].raw > 0 && at_[i - stride_].raw > 0; }

    const LevelOf<SmallFixed>* at_;
    std::int32_t stride_;
    std::int32_t two_before_at_ = 0;
    bool two_before_ = false;
    bool before_ = false;
    bool wide_before_ = false;
    bool here_ = false;
};

/// change = now − before + share · sharp, in place of `before`; `share` in 2^−14ths.
inline std::int16_t blended(std::int32_t now, std::int32_t before, std::int32_t sharp,
                            std::int32_t share) {
    // A thirtieth of a small velocity would round to 0.
    return short_of(now - before + ((share * sharp + chance(now * 4 + sharp, 14)) >> 14));
}

/// One component, ascending: what stood in a row is kept in `was` for the row above it.
template <bool OnU>
void blend(const GridShape& s, const LevelOf<SmallFixed>* level, bool wraps, const Part& rows,
           std::int32_t share, const VelocityOf<SmallFixed>* now, VelocityOf<SmallFixed>* was,
           VelocityOf<SmallFixed>* field) {
    if (rows.first == 0 && !rows.empty()) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            was[s.index(i, -1)] = field[s.index(i, -1)];
        }
    }
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        std::int32_t face = s.index(0, j);
        const std::int32_t end = s.index(s.nx, j);
        const bool inside = j < s.ny && (OnU || j > 0 || wraps);
        Deep<OnU> depth(s, level, 0, j, wraps);
        std::int32_t left = field[face - 1].raw;
        std::int32_t here = field[face].raw;
        for (; face < end; ++face) {
            const std::int32_t right = field[face + 1].raw;
            std::int32_t sharp = here;
            if (inside && depth.next()) {
                sharp = sharpened(here, left, right, was[face - s.stride].raw,
                                  field[face + s.stride].raw);
            }
            was[face].raw = static_cast<std::int16_t>(here);
            if ((now[face].raw | here | sharp) != 0) {
                field[face].raw = blended(now[face].raw, here, sharp, share);
            }
            left = here;
            here = right;
        }
        field[end].raw = blended(now[end].raw, here, here, share);
    }
}

/// What `extend_velocity` is told where a share of a velocity is kept.
inline Borders<SmallFixed> slower(Borders<SmallFixed> borders, SmallFixed share) {
    SurfaceLaw<SmallFixed>* walls[] = {&borders.bottom, &borders.right, &borders.top,
                                       &borders.left};
    for (SurfaceLaw<SmallFixed>* wall : walls) {
        wall->conveyor = share * wall->conveyor;
    }
    return borders;
}

}  // namespace packed

inline void blend_packed(const Borders<SmallFixed>& borders, SmallFixed flip_ratio,
                         PressureFields<SmallFixed>& fields, StaggeredGrid<SmallFixed>& grid,
                         Work work) {
    const GridShape& s = grid.shape;
    // Of what is left: both shares have to add up to 1, or velocity would fade.
    const std::int32_t share = (1 << 14) - (flip_ratio.raw >> 2);
    const Part rows = work.take(s.ny + 1, 2 * s.nx);
    packed::blend<true>(s, fields.level, borders.wrap_x, rows, share, grid.u, fields.divergence,
                        grid.mass_u);
    packed::blend<false>(s, fields.level, borders.wrap_y, rows, share, grid.v,
                         fields.inverse_diagonal, grid.mass_v);
    if (work.once(s.border())) {
        extend_velocity(packed::slower(borders, SmallFixed(1) - flip_ratio), s, grid.mass_u,
                        grid.mass_v);
    }
}

}  // namespace weir
