#include "step/grid_update.hpp"

namespace weir {

namespace {

template <class Real>
void update(Real* momentum, Real* mass, const GridShape& s, Real gained) {
    const std::int32_t end = s.index(s.nx, s.ny);
    for (std::int32_t face = s.index(0, 0); face <= end; ++face) {
        const Real m = mass[face];
        const Real before = m > Real(0) ? momentum[face] / m : Real(0);
        mass[face] = before;
        momentum[face] = m > Real(0) ? before + gained : Real(0);
    }
}

/// One component: `back` is the step from a face to the face before it across its own cells.
template <class Real>
void extrapolate_component(Real* velocity, const Real* level, const GridShape& s,
                           std::int32_t back, std::int32_t first_i, std::int32_t first_j) {
    const auto wet = [&](std::int32_t face) {
        return level[face] > Real(0) || level[face - back] > Real(0);
    };
    for (std::int32_t j = first_j; j < s.ny; ++j) {
        for (std::int32_t i = first_i; i < s.nx; ++i) {
            const std::int32_t face = s.index(i, j);
            if (wet(face)) {
                continue;
            }
            Real sum = Real(0);
            Real count = Real(0);
            const auto look = [&](bool exists, std::int32_t neighbour) {
                if (exists && wet(neighbour)) {
                    sum += velocity[neighbour];
                    count += Real(1);
                }
            };
            look(i > first_i, face - 1);
            look(i + 1 < s.nx, face + 1);
            look(j > first_j, face - s.stride);
            look(j + 1 < s.ny, face + s.stride);
            if (count > Real(0)) {
                velocity[face] = sum / count;
            }
        }
    }
}

}  // namespace

template <class Real>
void grid_update(StaggeredGrid<Real>& grid, Vec2<Real> gravity, Real dt_s) {
    const GridShape& s = grid.shape;
    update(grid.u, grid.mass_u, s, gravity.x * dt_s);
    update(grid.v, grid.mass_v, s, gravity.y * dt_s);
    for (std::int32_t j = 0; j < s.ny; ++j) {
        grid.u[s.index(0, j)] = Real(0);
        grid.u[s.index(s.nx, j)] = Real(0);
    }
    for (std::int32_t i = 0; i < s.nx; ++i) {
        grid.v[s.index(i, 0)] = Real(0);
        grid.v[s.index(i, s.ny)] = Real(0);
    }
}

template <class Real>
void extrapolate(StaggeredGrid<Real>& grid, const Real* level) {
    extrapolate_component(grid.u, level, grid.shape, 1, 1, 0);
    extrapolate_component(grid.v, level, grid.shape, grid.shape.stride, 0, 1);
}

#define WEIR_INSTANTIATE(Real)                                        \
    template void grid_update(StaggeredGrid<Real>&, Vec2<Real>, Real); \
    template void extrapolate(StaggeredGrid<Real>&, const Real*);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
#undef WEIR_INSTANTIATE

}  // namespace weir
