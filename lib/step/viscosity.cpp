#include "step/viscosity.hpp"

#include "grid/diffuse.hpp"
#include "solid/face_axis.hpp"
#include "solid/thin_between.hpp"
#include "step/no_slip.hpp"

namespace weir {

namespace {

/// What faces before walls without slip were pulled by their images beyond, the walls were pulled
/// back. Slippery walls' images do not pull.
template <class Real>
void drag_on_tank(const Domain<Real>& domain, const FaceShare<Real>& on_u,
                  const FaceShare<Real>& on_v, Real amount, Impulse<Real>& tank) {
    const GridShape& s = domain.grid.shape;
    const PressureFields<Real>& before = domain.fields;
    const auto pull = [&](const FaceShare<Real>& share, const VelocityOf<Real>* field,
                          std::int32_t face, std::int32_t image) {
        const Real lost = Real(field[face]) - Real(field[image]);
        return static_cast<Face<Real>>(amount * (share.at(face) * lost));
    };
    for (std::int32_t i = 0; i < s.nx && !domain.borders.wrap_y; ++i) {
        const std::int32_t low = s.index(i, 0);
        const std::int32_t high = s.index(i, s.ny - 1);
        tank.linear.x += pull(on_u, before.divergence, low, low - s.stride) +
                         pull(on_u, before.divergence, high, high + s.stride);
    }
    for (std::int32_t j = 0; j < s.ny && !domain.borders.wrap_x; ++j) {
        const std::int32_t left = s.index(0, j);
        const std::int32_t right = s.index(s.nx - 1, j);
        tank.linear.y += pull(on_v, before.inverse_diagonal, left, left - 1) +
                         pull(on_v, before.inverse_diagonal, right, right + 1);
    }
}

/// The images of what sticks to the tank's walls fall along with it: (u − fall) is turned round.
/// What falls past a wall that pulls at it would be a force that no pressure balances: still liquid
/// went round for ever.
template <class Real>
void let_images_fall(const Borders<Real>& b, const GridShape& s, Vec2<Real> fall,
                     StaggeredGrid<Real>& grid) {
    const auto add = [](VelocityOf<Real>* field, std::int32_t first, std::int32_t step,
                        std::int32_t count, Real twice) {
        for (std::int32_t k = 0; k < count; ++k) {
            field[first + k * step] += twice;
        }
    };
    const auto floor = [&](const SurfaceLaw<Real>& wall, std::int32_t j) {
        if (b.sticks(wall) && !b.wrap_y) {
            add(grid.u, s.index(0, j), 1, s.nx, fall.x + fall.x);
        }
    };
    const auto side = [&](const SurfaceLaw<Real>& wall, std::int32_t i) {
        if (b.sticks(wall) && !b.wrap_x) {
            add(grid.v, s.index(i, 0), s.stride, s.ny, fall.y + fall.y);
        }
    };
    floor(b.bottom, -1);
    floor(b.top, s.ny);
    side(b.left, -1);
    side(b.right, s.nx);
}

/// Over what `diffuse` did beside thin walls: liquid on one side does not rub on that of the other.
/// Faces next to those, too: cells that a thin wall cuts look half empty, and are not.
template <class Real>
void diffuse_beside(const ThinWalls<Real>& thin, const GridShape& s, const FaceShare<Real>& share,
                    std::int32_t first_i, std::int32_t first_j, Real amount,
                    const VelocityOf<Real>* field, VelocityOf<Real>* out) {
    const bool on_u = share.back == 1;
    const std::int32_t ways[] = {-1, 1, -s.stride, s.stride};
    for (std::int32_t j = first_j; j < s.ny; ++j) {
        for (std::int32_t i = first_i; i < s.nx; ++i) {
            const std::int32_t face = s.index(i, j);
            std::uint32_t marks = thin.mark[face];
            for (const std::int32_t way : ways) {
                marks |= thin.mark[face + way];
            }
            const Real own = (marks & kNear) != 0 ? share.at(face) : Real(0);
            if (!(own > Real(0))) {
                continue;
            }
            Real sum = Real(0);
            for (const std::int32_t way : ways) {
                if (!separated(thin, s, face, face + way, on_u)) {
                    const Real other = share.at(face + way);
                    const Real difference = Real(field[face + way]) - Real(field[face]);
                    sum += other < own ? difference * (other / own) : difference;
                }
            }
            out[face] = Real(field[face]) + amount * sum;
        }
    }
}

template <bool Solids, class Real>
void diffuse_faces(const Domain<Real>& domain, Real amount, Vec2<Real> fall, Impulse<Real>* tank,
                   Work work) {
    const Borders<Real>& borders = domain.borders;
    const Walls<Real>& walls = domain.walls;
    PressureFields<Real>& fields = domain.fields;
    StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const bool sticking = Solids && walls.sticking != nullptr;
    if (sticking) {
        centre_at_walls(domain, work);
    }
    if (work.once(2 * s.border())) {
        extend_velocity(borders, s, grid.u, grid.v);
        let_images_fall(borders, s, fall, grid);
        mirror_cells(borders, s, fields.density);
        extend_densities(borders, grid);
    }
    const Part copied = work.take(s.ny + 2, s.nx + 2);
    copy_rows(s, copied, grid.u, fields.divergence);
    copy_rows(s, copied, grid.v, fields.inverse_diagonal);
    const bool cut = Solids && walls.active;
    const FaceShare<Real> on_u{fields.density, cut ? walls.open_u : nullptr, 1,
                               grid.inverse_density_u};
    const FaceShare<Real> on_v{fields.density, cut ? walls.open_v : nullptr, s.stride,
                               grid.inverse_density_v};
    const Part rows = work.take(s.ny, s.nx);
    const std::int32_t from = fields.settling ? kNearest : rounded_from(fields.quiet_turn);
    const Rubbing<Real> of_u{on_u, fields.divergence, borders.wrap_x ? 0 : 1, 0, !borders.wrap_y};
    const Rubbing<Real> of_v{on_v, fields.inverse_diagonal, 0, borders.wrap_y ? 0 : 1,
                             !borders.wrap_x};
    diffuse(s, of_u, of_v, rows, amount, from, grid.u);
    diffuse(s, of_v, of_u, rows, amount, from, grid.v);
    if constexpr (Solids && kHasThinWalls<Real>) {
        if (walls.thin != nullptr && work.once(s.size())) {
            diffuse_beside(*walls.thin, s, on_u, 1, 0, amount, fields.divergence, grid.u);
            diffuse_beside(*walls.thin, s, on_v, 0, 1, amount, fields.inverse_diagonal, grid.v);
        }
    }
    if (sticking && work.once(s.size())) {
        diffuse_to_walls(domain, amount, fall, from);
    }
    if (tank != nullptr && work.once(2 * s.border())) {
        drag_on_tank(domain, on_u, on_v, amount, *tank);
    }
    if (work.once(s.border())) {
        extend_velocity(borders, s, grid.u, grid.v);
    }
}

template <class Real>
std::uint16_t sticking_to(const FaceAxis<Real>& axis, std::int32_t face) {
    return axis.sticking(face);
}
template <class Real>
Vec2<Real> velocity_of(const FaceAxis<Real>& axis, std::uint16_t slot, Vec2<Real> place,
                       Vec2<Real> n) {
    return axis.wall(slot, place, n);
}

/// Packed worlds have neither thin walls nor a mass matrix.
template <class Real>
constexpr StickingWalls<Real> sticking_walls() {
    if constexpr (Stored<Real>::coarse) {
        return {sticking_to<Real>, velocity_of<Real>, nullptr, nullptr};
    } else {
        return {sticking_to<Real>, velocity_of<Real>, centre_flow<Real>, bind_to_thin_walls<Real>};
    }
}

}  // namespace

template <bool Solids, class Real>
const detail::Viscosity<Real>& detail::viscosity() {
    static constexpr StickingWalls<Real> kSticking = sticking_walls<Real>();
    static constexpr Viscosity<Real> kStage{diffuse_faces<Solids, Real>,
                                            Solids ? &kSticking : nullptr};
    return kStage;
}

#define WEIR_INSTANTIATE(Real)                                                \
    template const detail::Viscosity<Real>& detail::viscosity<false, Real>(); \
    template const detail::Viscosity<Real>& detail::viscosity<true, Real>();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
