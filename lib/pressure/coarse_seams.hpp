// Seams of a periodic tank on the pressure's coarse grid: what both sides took belongs to both.
#pragma once

#include "grid/borders.hpp"

namespace weir {

/// A seam's faces, and cells beyond it, are those of the other side. `step`: along the seam.
template <class Real>
void join(Real* field, std::int32_t low, std::int32_t high, std::int32_t step,
          std::int32_t count) {
    for (std::int32_t k = 0; k < count; ++k) {
        const Real sum = field[low + k * step] + field[high + k * step];
        field[low + k * step] = sum;
        field[high + k * step] = sum;
    }
}

template <class Real>
void join_faces(const Borders<Real>& borders, const GridShape& big, Real* on_u, Real* on_v) {
    if (borders.wrap_x) {
        join(on_u, big.index(0, 0), big.index(big.nx, 0), big.stride, big.ny);
    }
    if (borders.wrap_y) {
        join(on_v, big.index(0, 0), big.index(0, big.ny), 1, big.nx);
    }
}

/// Of a cell field: what the ghosts took goes to the cells that they stand for.
template <class Real>
void join_cells(const Borders<Real>& borders, const GridShape& big, Real* field) {
    if (borders.wrap_x) {
        join(field, big.index(0, 0), big.index(big.nx, 0), big.stride, big.ny);
        join(field, big.index(-1, 0), big.index(big.nx - 1, 0), big.stride, big.ny);
    }
    if (borders.wrap_y) {
        join(field, big.index(0, 0), big.index(0, big.ny), 1, big.nx);
        join(field, big.index(0, -1), big.index(0, big.ny - 1), 1, big.nx);
    }
}

}  // namespace weir
