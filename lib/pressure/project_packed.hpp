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

/// One row of faces of a kind, `back` from a face to the cell before it. A kind at a time: both
/// want more registers than there are.
template <bool Solids>
[[gnu::noinline]] void project_faces(const PressureFields<SmallFixed>& fields,
                                     const ShareOf<SmallFixed>* open, std::int32_t back,
                                     const Part& faces, VelocityOf<SmallFixed>* velocity) {
    const LevelOf<SmallFixed>* at = fields.level + faces.first;
    const LevelOf<SmallFixed>* const end = fields.level + faces.end;
    const SmallFixed* p = fields.pressure + faces.first;
    velocity += faces.first;
    for (; at != end; at = whole(at + 1), p = whole(p + 1), velocity = whole(velocity + 1)) {
        const std::int32_t own = at->raw;
        const std::int32_t before = at[-back].raw;
        if (own <= 0 && before <= 0) {
            continue;
        }
        const auto face = static_cast<std::int32_t>(at - fields.level);
        const std::int32_t share = Solids ? open[face].raw : 128;
        if (share > 0) {
            const std::int32_t rise = own > 0 && before > 0
                                          ? p[0].raw - p[-back].raw
                                          : rise_at_surface(fields, face - back, face, share);
            velocity->raw = short_of(velocity->raw - rounded_shift(rise, 9));
        }
    }
}

}  // namespace packed

/// A row has faces that are pushed if there is liquid in it or below.
template <bool Solids, bool Mixed>
void project_packed(const FaceWeights<Solids, Mixed, SmallFixed>& weights, const Part& rows,
                    const PressureFields<SmallFixed>& fields, StaggeredGrid<SmallFixed>& grid) {
    const GridShape& s = grid.shape;
    const Part wet = rows_near_liquid(rows, weights.borders, fields.solve, 0, 1);
    for (std::int32_t j = wet.first; j < wet.end; ++j) {
        const std::int32_t row = s.index(0, j);
        const std::int32_t first = weights.has_left(0) ? row : row + 1;
        packed::project_faces<Solids>(fields, weights.walls.open_u, 1, {first, row + s.nx}, grid.u);
        if (weights.has_lower(j)) {
            packed::project_faces<Solids>(fields, weights.walls.open_v, s.stride,
                                          {row, row + s.nx}, grid.v);
        }
    }
}

}  // namespace weir
