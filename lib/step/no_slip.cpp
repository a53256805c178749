#include "step/no_slip.hpp"

#include "grid/diffuse.hpp"
#include "solid/body_force.hpp"
#include "solid/nearest_wall.hpp"

namespace weir {

namespace {

/// Distance to a wall is counted as at least this share of a cell.
template <class Real>
constexpr Real kLeastWay = Real(0.05);

/// Calls visit(i, j, face) for the faces of a component that are no wall of the tank.
template <class Real, class Visit>
void for_each_face(const FaceAxis<Real>& axis, Visit visit) {
    const GridShape& s = axis.s;
    for (std::int32_t j = axis.is_u ? 0 : 1; j < s.ny; ++j) {
        for (std::int32_t i = axis.is_u ? 1 : 0; i < s.nx; ++i) {
            visit(i, j, s.index(i, j));
        }
    }
}

/// Of the velocity at a face as scattered, the share that belongs to the face's own distance:
/// d over the mean distance of what the kernel holds on the wall's open side.
template <class Real>
Real share_at(Real d) {
    if (d <= Real(0)) {
        return Real(0);
    }
    const Real square = d * d;
    const Real mass = (Real(0.5) + d) - Real(0.5) * square;
    const Real lever =
        (Real(1.0 / 6.0) - Real(0.5) * square) + Real(1.0 / 3.0) * (square * d);
    return d / (d + lever / mass);
}

/// Mean of the other component's four faces around a face, of those that are not closed, nor beyond
/// a thin wall. `other(face)` tells their velocity.
template <class Real, class Other>
Real across_at(const FaceAxis<Real>& axis, std::int32_t i, std::int32_t j, Other other,
               bool thin) {
    constexpr Real kHalf = Real(0.5);
    const std::int32_t face = axis.s.index(i, j);
    const std::int32_t back = axis.is_u ? 1 : axis.s.stride;
    const std::int32_t up = axis.is_u ? axis.s.stride : 1;
    const ShareOf<Real>* open = axis.is_u ? axis.walls.open_v : axis.walls.open_u;
    Real sum = Real(0);
    std::int32_t count = 0;
    const Vec2<Real> here = axis.centre(i, j);
    const auto look = [&](std::int32_t at, Real own, Real beside) {
        const Vec2<Real> way = axis.is_u ? Vec2<Real>{own, beside} : Vec2<Real>{beside, own};
        if (open[at] > Real(0) && !(thin && hidden(*axis.walls.thin, axis.s, here, here + way))) {
            sum += other(at);
            ++count;
        }
    };
    look(face, kHalf, -kHalf);
    look(face - back, -kHalf, -kHalf);
    look(face + up, kHalf, kHalf);
    look(face + up - back, -kHalf, kHalf);
    return count > 0 ? part_of(sum, count) : Real(0);
}

/// Calls lessen(face, less) for the faces within a cell of a wall that liquid sticks to, with what
/// they have too much of. `own` and `other` tell velocities as scattered.
template <class Real, class Own, class Other, class Lessen>
void centre_component(const FaceAxis<Real>& axis, Own own, Other other, Lessen lessen) {
    const ShareOf<Real>* open = axis.open();
    for_each_face(axis, [&](std::int32_t i, std::int32_t j, std::int32_t face) {
        const NearestWall<Real> wall(axis, i, j, Real(1));
        if (wall.slot == kNoBody || !(open[face] > Real(0) || wall.thin)) {
            return;
        }
        const Vec2<Real> n = wall.normal;
        const Real d = wall.distance;
        const Vec2<Real> tangent{-n.y, n.x};
        const Real here = own(face);
        const Real there = across_at(axis, i, j, other, wall.thin);
        const Vec2<Real> liquid = axis.is_u ? Vec2<Real>{here, there} : Vec2<Real>{there, here};
        const Vec2<Real> on_wall = axis.centre(i, j) - d * n;
        const Real slip = dot(liquid - axis.wall(wall.slot, on_wall, n), tangent);
        lessen(face, ((Real(1) - share_at(d)) * slip) * axis.of(tangent));
    });
}

/// How the walls around a face pull it.
template <class Real>
struct Pull {
    Real weight = Real(0);       ///< Σ 1/θ
    Real towards = Real(0);      ///< Σ (u_wall + fall)/θ
    Real liquid = Real(0);       ///< Σ of what faces in the liquid pull
    Real beside = Real(0);       ///< and how many they are
    Real turning = Real(0);      ///< Σ of what turning walls are braked by besides
    std::uint16_t slot = kNoBody;
};

template <class Real>
Pull<Real> pull_on(const FaceAxis<Real>& axis, const FaceShare<Real>& share,
                   const VelocityOf<Real>* field, Real fall, std::int32_t i, std::int32_t j,
                   const NearestWall<Real>& wall) {
    const std::int32_t face = axis.s.index(i, j);
    const Real shown = axis.distance(face);
    const Real own = share.at(face);
    const Real here = field[face];
    const Vec2<Real> centre = axis.centre(i, j);
    Pull<Real> pull;
    const auto stop = [&](Vec2<Real> way, Real to_wall, std::uint16_t slot) {
        const Real theta = maximum(to_wall, kLeastWay<Real>);
        const Real stiff = Real(1) / theta;
        // Not the neighbour's normal: on the tank's wall it would ask for nodes beyond.
        pull.weight += stiff;
        const Vec2<Real> goes = axis.wall(slot, centre + theta * way, wall.normal);
        pull.towards += stiff * (axis.of(goes) + fall);
        // Traction on a wall is ∂u/∂n + (∇u)ᵀn; the Laplacian has the first of the two, the
        // second is that of the wall's own rotation.
        pull.turning += (axis.is_u ? -way.y : way.x) * axis.walls.body[slot].spin;
        pull.slot = slot;
    };
    const auto look = [&](std::int32_t di, std::int32_t dj) {
        const Vec2<Real> way{static_cast<Real>(di), static_cast<Real>(dj)};
        if constexpr (kHasThinWalls<Real>) {
            if (wall.thin) {
                const FirstMet<Real> met(*axis.walls.thin, axis.s, centre, centre + way);
                if (met.edge != nullptr) {
                    const std::uint16_t slot = sticking_edge(axis.walls, *met.edge);
                    if (slot != kNoBody) {
                        stop(way, met.part, slot);
                    }
                    return;
                }
            }
        }
        const std::int32_t neighbour = axis.s.index(i + di, j + dj);
        const Real beyond = axis.in_tank(i + di, j + dj) ? axis.distance(neighbour) : Real(1);
        if (beyond > Real(0)) {
            const Real other = share.at(neighbour);
            const Real difference = Real(field[neighbour]) - here;
            const Real part = other < own ? other / own : Real(1);
            pull.liquid += part * difference;
            pull.beside += part;
            return;
        }
        const std::uint16_t slot = axis.sticking(neighbour);
        if (slot != kNoBody) {
            stop(way, shown / (shown - beyond), slot);
        }
    };
    look(-1, 0);
    look(1, 0);
    look(0, -1);
    look(0, 1);
    return pull;
}

/// The turning of a body takes a push, its motion not: around a body such pushes add up to none.
template <class Real>
void brake(const Walls<Real>& walls, std::uint16_t slot, Face<Real> mass, Vec2<Real> place,
           Vec2<Real> lost) {
    if (slot != kNoBody) {
        Impulse<Real>& received = walls.load[slot].received;
        received.angular += mass * cross(convert<Face<Real>>(place) - walls.load[slot].at,
                                         convert<Face<Real>>(lost));
    }
}

template <class Real>
void diffuse_component(const FaceAxis<Real>& axis, const FaceShare<Real>& share, Real amount,
                       Real fall, std::int32_t from, const VelocityOf<Real>* field,
                       VelocityOf<Real>* out) {
    for_each_face(axis, [&](std::int32_t i, std::int32_t j, std::int32_t face) {
        const NearestWall<Real> wall(axis, i, j, kBand<Real>);
        if (wall.slot == kNoBody) {
            return;
        }
        const Real d = wall.distance;
        if ((d <= Real(0) && !wall.thin) || !(share.at(face) > Real(0))) {
            out[face] = field[face];
            return;
        }
        const Pull<Real> pull = pull_on(axis, share, field, fall, i, j, wall);
        const Real unbound = Real(field[face]) + amount * pull.liquid;
        const Real bound = (unbound + amount * pull.towards) /
                           (Real(1) + amount * pull.weight);
        out[face] = changed<Real>(field[face], bound, from);
        if (axis.walls.load != nullptr) {
            // What pulls on faces that are bound to the wall, pulls on the wall.
            const bool is_bound = d < kBoundLayer<Real>;
            const std::uint16_t slot = is_bound ? wall.slot : pull.slot;
            if (slot != kNoBody) {
                const auto mass = static_cast<Face<Real>>(share.at(face));
                const Vec2<Real> place = axis.centre(i, j);
                const Real stiff = amount * (is_bound ? pull.beside : pull.weight);
                const Real yields = is_bound ? stiff : stiff / (Real(1) + stiff);
                receive(axis.walls, slot, mass, place,
                        axis.along(is_bound ? amount * pull.liquid : unbound - bound),
                        mass * static_cast<Face<Real>>(yields));
                brake(axis.walls, pull.slot, mass, place, axis.along(amount * pull.turning));
            }
        }
    });
}

}  // namespace

template <class Real>
void centre_at_walls(const Domain<Real>& domain, Work work) {
    StaggeredGrid<Real>& grid = domain.grid;
    PressureFields<Real>& fields = domain.fields;
    const GridShape& s = grid.shape;
    const Part copied = work.take(s.ny + 2, s.nx + 2);
    copy_rows(s, copied, grid.mass_u, fields.divergence);
    copy_rows(s, copied, grid.mass_v, fields.inverse_diagonal);
    if (work.once(s.size())) {
        const auto centre = [&](bool is_u, const VelocityOf<Real>* own,
                                const VelocityOf<Real>* other, VelocityOf<Real>* velocity,
                                VelocityOf<Real>* before) {
            const auto of = [](const VelocityOf<Real>* field) {
                return [field](std::int32_t face) { return Real(field[face]); };
            };
            centre_component<Real>({s, domain.walls, is_u}, of(own), of(other),
                                   [&](std::int32_t face, Real less) {
                                       velocity[face] = Real(velocity[face]) - less;
                                       before[face] = Real(own[face]) - less;
                                   });
        };
        centre(true, fields.divergence, fields.inverse_diagonal, grid.u, grid.mass_u);
        centre(false, fields.inverse_diagonal, fields.divergence, grid.v, grid.mass_v);
    }
}

template <class Real>
void centre_flow(const FaceAxis<Real>& axis, const VelocityOf<Real>* other_mass,
                 const Real* other_momentum, VelocityOf<Real>* flow) {
    const auto other = [&](std::int32_t face) {
        const Real m = other_mass[face];
        return m > Real(0) ? other_momentum[face] / m : Real(0);
    };
    centre_component<Real>(axis, [&](std::int32_t face) { return Real(flow[face]); }, other,
                           [&](std::int32_t face, Real less) {
                               flow[face] = Real(flow[face]) - less;
                           });
}

template <class Real>
void diffuse_to_walls(const Domain<Real>& domain, Real amount, Vec2<Real> fall,
                      std::int32_t from) {
    const Walls<Real>& walls = domain.walls;
    const PressureFields<Real>& fields = domain.fields;
    const GridShape& s = domain.grid.shape;
    const StaggeredGrid<Real>& grid = domain.grid;
    const FaceShare<Real> on_u{fields.density, nullptr, 1, grid.inverse_density_u};
    const FaceShare<Real> on_v{fields.density, nullptr, s.stride, grid.inverse_density_v};
    diffuse_component<Real>({s, walls, true}, on_u, amount, fall.x, from, fields.divergence,
                            grid.u);
    diffuse_component<Real>({s, walls, false}, on_v, amount, fall.y, from,
                            fields.inverse_diagonal, grid.v);
}

#define WEIR_INSTANTIATE(Real)                                                             \
    template void centre_flow(const FaceAxis<Real>&, const VelocityOf<Real>*, const Real*, \
                              VelocityOf<Real>*);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

#define WEIR_INSTANTIATE(Real)                                \
    template void centre_at_walls(const Domain<Real>&, Work); \
    template void diffuse_to_walls(const Domain<Real>&, Real, Vec2<Real>, std::int32_t);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
