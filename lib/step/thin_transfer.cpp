#include "step/thin_transfer.hpp"

#include "fluid/particles.hpp"
#include "math/lanes.hpp"
#include "solid/reflect.hpp"
#include "solid/thin_beside.hpp"
#include "step/scatter.hpp"
#include "step/seen_sample.hpp"
#include "step/tank_walls.hpp"

namespace weir {

namespace {

/// What holds of a velocity nearer to a wall than it was sampled: its part along the normal grows
/// with the distance from the wall's own, without which particles gathered on thin walls, and where
/// the liquid sticks so does its part along the wall.
template <class Real>
struct TowardsWall {
    Vec2<Real> normal{};
    Real wall = Real(0);   ///< its own velocity along the normal
    Real along = Real(0);  ///< and along itself
    Real less = Real(0);   ///< share that does not hold along the normal
    Real less_along = Real(0);

    /// @param flip share that is left out of the velocity, and of the wall's.
    Vec2<Real> of(Vec2<Real> velocity, Real flip) const {
        const Real through = dot(velocity, normal);
        Vec2<Real> holds = velocity - (less * (through - (wall - flip * wall))) * normal;
        if (less_along > Real(0)) {
            const Vec2<Real> tangent{-normal.y, normal.x};
            const Real goes = dot(velocity, tangent);
            holds = holds - (less_along * (goes - (along - flip * along))) * tangent;
        }
        return holds;
    }
};

template <class Real>
TowardsWall<Real> near_wall(const Walls<Real>& walls, const GridShape& s, Vec2<Real> x,
                            Vec2<Real> way_u, Vec2<Real> way_v) {
    const NextWall<Real> next(*walls.thin, s, x, false);
    if (next.edge == nullptr) {
        return {};
    }
    const Vec2<Real> n = next.normal;
    const Body<Real>& body = walls.body[next.edge->slot];
    const Vec2<Real> wall = velocity_at(body, x);
    const Real along_u = dot(way_u, n);
    const Real along_v = dot(way_v, n);
    const auto share = [&](Real further) {
        return further > Real(0) ? further / (next.distance + further) : Real(0);
    };
    TowardsWall<Real> near;
    near.normal = n;
    near.wall = dot(wall, n);
    near.less = share(n.x * (n.x * along_u) + n.y * (n.y * along_v));
    if (walls.sticking != nullptr && body.surface.no_slip) {
        near.along = dot(surface_velocity(body.surface, wall, n), Vec2<Real>{-n.y, n.x});
        near.less_along = share(n.y * (n.y * along_u) + n.x * (n.x * along_v));
    }
    return near;
}

/// Emptier cells hold drops that fly alone, a particle of four at most.
template <class Real>
constexpr Real kSparse = Real(0.3);

/// The cell that liquid in a place belongs to.
template <class Real>
std::int32_t cell_seen(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    const Vec2<Real> centre = centre_seen(s, walls, x);
    return s.index(static_cast<std::int32_t>(centre.x), static_cast<std::int32_t>(centre.y));
}

/// Where velocity and change of a component lie, and how many numbers apart two faces are.
template <class Real>
struct Component {
    const VelocityOf<Real>* velocity;
    const VelocityOf<Real>* change;
    std::int32_t step;
};

template <class Real>
void components(const StaggeredGrid<Real>& grid, Component<Real>& u, Component<Real>& v) {
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr) {
            u = {grid.pairs, grid.pairs + 1, 2};
            v = {grid.u, grid.u + 1, 2};
            return;
        }
    }
    u = {grid.u, grid.mass_u, 1};
    v = {grid.v, grid.mass_v, 1};
}

}  // namespace

template <class Real>
std::int32_t scatter_past_walls(const Particles<Real>& particles, const ThinWalls<Real>& thin,
                                Real second_density, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    std::int32_t full = 0;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<Real> x = particles.position[k];
        const Vec2<Real> v = particles.velocity[k];
        const bool second = particles.kind != nullptr && particles.kind[k] == Liquid::second;
        const Real density = second ? second_density : Real(1);
        const std::uint32_t seen =
            beside_thin_wall(thin, s, x) ? seen_faces(thin, s, x) : 0xFFU;
        full += scatter_weighed<Real>(grid.mass_u, grid.inverse_density_u, grid.momentum_u(),
                                      s.stride, stencil_u(s, x), density, v.x, seen & kAllFour);
        full += scatter_weighed<Real>(grid.mass_v, grid.inverse_density_v, grid.momentum_v(),
                                      s.stride, stencil_v(s, x), density, v.y, seen >> 4U);
    }
    return full;
}

