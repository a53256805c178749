#include "pressure/volume_correction.hpp"

namespace weir {

namespace {

template <class Real>
constexpr Real kWindow = Real(1);

/// At the surface the density is that of a few particles: only what exceeds this counts there.
/// Without it the surface of an agitated pool stands 5 % of ten cells too high.
template <class Real>
constexpr Real kSurfaceSlack = Real(0.2);

/// How much too dense a cell is, or too thin where liquid is all around.
template <class Real>
inline Real excess(const GridShape& s, const PressureFields<Real>& f, std::int32_t c) {
    const Real e = f.density[c] - Real(1);
    const auto wet = [&](std::int32_t n) { return f.level[n] > Real(0); };
    if (wet(c) && wet(c - 1) && wet(c + 1) && wet(c - s.stride) && wet(c + s.stride)) {
        return clamp(e, -kWindow<Real>, kWindow<Real>);
    }
    return clamp(e - kSurfaceSlack<Real>, Real(0), kWindow<Real>);
}

}  // namespace

template <class Real>
void volume_correction(StaggeredGrid<Real>& grid, const Walls<Real>& walls, Real dt_s, Real gain,
                       const PressureFields<Real>& fields) {
    const GridShape& s = grid.shape;
    const Real speed = gain / dt_s;
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            const Real here = excess(s, fields, c);
            if (i > 0 && (!walls.active || walls.open_u[c] > Real(0))) {
                grid.u[c] -= speed * (here - excess(s, fields, c - 1));
            }
            if (j > 0 && (!walls.active || walls.open_v[c] > Real(0))) {
                grid.v[c] -= speed * (here - excess(s, fields, c - s.stride));
            }
        }
    }
}

template void volume_correction(StaggeredGrid<float>&, const Walls<float>&, float, float,
                                const PressureFields<float>&);
template void volume_correction(StaggeredGrid<double>&, const Walls<double>&, double, double,
                                const PressureFields<double>&);

}  // namespace weir
