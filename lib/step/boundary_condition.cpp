#include "step/boundary_condition.hpp"

#include "fluid/particles.hpp"

namespace weir {

namespace {

/// Faces deeper than this are never read: a particle stands in front of the wall, and its stencil
/// reaches one cell along each axis.
template <class Real>
constexpr Real kDeepest = Real(-1.5);

/// The mirror point lies at least this far out, where the stencil holds liquid.
template <class Real>
constexpr Real kLeastReach = Real(1);

template <class Real>
struct Mirror {
    Vec2<Real> normal;
    Vec2<Real> point;
    Real ratio = Real(0);  ///< depth of the face over distance of the mirror point
};

template <class Real>
Mirror<Real> mirror_of(const GridShape& s, Vec2<Real> face, Real distance, Vec2<Real> gradient) {
    Mirror<Real> mirror;
    const Real steepness = length(gradient);
    mirror.normal = steepness > Real(0) ? (Real(1) / steepness) * gradient : Vec2<Real>{};
    const Real depth = -distance;
    const Real reach = maximum(depth, kLeastReach<Real>);
    const Vec2<Real> point = face + (depth + reach) * mirror.normal;
    mirror.point = within_tank(s, point);
    mirror.ratio = depth / reach;
    return mirror;
}

/// Whether the point's cell or one around it holds liquid.
template <class Real>
bool near_liquid(const GridShape& s, const LevelOf<Real>* level, Vec2<Real> point) {
    const auto i = static_cast<std::int32_t>(point.x);
    const auto j = static_cast<std::int32_t>(point.y);
    for (std::int32_t row = maximum(j - 1, 0); row <= minimum(j + 1, s.ny - 1); ++row) {
        for (std::int32_t column = maximum(i - 1, 0); column <= minimum(i + 1, s.nx - 1);
             ++column) {
            if (level[s.index(column, row)] > Real(0)) {
                return true;
            }
        }
    }
    return false;
}

/// Velocity that the face takes: mirrored about the wall, in the wall's frame.
template <class Real>
Vec2<Real> mirrored(const StaggeredGrid<Real>& grid, const Mirror<Real>& mirror, Vec2<Real> wall) {
    const GridShape& s = grid.shape;
    const Vec2<Real> liquid{interpolate(grid.u, s.stride, stencil_u(s, mirror.point)),
                            interpolate(grid.v, s.stride, stencil_v(s, mirror.point))};
    const Real normal_part = dot(liquid - wall, mirror.normal);
    return liquid - (normal_part * (Real(1) + mirror.ratio)) * mirror.normal;
}

template <class Real>
Real mirror_u(const Walls<Real>& walls, const LevelOf<Real>* level, std::int32_t i, std::int32_t j,
              const StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const std::int32_t low = s.index(i, j);
    const std::int32_t high = low + s.stride;
    const DistanceOf<Real>* d = walls.distance;
    const Real distance = Real(0.5) * (d[low] + d[high]);
    if (walls.open_u[low] > Real(0) || distance < kDeepest<Real>) {
        return grid.u[low];
    }
    const Vec2<Real> gradient{
        Real(0.25) * ((d[low + 1] + d[high + 1]) - (d[low - 1] + d[high - 1])), d[high] - d[low]};
    const Vec2<Real> face{static_cast<Real>(i), static_cast<Real>(j) + Real(0.5)};
    const Vec2<Real> wall = wall_velocity(walls, low, high, face);
    const Mirror<Real> mirror = mirror_of(s, face, minimum(distance, Real(0)), gradient);
    return near_liquid(s, level, mirror.point) ? mirrored(grid, mirror, wall).x : grid.u[low];
}

template <class Real>
Real mirror_v(const Walls<Real>& walls, const LevelOf<Real>* level, std::int32_t i, std::int32_t j,
              const StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const std::int32_t left = s.index(i, j);
    const std::int32_t right = left + 1;
    const DistanceOf<Real>* d = walls.distance;
    const Real distance = Real(0.5) * (d[left] + d[right]);
    if (walls.open_v[left] > Real(0) || distance < kDeepest<Real>) {
        return grid.v[left];
    }
    const Vec2<Real> gradient{d[right] - d[left],
                              Real(0.25) * ((d[left + s.stride] + d[right + s.stride]) -
                                            (d[left - s.stride] + d[right - s.stride]))};
    const Vec2<Real> face{static_cast<Real>(i) + Real(0.5), static_cast<Real>(j)};
    const Vec2<Real> wall = wall_velocity(walls, left, right, face);
    const Mirror<Real> mirror = mirror_of(s, face, minimum(distance, Real(0)), gradient);
    return near_liquid(s, level, mirror.point) ? mirrored(grid, mirror, wall).y : grid.v[left];
}

}  // namespace

template <class Real>
void mirror_in_solids(const Walls<Real>& walls, PressureFields<Real>& fields,
                      StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const LevelOf<Real>* level = fields.level;
    // All are computed before the first is written: they read each other.
    std::int32_t count = 0;
    for_each_near(s, walls, [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        fields.divergence[count] = i > 0 ? mirror_u(walls, level, i, j, grid) : grid.u[c];
        fields.inverse_diagonal[count] = j > 0 ? mirror_v(walls, level, i, j, grid) : grid.v[c];
        ++count;
    });
    count = 0;
    for_each_near(s, walls, [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        grid.u[c] = fields.divergence[count];
        grid.v[c] = fields.inverse_diagonal[count];
        ++count;
    });
}

template void mirror_in_solids(const Walls<float>&, PressureFields<float>&,
                               StaggeredGrid<float>&);
template void mirror_in_solids(const Walls<double>&, PressureFields<double>&,
                               StaggeredGrid<double>&);
template void mirror_in_solids(const Walls<Fixed>&, PressureFields<Fixed>&,
                               StaggeredGrid<Fixed>&);
template void mirror_in_solids(const Walls<SmallFixed>&, PressureFields<SmallFixed>&,
                               StaggeredGrid<SmallFixed>&);

}  // namespace weir