template <class Real>
TransferResult<Real> gather_past_walls(const StaggeredGrid<Real>& grid,
                                       const Transfer<Real>& transfer,
                                       const Walls<Real>& walls, const DensityOf<Real>* density,
                                       Vec2<Real> fall, const Vec2<PositionOf<Real>>* before,
                                       const Vec2<VelocityOf<Real>>* velocity,
                                       Particles<Real>& block) {
    const ThinWalls<Real>& thin = *walls.thin;
    const GridShape& s = grid.shape;
    const Vec2<Real> size{static_cast<Real>(s.nx), static_cast<Real>(s.ny)};
    Component<Real> on_u{};
    Component<Real> on_v{};
    components(grid, on_u, on_v);
    TransferResult<Real> result;
    const MarkedInBlock<Real> marked(thin, s, before, block.count);
    for (std::int32_t m = 0; m < marked.count(); ++m) {
        const std::int32_t k = marked[m];
        Vec2<Real> x = before[k];
        if (!beside_thin_wall(thin, s, x)) {
            continue;
        }
        const std::uint32_t seen = seen_faces(thin, s, x);
        if (seen == 0xFFU) {
            continue;
        }
        const Vec2<Real> was = velocity[k];
        const Stencil<Real> at_u = stencil_u(s, x);
        const Stencil<Real> at_v = stencil_v(s, x);
        const std::uint32_t seen_u = seen & kAllFour;
        const std::uint32_t seen_v = seen >> 4U;
        const StandIns<Real> faces_u(seen_u, at_u);
        const StandIns<Real> faces_v(seen_v, at_v);
        TowardsWall<Real> near;
        if (seen_u != 0 && seen_v != 0 && !(density[cell_seen(s, walls, x)] < kSparse<Real>)) {
            near = near_wall(walls, s, x, way_to_sample(at_u, faces_u),
                             way_to_sample(at_v, faces_v));
        }
        const Sample<Real> u =
            seen_u != 0 ? sample_seen<Real>(on_u.velocity, on_u.step, s.stride, at_u, faces_u)
                        : Sample<Real>{was.x + fall.x, Real(0), Real(0)};
        const Sample<Real> w =
            seen_v != 0 ? sample_seen<Real>(on_v.velocity, on_v.step, s.stride, at_v, faces_v)
                        : Sample<Real>{was.y + fall.y, Real(0), Real(0)};
        const Real flip = transfer.flip_ratio;
        const auto change = [&](const Component<Real>& on, const Stencil<Real>& at,
                                std::uint32_t sees, const StandIns<Real>& faces, Real before_it,
                                Real falls) {
            return sees != 0 ? sample_seen<Real>(on.change, on.step, s.stride, at, faces).value
                             : (before_it - flip * before_it) + falls;
        };
        const Vec2<Real> gains = near.of({change(on_u, at_u, seen_u, faces_u, was.x, fall.x),
                                          change(on_v, at_v, seen_v, faces_v, was.y, fall.y)},
                                         flip);
        Vec2<Real> v = flip * was + gains;
        const Real half_x = Real(0.5) * (u.slope_x * u.value + u.slope_y * w.value);
        const Real half_y = Real(0.5) * (w.slope_x * u.value + w.slope_y * w.value);
        const Vec2<Real> along = near.of({u.value + transfer.dt_s * half_x,
                                          w.value + transfer.dt_s * half_y}, Real(0));
        advect(size, {transfer, nullptr}, along, x, v, result);
        block.position[k] = x;
        block.velocity[k] = v;
    }
    return result;
}

