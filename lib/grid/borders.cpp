#include "grid/borders.hpp"

#include "math/packed_arithmetic.hpp"

namespace weir {

namespace {

/// Ghost mass and momentum along a wall, onto the line before it. Without slip the image moves
/// against the liquid, seen from the wall. `sense`: the axis along which the conveyor runs.
template <class Mass, class Real>
void fold_along(Mass* mass, Real* momentum, const Line& inside, const Line& ghost,
                const SurfaceLaw<Real>& wall, Real sense) {
    const Real slide = sense * wall.conveyor;
    const std::int32_t end = inside.first + inside.count * inside.step;
    std::int32_t from = ghost.first;
    for (std::int32_t to = inside.first; to != end; to += inside.step, from += ghost.step) {
        if constexpr (Stored<Real>::coarse) {
            if (mass[from].raw == 0) {
                continue;  // nor has it momentum
            }
            if (!wall.no_slip) {
                mass[to].raw = short_of(mass[to].raw + mass[from].raw);
                momentum[to] += momentum[from];
                mass[from].raw = 0;
                momentum[from].raw = 0;
                continue;
            }
        }
        const Real image =
            wall.no_slip ? (slide + slide) * mass[from] - momentum[from] : momentum[from];
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

/// Faces on a wall or on the seam: their other half lies beyond.
template <class Real>
void fold_across(Real* field, const Line& low, const Line& high, bool wrap) {
    if (wrap) {
        add(field, low, high);
        copy(field, high, low);
    } else {
        add(field, low, low);
        add(field, high, high);
    }
}
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

/// Cells at a wall of the tank, beside a face and one further from it.
template <class Real>
struct CellsAtWall {
    const LevelOf<Real>* level;
    const Real* pressure;  ///< null: liquid does not part from this wall
    Real hold;             ///< less pressure holds nothing
    std::int32_t inward;   ///< from a cell at the wall to the next one
    bool wet = false;
    bool airy = false;
    bool pressed = false;
    Real light = Real(1);  ///< 1 / density of the liquid at the face

    void look(std::int32_t cell) {
        const bool liquid = level[cell] > LevelOf<Real>(0);
        wet = wet || liquid;
        airy = airy || !liquid;
        pressed = pressed || (liquid && pressure != nullptr && light * pressure[cell] > hold);
    }
    /// Whether liquid with that velocity through the wall goes from it, and nothing holds it there.
    bool parts(VelocityOf<Real> velocity) const {
        const bool away = inward > 0 ? velocity > VelocityOf<Real>(0)
                                     : velocity < VelocityOf<Real>(0);
        return pressure != nullptr && away && airy && !pressed;
    }
};

/// `cell`: from a face on the wall to the cell that it belongs to. The first and last entry of the
/// line are ghosts.
template <class Real>
void close(VelocityOf<Real>* velocity, const VelocityOf<Real>* light, const Line& wall,
           std::int32_t cell, const CellsAtWall<Real>& cells) {
    const LevelOf<Real>* level = cells.level;
    for (std::int32_t k = 1; k + 1 < wall.count; ++k) {
        const std::int32_t face = wall.first + k * wall.step;
        CellsAtWall<Real> around = cells;
        around.light = light != nullptr ? Real(light[face]) : Real(1);
        for (std::int32_t n = k > 1 ? -1 : 0; n <= (k + 2 < wall.count ? 1 : 0); ++n) {
            const std::int32_t at = face + cell + n * wall.step;
            around.look(at);
            around.look(at + cells.inward);
        }
        const bool own = level[face + cell] > LevelOf<Real>(0);
        if (around.wet && !(own && around.parts(velocity[face]))) {
            velocity[face] = VelocityOf<Real>(0);
        }
    }
}

template <class Velocity, class Real>
void mirror_along(Velocity* velocity, const Line& ghost, const Line& inside,
                  const SurfaceLaw<Real>& wall, Real sense) {
    if (!wall.no_slip) {
        copy(velocity, ghost, inside);
        return;
    }
    const Real slide = sense * wall.conveyor;
    for (std::int32_t k = 0; k < ghost.count; ++k) {
        const Real value = velocity[inside.first + k * inside.step];
        velocity[ghost.first + k * ghost.step] = (slide + slide) - value;
    }
}

}  // namespace

template <class Real>
void fold_borders(const Borders<Real>& b, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const std::int32_t right = s.nx - 1;
    const std::int32_t top = s.ny - 1;
    if (b.wrap_y) {
        move(grid.mass_u, row(s, top), row(s, -1));
        move(grid.mass_u, row(s, 0), row(s, s.ny));
        move(grid.momentum_u(), row(s, top), row(s, -1));
        move(grid.momentum_u(), row(s, 0), row(s, s.ny));
    } else {
        fold_along(grid.mass_u, grid.momentum_u(), row(s, 0), row(s, -1), b.bottom, Real(1));
        fold_along(grid.mass_u, grid.momentum_u(), row(s, top), row(s, s.ny), b.top, Real(-1));
    }
    if (b.wrap_x) {
        move(grid.mass_v, column(s, right), column(s, -1));
        move(grid.mass_v, column(s, 0), column(s, s.nx));
        move(grid.momentum_v(), column(s, right), column(s, -1));
        move(grid.momentum_v(), column(s, 0), column(s, s.nx));
    } else {
        fold_along(grid.mass_v, grid.momentum_v(), column(s, 0), column(s, -1), b.left, Real(-1));
        fold_along(grid.mass_v, grid.momentum_v(), column(s, right), column(s, s.nx), b.right,
                   Real(1));
    }
    fold_across(grid.mass_u, grid.momentum_u(), column(s, 0), column(s, s.nx), b.wrap_x);
    fold_across(grid.mass_v, grid.momentum_v(), row(s, 0), row(s, s.ny), b.wrap_y);
}

template <class Real>
void fold_counts(const Borders<Real>& b, const GridShape& s, VelocityOf<Real>* on_u,
                 VelocityOf<Real>* on_v) {
    const std::int32_t right = s.nx - 1;
    const std::int32_t top = s.ny - 1;
    move(on_u, row(s, b.wrap_y ? top : 0), row(s, -1));
    move(on_u, row(s, b.wrap_y ? 0 : top), row(s, s.ny));
    move(on_v, column(s, b.wrap_x ? right : 0), column(s, -1));
    move(on_v, column(s, b.wrap_x ? 0 : right), column(s, s.nx));
    fold_across(on_u, column(s, 0), column(s, s.nx), b.wrap_x);
    fold_across(on_v, row(s, 0), row(s, s.ny), b.wrap_y);
}

template <class Real>
void extend_velocity(const Borders<Real>& b, const GridShape& s, VelocityOf<Real>* u,
                     VelocityOf<Real>* v) {
    if (b.wrap_x) {
        copy(u, column(s, s.nx), column(s, 0));
        copy(v, column(s, s.nx), column(s, 0));
        copy(u, column(s, -1), column(s, s.nx - 1));
        copy(v, column(s, -1), column(s, s.nx - 1));
    } else {
        mirror_along(v, column(s, -1), column(s, 0), b.left, Real(-1));
        mirror_along(v, column(s, s.nx), column(s, s.nx - 1), b.right, Real(1));
    }
    if (b.wrap_y) {
        copy(u, row(s, s.ny), row(s, 0));
        copy(v, row(s, s.ny), row(s, 0));
        copy(u, row(s, -1), row(s, s.ny - 1));
        copy(v, row(s, -1), row(s, s.ny - 1));
    } else {
        mirror_along(u, row(s, -1), row(s, 0), b.bottom, Real(1));
        mirror_along(u, row(s, s.ny), row(s, s.ny - 1), b.top, Real(-1));
    }
}

template <class Real>
void close_walls(const Borders<Real>& b, Vec2<Real> fall, const LevelOf<Real>* level,
                 const Real* pressure, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const Real hold = kHold<Real> * maximum(absolute(fall.x), absolute(fall.y));
    const auto at = [&](std::int32_t inward, Real off) {
        return CellsAtWall<Real>{level, off > Real(0) ? pressure : nullptr, hold, inward};
    };
    if (!b.wrap_x) {
        close(grid.u, grid.inverse_density_u, column(s, 0), 0, at(1, fall.x));
        close(grid.u, grid.inverse_density_u, column(s, s.nx), -1, at(-1, -fall.x));
    }
    if (!b.wrap_y) {
        close(grid.v, grid.inverse_density_v, row(s, 0), 0,
              at(s.stride, fall.y));
        close(grid.v, grid.inverse_density_v, row(s, s.ny), -s.stride,
              at(-s.stride, -fall.y));
    }
}

#define WEIR_INSTANTIATE(Real)                                                           \
    template void fold_borders(const Borders<Real>&, StaggeredGrid<Real>&);              \
    template void fold_counts(const Borders<Real>&, const GridShape&, VelocityOf<Real>*, \
                              VelocityOf<Real>*);                                        \
    template void extend_velocity(const Borders<Real>&, const GridShape&,                \
                                  VelocityOf<Real>*, VelocityOf<Real>*);                 \
    template void close_walls(const Borders<Real>&, Vec2<Real>, const LevelOf<Real>*,    \
                              const Real*, StaggeredGrid<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
