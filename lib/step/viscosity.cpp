#include "step/viscosity.hpp"

#include "grid/diffuse.hpp"
#include "step/no_slip.hpp"

namespace weir {

template <class Real>
void diffuse_velocity(const Borders<Real>& borders, const Walls<Real>& walls,
                      PressureFields<Real>& fields, Real amount, StaggeredGrid<Real>& grid,
                      Work work) {
    const GridShape& s = grid.shape;
    if (walls.sticking) {
        centre_at_walls(walls, fields, grid, work);
    }
    if (work.once(2 * s.border())) {
        extend_velocity(borders, s, grid.u, grid.v);
        mirror_cells(borders, s, fields.density);
    }
    const Part copied = work.take(s.ny + 2, s.nx + 2);
    copy_rows(s, copied, grid.u, fields.divergence);
    copy_rows(s, copied, grid.v, fields.inverse_diagonal);
    const FaceShare<Real> on_u{fields.density, walls.active ? walls.open_u : nullptr, 1};
    const FaceShare<Real> on_v{fields.density, walls.active ? walls.open_v : nullptr, s.stride};
    const Part rows = work.take(s.ny, s.nx);
    diffuse(s, on_u, borders.wrap_x ? 0 : 1, 0, rows, amount, fields.divergence, grid.u);
    diffuse(s, on_v, 0, borders.wrap_y ? 0 : 1, rows, amount, fields.inverse_diagonal, grid.v);
    if (walls.sticking && work.once(s.size())) {
        diffuse_to_walls(walls, fields, amount, grid);
    }
    if (work.once(s.border())) {
        extend_velocity(borders, s, grid.u, grid.v);
    }
}

#define WEIR_INSTANTIATE(Real)                                                             \
    template void diffuse_velocity(const Borders<Real>&, const Walls<Real>&,               \
                                   PressureFields<Real>&, Real, StaggeredGrid<Real>&, Work);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
WEIR_INSTANTIATE(Fixed)
WEIR_INSTANTIATE(SmallFixed)
#undef WEIR_INSTANTIATE

}  // namespace weir
