#include "step/grid_to_particle.hpp"

#include "grid/diffuse.hpp"
#include "step/blend_packed.hpp"
#include "step/face_lanes.hpp"
#include "step/tank_walls.hpp"
#include "step/transfer_lanes.hpp"
#include "step/transfer_packed.hpp"

namespace weir {

namespace {

/// Scatter and gather together smooth like 1 + ∇²/6: each is a hat function of variance 1/6.
template <class Real>
constexpr Real kSmoothing = Real(1.0 / 6.0);

/// Lowest and highest of a face and the four around it.
template <class Real>
struct Range {
    Real low;
    Real high;
};

template <class Real, class Field>
inline Range<Real> range_around(const Field* field, std::int32_t face, std::int32_t stride) {
    const Real left = field[face - 1];
    const Real right = field[face + 1];
    const Real lower = field[face - stride];
    const Real upper = field[face + stride];
    const Real here = field[face];
    return {minimum(here, minimum(minimum(left, right), minimum(lower, upper))),
            maximum(here, maximum(maximum(left, right), maximum(lower, upper)))};
}

/// One component: out = field − kSmoothing ∇²field where liquid is all around, within what is
/// there: beyond it, a jump such as a wall without slip makes would grow from step to step.
template <class Real>
void sharpen(const ThinWalls<Real>* thin, const GridShape& s, const LevelOf<Real>* level,
             std::int32_t back, std::int32_t first_i, std::int32_t first_j, const Part& rows,
             const VelocityOf<Real>* field, VelocityOf<Real>* out) {
    const auto deep = [&](std::int32_t face) {
        return level[face] > Real(0) && level[face - back] > Real(0);
    };
    const auto beside_thin_wall = [&](std::int32_t face) {
        return thin != nullptr && ((thin->mark[face] | thin->mark[face - back]) & kTouching) != 0;
    };
    // The face before the one on the seam has cells that lie two beyond it: its image has not.
    const auto before = [&](std::int32_t face, std::int32_t i, std::int32_t j) {
        const bool on_seam = (back == 1 ? i : j) == 0;
        return face - back + (on_seam ? back * (back == 1 ? s.nx : s.ny) : 0);
    };
    const auto one = [&](std::int32_t i, std::int32_t j) {
        const std::int32_t face = s.index(i, j);
        const std::int32_t along = back == 1 ? s.stride : 1;
        if (!deep(face) || !deep(before(face, i, j)) || !deep(face + back) ||
            !deep(face - along) || !deep(face + along) || beside_thin_wall(face)) {
            return;
        }
        const Real around = (field[face - 1] + field[face + 1]) +
                            (field[face - s.stride] + field[face + s.stride]);
        const Range<Real> range = range_around<Real>(field, face, s.stride);
        out[face] = clamp(field[face] - kSmoothing<Real> * (around - Real(4) * field[face]),
                          range.low, range.high);
    };
    for (std::int32_t j = maximum(first_j, rows.first); j < rows.end; ++j) {
        std::int32_t i = first_i;
        if constexpr (kHasLanes<Real>) {
            for (; back == 1 && i < 1; ++i) {
                one(i, j);
            }
            if (thin == nullptr && (back == 1 || j > 0)) {
                const std::int32_t face = s.index(i, j);
                i += sharpen_lanes(level, back, s.stride, kSmoothing<Real>, field, face,
                                   s.index(s.nx, j), out) - face;
            }
        }
        for (; i < s.nx; ++i) {
            one(i, j);
        }
    }
}

/// before = (now − before) + pic_ratio · sharp, for both components.
template <class Real>
void blend(const Part& faces, Real pic_ratio, const VelocityOf<Real>* sharp_u,
           const VelocityOf<Real>* sharp_v, StaggeredGrid<Real>& grid) {
    std::int32_t face = faces.first;
    if constexpr (kHasLanes<Real>) {
        face = blend_lanes(grid.u, sharp_u, pic_ratio, faces.first, faces.end, grid.mass_u);
        blend_lanes(grid.v, sharp_v, pic_ratio, faces.first, faces.end, grid.mass_v);
    }
    for (; face < faces.end; ++face) {
        grid.mass_u[face] = (grid.u[face] - grid.mass_u[face]) + pic_ratio * sharp_u[face];
        grid.mass_v[face] = (grid.v[face] - grid.mass_v[face]) + pic_ratio * sharp_v[face];
    }
}

}  // namespace

template <class Real>
void blend_change(const Borders<Real>& borders, Real flip_ratio, PressureFields<Real>& fields,
                  StaggeredGrid<Real>& grid, const ThinWalls<Real>* thin, Work work) {
    if constexpr (Stored<Real>::coarse) {
        blend_packed(borders, flip_ratio, fields, grid, work);
        return;
    }
    const GridShape& s = grid.shape;
    VelocityOf<Real>* sharp_u = fields.divergence;
    VelocityOf<Real>* sharp_v = fields.inverse_diagonal;
    work.share(work.take(s.ny + 2, s.nx + 2), s.nx + 2, 1, [&](const Part& rows, std::int32_t) {
        copy_rows(s, rows, grid.mass_u, sharp_u);
        copy_rows(s, rows, grid.mass_v, sharp_v);
    });
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        sharpen<Real>(thin, s, fields.level, 1, borders.wrap_x ? 0 : 1, 0, rows, grid.mass_u,
                      sharp_u);
        sharpen<Real>(thin, s, fields.level, s.stride, 0, borders.wrap_y ? 0 : 1, rows,
                      grid.mass_v, sharp_v);
    });
    if (work.once(s.border())) {
        extend_velocity(borders, s, sharp_u, sharp_v);
    }
    work.share(work.take(s.ny + 2, s.nx + 2), s.nx + 2, 1, [&](const Part& rows, std::int32_t) {
        for_each_run(s, rows, [&](const Part& faces) {
            blend<Real>(faces, Real(1) - flip_ratio, sharp_u, sharp_v, grid);
        });
    });
}

