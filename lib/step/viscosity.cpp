#include "step/viscosity.hpp"

#include <cstring>

#include "grid/diffuse.hpp"

namespace weir {

template <class Real>
void diffuse_velocity(const Borders<Real>& borders, PressureFields<Real>& fields, Real amount,
                      StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    extend_velocity(borders, s, grid.u, grid.v);
    const std::size_t bytes = static_cast<std::size_t>(s.size()) * sizeof *grid.u;
    std::memcpy(static_cast<void*>(fields.divergence), grid.u, bytes);
    std::memcpy(static_cast<void*>(fields.inverse_diagonal), grid.v, bytes);
    diffuse(s, fields.level, 1, borders.wrap_x ? 0 : 1, 0, amount, fields.divergence, grid.u);
    diffuse(s, fields.level, s.stride, 0, borders.wrap_y ? 0 : 1, amount,
            fields.inverse_diagonal, grid.v);
    extend_velocity(borders, s, grid.u, grid.v);
}

template void diffuse_velocity(const Borders<float>&, PressureFields<float>&, float,
                               StaggeredGrid<float>&);
template void diffuse_velocity(const Borders<double>&, PressureFields<double>&, double,
                               StaggeredGrid<double>&);
template void diffuse_velocity(const Borders<Fixed>&, PressureFields<Fixed>&, Fixed,
                               StaggeredGrid<Fixed>&);
template void diffuse_velocity(const Borders<SmallFixed>&, PressureFields<SmallFixed>&, SmallFixed,
                               StaggeredGrid<SmallFixed>&);

}  // namespace weir
