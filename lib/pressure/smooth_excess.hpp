// The excess of liquid that sticks to the tank's walls, smoothed.
#pragma once

#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Whether viscous liquid sticks to a wall of the tank.
template <class Real>
inline bool sticks_to_tank(const Borders<Real>& b) {
    return (!b.wrap_y && (b.sticks(b.bottom) || b.sticks(b.top))) ||
           (!b.wrap_x && (b.sticks(b.left) || b.sticks(b.right)));
}

/// Means by ¼ ½ ¼ of liquid cells and those `step` before and behind; what is no liquid, or behind
/// a closed face, is taken to be as the cell itself. `open`: shares of the faces before the cells.
template <bool Solids, class Real>
void smooth_rows(const GridShape& s, const LevelOf<Real>* level, const ShareOf<Real>* open,
                 std::int32_t step, const Part& rows, const VelocityOf<Real>* from,
                 VelocityOf<Real>* to) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const Part columns = s.columns(j);
        const std::int32_t end = s.index(columns.end, j);
        for (std::int32_t c = s.index(columns.first, j); c < end; ++c) {
            const Real here = from[c];
            const auto rise = [&](std::int32_t other, std::int32_t face) {
                const bool counts = is_positive(Real(level[other])) &&
                                    (!Solids || is_positive(Real(open[face])));
                return counts ? Real(from[other]) - here : Real(0);
            };
            to[c] = is_positive(Real(level[c]))
                        ? here + Real(0.25) * (rise(c - step, c) + rise(c + step, c + step))
                        : here;
        }
    }
}

/// A particle's own share of the excess drives it from the middle of a cell to its faces, and off a
/// wall: where liquid sticks and nothing mixes it, all gathers there in rows, which no cell sees.
/// Of means over 3 × 3 cells that is an eighth. They see no line of full cells beside an empty one,
/// either, which strained vortices make: so elsewhere nothing is smoothed.
/// In `divergence`, by way of `inverse_diagonal`.
template <bool Solids, class Real>
void smooth_excess(const Borders<Real>& borders, const Walls<Real>& walls, const GridShape& s,
                   PressureFields<Real>& fields, Work work) {
    const auto smooth = [&](const ShareOf<Real>* open, std::int32_t step, VelocityOf<Real>* from,
                            VelocityOf<Real>* to) {
        if (work.once(s.border())) {
            mirror_cells(borders, s, from);
        }
        work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
            smooth_rows<Solids, Real>(s, fields.level, open, step, rows, from, to);
        });
    };
    smooth(walls.open_u, 1, fields.divergence, fields.inverse_diagonal);
    smooth(walls.open_v, s.stride, fields.inverse_diagonal, fields.divergence);
}

}  // namespace weir
