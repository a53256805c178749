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

}  // namespace

template <class Real>
void particle_to_grid(const Particles<Real>& particles, const Borders<Real>& borders,
                      StaggeredGrid<Real>& grid) {
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
    fold_borders(borders, grid);
}

template void particle_to_grid(const Particles<float>&, const Borders<float>&,
                               StaggeredGrid<float>&);
template void particle_to_grid(const Particles<double>&, const Borders<double>&,
                               StaggeredGrid<double>&);

}  // namespace weir
