// What the pressure does to velocities, in whole numbers.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/face_weights.hpp"
#include "pressure/projection.hpp"

namespace weir {

namespace packed {

/// A face with liquid on one of its sides. `share`: how far it is open, 128ths.
[[gnu::noinline]] inline std::int32_t rise_at_surface(const PressureFields<SmallFixed>& fields,
                                                      std::int32_t before, std::int32_t face,
                                                      std::int32_t share) {
    return pressure_rise(fields, before, face, SmallFixed::of_raw(share * 512)).raw;
}

}  // namespace packed

template <bool Solids, bool Mixed>
void project_packed(const FaceWeights<Solids, Mixed, SmallFixed>& weights, const Part& rows,
                    const PressureFields<SmallFixed>& fields, StaggeredGrid<SmallFixed>& grid) {
    const GridShape& s = grid.shape;
    const SmallFixed* const p = fields.pressure;
    const LevelOf<SmallFixed>* const level = fields.level;
    const auto accelerate = [&](VelocityOf<SmallFixed>& velocity, std::int32_t face,
                                std::int32_t before, bool both, const ShareOf<SmallFixed>* open) {
        const std::int32_t share = Solids ? open[face].raw : 128;
        if (share > 0) {
            const std::int32_t rise = both ? p[face].raw - p[before].raw
                                           : packed::rise_at_surface(fields, before, face, share);
            velocity.raw = short_of(velocity.raw - rounded_shift(rise, 9));
        }
    };
    const std::int32_t stride = s.stride;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const bool has_lower = weights.has_lower(j);
        const std::int32_t row = s.index(0, j);
        const std::int32_t behind = row + s.nx;
        bool wet_before = weights.has_left(0) && level[row - 1].raw > 0;
        for (std::int32_t c = row; c < behind; ++c) {
            const bool wet = level[c].raw > 0;
            if ((wet || wet_before) && (c > row || weights.has_left(0))) {
                accelerate(grid.u[c], c, c - 1, wet && wet_before, weights.walls.open_u);
            }
            wet_before = wet;
            if (has_lower) {
                const bool wet_below = level[c - stride].raw > 0;
                if (wet || wet_below) {
                    accelerate(grid.v[c], c, c - stride, wet && wet_below, weights.walls.open_v);
                }
            }
        }
    }
}

}  // namespace weir