namespace {

template <class Real>
TransferResult<Real> gather(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                            Particles<Real>& particles) {
    const GridShape& s = grid.shape;
    const Vec2<Real> size{static_cast<Real>(s.nx), static_cast<Real>(s.ny)};
    TransferResult<Real> result;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        Vec2<Real> x = particles.position[k];
        Vec2<Real> v = particles.velocity[k];
        const Stencil<Real> at_u = stencil_u(s, x);
        const Stencil<Real> at_v = stencil_v(s, x);
        const Vec2<Real> along{interpolate(grid.u, s.stride, at_u),
                               interpolate(grid.v, s.stride, at_v)};
        v.x = transfer.flip_ratio * v.x + interpolate(grid.mass_u, s.stride, at_u);
        v.y = transfer.flip_ratio * v.y + interpolate(grid.mass_v, s.stride, at_v);
        advect(size, {transfer, particles.kind_at(k)}, along, x, v, result);
        particles.position[k] = x;
        particles.velocity[k] = v;
    }
    return result;
}

}  // namespace

template <class Real>
void prepare_gather(StaggeredGrid<Real>& grid, Work work) {
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr) {
            pair_fields(grid, work);
        }
    }
}

template <class Real>
TransferResult<Real> grid_to_particle(const StaggeredGrid<Real>& grid,
                                      const Transfer<Real>& transfer,
                                      Particles<Real>& particles) {
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr) {
            return gather_in_lanes(grid, transfer, particles);
        }
    }
    if constexpr (Stored<Real>::coarse) {
        return gather_packed(grid, transfer, particles);
    } else {
        return gather(grid, transfer, particles);
    }
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template void blend_change(const Borders<Real>&, Real, PressureFields<Real>&,   \
                               StaggeredGrid<Real>&, const ThinWalls<Real>*, Work); \
    template void prepare_gather(StaggeredGrid<Real>&, Work);                       \
    template TransferResult<Real> grid_to_particle(                                 \
        const StaggeredGrid<Real>&, const Transfer<Real>&, Particles<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
