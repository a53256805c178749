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
            jet_share(fields, wet ? face : before, wet ? before : face, light, through);
        const Real fall = fields.sound_speed > Real(0) ? Real(0) : fields.cell_weight;
        const Real stop = clamp(rise, minimum(was, Real(0)) - fall, maximum(was, Real(0)) + fall);
        rise = share < Real(1) ? stop + share * (rise - stop) : rise;
    }
    velocity[face] = was - rise;
}

/// The same of faces along an axis: those before the cells from `c` to `end`, of which `back` lies
/// before each. `open` null: no solids.
template <class Real, class Light>
inline void project_faces(VelocityOf<Real>* velocity, std::int32_t c, std::int32_t end,
                          std::int32_t back, const ShareOf<Real>* open, const Light& light,
                          const PressureFields<Real>& fields) {
    const LevelOf<Real>* at = fields.level + c;
    const LevelOf<Real>* const last = fields.level + end;
    const Real* p = fields.pressure + c;
    VelocityOf<Real>* pushed = velocity + c;
    const auto face = [&] { return static_cast<std::int32_t>(at - fields.level); };
    for (; at < last; at = whole(at + 1), p = whole(p + 1), pushed = whole(pushed + 1)) {
        const bool wet = is_positive<Real>(at[0]);
        const bool wet_before = is_positive<Real>(at[-back]);
        if (wet && wet_before &&
            (open == nullptr || bound_key(Real(open[face()])) == bound_key(Real(1)))) {
            *pushed -= light(face()) * (p[0] - p[-back]);
        } else if (wet || wet_before) {
            accelerate(velocity, face(), face() - back, light(face()), open, fields);
        }
    }
}

/// The same of a row of cells and the faces before them.
template <bool Solids, bool Mixed, class Real>
void project_row(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t j, Part columns,
                 const PressureFields<Real>& fields, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const Walls<Real>& walls = weights.walls;
    const ShareOf<Real>* open_u = Solids ? walls.open_u : nullptr;
    const ShareOf<Real>* open_v = Solids ? walls.open_v : nullptr;
    const std::int32_t first = columns.first + (weights.has_left(columns.first) ? 0 : 1);
    const std::int32_t end = s.index(columns.end, j);
    project_faces<Real>(grid.u, s.index(first, j), end, 1, open_u,
                        [&](std::int32_t c) { return weights.light_u(c); }, fields);
    if (weights.has_lower(j)) {
        project_faces<Real>(grid.v, s.index(columns.first, j), end, s.stride, open_v,
                            [&](std::int32_t c) { return weights.light_v(c); }, fields);
    }
}

template <bool Solids, bool Mixed, class Real>
void project(const FaceWeights<Solids, Mixed, Real>& weights, const Part& rows,
             const PressureFields<Real>& fields, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const Part columns = s.columns(j);
        std::int32_t i = columns.first;
        if constexpr (kHasLanes<Real> && !Mixed) {
            const std::int32_t row = s.index(0, j);
            const Real on_wall = grid.u[row];
            i = accelerate_lanes(fields, Solids ? weights.walls.open_u : nullptr,
                                 weights.walls.open_v, weights.has_lower(j), row + i,
                                 row + columns.end, grid) - row;
            if (!weights.has_left(0)) {
                grid.u[row] = on_wall;
            }
        }
        project_row(weights, j, {i, columns.end}, fields, grid);
    }
}

}  // namespace weir
