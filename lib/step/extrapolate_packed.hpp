// `extrapolate` in whole numbers: what faces in air gain is that of the faces beside them. There is
// no surface tension, and no thin wall.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/projection.hpp"

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

};

/// What faces with liquid on one of their sides at least have gained.
struct Gains {
    std::int32_t sum = 0;
    std::int32_t count = 0;

    /// Not inline: most faces beside one in air are in air, too.
    [[gnu::noinline]] void add(const AirFaces& faces, std::int32_t face) {
        const std::int32_t share = faces.open != nullptr ? faces.open[face].raw : 128;
        if (share > 0) {
            const SmallFixed rise = pressure_rise(faces.fields, face - faces.back, face,
                                                  SmallFixed::of_raw(share * 512));
            sum = fixed::add(sum, fixed::subtract(0, rise.raw));
            count += 1;
        }
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
    if (i < faces.first_i || j < faces.first_j) {
        return;
    }
    const std::int32_t face = s.index(i, j);
    const LevelOf<SmallFixed>* const own = faces.fields.level + face;
    const LevelOf<SmallFixed>* const before = own - faces.back;
    Gains gains;
    const auto look = [&](bool exists, std::int32_t step) {
        if (exists && (own[step].raw > 0 || before[step].raw > 0)) {
            gains.add(faces, face + step);
        }
    };
    look(i > faces.first_i, -1);
    look(i + 1 < s.nx, 1);
    look(j > faces.first_j, -s.stride);
    look(j + 1 < s.ny, s.stride);
    if (gains.count > 0) {
        const std::int32_t now = std::int32_t{faces.velocity[face].raw} * 512;
        faces.velocity[face] =
            SmallFixed::of_raw(fixed::add(now, mean_of(gains.sum, gains.count)));
    }
}

}  // namespace packed

inline void extrapolate_packed(const Domain<SmallFixed>& domain, const Part& rows) {
    const Borders<SmallFixed>& borders = domain.borders;
    const Walls<SmallFixed>& walls = domain.walls;
    const PressureFields<SmallFixed>& fields = domain.fields;
    StaggeredGrid<SmallFixed>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const packed::AirFaces u{fields, s, walls.active ? walls.open_u : nullptr,
                             1,      borders.wrap_x ? 0 : 1,
                             0,      grid.u};
    const packed::AirFaces v{fields, s, walls.active ? walls.open_v : nullptr,
                             s.stride, 0,
                             borders.wrap_y ? 0 : 1, grid.v};
    constexpr std::int32_t kEmpty = LevelOf<SmallFixed>(kEmptyLevel<SmallFixed>).raw;
    const auto in_reach = [](const LevelOf<SmallFixed>& level) {
        return level.raw <= 0 && level.raw > kEmpty;
    };
    const std::int32_t columns = s.nx;
    const Part near = rows_near_liquid(rows, borders, fields.solve, 1, 2);
    for (std::int32_t j = near.first; j < near.end; ++j) {
        const LevelOf<SmallFixed>* const row = fields.level + s.index(0, j);
        for (std::int32_t i = 0; i < columns; ++i) {
            // A face that has mass shows in both its cells; one that has none is read by nobody.
            if (in_reach(row[i])) {
                if (in_reach(row[i - 1])) {
                    packed::extrapolate_face(u, i, j);
                }
                if (in_reach(row[i - s.stride])) {
                    packed::extrapolate_face(v, i, j);
                }
            }
        }
    }
}

}  // namespace weir
