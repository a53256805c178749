#include "solid/cut_cells.hpp"

#include "contour/marching_squares.hpp"

namespace weir {

namespace {

/// A cell with less room than this is taken as solid: its pressure would be ill determined.
template <class Real>
constexpr Real kSliver = Real(0.02);

/// The cells around a box of nodes, and `more` beyond them.
NodeBox cells_around(const GridShape& shape, const NodeBox& nodes, std::int32_t more) {
    return {maximum(0, nodes.i0 - 1 - more), maximum(0, nodes.j0 - 1 - more),
            minimum(shape.nx - 1, nodes.i1 + more), minimum(shape.ny - 1, nodes.j1 + more)};
}

template <class Real>
struct Corners {
    Real distance[4];
};

template <class Real>
Corners<Real> corners_of(const GridShape& s, const Walls<Real>& walls, std::int32_t cell) {
    const Real* low = walls.distance + cell;
    return {{low[0], low[1], low[s.stride + 1], low[s.stride]}};
}

/// Case and open faces of the cells whose nodes changed.
template <class Real>
void contour_matrix(const GridShape& s, const NodeBox& cells, Walls<Real>& walls) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
            const std::int32_t c = s.index(i, j);
            const Corners<Real> corner = corners_of(s, walls, c);
            const Real* d = corner.distance;
            walls.cell_case[c] = contour_case(d);
            walls.open_u[c] = open_fraction(d[0], d[3]);
            walls.open_u[c + 1] = open_fraction(d[1], d[2]);
            walls.open_v[c] = open_fraction(d[0], d[1]);
            walls.open_v[c + s.stride] = open_fraction(d[3], d[2]);
        }
    }
}

template <class Real>
void open_areas(const GridShape& s, const NodeBox& cells, const Walls<Real>& walls, Real* area) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
            const std::int32_t c = s.index(i, j);
            const Real open = open_area(corners_of(s, walls, c).distance);
            area[c] = open < kSliver<Real> ? Real(0) : open;
        }
    }
}

template <class Real>
void close_slivers(const GridShape& s, const NodeBox& cells, const Real* area,
                   Walls<Real>& walls) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
            const std::int32_t c = s.index(i, j);
            if (area[c] == Real(0)) {
                walls.open_u[c] = Real(0);
                walls.open_u[c + 1] = Real(0);
                walls.open_v[c] = Real(0);
                walls.open_v[c + s.stride] = Real(0);
            }
        }
    }
}

/// The kernel with which particles reach a cell's density, over the open areas around it: what
/// the cell shows when they are full. At the tank's walls the areas are mirrored, as masses are.
template <class Real>
Real full_density(const GridShape& s, const Real* area, std::int32_t i, std::int32_t j) {
    const std::int32_t left = maximum(0, i - 1);
    const std::int32_t right = minimum(s.nx - 1, i + 1);
    const std::int32_t low = maximum(0, j - 1);
    const std::int32_t high = minimum(s.ny - 1, j + 1);
    const auto at = [&](std::int32_t column, std::int32_t row) {
        return area[s.index(column, row)];
    };
    const Real sides = (at(left, j) + at(right, j)) + (at(i, low) + at(i, high));
    const Real corners = (at(left, low) + at(right, low)) + (at(left, high) + at(right, high));
    return Real(0.375) * at(i, j) + (Real(0.125) * sides + Real(0.03125) * corners);
}

}  // namespace

template <class Real>
void update_cut_cells(const GridShape& shape, const NodeBox& nodes, Real* scratch,
                      Walls<Real>& walls) {
    // Changed nodes reach the faces around them, the slivers beside those, and by the density
    // kernel one cell more, for which areas are wanted one further still.
    const NodeBox inner = cells_around(shape, nodes, 1);
    contour_matrix(shape, cells_around(shape, nodes, 0), walls);
    open_areas(shape, cells_around(shape, nodes, 2), walls, scratch);
    close_slivers(shape, inner, scratch, walls);
    for (std::int32_t j = inner.j0; j <= inner.j1; ++j) {
        for (std::int32_t i = inner.i0; i <= inner.i1; ++i) {
            walls.full_density[shape.index(i, j)] = full_density(shape, scratch, i, j);
        }
    }
}

template void update_cut_cells(const GridShape&, const NodeBox&, float*, Walls<float>&);
template void update_cut_cells(const GridShape&, const NodeBox&, double*, Walls<double>&);
template void update_cut_cells(const GridShape&, const NodeBox&, Fixed*, Walls<Fixed>&);

}  // namespace weir
