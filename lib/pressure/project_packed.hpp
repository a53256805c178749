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
    const SmallFixed* p = fields.pressure;
    const LevelOf<SmallFixed>* level = fields.level;
    const auto accelerate = [&](VelocityOf<SmallFixed>* velocity, std::int32_t face,
                                std::int32_t before, bool wet, const ShareOf<SmallFixed>* open) {
        const bool wet_before = level[before].raw > 0;
        const std::int32_t share = Solids ? open[face].raw : 128;
        if ((wet || wet_before) && share > 0) {
            const std::int32_t rise = wet && wet_before
                                          ? p[face].raw - p[before].raw
                                          : packed::rise_at_surface(fields, before, face, share);
            velocity[face].raw = short_of(velocity[face].raw - rounded_shift(rise, 9));
        }
    };
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const bool has_lower = weights.has_lower(j);
        const std::int32_t row = s.index(0, j);
        for (std::int32_t c = row; c < row + s.nx; ++c) {
            const bool wet = level[c].raw > 0;
            if (weights.has_left(c - row)) {
                accelerate(grid.u, c, c - 1, wet, weights.walls.open_u);
            }
            if (has_lower) {
                accelerate(grid.v, c, c - s.stride, wet, weights.walls.open_v);
            }
        }
    }
}

}  // namespace weir
