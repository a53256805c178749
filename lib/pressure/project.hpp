// The end of the projection: what the pressure does to the faces of liquid cells.
#pragma once

#include "pressure/face_weights.hpp"
#include "pressure/projection.hpp"
#include "pressure/system_lanes.hpp"

namespace weir {

/// u −= 1/density · ∂p/∂x on the face between two neighbouring cells. `open` null: no solids. Not
/// inline: faces amid liquid, which are most, do without.
template <class Real>
[[gnu::noinline]] void accelerate(VelocityOf<Real>* velocity, std::int32_t face,
                                  std::int32_t before, Real light, const ShareOf<Real>* open,
                                  const PressureFields<Real>& fields) {
    const Real through = open != nullptr ? Real(open[face]) : Real(1);
    const bool wet_before = fields.level[before] > Real(0);
    const bool wet = fields.level[face] > Real(0);
    if (!(wet || wet_before) || !(through > Real(0))) {
        return;
    }
    const Real was = velocity[face];
    Real rise = light * pressure_rise(fields, before, face, through);
    const bool pushes = (was > Real(0)) == (rise < Real(0));
    rise = (pushes ? push_through(fields, wet != wet_before, through) : Real(1)) * rise;
    if (wet != wet_before) {
        const Real share =
            jet_share(fields, wet ? face : before, wet ? before : face, through);
        const Real fall = fields.sound_speed > Real(0) ? Real(0) : fields.cell_weight;
        const Real stop = clamp(rise, minimum(was, Real(0)) - fall, maximum(was, Real(0)) + fall);
        rise = share < Real(1) ? stop + share * (rise - stop) : rise;
    }
    velocity[face] = was - rise;
}

/// The same of a row of cells and the faces before them.
template <bool Solids, bool Mixed, class Real>
void project_row(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t j, Part columns,
                 const PressureFields<Real>& fields, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const Walls<Real>& walls = weights.walls;
    const ShareOf<Real>* open_u = Solids ? walls.open_u : nullptr;
    const ShareOf<Real>* open_v = Solids ? walls.open_v : nullptr;
    const bool has_lower = weights.has_lower(j);
    const LevelOf<Real>* level = fields.level + s.index(0, j);
    const Real* p = fields.pressure + s.index(0, j);
    VelocityOf<Real>* u = grid.u + s.index(0, j);
    VelocityOf<Real>* v = grid.v + s.index(0, j);
    const auto wide = [](const ShareOf<Real>* open, std::int32_t face) {
        return !Solids || bound_key(Real(open[face])) == bound_key(Real(1));
    };
    bool wet_before = is_positive<Real>(level[columns.first - 1]);
    for (std::int32_t i = columns.first; i < columns.end; ++i) {
        const std::int32_t c = s.index(i, j);
        const bool wet = is_positive<Real>(level[i]);
        if (weights.has_left(i)) {
            if (wet && wet_before && wide(open_u, c)) {
                u[i] -= weights.light_u(c) * (p[i] - p[i - 1]);
            } else if (wet || wet_before) {
                accelerate(grid.u, c, c - 1, weights.light_u(c), open_u, fields);
            }
        }
        wet_before = wet;
        if (has_lower) {
            const bool wet_below = is_positive<Real>(level[i - s.stride]);
            if (wet && wet_below && wide(open_v, c)) {
                v[i] -= weights.light_v(c) * (p[i] - p[i - s.stride]);
            } else if (wet || wet_below) {
                accelerate(grid.v, c, c - s.stride, weights.light_v(c), open_v, fields);
            }
        }
    }
}

template <bool Solids, bool Mixed, class Real>
void project(const FaceWeights<Solids, Mixed, Real>& weights, const Part& rows,
             const PressureFields<Real>& fields, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        std::int32_t i = 0;
        if constexpr (kHasLanes<Real> && !Mixed) {
            const std::int32_t row = s.index(0, j);
            const Real on_wall = grid.u[row];
            i = accelerate_lanes(fields, Solids ? weights.walls.open_u : nullptr,
                                 weights.walls.open_v, weights.has_lower(j), row, row + s.nx,
                                 grid) - row;
            if (!weights.has_left(0)) {
                grid.u[row] = on_wall;
            }
        }
        project_row(weights, j, {i, s.nx}, fields, grid);
    }
}

}  // namespace weir
