#include "step/particle_to_grid.hpp"

#include <cstring>

#include "step/thin_transfer.hpp"
#include "step/transfer_lanes.hpp"

namespace weir {

namespace {

template <class Field>
void clear(Field* field, const GridShape& shape) {
    std::memset(static_cast<void*>(field), 0,
                static_cast<std::size_t>(shape.size()) * sizeof(Field));
}

template <class Mass, class Real>
inline void scatter(Mass* mass, Real* momentum, std::int32_t stride, const Stencil<Real>& at,
                    Real velocity) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;                       // fx (1 − fy)
    const Real upper = at.fy - w1;                       // (1 − fx) fy
    const Real w0 = (Real(1) - at.fx) - upper;           // (1 − fx)(1 − fy)
    Mass* m = mass + at.base;
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

/// The same, and the mass of a particle of that density.
template <class Mass, class Real>
inline void scatter_mixed(Mass* volume, Mass* mass, Real* momentum, std::int32_t stride,
                          const Stencil<Real>& at, Real density, Real velocity) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;
    const Real upper = at.fy - w1;
    const Real weight[] = {(Real(1) - at.fx) - upper, right, upper, w1};
    const std::int32_t node[] = {at.base, at.base + 1, at.base + stride, at.base + stride + 1};
    for (std::int32_t k = 0; k < 4; ++k) {
        const Real share = weight[k] * density;
        volume[node[k]] += weight[k];
        mass[node[k]] += share;
        momentum[node[k]] += share * velocity;
    }
}

template <class Real>
void scatter_two_liquids(const Particles<Real>& particles, const Borders<Real>& borders,
                         Real second_density, StaggeredGrid<Real>& grid,
                         const ThinWalls<Real>* thin) {
    const GridShape& shape = grid.shape;
    clear(grid.momentum_u(), shape);
    clear(grid.momentum_v(), shape);
    clear(grid.mass_u, shape);
    clear(grid.mass_v, shape);
    clear(grid.inverse_density_u, shape);
    clear(grid.inverse_density_v, shape);
    if (thin != nullptr) {
        scatter_past_walls(particles, *thin, second_density, grid);
    }
    for (std::int32_t k = 0; thin == nullptr && k < particles.count; ++k) {
        const Vec2<Real> x = particles.position[k];
        const Vec2<Real> v = particles.velocity[k];
        const Real density = particles.kind[k] == Liquid::second ? second_density : Real(1);
        scatter_mixed(grid.mass_u, grid.inverse_density_u, grid.momentum_u(), shape.stride,
                      stencil_u(shape, x), density, v.x);
        scatter_mixed(grid.mass_v, grid.inverse_density_v, grid.momentum_v(), shape.stride,
                      stencil_v(shape, x), density, v.y);
    }
    StaggeredGrid<Real> by_mass = grid;
    by_mass.mass_u = grid.inverse_density_u;
    by_mass.mass_v = grid.inverse_density_v;
    fold_borders(borders, by_mass);
    fold_counts(borders, shape, grid.mass_u, grid.mass_v);
}

template <class Real>
void scatter_one_liquid(const Particles<Real>& particles, StaggeredGrid<Real>& grid,
                        const ThinWalls<Real>* thin) {
    const GridShape& shape = grid.shape;
    clear(grid.momentum_u(), shape);
    clear(grid.momentum_v(), shape);
    clear(grid.mass_u, shape);
    clear(grid.mass_v, shape);
    if (thin != nullptr) {
        scatter_past_walls(particles, *thin, Real(1), grid);
        return;
    }
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<Real> x = particles.position[k];
        const Vec2<Real> v = particles.velocity[k];
        scatter(grid.mass_u, grid.momentum_u(), shape.stride, stencil_u(shape, x), v.x);
        scatter(grid.mass_v, grid.momentum_v(), shape.stride, stencil_v(shape, x), v.y);
    }
}

}  // namespace

template <class Real>
void particle_to_grid(const Particles<Real>& particles, const Borders<Real>& borders,
                      Real second_density, StaggeredGrid<Real>& grid,
                      const ThinWalls<Real>* thin) {
    if (particles.kind != nullptr) {
        scatter_two_liquids(particles, borders, second_density, grid, thin);
        return;
    }
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr && thin == nullptr) {
            scatter_in_lanes(particles, grid);
            fold_borders(borders, grid);
            return;
        }
    }
    scatter_one_liquid(particles, grid, thin);
    fold_borders(borders, grid);
}

template void particle_to_grid(const Particles<float>&, const Borders<float>&, float,
                               StaggeredGrid<float>&, const ThinWalls<float>*);
template void particle_to_grid(const Particles<double>&, const Borders<double>&, double,
                               StaggeredGrid<double>&, const ThinWalls<double>*);
template void particle_to_grid(const Particles<Fixed>&, const Borders<Fixed>&, Fixed,
                               StaggeredGrid<Fixed>&, const ThinWalls<Fixed>*);
template void particle_to_grid(const Particles<SmallFixed>&, const Borders<SmallFixed>&, SmallFixed,
                               StaggeredGrid<SmallFixed>&, const ThinWalls<SmallFixed>*);

}  // namespace weir
