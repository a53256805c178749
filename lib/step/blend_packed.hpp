// blend_change in whole numbers, in one pass. There are no thin walls.
#pragma once

#include "grid/borders.hpp"
#include "math/packed_arithmetic.hpp"
#include "pressure/pressure_fields.hpp"
#include "step/blend_m0.hpp"

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

/// Whether a cell has nothing but liquid around it, as its diagonal tells: it may touch a wall.
inline bool amid(VelocityOf<SmallFixed> diagonal) {
    return diagonal.raw == 512 || diagonal.raw == 384;
}

/// change = now − before + share · sharp, in place of `before`; `share` in 2^−14ths.
inline std::int16_t blended(std::int32_t now, std::int32_t before, std::int32_t sharp,
                            std::int32_t share) {
    // A thirtieth of a small velocity would round to 0.
    return short_of(now - before + ((share * sharp + chance(now * 4 + sharp, 14)) >> 14));
}

/// A row of faces of a kind, ascending: what stood in it is kept for the row above.
struct BlendRow {
    using Speed = VelocityOf<SmallFixed>;
    const Speed* now;
    Speed* field;
    const Speed* lower;     ///< what stood in the row below
    Speed* was;             ///< room for what stands here
    const Speed* diagonal;  ///< of the cells behind the faces
    const Speed* before;    ///< of those before them; null: no face has liquid all around
    std::int32_t stride;
    std::int32_t count;
    std::int32_t share;
};

/// What stands beside the tank's wall is not sharpened.
inline void blend_last(const BlendRow& row, std::int32_t here) {
    row.field[row.count].raw = blended(row.now[row.count].raw, here, here, row.share);
}

template <bool Sharp>
void blend_row(const BlendRow& row) {
#if defined(__ARM_ARCH_6M__)
    if (Sharp) {
        const auto from_face = [&](const Speed* other) { return bytes_between(row.field, other); };
        blend_last(row, blend_faces({from_face(row.now), from_face(row.was), from_face(row.lower),
                                     row.stride * kSpeedBytes, from_face(row.diagonal),
                                     from_face(row.before)},
                                    row.field, row.field + row.count, row.share));
        return;
    }
#endif
    std::int32_t left = row.field[-1].raw;
    std::int32_t here = row.field[0].raw;
    for (std::int32_t k = 0; k < row.count; ++k) {
        const std::int32_t right = row.field[k + 1].raw;
        const std::int32_t now = row.now[k].raw;
        if ((now | here | row.diagonal[k].raw) == 0) {  // a third of them are in the air
            row.was[k].raw = 0;
            left = here;
            here = right;
            continue;
        }
        std::int32_t sharp = here;
        if (Sharp && amid(row.diagonal[k]) && amid(row.before[k])) {
            sharp = sharpened(here, left, right, row.lower[k].raw, row.field[k + row.stride].raw);
        }
        row.was[k].raw = static_cast<std::int16_t>(here);
        if ((now | here | sharp) != 0) {
            row.field[k].raw = blended(now, here, sharp, row.share);
        }
        left = here;
        here = right;
    }
    blend_last(row, here);
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
    VelocityOf<SmallFixed>* diagonal = fields.inverse_diagonal;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::int32_t c = s.index(0, j);
        const std::int32_t below = c - s.stride;
        const bool inside = j < s.ny;
        // The cells before the first face of a row stand for what is beyond the tank.
        diagonal[c - 1] = borders.wrap_x ? diagonal[c + s.nx - 1] : VelocityOf<SmallFixed>(0);
        const auto run = [&](const packed::BlendRow& row, bool sharp) {
            sharp ? packed::blend_row<true>(row) : packed::blend_row<false>(row);
        };
        run({grid.u + c, grid.mass_u + c, j > 0 ? fields.divergence + below : grid.mass_u + below,
             fields.divergence + c, diagonal + c, diagonal + c - 1, s.stride, s.nx, share},
            inside);
        // What stood there takes the place of diagonals that no row above looks at.
        const bool on_seam = j == 0 && borders.wrap_y;
        run({grid.v + c, grid.mass_v + c, j > 0 ? diagonal + below - s.stride : grid.mass_v + below,
             diagonal + below, diagonal + c,
             on_seam ? diagonal + s.index(0, s.ny - 1) : diagonal + below, s.stride, s.nx, share},
            inside && (j > 0 || on_seam));
    }
    if (work.once(s.border())) {
        extend_velocity(packed::slower(borders, SmallFixed(1) - flip_ratio), s, grid.mass_u,
                        grid.mass_v);
    }
}

}  // namespace weir
