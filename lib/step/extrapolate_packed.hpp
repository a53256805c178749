// `extrapolate` in whole numbers: what faces in air gain is that of the faces beside them. There is
// no surface tension, and no thin wall.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/projection.hpp"
#include "solid/walls.hpp"

namespace weir {

namespace packed {

/// One component's faces.
struct AirFaces {
    const PressureFields<SmallFixed>& fields;
    const GridShape& shape;
    const ShareOf<SmallFixed>* open;  ///< null: no solids
    std::int32_t back;                ///< from a face to the cell before it
    std::int32_t first_i;
    std::int32_t first_j;
    VelocityOf<SmallFixed>* velocity;

    bool wet(std::int32_t face) const {
        return fields.level[face].raw > 0 || fields.level[face - back].raw > 0;
    }
    std::int32_t share(std::int32_t face) const { return open != nullptr ? open[face].raw : 128; }
    std::int32_t gained(std::int32_t face) const {
        const SmallFixed share_of_face = SmallFixed::of_raw(share(face) * 512);
        return fixed::subtract(0, pressure_rise(fields, face - back, face, share_of_face).raw);
    }
};

/// Rounded to the nearest, ties away from zero.
inline std::int32_t mean_of(std::int32_t sum, std::int32_t count) {
    if (count == 1) {
        return sum;
    }
    if (count != 3) {  // two, or four
        return fixed::add(sum, (count >> 1) + (sum >> 31)) >> (count >> 1);
    }
    const std::int32_t whole = sum / count;
    const std::int32_t rest = sum - whole * count;
    return whole + (2 * rest >= count ? 1 : (2 * rest <= -count ? -1 : 0));
}

/// A face in air, within reach of liquid.
[[gnu::noinline]] inline void extrapolate_face(const AirFaces& faces, std::int32_t i,
                                               std::int32_t j) {
    const GridShape& s = faces.shape;
    const std::int32_t face = s.index(i, j);
    if (i < faces.first_i || j < faces.first_j) {
        return;
    }
    std::int32_t sum = 0;
    std::int32_t count = 0;
    const auto look = [&](bool exists, std::int32_t neighbour) {
        if (exists && faces.wet(neighbour) && faces.share(neighbour) > 0) {
            sum = fixed::add(sum, faces.gained(neighbour));
            count += 1;
        }
    };
    look(i > faces.first_i, face - 1);
    look(i + 1 < s.nx, face + 1);
    look(j > faces.first_j, face - s.stride);
    look(j + 1 < s.ny, face + s.stride);
    if (count > 0) {
        const std::int32_t now = std::int32_t{faces.velocity[face].raw} * 512;
        faces.velocity[face] = SmallFixed::of_raw(fixed::add(now, mean_of(sum, count)));
    }
}

}  // namespace packed

inline void extrapolate_packed(const Borders<SmallFixed>& borders, const Walls<SmallFixed>& walls,
                               const PressureFields<SmallFixed>& fields, const Part& rows,
                               StaggeredGrid<SmallFixed>& grid) {
    const GridShape& s = grid.shape;
    const packed::AirFaces u{fields, s, walls.active ? walls.open_u : nullptr,
                             1,      borders.wrap_x ? 0 : 1,
                             0,      grid.u};
    const packed::AirFaces v{fields, s, walls.active ? walls.open_v : nullptr,
                             s.stride, 0,
                             borders.wrap_y ? 0 : 1, grid.v};
    constexpr std::int32_t kEmpty = LevelOf<SmallFixed>(kEmptyLevel<SmallFixed>).raw;
    const auto in_reach = [&](std::int32_t c) {
        return fields.level[c].raw <= 0 && fields.level[c].raw > kEmpty;
    };
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            // A face that has mass shows in both its cells; one that has none is read by nobody.
            if (in_reach(c)) {
                if (in_reach(c - 1)) {
                    packed::extrapolate_face(u, i, j);
                }
                if (in_reach(c - s.stride)) {
                    packed::extrapolate_face(v, i, j);
                }
            }
        }
    }
}

}  // namespace weir
