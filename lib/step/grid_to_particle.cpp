#include "step/grid_to_particle.hpp"

namespace weir {

namespace {

template <class Real>
struct Sample {
    Real value;
    Real slope_x;
    Real slope_y;
};

/// Bilinear value and its gradient, per cell.
template <class Real>
inline Sample<Real> sample(const Real* field, std::int32_t stride, const Stencil<Real>& at) {
    const Real* p = field + at.base;
    const Real low_slope = p[1] - p[0];
    const Real high_slope = p[stride + 1] - p[stride];
    const Real low = p[0] + at.fx * low_slope;
    const Real high = p[stride] + at.fx * high_slope;
    const Real slope_y = high - low;
    return {low + at.fy * slope_y, low_slope + at.fy * (high_slope - low_slope), slope_y};
}

/// Written so that a NaN takes the first branch.
template <class Real>
Vec2<Real> limited(Vec2<Real> v, Real limit, TransferResult<Real>& count) {
    if (absolute(v.x) <= limit && absolute(v.y) <= limit) {
        return v;
    }
    if (!is_finite(v)) {
        ++count.reset;
        return {};
    }
    ++count.slowed;
    return {clamp(v.x, -limit, limit), clamp(v.y, -limit, limit)};
}

/// One axis at the tank's walls: back to the wall, and the velocity towards it given back.
template <class Real>
inline void keep_inside(Real& x, Real& v, Real size, Real restitution) {
    if (x < kWallGap<Real>) {
        x = kWallGap<Real>;
        v = v < Real(0) ? -restitution * v : v;
    } else if (x > size - kWallGap<Real>) {
        x = size - kWallGap<Real>;
        v = v > Real(0) ? -restitution * v : v;
    }
}

/// One axis across a seam. A step is far shorter than the tank, so once is enough; the last line
/// is for a number so small below zero that adding the size rounds it to the size.
template <class Real>
inline void wrap_around(Real& x, Real size) {
    if (x < Real(0)) {
        x += size;
    }
    if (!(x < size)) {
        x -= size;
    }
}

}  // namespace

template <class Real>
void blend_change(StaggeredGrid<Real>& grid, Real flip_ratio) {
    const std::int32_t size = grid.shape.size();
    for (std::int32_t face = 0; face < size; ++face) {
        grid.mass_u[face] = grid.u[face] - flip_ratio * grid.mass_u[face];
        grid.mass_v[face] = grid.v[face] - flip_ratio * grid.mass_v[face];
    }
}

template <class Real>
TransferResult<Real> grid_to_particle(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                               Particles<Real>& particles) {
    const GridShape& s = grid.shape;
    const Real width = static_cast<Real>(s.nx);
    const Real height = static_cast<Real>(s.ny);
    const Real half_dt = Real(0.5) * transfer.dt_s;
    TransferResult<Real> result;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        Vec2<Real> x = particles.position[k];
        Vec2<Real> v = particles.velocity[k];
        const Stencil<Real> at_u = stencil_u(s, x);
        const Stencil<Real> at_v = stencil_v(s, x);
        const Sample<Real> u = sample(grid.u, s.stride, at_u);
        const Sample<Real> w = sample(grid.v, s.stride, at_v);
        v.x = transfer.flip_ratio * v.x + interpolate(grid.mass_u, s.stride, at_u);
        v.y = transfer.flip_ratio * v.y + interpolate(grid.mass_v, s.stride, at_v);
        v = limited(v, transfer.limit, result);
        Vec2<Real> along{
            u.value + half_dt * (u.slope_x * u.value + u.slope_y * w.value),
            w.value + half_dt * (w.slope_x * u.value + w.slope_y * w.value)};
        TransferResult<Real> unused;
        along = limited(along, transfer.limit, unused);
        x = x + transfer.dt_s * along;
        if (transfer.wrap_x) {
            wrap_around(x.x, width);
        } else {
            keep_inside(x.x, v.x, width, transfer.wall_restitution);
        }
        if (transfer.wrap_y) {
            wrap_around(x.y, height);
        } else {
            keep_inside(x.y, v.y, height, transfer.wall_restitution);
        }
        result.max_speed = maximum(result.max_speed, maximum(absolute(v.x), absolute(v.y)));
        particles.position[k] = x;
        particles.velocity[k] = v;
    }
    return result;
}

#define WEIR_INSTANTIATE(Real)                                                            \
    template void blend_change(StaggeredGrid<Real>&, Real);                               \
    template TransferResult<Real> grid_to_particle(const StaggeredGrid<Real>&,                   \
                                            const Transfer<Real>&, Particles<Real>&);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
#undef WEIR_INSTANTIATE

}  // namespace weir
