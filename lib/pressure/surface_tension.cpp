#include "pressure/surface_tension.hpp"

namespace weir {

namespace {

/// A cell that would see less than this of a full surrounding knows no density.
template <class Real>
constexpr Real kLeastFullDensity = Real(0.02);

/// No grid shows a drop smaller than a cell, 1/cells.
template <class Real>
constexpr Real kSharpest = Real(1);

/// |∇f|² below which there is no surface; at one it is about 0.1.
template <class Real>
constexpr Real kFlat = Real(1.0e-6);

/// One axis of the smoothing, `step` from cell to cell. Deep in a solid nothing is known: its
/// neighbour's own value stands there.
template <class Field, class Real>
void smooth(const GridShape& s, const Walls<Real>& walls, const Part& rows, std::int32_t step,
            const Field* from, VelocityOf<Real>* to) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            const Real here = minimum(Real(from[c]), Real(1));
            const auto at = [&](std::int32_t n, bool inside) {
                const bool unknown =
                    walls.active && inside && walls.full_density[n] < kLeastFullDensity<Real>;
                return unknown ? here : minimum(Real(from[n]), Real(1));
            };
            const bool along_x = step == 1;
            const Real before = at(c - step, along_x ? i > 0 : j > 0);
            const Real after = at(c + step, along_x ? i + 1 < s.nx : j + 1 < s.ny);
            to[c] = Real(0.5) * here + Real(0.25) * (before + after);
        }
    }
}

/// κ = −(fxx fy² − 2 fx fy fxy + fyy fx²) / |∇f|³ at a cell's centre, from its 3 × 3 cells.
template <class Real>
Real curvature(const GridShape& s, const VelocityOf<Real>* f, std::int32_t c) {
    const std::int32_t up = c + s.stride;
    const std::int32_t down = c - s.stride;
    const Real fx = Real(0.5) * (f[c + 1] - f[c - 1]);
    const Real fy = Real(0.5) * (f[up] - f[down]);
    const Real steepness = fx * fx + fy * fy;
    if (!(steepness > kFlat<Real>)) {
        return Real(0);
    }
    const Real fxx = (f[c + 1] + f[c - 1]) - Real(2) * f[c];
    const Real fyy = (f[up] + f[down]) - Real(2) * f[c];
    const Real fxy = Real(0.25) * ((f[up + 1] + f[down - 1]) - (f[up - 1] + f[down + 1]));
    const Real bend = (fxx * fy * fy + fyy * fx * fx) - Real(2) * fx * fy * fxy;
    return clamp(-bend / (steepness * square_root(steepness)), -kSharpest<Real>,
                 kSharpest<Real>);
}

/// Mean curvature of the surface between an air cell and the liquid cells beside it.
template <class Real>
Real surface_curvature(const GridShape& s, const VelocityOf<Real>* f, const LevelOf<Real>* level,
                       std::int32_t air) {
    const std::int32_t around[] = {air - 1, air + 1, air - s.stride, air + s.stride};
    Real sum = Real(0);
    Real count = Real(0);
    Real in_air = Real(0);
    for (const std::int32_t liquid : around) {
        if (!(level[liquid] > Real(0))) {
            continue;
        }
        in_air = count > Real(0) ? in_air : curvature<Real>(s, f, air);
        const Real in_liquid = curvature<Real>(s, f, liquid);
        const Real way = level[liquid] / (level[liquid] - level[air]);
        sum += in_liquid + way * (in_air - in_liquid);
        count += Real(1);
    }
    return count > Real(0) ? sum / count : Real(0);
}

}  // namespace

template <class Real>
void surface_tension(const Domain<Real>& domain, Real amount, Work work) {
    const GridShape& s = domain.grid.shape;
    const Borders<Real>& borders = domain.borders;
    PressureFields<Real>& fields = domain.fields;
    VelocityOf<Real>* f = fields.divergence;
    VelocityOf<Real>* between = fields.inverse_diagonal;
    if (work.once(s.border())) {
        mirror_cells(borders, s, fields.density);
    }
    smooth(s, domain.walls, work.take(s.ny, s.nx), 1, fields.density, between);
    if (work.once(s.border())) {
        mirror_cells(borders, s, between);
    }
    smooth(s, domain.walls, work.take(s.ny, s.nx), s.stride, between, f);
    if (work.once(s.border())) {
        mirror_cells(borders, s, f);
    }
    const Part rows = work.take(s.ny, s.nx);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            if (!(fields.level[c] > Real(0))) {
                fields.pressure[c] = amount * surface_curvature<Real>(s, f, fields.level, c);
            }
        }
    }
    if (work.once(s.border())) {
        extend_cells(borders, s, fields.pressure);
    }
}

template <class Real>
const detail::Tension<Real>& detail::tension() {
    static constexpr Tension<Real> kStage{surface_tension<Real>};
    return kStage;
}

#define WEIR_INSTANTIATE(Real)                                     \
    template const detail::Tension<Real>& detail::tension<Real>(); \
    template void surface_tension(const Domain<Real>&, Real, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
