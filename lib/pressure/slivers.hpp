// Slivers of cells beside a contour that a single particle would make liquid.
#pragma once

#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// How cells beside a contour show their density.
template <class Real>
struct CutDensity {
    const ShareOf<Real>* full = nullptr;  ///< what they show when they are full; null: no solids
    Real least = Real(0.02);              ///< a cell that shows less has no density
    Real sliver = Real(1);                ///< one that shows less is filled by one particle
};

/// `empty_lone_slivers`, which worlds without room for bodies do not link.
template <class Real>
using EmptySlivers = void (*)(const StaggeredGrid<Real>&, const Borders<Real>&,
                              const CutDensity<Real>&, std::int32_t, const Part&, LevelOf<Real>*);

/// Mass on a cell's four faces.
template <class Real>
inline Real mass_of_cell(const StaggeredGrid<Real>& grid, std::int32_t c) {
    return (grid.mass_u[c] + grid.mass_u[c + 1]) +
           (grid.mass_v[c] + grid.mass_v[c + grid.shape.stride]);
}

/// What a cell's faces take of one particle at most.
template <class Real>
constexpr Real kMassOfOne = Real(2 * Stored<Real>::particle_mass);

/// Whether there must be several particles around a cell.
template <class Real>
inline bool holds_several(const StaggeredGrid<Real>& grid, std::int32_t c) {
    return mass_of_cell(grid, c) > kMassOfOne<Real>;
}

/// Whether such a cell is beside a cell, be it behind a closed face.
template <class Real>
[[gnu::noinline]] bool beside_several(const StaggeredGrid<Real>& grid,
                                      const Borders<Real>& borders, std::int32_t i,
                                      std::int32_t j) {
    const GridShape& s = grid.shape;
    const auto several = [&](bool inside, std::int32_t n) {
        return inside && holds_several(grid, n);
    };
    const bool left = i > 0;
    const bool right = i + 1 < s.nx;
    const bool lower = j > 0;
    const bool upper = j + 1 < s.ny;
    return several(left || borders.wrap_x, s.index(left ? i - 1 : s.nx - 1, j)) ||
           several(right || borders.wrap_x, s.index(right ? i + 1 : 0, j)) ||
           several(lower || borders.wrap_y, s.index(i, lower ? j - 1 : s.ny - 1)) ||
           several(upper || borders.wrap_y, s.index(i, upper ? j + 1 : 0));
}

#if WEIR_HAS_LANES
/// The first of cells that may be a sliver with liquid, or `end`.
inline std::int32_t skip_wide_or_dry(const CutDensity<float>& cut, const float* level,
                                     std::int32_t c, std::int32_t end) {
    const Lanes sliver = all_lanes(cut.sliver);
    const Lanes zero = all_lanes(0.0F);
    for (; c + 4 <= end; c += 4) {
        if (any_true((load_lanes(cut.full + c) < sliver) & (load_lanes(level + c) > zero))) {
            return c;
        }
    }
    return c;
}
#endif

/// One particle in a sliver is no liquid, unless there are others: closed faces would be mirrored
/// for its sake, from air, and turn what flies by. Cells c … end − 1 of row j.
template <class Real>
void empty_lone_slivers(const StaggeredGrid<Real>& grid, const Borders<Real>& borders,
                        const CutDensity<Real>& cut, std::int32_t j, const Part& cells,
                        LevelOf<Real>* level) {
    const std::int32_t row = grid.shape.index(0, j);
    for (std::int32_t c = cells.first; c < cells.end; ++c) {
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            c = skip_wide_or_dry(cut, level, c, cells.end);
            if (c == cells.end) {
                return;
            }
        }
#endif
        if (Real(cut.full[c]) < cut.sliver && is_positive(Real(level[c])) &&
            !holds_several(grid, c) && !beside_several(grid, borders, c - row, j)) {
            level[c] = kEmptyLevel<Real>;
        }
    }
}

}  // namespace weir
