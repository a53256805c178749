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
void volume_correction(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                       Real gain, PressureFields<Real>& fields, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const Real speed = gain / dt_s;
    Real* e = fields.divergence;
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            e[c] = excess(s, fields, c);
        }
    }
    extend_cells(borders, s, e);
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            if ((i > 0 || borders.wrap_x) && (!walls.active || walls.open_u[c] > Real(0))) {
                grid.u[c] -= speed * (e[c] - e[c - 1]);
            }
            if ((j > 0 || borders.wrap_y) && (!walls.active || walls.open_v[c] > Real(0))) {
                grid.v[c] -= speed * (e[c] - e[c - s.stride]);
            }
        }
    }
}

template void volume_correction(const Borders<float>&, const Walls<float>&, float, float,
                                PressureFields<float>&, StaggeredGrid<float>&);
template void volume_correction(const Borders<double>&, const Walls<double>&, double, double,
                                PressureFields<double>&, StaggeredGrid<double>&);
template void volume_correction(const Borders<Fixed>&, const Walls<Fixed>&, FixedSeconds, Fixed,
                                PressureFields<Fixed>&, StaggeredGrid<Fixed>&);

}  // namespace weir
