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
    Real rest_count = Real(1);            ///< particles a cell
    Real sliver = Real(1);                ///< 1 / rest_count: what is less, one particle fills
};

/// Mass on a cell's four faces.
template <class Real>
inline Real mass_of_cell(const StaggeredGrid<Real>& grid, std::int32_t c) {
    return (grid.mass_u[c] + grid.mass_u[c + 1]) +
           (grid.mass_v[c] + grid.mass_v[c + grid.shape.stride]);
}

/// What a cell's faces take of one particle at most.
template <class Real>
constexpr Real kMassOfOne = Real(2 * Stored<Real>::particle_mass);

/// Whether a cell is liquid that several particles make.
template <class Real>
inline bool several_make_liquid(const StaggeredGrid<Real>& grid, const CutDensity<Real>& cut,
                                std::int32_t c) {
    const Real mass = mass_of_cell(grid, c);
    const Real half_full = kMassOfOne<Real> * (cut.rest_count * Real(cut.full[c]));
    return mass > kMassOfOne<Real> && mass > half_full;
}

/// Whether such a cell is beside a cell. Also behind a closed face: a cell within the solid shows
/// what stands in front of it, and its faces are mirrored for that.
template <class Real>
[[gnu::noinline]] bool beside_several(const StaggeredGrid<Real>& grid, const Borders<Real>& borders,
                                      const CutDensity<Real>& cut, std::int32_t i,
                                      std::int32_t j) {
    const GridShape& s = grid.shape;
    const auto liquid = [&](bool inside, std::int32_t n) {
        return inside && several_make_liquid(grid, cut, n);
    };
    const bool left = i > 0;
    const bool right = i + 1 < s.nx;
    const bool lower = j > 0;
    const bool upper = j + 1 < s.ny;
    return liquid(left || borders.wrap_x, s.index(left ? i - 1 : s.nx - 1, j)) ||
           liquid(right || borders.wrap_x, s.index(right ? i + 1 : 0, j)) ||
           liquid(lower || borders.wrap_y, s.index(i, lower ? j - 1 : s.ny - 1)) ||
           liquid(upper || borders.wrap_y, s.index(i, upper ? j + 1 : 0));
}

/// One particle in a sliver is no liquid, unless there is liquid beside it: closed faces would be
/// mirrored for its sake, from air, and turn what flies by. Cells c … end − 1 of row j.
template <class Real>
[[gnu::noinline]] void empty_lone_slivers(const StaggeredGrid<Real>& grid,
                                          const Borders<Real>& borders,
                                          const CutDensity<Real>& cut, std::int32_t j,
                                          const Part& cells, LevelOf<Real>* level) {
    const std::int32_t row = grid.shape.index(0, j);
    for (std::int32_t c = cells.first; c < cells.end; ++c) {
        if (Real(cut.full[c]) < cut.sliver && is_positive(Real(level[c])) &&
            !(mass_of_cell(grid, c) > kMassOfOne<Real>) &&
            !beside_several(grid, borders, cut, c - row, j)) {
            level[c] = kEmptyLevel<Real>;
        }
    }
}

}  // namespace weir
