#include "step/grid_update.hpp"

#include "math/packed_arithmetic.hpp"
#include "math/quotient_packed.hpp"
#include "pressure/equation_of_state.hpp"
#include "pressure/parting.hpp"
#include "pressure/projection.hpp"
#include "solid/thin_between.hpp"
#include "step/extrapolate_lanes.hpp"
#include "step/extrapolate_packed.hpp"
#include "step/face_lanes.hpp"
#include "step/update_m0.hpp"

namespace weir {

namespace {

/// Packed velocities are written over momenta already read.
using AliasedRaw [[gnu::may_alias]] = std::int32_t;

/// The face's momentum, read as bytes. __builtin: a freestanding std::memcpy is a call.
template <class Real>
inline Real momentum_at(const Real* momentum, std::int32_t face) {
    Real value;
    WEIR_COPY_BYTES(&value, momentum + face, sizeof value);
    return value;
}

/// Faces of some rows, from the first one of the tank on.
template <class Visit>
inline void for_each_run_of_faces(const GridShape& s, const Part& rows, Visit visit) {
    for_each_run(s, {rows.first + 1, rows.end + 1}, [&](const Part& run) {
        visit(Part{maximum(run.first, s.index(0, 0)), run.end});
    });
}

/// Ascending, so that a velocity may stand where the momenta of faces before it stood.
template <class Real>
void update(const Real* momentum, VelocityOf<Real>* mass, const Part& faces, Real gained,
            Real unreached, VelocityOf<Real>* velocity) {
    std::int32_t face = faces.first;
    if constexpr (kHasLanes<Real>) {
        face = velocity_lanes(momentum, mass, gained, face, faces.end, velocity);
    }
    for (; face < faces.end; ++face) {
        const Real m = mass[face];
        const Real before =
            m > Real(0) ? momentum_at(momentum, face) / m : unreached;
        mass[face] = m > Real(0) ? reached_velocity(before, unreached) : before;
        velocity[face] = m > Real(0) ? before + gained : Real(0);
    }
}

/// The same in whole numbers: masses are 256ths of a particle, momenta 2^−17.
void update_packed(const SmallFixed* momentum, VelocityOf<SmallFixed>* mass, const Part& faces,
                   SmallFixed gained, VelocityOf<SmallFixed>* velocity) {
    const std::int32_t faster = VelocityOf<SmallFixed>(gained).raw;
    for (std::int32_t face = faces.first; face < faces.end; ++face) {
#if defined(WEIR_LOOPS_OF_M0)
        const auto first = reinterpret_cast<std::uintptr_t>(mass);
        const VelocityOf<SmallFixed>* const next = packed::velocities_of(
            mass + face, mass + faces.end, reinterpret_cast<std::uintptr_t>(momentum) - 2 * first,
            packed::bytes_between(mass, velocity), faster);
        face = static_cast<std::int32_t>(next - mass);
        if (face == faces.end) {
            return;
        }
#endif
        const std::int32_t m = mass[face].raw;
        if (m == 0) {
            velocity[face].raw = 0;
            continue;
        }
        const std::int32_t sum = reinterpret_cast<const AliasedRaw*>(momentum)[face];
        const std::uint32_t divisor = static_cast<std::uint32_t>(m) * 4U;
        const auto size =
            static_cast<std::int32_t>(quotient_of(fixed::magnitude(sum) + divisor / 2U, divisor));
        const std::int32_t before = sum < 0 ? -size : size;
        mass[face].raw = short_of(before);
        velocity[face].raw = short_of(before + faster);
    }
}

/// The same where mass_u counts particles and their mass stands beside it. A face without any is
/// as dense as the first liquid.
template <class Real>
void update_mixed(const Real* momentum, VelocityOf<Real>* volume, VelocityOf<Real>* mass,
                  const Part& faces, Real gained, Real unreached,
                  VelocityOf<Real>* velocity) {
    for (std::int32_t face = faces.first; face < faces.end; ++face) {
        const Real m = mass[face];
        const Real before =
            m > Real(0) ? momentum_at(momentum, face) / m : unreached;
        mass[face] = m > Real(0) ? volume[face] / m : Real(1);
        volume[face] = m > Real(0) ? reached_velocity(before, unreached) : before;
        velocity[face] = m > Real(0) ? before + gained : Real(0);
    }
}

/// One component's faces, for extrapolation.
template <class Real>
struct Component {
    VelocityOf<Real>* velocity;
    const VelocityOf<Real>* light;  ///< 1/density; null: 1 everywhere
    const ShareOf<Real>* open;      ///< open fraction; null: no solids
    std::int32_t back;              ///< from a face to the face before it across its own cells
    std::int32_t first_i;
    std::int32_t first_j;
    const ThinWalls<Real>* thin;    ///< through which nothing goes on; null: there are none
};

/// What a push on liquid does to a face in the air beside it: it makes it as fast as the liquid is
/// by it, or turns it round, and no faster: spray that runs ahead has had its push. What comes
/// through a face that is `open` in part stops it, and speeds it up, beyond the `fall` that gravity
/// gives in a step, by that part: no more liquid is behind it.
template <class Real>
Real push_on_spray(Real push, Real liquid, Real spray, ReachOfPush<Real> most, Real fall,
                   Real open) {
    const Real reach = most.factor * liquid;
    const Real speed = absolute(spray);
    const Real most_up = maximum<Real>(speed, reach) + most.beyond;
    const Real most_down = minimum<Real>(Real(0) - speed, reach) - most.beyond;
    const Real gained = push > Real(0) ? minimum<Real>(push, most_up - spray)
                                       : maximum<Real>(push, most_down - spray);
    const Real stops =
        gained > Real(0) ? minimum<Real>(gained, maximum<Real>(Real(0), fall - spray))
                         : maximum<Real>(gained, minimum<Real>(Real(0), Real(0) - fall - spray));
    return gained - (Real(1) - open) * (gained - stops);
}

template <class Real>
void extrapolate_component(const Component<Real>& component, const PressureFields<Real>& fields,
                           bool velocity_itself, const GridShape& s, const Part& rows) {
    const LevelOf<Real>* level = fields.level;
    const std::int32_t back = component.back;
    const ReachOfPush<Real> reach = reach_of_push(fields);
    const auto height = [&](std::int32_t cell) { return bound_key(Real(level[cell])); };
    const auto wet = [&](std::int32_t face) {
        return height(face) > bound_key(Real(0)) || height(face - back) > bound_key(Real(0));
    };
    // A face that has mass shows in both its cells; one that has none is read by no particle. Of
    // cells without liquid.
    const auto empty = [&](std::int32_t face) {
        const auto depth = [&](std::int32_t cell) { return bound_key(Real(-level[cell])); };
        return depth(face) >= bound_key(Real(-kEmptyLevel<Real>)) ||
               depth(face - back) >= bound_key(Real(-kEmptyLevel<Real>));
    };
    const auto share = [&](std::int32_t face) {
        return component.open != nullptr ? Real(component.open[face]) : Real(1);
    };
    const auto gained = [&](std::int32_t face) {
        const Real rise = pressure_rise(fields, face - back, face, share(face));
        return component.light != nullptr ? Real(component.light[face]) * rise : rise;
    };
    const auto extend = [&](std::int32_t i, std::int32_t j, std::int32_t face) {
        Real sum = Real(0);
        Real count = Real(0);
        const auto take = [&](std::int32_t neighbour) {
            if (share(neighbour) > Real(0) &&
                (component.thin == nullptr ||
                 !separated(*component.thin, s, face, neighbour, back == 1))) {
                const Real liquid = component.velocity[neighbour];
                sum += velocity_itself ? liquid
                                       : push_on_spray(-gained(neighbour), liquid,
                                                       Real(component.velocity[face]), reach,
                                                       fields.cell_weight, share(neighbour));
                count += Real(1);
            }
        };
        const auto look = [&](bool exists, std::int32_t neighbour) {
            if (exists && wet(neighbour)) {
                take(neighbour);
            }
        };
        look(i > component.first_i, face - 1);
        look(i + 1 < s.nx, face + 1);
        look(j > component.first_j, face - s.stride);
        look(j + 1 < s.ny, face + s.stride);
        if (count > Real(0)) {
            const Real mean = sum / count;
            component.velocity[face] =
                velocity_itself ? mean : Real(component.velocity[face]) + mean;
        }
    };
    for (std::int32_t j = maximum(component.first_j, rows.first); j < rows.end; ++j) {
        const std::int32_t row = s.index(0, j);
        const Part columns = s.columns(j);
        std::int32_t face = row + maximum(component.first_i, columns.first);
        if constexpr (kHasLanes<Real>) {
            // Lanes load and store what they leave as it is: not where others are at work.
            const bool amid = (j > rows.first || j == 0) && (j + 1 < rows.end || j + 1 == s.ny);
            if (amid && component.light == nullptr &&
                next_marked(component.thin, s, j - 1, j + 1, 0, s.nx, kNear) == s.nx &&
                extrapolate_lanes({level, fields.pressure, component.open, component.velocity,
                                   back, s.stride, lever_of(fields),
                                   reach, fields.cell_weight, velocity_itself,
                                   j > component.first_j, j + 1 < s.ny, face, row + columns.end})) {
                continue;
            }
        }
        const LevelOf<Real>* const end = level + row + columns.end;
        for (const LevelOf<Real>* at = level + face; at < end; ++at) {
            if (!is_positive(Real(*at))) {  // else it is wet
                face = static_cast<std::int32_t>(at - level);
                if (!wet(face) && !empty(face)) {
                    extend(face - row, j, face);
                }
            }
        }
    }
}

}  // namespace

template <class Real>
void grid_update(const Domain<Real>& domain, Vec2<Real> fall, Work work, Real unreached) {
    StaggeredGrid<Real>& grid = domain.grid;
    const PressureFields<Real>& fields = domain.fields;
    const GridShape& s = grid.shape;
    // One component after the other: packed velocities take the place of momenta.
    const auto component = [&](const Real* momentum, VelocityOf<Real>* mass,
                          VelocityOf<Real>* inverse_density, Real gained,
                          VelocityOf<Real>* velocity) {
        const auto stage = [&](const Part& faces) {
            if constexpr (Stored<Real>::coarse) {
                update_packed(momentum, mass, faces, gained, velocity);
            } else if (inverse_density != nullptr) {
                update_mixed(momentum, mass, inverse_density, faces, gained, unreached,
                             velocity);
            } else {
                update(momentum, mass, faces, gained, unreached, velocity);
            }
        };
        const Part rows = work.take(s.ny + 1, s.nx + 2);
        if constexpr (Stored<Real>::shares_momentum) {
            for_each_run_of_faces(s, rows, stage);
        } else {
            work.share(rows, s.nx + 2, 1, [&](const Part& some, std::int32_t) {
                for_each_run_of_faces(s, some, stage);
            });
        }
    };
    component(grid.momentum_u(), grid.mass_u, grid.inverse_density_u, fall.x, grid.u);
    component(grid.momentum_v(), grid.mass_v, grid.inverse_density_v, fall.y, grid.v);
    if (work.once(s.border())) {
        const Real* pressure = may_part(fields) ? fields.pressure : nullptr;
        close_walls(domain.borders, fall, fields.level, pressure, grid);
    }
}

template <class Real>
void extrapolate(const Domain<Real>& domain, bool velocity_itself, Work work) {
    if constexpr (Stored<Real>::coarse) {
        const detail::Elasticity<Real>* elasticity = domain.fields.elasticity;
        if (elasticity != nullptr) {
            elasticity->extrapolate(domain, velocity_itself, work);
        } else {
            const GridShape& s = domain.grid.shape;
            extrapolate_packed(domain, work.take(s.ny, s.nx));
        }
    } else {
        extrapolate_by_face(domain, velocity_itself, work);
    }
}

template <class Real>
void extrapolate_by_face(const Domain<Real>& domain, bool velocity_itself, Work work) {
    const Borders<Real>& borders = domain.borders;
    const Walls<Real>& walls = domain.walls;
    StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const ShareOf<Real>* open_u = walls.active ? walls.open_u : nullptr;
    const ShareOf<Real>* open_v = walls.active ? walls.open_v : nullptr;
    const Component<Real> u{grid.u, grid.inverse_density_u, open_u,    1, borders.wrap_x ? 0 : 1,
                            0,      walls.thin};
    const Component<Real> v{grid.v,   grid.inverse_density_v,    open_v,
                            s.stride, 0, borders.wrap_y ? 0 : 1, walls.thin};
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        extrapolate_component(u, domain.fields, velocity_itself, s, rows);
        extrapolate_component(v, domain.fields, velocity_itself, s, rows);
    });
}

#define WEIR_INSTANTIATE(Real)                                              \
    template void grid_update(const Domain<Real>&, Vec2<Real>, Work, Real); \
    template void extrapolate(const Domain<Real>&, bool, Work);             \
    template void extrapolate_by_face(const Domain<Real>&, bool, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
