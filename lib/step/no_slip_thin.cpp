#include "solid/nearest_wall.hpp"
#include "step/no_slip.hpp"
#include "step/seen_sample.hpp"
#include "step/tank_walls.hpp"

namespace weir {

namespace {

/// Faces of a stencil, as bits, that are further from a wall than what is bound to it.
template <class Real>
std::uint32_t unbound_of(Vec2<Real> first, Vec2<Real> on_wall, Vec2<Real> normal) {
    std::uint32_t out = 0;
    for (std::uint32_t node = 0; node < 4; ++node) {
        const Vec2<Real> face =
            first + Vec2<Real>{Real((node & 1U) != 0 ? 1 : 0), Real((node & 2U) != 0 ? 1 : 0)};
        const Real height = dot(face - on_wall, normal);
        out |= height < kBoundLayer<Real> ? 0U : 1U << node;
    }
    return out;
}

/// How fast the liquid before a wall slips along it, and how far from the wall.
template <class Real>
struct SlipBefore {
    Real along = Real(0);
    Real distance = Real(0);  ///< 0: there is nothing to be told
};

/// @param place a cell from the wall, in the liquid.
template <class Real>
SlipBefore<Real> slip_before(const ThinWalls<Real>& thin, const StaggeredGrid<Real>& grid,
                             Vec2<Real> place, Vec2<Real> on_wall, Vec2<Real> n) {
    const GridShape& s = grid.shape;
    const Stencil<Real> at_u = stencil_u(s, place);
    const Stencil<Real> at_v = stencil_v(s, place);
    const Vec2<Real> first_u = place - Vec2<Real>{at_u.fx, at_u.fy};
    const Vec2<Real> first_v = place - Vec2<Real>{at_v.fx, at_v.fy};
    const std::uint32_t seen = seen_faces(thin, s, place);
    const std::uint32_t on_u = seen & unbound_of(first_u, on_wall, n);
    const std::uint32_t on_v = seen >> 4U & unbound_of(first_v, on_wall, n);
    if (on_u == 0 || on_v == 0) {
        return {};
    }
    const StandIns<Real> faces_u(on_u, at_u);
    const StandIns<Real> faces_v(on_v, at_v);
    const Vec2<Real> tangent{-n.y, n.x};
    const Vec2<Real> liquid{sample_seen<Real>(grid.u, 1, s.stride, at_u, faces_u).value,
                            sample_seen<Real>(grid.v, 1, s.stride, at_v, faces_v).value};
    const Real height = dot(place - on_wall, n);
    const Real of_u = dot(way_to_sample(at_u, faces_u), n);
    const Real of_v = dot(way_to_sample(at_v, faces_v), n);
    return {dot(liquid, tangent), height + (n.y * (n.y * of_u) + n.x * (n.x * of_v))};
}

/// One component of the faces near thin walls that liquid sticks to.
template <class Real>
void bind_component(const FaceAxis<Real>& axis, const LevelOf<Real>* level,
                    const StaggeredGrid<Real>& grid, VelocityOf<Real>* velocity) {
    const GridShape& s = axis.s;
    const ThinWalls<Real>& thin = *axis.walls.thin;
    for (std::int32_t j = axis.is_u ? 0 : 1; j < s.ny; ++j) {
        const auto next = [&](std::int32_t i) {
            return next_marked(&thin, s, j, j, i, s.nx, kTouching);
        };
        for (std::int32_t i = next(axis.is_u ? 1 : 0); i < s.nx; i = next(i + 1)) {
            const std::int32_t face = s.index(i, j);
            const NearestWall<Real> wall(axis, i, j, Real(0));
            if (!wall.thin || wall.slot == kNoBody || !(wall.distance < kBoundLayer<Real>) ||
                !(level[face] > Real(0) || level[face - axis.before()] > Real(0))) {
                continue;
            }
            const Vec2<Real> n = wall.normal;
            const Vec2<Real> centre = axis.centre(i, j);
            const Vec2<Real> on_wall = centre - wall.distance * n;
            const Vec2<Real> place = within_tank(s, on_wall + n);
            if (hidden(thin, s, centre, place)) {
                continue;
            }
            const SlipBefore<Real> liquid = slip_before(thin, grid, place, on_wall, n);
            // What the face itself has: nearer faces count, too.
            const SlipBefore<Real> own = slip_before(thin, grid, centre, on_wall - n, n);
            if (!(liquid.distance > Real(0)) || !(own.distance > Real(0))) {
                continue;
            }
            const Vec2<Real> tangent{-n.y, n.x};
            const Real of_wall = dot(axis.wall(wall.slot, on_wall, n), tangent);
            const Real bound =
                of_wall + (wall.distance / liquid.distance) * (liquid.along - of_wall);
            velocity[face] = Real(velocity[face]) + (bound - own.along) * axis.of(tangent);
        }
    }
}

}  // namespace

template <class Real>
void bind_to_thin_walls(const Walls<Real>& walls, const LevelOf<Real>* level,
                        StaggeredGrid<Real>& grid) {
    bind_component<Real>({grid.shape, walls, true}, level, grid, grid.u);
    bind_component<Real>({grid.shape, walls, false}, level, grid, grid.v);
}

#define WEIR_INSTANTIATE(Real)                                                 \
    template void bind_to_thin_walls(const Walls<Real>&, const LevelOf<Real>*, \
                                     StaggeredGrid<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
