// What lies beyond the tank: a wall that mirrors the liquid, or the tank's other side.
#pragma once

#include "grid/lines.hpp"
#include "grid/surface_law.hpp"
#include "weir/features.hpp"

namespace weir {

/// Slippery walls mirror the velocity along them; walls without slip turn it round about their
/// own, so that bilinear interpolation meets the wall's velocity on the wall.
template <class Real>
struct Borders {
    bool wrap_x = false;  ///< left and right side are one
    bool wrap_y = false;  ///< bottom and top are one
    bool viscous = false;     ///< the liquid: otherwise nothing sticks
    SurfaceLaw<Real> bottom;  ///< its conveyor runs along x
    SurfaceLaw<Real> right;   ///< along y
    SurfaceLaw<Real> top;     ///< against x
    SurfaceLaw<Real> left;    ///< against y
    const detail::OddBorders<Real>* odd = nullptr;  ///< null: four slippery walls

    bool sticks(const SurfaceLaw<Real>& wall) const { return viscous && wall.no_slip; }
};

/// Whether a wall drags viscous liquid along.
template <class Real>
bool any_wall_drags(const Borders<Real>& borders) {
    const auto drags = [&](const SurfaceLaw<Real>& wall) {
        return borders.sticks(wall) && wall.conveyor != Real(0);
    };
    return drags(borders.bottom) || drags(borders.right) || drags(borders.top) ||
           drags(borders.left);
}

/// Of u, or of v, in tanks that have a seam, or viscous liquid that may stick to a wall.
template <class Real>
struct detail::OddBorders {
    void (*fold_component)(const Borders<Real>& borders, const GridShape& shape, bool is_u,
                           VelocityOf<Real>* mass, Real* momentum);
    void (*extend_component)(const Borders<Real>& borders, const GridShape& shape, bool is_u,
                             VelocityOf<Real>* field);
};

/// After the scatter: ghost rows are folded back onto the rows that they mirror or repeat.
template <class Real>
void fold_borders(const Borders<Real>& borders, StaggeredGrid<Real>& grid);

/// The same for a pair of face fields without momentum.
template <class Real>
void fold_counts(const Borders<Real>& borders, const GridShape& shape,
                 VelocityOf<Real>* on_u, VelocityOf<Real>* on_v);

/// Ghost rows of one component of a velocity take what they mirror or repeat.
template <class Real>
void extend_component(const Borders<Real>& borders, const GridShape& shape, bool is_u,
                      VelocityOf<Real>* field);

/// The same of both, as before a gather.
template <class Real>
void extend_velocity(const Borders<Real>& borders, const GridShape& shape,
                     VelocityOf<Real>* u, VelocityOf<Real>* v);

/// With two liquids: ghost faces are as dense as those that they mirror or repeat.
template <class Real>
void extend_densities(const Borders<Real>& borders, StaggeredGrid<Real>& grid);

/// Ghost cells of a cell field take the tank's other side. Walls: nothing is done.
template <bool Seams = true, class Real, class Field>
inline void extend_cells(const Borders<Real>& b, const GridShape& s, Field* field) {
    if (Seams && (b.wrap_x || b.wrap_y)) {
        fill_ghosts(field, sizeof(Field), s, b.wrap_x, b.wrap_y, true);
    }
}

/// The same, and beyond a wall ghost cells repeat the cell before it.
template <class Real, class Field>
inline void mirror_cells(const Borders<Real>& b, const GridShape& s, Field* field) {
    fill_ghosts(field, sizeof(Field), s, b.wrap_x, b.wrap_y, false);
}

/// Pressure below so much of what lies under a cell of still liquid is what a solve leaves of none.
template <class Real>
inline constexpr Real kHold = Real(0.125);

/// Velocity through the walls is 0 where liquid (level > 0) is at or beside the face's cell. Drops
/// keep theirs: they meet the wall one by one, and bounce as told. Liquid keeps its, too, that
/// gravity takes from a wall, where there is air that may come between and no pressure holds it.
/// @param fall     what gravity gave, cells/s.
/// @param pressure that the last substep found; null: liquid parts from no wall.
template <class Real>
void close_walls(const Borders<Real>& borders, Vec2<Real> fall, const LevelOf<Real>* level,
                 const Real* pressure, StaggeredGrid<Real>& grid);

}  // namespace weir
