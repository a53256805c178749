// A particle that a wall stops goes on along it. Flow around a corner leads what is beside it into
// the wall, step by step: it stood there for ever, and the flow, of which hundreds were missing,
// became a jet.
#pragma once

#include "fluid/particles.hpp"
#include "solid/first_entry.hpp"

namespace weir {

/// Where a particle is put: this far in front of the wall, so that it is not found behind it again.
template <class Real>
inline constexpr Real kClearance = Real(Stored<Real>::coarse ? 1.0 / 64.0 : 1.0 / 1024.0);

/// Normal of the line behind which a place is. That of the distance leans to it near corners.
template <class Real>
Vec2<Real> line_normal(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> behind) {
    const auto ask = [behind](const GridShape& s, const Walls<Real>& w) {
        const CellView<Real> cell = cell_of(s, w, behind);
        return hit_in(cell, w.cell_case[cell.node]).normal;
    };
    return all_stored(walls) ? ask(shape, walls) : in_window(shape, walls, behind, ask);
}

/// Where a particle gets along the line that stopped it, with what was left of its way.
template <class Real>
[[gnu::noinline, gnu::cold]] Vec2<Real> slide(const GridShape& shape, const Walls<Real>& walls,
                                              const Entry<Real>& entry, Vec2<Real> to) {
    const Vec2<Real> normal = line_normal(shape, walls, entry.behind);
    const Vec2<Real> rest = to - entry.place;
    const Vec2<Real> along = rest + (kClearance<Real> - Real(dot(rest, normal))) * normal;
    const Vec2<Real> end = as_kept(within_tank(shape, entry.place + along));
    const Entry<Real> next = first_entry(shape, walls, entry.place, end);
    return next.found ? next.place : end;
}

}  // namespace weir
