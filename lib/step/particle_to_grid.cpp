#include "step/particle_to_grid.hpp"

#include "step/scatter.hpp"
#include "step/thin_transfer.hpp"
#include "step/transfer_fpu.hpp"
#include "step/transfer_lanes.hpp"
#include "step/transfer_packed.hpp"

namespace weir {

namespace {

template <class Real>
void clear_faces(const StaggeredGrid<Real>& grid, const Part& rows) {
    clear_rows(grid.shape, rows, grid.momentum_u());
    clear_rows(grid.shape, rows, grid.momentum_v());
    clear_rows(grid.shape, rows, grid.mass_u);
    clear_rows(grid.shape, rows, grid.mass_v);
}

template <class Real>
std::int32_t scatter_two_liquids(const Particles<Real>& particles, const Borders<Real>& borders,
                                 Real second_density, StaggeredGrid<Real>& grid,
                                 const ThinWalls<Real>* thin, Work work) {
    const GridShape& shape = grid.shape;
    std::int32_t full = 0;
    const Part rows = work.take(shape.ny + 2, shape.nx + 2);
    clear_faces(grid, rows);
    clear_rows(shape, rows, grid.inverse_density_u);
    clear_rows(shape, rows, grid.inverse_density_v);
    const Part part = work.take(particles.count, 1);
    if (thin != nullptr) {
        full = scatter_past_walls(particles.part(part.first, part.end - part.first), *thin,
                                  second_density, grid);
    }
    for (std::int32_t k = part.first; thin == nullptr && k < part.end; ++k) {
        const Vec2<Real> x = particles.position[k];
        const Vec2<Real> v = particles.velocity[k];
        const Real density = particles.kind[k] == Liquid::second ? second_density : Real(1);
        full += scatter_dense<Real>(grid.mass_u, grid.inverse_density_u, grid.momentum_u(),
                                    shape.stride, stencil_u(shape, x), density, v.x);
        full += scatter_dense<Real>(grid.mass_v, grid.inverse_density_v, grid.momentum_v(),
                                    shape.stride, stencil_v(shape, x), density, v.y);
    }
    if (work.once(shape.border())) {
        StaggeredGrid<Real> by_mass = grid;
        by_mass.mass_u = grid.inverse_density_u;
        by_mass.mass_v = grid.inverse_density_v;
        fold_borders(borders, by_mass);
        fold_counts(borders, shape, grid.mass_u, grid.mass_v);
    }
    return full;
}

template <class Real>
std::int32_t scatter_plainly(const Particles<Real>& particles, StaggeredGrid<Real>& grid) {
    std::int32_t full = 0;
    if constexpr (kHasFpuLoops<Real>) {
        scatter_with_fpu(particles, grid);
    } else {
        const GridShape& shape = grid.shape;
        for (std::int32_t k = 0; k < particles.count; ++k) {
            const Vec2<Real> x = particles.position[k];
            const Vec2<Real> v = particles.velocity[k];
            full += scatter(grid.mass_u, grid.momentum_u(), shape.stride, stencil_u(shape, x), v.x);
            full += scatter(grid.mass_v, grid.momentum_v(), shape.stride, stencil_v(shape, x), v.y);
        }
    }
    return full;
}

template <class Real>
std::int32_t scatter_one_liquid(const Particles<Real>& particles, StaggeredGrid<Real>& grid,
                                const ThinWalls<Real>* thin, Work work) {
    const GridShape& shape = grid.shape;
    const Part rows = work.take(shape.ny + 2, shape.nx + 2);
    clear_faces(grid, rows);
    const Part part = work.take(particles.count, 1);
    if constexpr (Stored<Real>::coarse) {
        return scatter_packed(particles.part(part.first, part.end - part.first), grid);
    }
    if (kHasThinWalls<Real> && thin != nullptr) {
        std::int32_t full = 0;
        for_each_beside(
            particles, part, *thin, shape,
            [&](const Part& some) {
                full += scatter_plainly(particles.part(some.first, some.end - some.first), grid);
            },
            [&](std::int32_t k) {
                full += scatter_past_walls(particles.part(k, 1), *thin, Real(1), grid);
            });
        return full;
    }
    return scatter_plainly(particles.part(part.first, part.end - part.first), grid);
}

}  // namespace

template <class Real>
std::int32_t particle_to_grid(const Particles<Real>& particles, const Borders<Real>& borders,
                              Real second_density, StaggeredGrid<Real>& grid,
                              const ThinWalls<Real>* thin, Work work) {
    if constexpr (!Stored<Real>::shares_momentum) {  // packed worlds have one liquid
        if (particles.kind != nullptr) {
            return scatter_two_liquids(particles, borders, second_density, grid, thin, work);
        }
    }
    bool in_lanes = false;
    if constexpr (kHasLanes<Real>) {
        in_lanes = grid.pairs != nullptr;
        if (in_lanes) {
            scatter_in_lanes(particles, thin, grid, work);
        }
    }
    const std::int32_t crowded = in_lanes ? 0 : scatter_one_liquid(particles, grid, thin, work);
    if (work.once(grid.shape.border())) {
        fold_borders(borders, grid);
    }
    return crowded;
}

#define WEIR_INSTANTIATE(Real)                                                    \
    template std::int32_t particle_to_grid(                                       \
        const Particles<Real>&, const Borders<Real>&, Real, StaggeredGrid<Real>&, \
        const ThinWalls<Real>*, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
