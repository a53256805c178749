#include "grid/borders.hpp"

#include "math/packed_arithmetic.hpp"

namespace weir {

namespace {

/// Ghost mass and momentum along a wall, onto the line before it. Without slip the image moves
/// against the liquid, seen from the wall. `sense`: the axis along which the conveyor runs. `Odd`,
/// here and below: borders may be other than slippery walls.
template <bool Odd, class Mass, class Real>
void fold_along(Mass* mass, Real* momentum, const Line& inside, const Line& ghost,
                const Borders<Real>& b, const SurfaceLaw<Real>& wall, Real sense) {
    const bool sticks = Odd && b.sticks(wall);
    const Real slide = sense * wall.conveyor;
    const std::int32_t end = inside.first + inside.count * inside.step;
    std::int32_t from = ghost.first;
    for (std::int32_t to = inside.first; to != end; to += inside.step, from += ghost.step) {
        if constexpr (Stored<Real>::coarse) {
            if (mass[from].raw == 0) {
                continue;  // nor has it momentum
            }
            if (!sticks) {
                mass[to].raw = short_of(mass[to].raw + mass[from].raw);
                momentum[to] += momentum[from];
                mass[from].raw = 0;
                momentum[from].raw = 0;
                continue;
            }
        }
        const Real image = sticks ? (slide + slide) * mass[from] - momentum[from] : momentum[from];
        mass[to] += mass[from];
        momentum[to] += image;
        mass[from] = Mass(0);
        momentum[from] = Real(0);
    }
}

/// Of a line's faces, many of which have none.
void double_masses(VelocityOf<SmallFixed>* mass, SmallFixed* momentum, const Line& line) {
    std::int32_t at = line.first;
    for (std::int32_t k = 0; k < line.count; ++k, at += line.step) {
        if (mass[at].raw != 0) {
            mass[at].raw = short_of(2 * mass[at].raw);
            momentum[at] += momentum[at];
        }
    }
}

/// Faces on a wall or on the seam, as one field's.
template <class Mass, class Real>
void fold_across(Mass* mass, Real* momentum, const Line& low, const Line& high, bool wrap) {
    if constexpr (Stored<Real>::coarse) {
        if (!wrap) {
            double_masses(mass, momentum, low);
            double_masses(mass, momentum, high);
            return;
        }
    }
    fold_across(mass, low, high, wrap);
    fold_across(momentum, low, high, wrap);
}

/// `cell`: from a face on the wall to the cell that it belongs to; `inward`: from there to the
/// next one away from the wall. The first and last entry of the line are ghosts. `stays`: faces
/// that are left as they are.
template <class Velocity, class Level, class Stays>
void close(Velocity* velocity, const Line& wall, const Level* level, std::int32_t cell,
           std::int32_t inward, const Stays& stays) {
    const auto wet = [&](std::int32_t at) {
        return level[at] > Level(0) || level[at + inward] > Level(0);
    };
    for (std::int32_t k = 1; k + 1 < wall.count; ++k) {
        const std::int32_t face = wall.first + k * wall.step;
        const std::int32_t at = face + cell;
        if ((wet(at) || wet(at - wall.step) || wet(at + wall.step)) && !stays(k, face)) {
            velocity[face] = Velocity(0);
        }
    }
}

/// What may part from a wall that gravity takes it from.
template <class Real>
struct Parting {
    const LevelOf<Real>* level;
    const Real* pressure;
    Real hold;  ///< less pressure holds nothing

