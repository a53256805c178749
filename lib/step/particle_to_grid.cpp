#include "step/particle_to_grid.hpp"

#include <cstring>

namespace weir {

namespace {

template <class Real>
void clear(Real* field, const GridShape& shape) {
    std::memset(field, 0, static_cast<std::size_t>(shape.size()) * sizeof(Real));
}

template <class Real>
inline void scatter(Real* mass, Real* momentum, std::int32_t stride, const Stencil<Real>& at,
                    Real velocity) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;                       // fx (1 − fy)
    const Real upper = at.fy - w1;                       // (1 − fx) fy
    const Real w0 = (Real(1) - at.fx) - upper;           // (1 − fx)(1 − fy)
    Real* m = mass + at.base;
    Real* p = momentum + at.base;
    m[0] += w0;
    p[0] += w0 * velocity;
    m[1] += right;
    p[1] += right * velocity;
    m[stride] += upper;
    p[stride] += upper * velocity;
    m[stride + 1] += w1;
    p[stride + 1] += w1 * velocity;
}

/// A wall is a mirror: what lies in the ghost row beyond it belongs to the row before it.
template <class Real>
void fold(Real* field, std::int32_t inside, std::int32_t ghost, std::int32_t step,
          std::int32_t count) {
    for (std::int32_t k = 0; k < count; ++k) {
        field[inside + k * step] += field[ghost + k * step];
        field[ghost + k * step] = Real(0);
    }
}

/// On the wall itself only the inner half was summed: the mirror image has as much.
template <class Real>
void twice(Real* field, std::int32_t first, std::int32_t step, std::int32_t count) {
    for (std::int32_t k = 0; k < count; ++k) {
        field[first + k * step] += field[first + k * step];
    }
}

template <class Real>
void mirror_at_walls(StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    Real* const on_u[] = {grid.mass_u, grid.u};
    for (Real* field : on_u) {
        fold(field, s.index(0, 0), s.index(0, -1), 1, s.nx + 1);
        fold(field, s.index(0, s.ny - 1), s.index(0, s.ny), 1, s.nx + 1);
        twice(field, s.index(0, 0), s.stride, s.ny);
        twice(field, s.index(s.nx, 0), s.stride, s.ny);
    }
    Real* const on_v[] = {grid.mass_v, grid.v};
    for (Real* field : on_v) {
        fold(field, s.index(0, 0), s.index(-1, 0), s.stride, s.ny + 1);
        fold(field, s.index(s.nx - 1, 0), s.index(s.nx, 0), s.stride, s.ny + 1);
        twice(field, s.index(0, 0), 1, s.nx);
        twice(field, s.index(0, s.ny), 1, s.nx);
    }
}

}  // namespace

template <class Real>
void particle_to_grid(const Particles<Real>& particles, StaggeredGrid<Real>& grid) {
    const GridShape& shape = grid.shape;
    clear(grid.u, shape);
    clear(grid.v, shape);
    clear(grid.mass_u, shape);
    clear(grid.mass_v, shape);
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<Real> x = particles.position[k];
        const Vec2<Real> v = particles.velocity[k];
        scatter(grid.mass_u, grid.u, shape.stride, stencil_u(shape, x), v.x);
        scatter(grid.mass_v, grid.v, shape.stride, stencil_v(shape, x), v.y);
    }
    mirror_at_walls(grid);
}

template void particle_to_grid(const Particles<float>&, StaggeredGrid<float>&);
template void particle_to_grid(const Particles<double>&, StaggeredGrid<double>&);

}  // namespace weir
