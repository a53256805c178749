#include "pressure/volume_correction.hpp"

namespace weir {

namespace {

template <class Real>
constexpr Real kWindow = Real(1);

/// How much too dense a cell is.
template <class Real>
inline Real excess(Real density) {
    return clamp(density - Real(1), Real(0), kWindow<Real>);
}

}  // namespace

template <class Real>
void volume_correction(StaggeredGrid<Real>& grid, const Walls<Real>& walls, Real dt_s, Real gain,
                       const PressureFields<Real>& fields) {
    const GridShape& s = grid.shape;
    const Real speed = gain / dt_s;
    const Real* density = fields.density;
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            const Real here = excess(density[c]);
            if (i > 0 && (!walls.active || walls.open_u[c] > Real(0))) {
                grid.u[c] -= speed * (here - excess(density[c - 1]));
            }
            if (j > 0 && (!walls.active || walls.open_v[c] > Real(0))) {
                grid.v[c] -= speed * (here - excess(density[c - s.stride]));
            }
        }
    }
}

template void volume_correction(StaggeredGrid<float>&, const Walls<float>&, float, float,
                                const PressureFields<float>&);
template void volume_correction(StaggeredGrid<double>&, const Walls<double>&, double, double,
                                const PressureFields<double>&);

}  // namespace weir
