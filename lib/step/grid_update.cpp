#include "step/grid_update.hpp"

#include <cstring>

namespace weir {

namespace {

/// The face's momentum, read as bytes: packed velocities are written over momenta already read.
template <class Real>
Real momentum_at(const Real* momentum, std::int32_t face) {
    Real value;
    std::memcpy(&value, momentum + face, sizeof value);
    return value;
}

/// Ascending, so that a velocity may stand where the momenta of faces before it stood.
template <class Real>
void update(const Real* momentum, VelocityOf<Real>* mass, const GridShape& s, Real gained,
            VelocityOf<Real>* velocity) {
    const std::int32_t end = s.index(s.nx, s.ny);
    for (std::int32_t face = s.index(0, 0); face <= end; ++face) {
        const Real m = mass[face];
        const Real before = m > Real(0) ? momentum_at(momentum, face) / m : Real(0);
        mass[face] = before;
        velocity[face] = m > Real(0) ? before + gained : Real(0);
    }
}

/// The same where mass_u counts particles and their mass stands beside it. A face without any is
/// as dense as the first liquid.
template <class Real>
void update_mixed(const Real* momentum, VelocityOf<Real>* volume, VelocityOf<Real>* mass,
                  const GridShape& s, Real gained, VelocityOf<Real>* velocity) {
    const std::int32_t end = s.index(s.nx, s.ny);
    for (std::int32_t face = s.index(0, 0); face <= end; ++face) {
        const Real m = mass[face];
        const Real before = m > Real(0) ? momentum_at(momentum, face) / m : Real(0);
        mass[face] = m > Real(0) ? volume[face] / m : Real(1);
        volume[face] = before;
        velocity[face] = m > Real(0) ? before + gained : Real(0);
    }
}

/// One component: `back` is the step from a face to the face before it across its own cells.
template <class Real>
void extrapolate_component(VelocityOf<Real>* velocity, const VelocityOf<Real>* before,
                           const LevelOf<Real>* level,
                           const GridShape& s, std::int32_t back, std::int32_t first_i,
                           std::int32_t first_j) {
    const auto wet = [&](std::int32_t face) {
        return level[face] > Real(0) || level[face - back] > Real(0);
    };
    // A face that has mass shows in both its cells; one that has none is read by no particle.
    const auto empty = [&](std::int32_t face) {
        return level[face] <= kEmptyLevel<Real> || level[face - back] <= kEmptyLevel<Real>;
    };
    for (std::int32_t j = first_j; j < s.ny; ++j) {
        for (std::int32_t i = first_i; i < s.nx; ++i) {
            const std::int32_t face = s.index(i, j);
            if (wet(face) || empty(face)) {
                continue;
            }
            Real sum = Real(0);
            Real count = Real(0);
            const auto look = [&](bool exists, std::int32_t neighbour) {
                if (exists && wet(neighbour)) {
                    sum += Real(velocity[neighbour]);
                    sum -= before != nullptr ? Real(before[neighbour]) : Real(0);
                    count += Real(1);
                }
            };
            look(i > first_i, face - 1);
            look(i + 1 < s.nx, face + 1);
            look(j > first_j, face - s.stride);
            look(j + 1 < s.ny, face + s.stride);
            if (count > Real(0)) {
                velocity[face] = (before != nullptr ? Real(before[face]) : Real(0)) + sum / count;
            }
        }
    }
}

}  // namespace

template <class Real>
void grid_update(const Borders<Real>& borders, Vec2<Real> gravity, Seconds<Real> dt_s,
                 const LevelOf<Real>* level, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    if (grid.inverse_density_u != nullptr) {
        update_mixed(grid.momentum_u(), grid.mass_u, grid.inverse_density_u, s, gravity.x * dt_s,
                     grid.u);
        update_mixed(grid.momentum_v(), grid.mass_v, grid.inverse_density_v, s, gravity.y * dt_s,
                     grid.v);
    } else {
        update(grid.momentum_u(), grid.mass_u, s, gravity.x * dt_s, grid.u);
        update(grid.momentum_v(), grid.mass_v, s, gravity.y * dt_s, grid.v);
    }
    close_walls(borders, level, grid);
}

template <class Real>
void extrapolate(const Borders<Real>& borders, const LevelOf<Real>* level, bool velocity_itself,
                 StaggeredGrid<Real>& grid) {
    const VelocityOf<Real>* before_u = velocity_itself ? nullptr : grid.mass_u;
    const VelocityOf<Real>* before_v = velocity_itself ? nullptr : grid.mass_v;
    extrapolate_component<Real>(grid.u, before_u, level, grid.shape, 1, borders.wrap_x ? 0 : 1, 0);
    extrapolate_component<Real>(grid.v, before_v, level, grid.shape, grid.shape.stride, 0,
                          borders.wrap_y ? 0 : 1);
}

#define WEIR_INSTANTIATE(Real)                                                  \
    template void grid_update(const Borders<Real>&, Vec2<Real>, Seconds<Real>,  \
                              const LevelOf<Real>*, StaggeredGrid<Real>&);      \
    template void extrapolate(const Borders<Real>&, const LevelOf<Real>*, bool, \
                              StaggeredGrid<Real>&);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
WEIR_INSTANTIATE(Fixed)
WEIR_INSTANTIATE(SmallFixed)
#undef WEIR_INSTANTIATE

}  // namespace weir