    /// Of a cell and the next one inward: whether neither holds liquid to the wall. `light`: its
    /// 1 / density. Rare: by itself.
    [[gnu::noinline]] bool is_slack(std::int32_t at, std::int32_t inward, Real light,
                                    bool& airy) const {
        for (const std::int32_t end = at + 2 * inward; at != end; at += inward) {
            const bool wet = level[at] > LevelOf<Real>(0);
            airy = airy || !wet;
            if (wet && light * pressure[at] > hold) {
                return false;
            }
        }
        return true;
    }
};

/// As `close`, but for faces through which liquid parts from the wall.
template <class Real>
[[gnu::noinline]] void close_but_part(VelocityOf<Real>* velocity,
                                      const VelocityOf<Real>* inverse_density, const Line& wall,
                                      std::int32_t cell, std::int32_t inward,
                                      const Parting<Real>& parting) {
    close(velocity, wall, parting.level, cell, inward, [&](std::int32_t k, std::int32_t face) {
        const VelocityOf<Real> v = velocity[face];
        const std::int32_t at = face + cell;
        if (!(inward > 0 ? v > VelocityOf<Real>(0) : v < VelocityOf<Real>(0)) ||
            !(parting.level[at] > LevelOf<Real>(0))) {
            return false;
        }
        const Real light = inverse_density != nullptr ? Real(inverse_density[face]) : Real(1);
        bool airy = false;
        return parting.is_slack(at, inward, light, airy) &&
               (k == 1 || parting.is_slack(at - wall.step, inward, light, airy)) &&
               (k + 2 == wall.count || parting.is_slack(at + wall.step, inward, light, airy)) &&
               airy;
    });
}

template <bool Odd, class Velocity, class Real>
void mirror_along(Velocity* velocity, const Line& ghost, const Line& inside,
                  const Borders<Real>& b, const SurfaceLaw<Real>& wall, Real sense) {
    if (!Odd || !b.sticks(wall)) {
        copy(velocity, ghost, inside);
        return;
    }
    const Real slide = sense * wall.conveyor;
    for (std::int32_t k = 0; k < ghost.count; ++k) {
        const Real value = velocity[inside.first + k * inside.step];
        velocity[ghost.first + k * ghost.step] = (slide + slide) - value;
    }
}

/// Of u, or of v.
template <bool Odd, class Real>
void fold_component(const Borders<Real>& b, const GridShape& s, bool is_u, VelocityOf<Real>* mass,
                    Real* momentum) {
    Line (*const along)(const GridShape&, std::int32_t) = is_u ? row : column;
    Line (*const across)(const GridShape&, std::int32_t) = is_u ? column : row;
    const std::int32_t last = (is_u ? s.ny : s.nx) - 1;
    const Real sense = Real(is_u ? 1 : -1);
    if (Odd && (is_u ? b.wrap_y : b.wrap_x)) {
        move_ghosts(mass, s, along, last, true);
        move_ghosts(momentum, s, along, last, true);
    } else {
        fold_along<Odd>(mass, momentum, along(s, 0), along(s, -1), b, is_u ? b.bottom : b.left,
                        sense);
        fold_along<Odd>(mass, momentum, along(s, last), along(s, last + 1), b,
                        is_u ? b.top : b.right, -sense);
    }
    fold_across(mass, momentum, across(s, 0), across(s, is_u ? s.nx : s.ny),
                Odd && (is_u ? b.wrap_x : b.wrap_y));
}

template <bool Odd, class Real>
void extend_one(const Borders<Real>& b, const GridShape& s, bool is_u, VelocityOf<Real>* field) {
    extend_cells<Odd>(b, s, field);
    if (Odd && (is_u ? b.wrap_y : b.wrap_x)) {
        return;
    }
    Line (*const along)(const GridShape&, std::int32_t) = is_u ? row : column;
    const std::int32_t last = (is_u ? s.ny : s.nx) - 1;
    const Real sense = Real(is_u ? 1 : -1);
    mirror_along<Odd>(field, along(s, -1), along(s, 0), b, is_u ? b.bottom : b.left, sense);
    mirror_along<Odd>(field, along(s, last + 1), along(s, last), b, is_u ? b.top : b.right,
                      -sense);
}

}  // namespace

template <class Real>
const detail::OddBorders<Real>& detail::odd_borders() {
    static constexpr OddBorders<Real> kBorders{fold_component<true, Real>, extend_one<true, Real>};
    return kBorders;
}

template <class Real>
void fold_borders(const Borders<Real>& b, StaggeredGrid<Real>& grid) {
    const auto fold = b.odd != nullptr ? b.odd->fold_component : fold_component<false, Real>;
    fold(b, grid.shape, true, grid.mass_u, grid.momentum_u());
    fold(b, grid.shape, false, grid.mass_v, grid.momentum_v());
}

template <class Real>
void fold_counts(const Borders<Real>& b, const GridShape& s, VelocityOf<Real>* on_u,
                 VelocityOf<Real>* on_v) {
    move_ghosts(on_u, s, row, s.ny - 1, b.wrap_y);
    move_ghosts(on_v, s, column, s.nx - 1, b.wrap_x);
    fold_across(on_u, column(s, 0), column(s, s.nx), b.wrap_x);
    fold_across(on_v, row(s, 0), row(s, s.ny), b.wrap_y);
}

template <class Real>
void extend_component(const Borders<Real>& b, const GridShape& s, bool is_u,
                      VelocityOf<Real>* field) {
    const auto extend = b.odd != nullptr ? b.odd->extend_component : extend_one<false, Real>;
    extend(b, s, is_u, field);
}

template <class Real>
void extend_velocity(const Borders<Real>& b, const GridShape& s, VelocityOf<Real>* u,
                     VelocityOf<Real>* v) {
    extend_component(b, s, true, u);
    extend_component(b, s, false, v);
}

template <class Real>
void extend_densities(const Borders<Real>& b, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const auto extend = [&](VelocityOf<Real>* light, bool is_u) {
        Line (*const along)(const GridShape&, std::int32_t) = is_u ? row : column;
        Line (*const across)(const GridShape&, std::int32_t) = is_u ? column : row;
        const std::int32_t last = (is_u ? s.ny : s.nx) - 1;
        const bool seam = is_u ? b.wrap_y : b.wrap_x;
        copy(light, along(s, -1), along(s, seam ? last : 0));
        copy(light, along(s, last + 1), along(s, seam ? 0 : last));
        if (is_u ? b.wrap_x : b.wrap_y) {
            copy(light, across(s, -1), across(s, (is_u ? s.nx : s.ny) - 1));
        }
    };
    if (!Stored<Real>::shares_momentum && grid.inverse_density_u != nullptr) {
        extend(grid.inverse_density_u, true);
        extend(grid.inverse_density_v, false);
    }
}

/// `off`: what of the fall leads from the wall. By itself: four walls share it.
template <class Real>
[[gnu::noinline]] void close_wall(VelocityOf<Real>* velocity,
                                  const VelocityOf<Real>* inverse_density, const Line& line,
                                  std::int32_t cell, std::int32_t inward, Real off,
                                  const Parting<Real>& parting) {
    if (parting.pressure != nullptr && off > Real(0)) {
        close_but_part(velocity, inverse_density, line, cell, inward, parting);
    } else {
        close(velocity, line, parting.level, cell, inward,
              [](std::int32_t, std::int32_t) { return false; });
    }
}

template <class Real>
void close_walls(const Borders<Real>& b, Vec2<Real> fall, const LevelOf<Real>* level,
                 const Real* pressure, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const Parting<Real> parting{level, pressure,
                                kHold<Real> * larger_part(fall)};
    const auto close_u = [&](std::int32_t i, std::int32_t cell, std::int32_t inward, Real off) {
        close_wall(grid.u, grid.inverse_density_u, column(s, i), cell, inward, off, parting);
    };
    const auto close_v = [&](std::int32_t j, std::int32_t cell, std::int32_t inward, Real off) {
        close_wall(grid.v, grid.inverse_density_v, row(s, j), cell, inward, off, parting);
    };
    if (!b.wrap_x) {
        close_u(0, 0, 1, fall.x);
        close_u(s.nx, -1, -1, -fall.x);
    }
    if (!b.wrap_y) {
        close_v(0, 0, s.stride, fall.y);
        close_v(s.ny, -s.stride, -s.stride, -fall.y);
    }
}

#define WEIR_INSTANTIATE(Real)                                                           \
    template const detail::OddBorders<Real>& detail::odd_borders<Real>();                \
    template void fold_borders(const Borders<Real>&, StaggeredGrid<Real>&);              \
    template void fold_counts(const Borders<Real>&, const GridShape&, VelocityOf<Real>*, \
                              VelocityOf<Real>*);                                        \
    template void extend_densities(const Borders<Real>&, StaggeredGrid<Real>&);          \
    template void extend_velocity(const Borders<Real>&, const GridShape&,                \
                                  VelocityOf<Real>*, VelocityOf<Real>*);                 \
    template void close_walls(const Borders<Real>&, Vec2<Real>, const LevelOf<Real>*,    \
                              const Real*, StaggeredGrid<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

#define WEIR_INSTANTIATE(Real)                                                   \
    template void extend_component(const Borders<Real>&, const GridShape&, bool, \
                                   VelocityOf<Real>*);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
