#include "pressure/equation_of_state.hpp"

namespace weir {

namespace {

/// Bulk viscosity in units of sound speed × cell.
template <class Real>
constexpr Real kBulkViscosity = Real(0.3);

}  // namespace

template <class Real>
void equation_of_state(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                       Real sound_speed, StaggeredGrid<Real>& grid,
                       PressureFields<Real>& fields, Work work) {
    const GridShape& s = grid.shape;
    const Real stiffness = dt_s * sound_speed * sound_speed;
    const Real damping = dt_s * kBulkViscosity<Real> * sound_speed;
    const Part cells = work.take(s.ny, s.nx);
    for (std::int32_t j = cells.first; j < cells.end; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            const Real compression = fields.density[c] - Real(1);
            Real pressure = Real(0);
            if (compression > Real(0)) {
                const Real divergence = (grid.u[c + 1] - grid.u[c]) +
                                        (grid.v[c + s.stride] - grid.v[c]);
                pressure = maximum(Real(0), stiffness * compression - damping * divergence);
            }
            fields.pressure[c] = pressure;
        }
    }
    if (work.once(s.border())) {
        extend_cells(borders, s, fields.pressure);
        fields.last_dt = dt_s;
    }
    const Part faces = work.take(s.ny, s.nx);
    for (std::int32_t j = faces.first; j < faces.end; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            if ((i > 0 || borders.wrap_x) && (!walls.active || walls.open_u[c] > Real(0))) {
                grid.u[c] -= fields.pressure[c] - fields.pressure[c - 1];
            }
            if ((j > 0 || borders.wrap_y) && (!walls.active || walls.open_v[c] > Real(0))) {
                grid.v[c] -= fields.pressure[c] - fields.pressure[c - s.stride];
            }
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                                                     \
    template void equation_of_state(const Borders<Real>&, const Walls<Real>&, Seconds<Real>, Real, \
                                    StaggeredGrid<Real>&, PressureFields<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
