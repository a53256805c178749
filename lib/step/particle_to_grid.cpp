#include "step/particle_to_grid.hpp"

#include "step/thin_transfer.hpp"
#include "step/transfer_lanes.hpp"
#include "step/transfer_packed.hpp"

namespace weir {

namespace {

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
                         const ThinWalls<Real>* thin, Work work) {
    const GridShape& shape = grid.shape;
    const Part rows = work.take(shape.ny + 2, shape.nx + 2);
    clear_rows(shape, rows, grid.momentum_u());
    clear_rows(shape, rows, grid.momentum_v());
    clear_rows(shape, rows, grid.mass_u);
    clear_rows(shape, rows, grid.mass_v);
    clear_rows(shape, rows, grid.inverse_density_u);
    clear_rows(shape, rows, grid.inverse_density_v);
    const Part part = work.take(particles.count, 1);
    if (thin != nullptr) {
        scatter_past_walls(particles.part(part.first, part.end - part.first), *thin,
                           second_density, grid);
    }
    for (std::int32_t k = part.first; thin == nullptr && k < part.end; ++k) {
        const Vec2<Real> x = particles.position[k];
        const Vec2<Real> v = particles.velocity[k];
        const Real density = particles.kind[k] == Liquid::second ? second_density : Real(1);
        scatter_mixed(grid.mass_u, grid.inverse_density_u, grid.momentum_u(), shape.stride,
                      stencil_u(shape, x), density, v.x);
        scatter_mixed(grid.mass_v, grid.inverse_density_v, grid.momentum_v(), shape.stride,
                      stencil_v(shape, x), density, v.y);
    }
    if (work.once(shape.border())) {
        StaggeredGrid<Real> by_mass = grid;
        by_mass.mass_u = grid.inverse_density_u;
        by_mass.mass_v = grid.inverse_density_v;
        fold_borders(borders, by_mass);
        fold_counts(borders, shape, grid.mass_u, grid.mass_v);
    }
}

template <class Real>
std::int32_t scatter_one_liquid(const Particles<Real>& particles, StaggeredGrid<Real>& grid,
                        const ThinWalls<Real>* thin, Work work) {
    const GridShape& shape = grid.shape;
    const Part rows = work.take(shape.ny + 2, shape.nx + 2);
    clear_rows(shape, rows, grid.momentum_u());
    clear_rows(shape, rows, grid.momentum_v());
    clear_rows(shape, rows, grid.mass_u);
    clear_rows(shape, rows, grid.mass_v);
    const Part part = work.take(particles.count, 1);
    if constexpr (Stored<Real>::coarse) {
        return scatter_packed(particles.part(part.first, part.end - part.first), grid);
    }
    if (kHasThinWalls<Real> && thin != nullptr) {
        scatter_past_walls(particles.part(part.first, part.end - part.first), *thin, Real(1),
                           grid);
        return 0;
    }
    for (std::int32_t k = part.first; k < part.end; ++k) {
        const Vec2<Real> x = particles.position[k];
        const Vec2<Real> v = particles.velocity[k];
        scatter(grid.mass_u, grid.momentum_u(), shape.stride, stencil_u(shape, x), v.x);
        scatter(grid.mass_v, grid.momentum_v(), shape.stride, stencil_v(shape, x), v.y);
    }
    return 0;
}

}  // namespace

template <class Real>
std::int32_t particle_to_grid(const Particles<Real>& particles, const Borders<Real>& borders,
                              Real second_density, StaggeredGrid<Real>& grid,
                              const ThinWalls<Real>* thin, Work work) {
    if constexpr (!Stored<Real>::shares_momentum) {  // packed worlds have one liquid
        if (particles.kind != nullptr) {
            scatter_two_liquids(particles, borders, second_density, grid, thin, work);
            return 0;
        }
    }
    bool in_lanes = false;
    if constexpr (kHasLanes<Real>) {
        in_lanes = grid.pairs != nullptr && thin == nullptr;
        if (in_lanes) {
            scatter_in_lanes(particles, grid, work);
        }
    }
    const std::int32_t crowded = in_lanes ? 0 : scatter_one_liquid(particles, grid, thin, work);
    if (work.once(grid.shape.border())) {
        fold_borders(borders, grid);
    }
    return crowded;
}

#define WEIR_INSTANTIATE(Real)                                                           \
    template std::int32_t particle_to_grid(const Particles<Real>&, const Borders<Real>&, \
                                           Real, StaggeredGrid<Real>&,                   \
                                           const ThinWalls<Real>*, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
