#include "step/viscosity.hpp"

#include <cstring>

#include "grid/diffuse.hpp"

namespace weir {

template <class Real>
void diffuse_velocity(const Borders<Real>& borders, const Walls<Real>& walls,
                      PressureFields<Real>& fields, Real amount, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    extend_velocity(borders, s, grid.u, grid.v);
    mirror_cells(borders, s, fields.density);
    const std::size_t bytes = static_cast<std::size_t>(s.size()) * sizeof *grid.u;
    std::memcpy(static_cast<void*>(fields.divergence), grid.u, bytes);
    std::memcpy(static_cast<void*>(fields.inverse_diagonal), grid.v, bytes);
    const FaceShare<Real> on_u{fields.density, walls.active ? walls.open_u : nullptr, 1};
    const FaceShare<Real> on_v{fields.density, walls.active ? walls.open_v : nullptr, s.stride};
    diffuse(s, on_u, borders.wrap_x ? 0 : 1, 0, amount, fields.divergence, grid.u);
    diffuse(s, on_v, 0, borders.wrap_y ? 0 : 1, amount, fields.inverse_diagonal, grid.v);
    extend_velocity(borders, s, grid.u, grid.v);
}

template void diffuse_velocity(const Borders<float>&, const Walls<float>&, PressureFields<float>&,
                               float, StaggeredGrid<float>&);
template void diffuse_velocity(const Borders<double>&, const Walls<double>&,
                               PressureFields<double>&, double, StaggeredGrid<double>&);
template void diffuse_velocity(const Borders<Fixed>&, const Walls<Fixed>&, PressureFields<Fixed>&,
                               Fixed, StaggeredGrid<Fixed>&);
template void diffuse_velocity(const Borders<SmallFixed>&, const Walls<SmallFixed>&,
                               PressureFields<SmallFixed>&, SmallFixed, StaggeredGrid<SmallFixed>&);

}  // namespace weir