namespace {

/// Faces of a stencil that thin walls do not close.
template <class Real>
std::uint32_t open_of(const ThinWalls<Real>& thin, std::int32_t stride, std::int32_t base,
                      ThinMark closed) {
    const std::int32_t face[] = {base, base + 1, base + stride, base + stride + 1};
    std::uint32_t open = 0;
    for (std::uint32_t node = 0; node < 4; ++node) {
        open |= (thin.mark[face[node]] & closed) == 0 ? 1U << node : 0U;
    }
    return open;
}

/// Velocity of the liquid at a place, from faces that are seen from there and open. False: none.
template <class Real>
bool liquid_at(const ThinWalls<Real>& thin, const StaggeredGrid<Real>& liquid, Vec2<Real> place,
               Vec2<Real>& velocity) {
    const GridShape& s = liquid.shape;
    const Stencil<Real> at_u = stencil_u(s, place);
    const Stencil<Real> at_v = stencil_v(s, place);
    const std::uint32_t seen = seen_faces(thin, s, place);
    const std::uint32_t on_u = seen & open_of(thin, s.stride, at_u.base, kLeftClosed);
    const std::uint32_t on_v = seen >> 4U & open_of(thin, s.stride, at_v.base, kLowerClosed);
    if (on_u == 0 || on_v == 0) {
        return false;
    }
    velocity = {sample_seen<Real>(liquid.u, 1, s.stride, at_u, StandIns<Real>(on_u, at_u)).value,
                sample_seen<Real>(liquid.v, 1, s.stride, at_v, StandIns<Real>(on_v, at_v)).value};
    return true;
}

/// Velocity at a closed face between two cells, on the side of the wall on which it is.
template <class Real>
bool mirrored_face(const Walls<Real>& walls, const StaggeredGrid<Real>& liquid, Vec2<Real> face,
                   std::int32_t before, std::int32_t cell, bool along_x, Vec2<Real>& velocity) {
    const ThinWalls<Real>& thin = *walls.thin;
    const GridShape& s = liquid.shape;
    const WallEdge* edge = edge_between(thin, face, before, cell, along_x);
    if (edge == nullptr) {
        return false;
    }
    const Vec2<Real> a = thin.vertex[edge->from];
    const Vec2<Real> left = left_normal(thin, *edge);
    const Real height = dot(face - a, left);
    const Vec2<Real> normal = height >= Real(0) ? left : Vec2<Real>{} - left;
    const Vec2<Real> place = within_tank(s, face + normal);
    Vec2<Real> there;
    if (hidden(thin, s, face, place) || !liquid_at(thin, liquid, place, there)) {
        return false;
    }
    const Vec2<Real> wall = velocity_at(walls.body[edge->slot], face);
    const Real approach = dot(there - wall, normal);
    velocity = there - (approach / (Real(1) + absolute(height))) * normal;
    return true;
}

}  // namespace

template <class Real>
void mirror_at_thin_walls(const Walls<Real>& walls, const LevelOf<Real>* level,
                          StaggeredGrid<Real>& grid) {
    const ThinWalls<Real>& thin = *walls.thin;
    const GridShape& s = grid.shape;
    constexpr Real kHalf = Real(0.5);
    const auto wet = [&](std::int32_t before, std::int32_t c, std::uint32_t unseen) {
        return level[unseen == 0 ? c : before] > Real(0);
    };
    const auto next = [&](std::int32_t j, std::int32_t i) {
        return next_marked(&thin, s, j, j, i, s.nx, ThinMark(kLeftClosed | kLowerClosed));
    };
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = next(j, 0); i < s.nx; i = next(j, i + 1)) {
            const std::int32_t c = s.index(i, j);
            const std::uint32_t mark = thin.mark[c];
            Vec2<Real> velocity;
            const Vec2<Real> left{static_cast<Real>(i), static_cast<Real>(j) + kHalf};
            if ((mark & kLeftClosed) != 0 && wet(c - 1, c, mark & kLeftUnseen) &&
                mirrored_face(walls, grid, left, c - 1, c, true, velocity)) {
                grid.u[c] = velocity.x;
            }
            const Vec2<Real> lower{static_cast<Real>(i) + kHalf, static_cast<Real>(j)};
            if ((mark & kLowerClosed) != 0 && wet(c - s.stride, c, mark & kLowerUnseen) &&
                mirrored_face(walls, grid, lower, c - s.stride, c, false, velocity)) {
                grid.v[c] = velocity.y;
            }
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                                             \
    template std::int32_t scatter_past_walls(const Particles<Real>&, const ThinWalls<Real>&, Real, \
                                     StaggeredGrid<Real>&);                                \
    template TransferResult<Real> gather_past_walls(                                       \
        const StaggeredGrid<Real>&, const Transfer<Real>&, const Walls<Real>&,             \
        const DensityOf<Real>*, Vec2<Real>, const Vec2<PositionOf<Real>>*,                 \
        const Vec2<VelocityOf<Real>>*, Particles<Real>&);                                  \
    template void mirror_at_thin_walls(const Walls<Real>&, const LevelOf<Real>*,           \
                                       StaggeredGrid<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
