// blend_change in whole numbers. There are no thin walls.
#pragma once

#include "grid/borders.hpp"
#include "math/packed_arithmetic.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// A face less a sixth of its ∇², within what is around; 171/1024 for a sixth.
inline std::int16_t sharpened_packed(const VelocityOf<SmallFixed>* field, std::int32_t face,
                                     std::int32_t stride) {
    const std::int32_t here = field[face].raw;
    const std::int32_t left = field[face - 1].raw;
    const std::int32_t right = field[face + 1].raw;
    const std::int32_t lower = field[face - stride].raw;
    const std::int32_t upper = field[face + stride].raw;
    const std::int32_t bend = (left + right) + (lower + upper) - 4 * here;
    const std::int32_t low = minimum(here, minimum(minimum(left, right), minimum(lower, upper)));
    const std::int32_t high = maximum(here, maximum(maximum(left, right), maximum(lower, upper)));
    return static_cast<std::int16_t>(clamp(here - rounded_shift(171 * bend, 10), low, high));
}

/// One component, as `sharpen`: where liquid is all around.
inline void sharpen_packed(const GridShape& s, const LevelOf<SmallFixed>* level, std::int32_t back,
                           std::int32_t along, bool wrap_x, bool wrap_y, const Part& rows,
                           const VelocityOf<SmallFixed>* field, VelocityOf<SmallFixed>* out) {
    const std::int32_t first_i = back == 1 && !wrap_x ? 1 : 0;
    const std::int32_t first_j = back != 1 && !wrap_y ? 1 : 0;
    const auto deep = [&](std::int32_t face) {
        return level[face].raw > 0 && level[face - back].raw > 0;
    };
    for (std::int32_t j = maximum(first_j, rows.first); j < rows.end; ++j) {
        for (std::int32_t i = first_i; i < s.nx; ++i) {
            const std::int32_t face = s.index(i, j);
            if (!deep(face)) {
                continue;
            }
            // The face before the one on the seam has cells that lie two beyond it.
            const bool on_seam = (back == 1 ? i : j) == 0;
            const std::int32_t round = on_seam ? back * (back == 1 ? s.nx : s.ny) : 0;
            const std::int32_t before = face - back + round;
            if (deep(before) && deep(face + back) && deep(face - along) && deep(face + along)) {
                out[face].raw = sharpened_packed(field, face, s.stride);
            }
        }
    }
}

inline void blend_packed(const Borders<SmallFixed>& borders, SmallFixed flip_ratio,
                         PressureFields<SmallFixed>& fields, StaggeredGrid<SmallFixed>& grid,
                         Work work) {
    const GridShape& s = grid.shape;
    VelocityOf<SmallFixed>* sharp_u = fields.divergence;
    VelocityOf<SmallFixed>* sharp_v = fields.inverse_diagonal;
    const Part copied = work.take(s.ny + 2, s.nx + 2);
    copy_rows(s, copied, grid.mass_u, sharp_u);
    copy_rows(s, copied, grid.mass_v, sharp_v);
    const Part rows = work.take(s.ny, s.nx);
    sharpen_packed(s, fields.level, 1, s.stride, borders.wrap_x, borders.wrap_y, rows, grid.mass_u,
                   sharp_u);
    sharpen_packed(s, fields.level, s.stride, 1, borders.wrap_x, borders.wrap_y, rows, grid.mass_v,
                   sharp_v);
    if (work.once(s.border())) {
        extend_velocity(borders, s, sharp_u, sharp_v);
    }
    // Of what is left: both shares have to add up to 1, or velocity would fade.
    const std::int32_t share = (1 << 14) - (flip_ratio.raw >> 2);
    const Part blended = work.take(s.ny + 2, s.nx + 2);
    const auto blend = [&](const VelocityOf<SmallFixed>* now, const VelocityOf<SmallFixed>* sharp,
                           VelocityOf<SmallFixed>* change) {
        for_each_run(s, blended, [&](const Part& run) {
            for (std::int32_t face = run.first; face < run.end; ++face) {
                // A thirtieth of a small velocity would round to 0.
                const std::int32_t by = chance(now[face].raw * 4 + sharp[face].raw, 14);
                change[face].raw = short_of(now[face].raw - change[face].raw +
                                            ((share * sharp[face].raw + by) >> 14));
            }
        });
    };
    blend(grid.u, sharp_u, grid.mass_u);
    blend(grid.v, sharp_v, grid.mass_v);
}

}  // namespace weir
