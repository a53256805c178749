#include "step/viscosity.hpp"

#include <cstring>

namespace weir {

namespace {

/// One component. `back`: from a face to the cell before it; `first_i`, `first_j`: first face that
/// is no wall. Ghost lines have been extended; across them the velocity counts whatever the cell.
template <class Real>
void diffuse(const GridShape& s, const Real* level, std::int32_t back, std::int32_t first_i,
             std::int32_t first_j, Real amount, const Real* velocity, Real* out) {
    constexpr Real kDry = Real(-1.5);
    const auto wet = [&](std::int32_t i, std::int32_t j) {
        if (i < 0 || i >= s.nx || j < 0 || j >= s.ny) {
            return true;
        }
        const std::int32_t face = s.index(i, j);
        return level[face] > kDry && level[face - back] > kDry;
    };
    for (std::int32_t j = first_j; j < s.ny; ++j) {
        for (std::int32_t i = first_i; i < s.nx; ++i) {
            const std::int32_t face = s.index(i, j);
            if (!wet(i, j)) {
                continue;
            }
            const Real here = velocity[face];
            const auto pull = [&](std::int32_t di, std::int32_t dj) {
                return wet(i + di, j + dj) ? velocity[face + dj * s.stride + di] - here : Real(0);
            };
            out[face] = here + amount * ((pull(-1, 0) + pull(1, 0)) + (pull(0, -1) + pull(0, 1)));
        }
    }
}

}  // namespace

template <class Real>
void diffuse_velocity(const Borders<Real>& borders, PressureFields<Real>& fields, Real amount,
                      StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    extend_velocity(borders, s, grid.u, grid.v);
    const std::size_t bytes = static_cast<std::size_t>(s.size()) * sizeof(Real);
    std::memcpy(fields.divergence, grid.u, bytes);
    std::memcpy(fields.inverse_diagonal, grid.v, bytes);
    diffuse(s, fields.level, 1, borders.wrap_x ? 0 : 1, 0, amount, fields.divergence, grid.u);
    diffuse(s, fields.level, s.stride, 0, borders.wrap_y ? 0 : 1, amount,
            fields.inverse_diagonal, grid.v);
    extend_velocity(borders, s, grid.u, grid.v);
}

template void diffuse_velocity(const Borders<float>&, PressureFields<float>&, float,
                               StaggeredGrid<float>&);
template void diffuse_velocity(const Borders<double>&, PressureFields<double>&, double,
                               StaggeredGrid<double>&);

}  // namespace weir
