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

/// A velocity that is only read.
template <class Real>
struct Velocity {
    const GridShape& shape;
    const VelocityOf<Real>* u;
    const VelocityOf<Real>* v;
};

template <class Real>
struct Mirror {
    Vec2<Real> face;
    Vec2<Real> normal;
    Vec2<Real> point;      ///< in the liquid
    Vec2<Real> wall;       ///< velocity of the wall there
    Real ratio = Real(0);  ///< depth of the face over distance of the mirror point
};

template <class Real>
Mirror<Real> mirror_of(const GridShape& s, Vec2<Real> face, Real distance, Vec2<Real> gradient) {
    Mirror<Real> mirror;
    mirror.face = face;
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

template <class Real>
Vec2<Real> at_point(const Velocity<Real>& grid, Vec2<Real> point) {
    const GridShape& s = grid.shape;
    return {interpolate(grid.u, s.stride, stencil_u(s, point)),
            interpolate(grid.v, s.stride, stencil_v(s, point))};
}

/// Velocity that a face in a solid takes: mirrored about the wall, in the wall's frame.
template <class Real>
Vec2<Real> mirrored(const Velocity<Real>& grid, const Mirror<Real>& mirror) {
    const Vec2<Real> liquid = at_point(grid, mirror.point);
    const Real normal_part = dot(liquid - mirror.wall, mirror.normal);
    return liquid - (normal_part * (Real(1) + mirror.ratio)) * mirror.normal;
}

/// Velocity before the step that goes with it. Towards the wall: what was there, so that the change
/// stops it. Along the wall: the liquid's, so that the change is the liquid's, or what was there if
/// that was faster, so that the change brakes.
template <class Real>
Vec2<Real> before(const Velocity<Real>& grid, const Mirror<Real>& mirror) {
    const Vec2<Real> own = at_point(grid, within_tank(grid.shape, mirror.face)) - mirror.wall;
    const Vec2<Real> liquid = at_point(grid, mirror.point) - mirror.wall;
    const Real towards = dot(own, mirror.normal);
    const Real liquid_towards = dot(liquid, mirror.normal);
    const Vec2<Real> along = own - towards * mirror.normal;
    const Vec2<Real> liquid_along = liquid - liquid_towards * mirror.normal;
    const bool brakes = dot(liquid_along, liquid_along) < dot(along, along);
    return mirror.wall + (brakes ? along : liquid_along) + towards * mirror.normal;
}

/// The field that is mirrored, and what is done to it: `mirrored` or `before`.
template <class Real>
struct Field {
    Velocity<Real> velocity;
    const LevelOf<Real>* level;
    Vec2<Real> (*value)(const Velocity<Real>&, const Mirror<Real>&);
};

template <class Real>
Real mirror_u(const Walls<Real>& walls, const Field<Real>& field, std::int32_t i,
              std::int32_t j) {
    const GridShape& s = field.velocity.shape;
    const std::int32_t low = s.index(i, j);
    const std::int32_t high = low + s.stride;
    const DistanceOf<Real>* d = walls.distance;
    const Real distance = Real(0.5) * (d[low] + d[high]);
    if (walls.open_u[low] > Real(0) || distance < kDeepest<Real>) {
        return field.velocity.u[low];
    }
    const Vec2<Real> gradient{
        Real(0.25) * ((d[low + 1] + d[high + 1]) - (d[low - 1] + d[high - 1])), d[high] - d[low]};
    const Vec2<Real> face{static_cast<Real>(i), static_cast<Real>(j) + Real(0.5)};
    Mirror<Real> mirror = mirror_of(s, face, minimum(distance, Real(0)), gradient);
    mirror.wall = wall_velocity(walls, low, high, face);
    return near_liquid(s, field.level, mirror.point) ? field.value(field.velocity, mirror).x
                                                     : field.velocity.u[low];
}

template <class Real>
Real mirror_v(const Walls<Real>& walls, const Field<Real>& field, std::int32_t i,
              std::int32_t j) {
    const GridShape& s = field.velocity.shape;
    const std::int32_t left = s.index(i, j);
    const std::int32_t right = left + 1;
    const DistanceOf<Real>* d = walls.distance;
    const Real distance = Real(0.5) * (d[left] + d[right]);
    if (walls.open_v[left] > Real(0) || distance < kDeepest<Real>) {
        return field.velocity.v[left];
    }
    const Vec2<Real> gradient{d[right] - d[left],
                              Real(0.25) * ((d[left + s.stride] + d[right + s.stride]) -
                                            (d[left - s.stride] + d[right - s.stride]))};
    const Vec2<Real> face{static_cast<Real>(i) + Real(0.5), static_cast<Real>(j)};
    Mirror<Real> mirror = mirror_of(s, face, minimum(distance, Real(0)), gradient);
    mirror.wall = wall_velocity(walls, left, right, face);
    return near_liquid(s, field.level, mirror.point) ? field.value(field.velocity, mirror).y
                                                     : field.velocity.v[left];
}

template <class Real>
void mirror_field(const Walls<Real>& walls, const Field<Real>& field, Work work,
                  PressureFields<Real>& fields, VelocityOf<Real>* u, VelocityOf<Real>* v) {
    const GridShape& s = field.velocity.shape;
    // All are computed before the first is written: they read each other.
    for_each_near(s, walls, work.take(s.ny, s.nx), [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        fields.divergence[c] = i > 0 ? mirror_u(walls, field, i, j) : Real(u[c]);
        fields.inverse_diagonal[c] = j > 0 ? mirror_v(walls, field, i, j) : Real(v[c]);
    });
    for_each_near(s, walls, work.take(s.ny, s.nx), [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        u[c] = fields.divergence[c];
        v[c] = fields.inverse_diagonal[c];
    });
}

}  // namespace

template <class Real>
void mirror_in_solids(const Walls<Real>& walls, PressureFields<Real>& fields,
                      StaggeredGrid<Real>& grid, Work work) {
    const Field<Real> now{{grid.shape, grid.u, grid.v}, fields.level, mirrored<Real>};
    const Field<Real> was{{grid.shape, grid.mass_u, grid.mass_v}, fields.level, before<Real>};
    mirror_field(walls, now, work, fields, grid.u, grid.v);
    mirror_field(walls, was, work, fields, grid.mass_u, grid.mass_v);
}

template void mirror_in_solids(const Walls<float>&, PressureFields<float>&,
                               StaggeredGrid<float>&, Work);
template void mirror_in_solids(const Walls<double>&, PressureFields<double>&,
                               StaggeredGrid<double>&, Work);
template void mirror_in_solids(const Walls<Fixed>&, PressureFields<Fixed>&,
                               StaggeredGrid<Fixed>&, Work);
template void mirror_in_solids(const Walls<SmallFixed>&, PressureFields<SmallFixed>&,
                               StaggeredGrid<SmallFixed>&, Work);

}  // namespace weir
