// What the loops over cut cells are made of.
#pragma once

#include "contour/marching_squares.hpp"
#include "contour/raster.hpp"
#include "solid/walls.hpp"

namespace weir {

/// A cell with less room than this is taken as solid: its pressure would be ill determined.
template <class Real>
inline constexpr Real kSliver = Real(0.02);

/// Of a cell's density, what another over a corner of it adds if it is full.
template <class Real>
inline constexpr Real kCornerShare = Real(0.03125);

template <class Real>
struct Corners {
    Real distance[4];
};

template <class Real>
Corners<Real> corners_of(const GridShape& s, const Walls<Real>& walls, std::int32_t cell) {
    const DistanceOf<Real>* low = walls.distance + cell;
    return {{low[0], low[1], low[s.stride + 1], low[s.stride]}};
}

inline constexpr std::uint8_t kOpen = 0;
inline constexpr std::uint8_t kSolid = 15;

constexpr bool is_cut(std::uint8_t solid_nodes) {
    return solid_nodes != kOpen && solid_nodes != kSolid;
}

/// Of a cut cell: one node is in the solid, and half of the cell at least is open.
constexpr bool is_roomy(std::uint8_t solid_nodes) {
    return (solid_nodes & (solid_nodes - 1U)) == 0;
}

template <class Real>
void close_faces(const GridShape& s, std::int32_t c, Walls<Real>& walls) {
    walls.open_u[c] = Real(0);
    walls.open_u[c + 1] = Real(0);
    walls.open_v[c] = Real(0);
    walls.open_v[c + s.stride] = Real(0);
}

/// Kernel of the nine cells around one over its liquid, by row and column. With t the hat function
/// of a cell's width and h(x) = t(x − ½) + t(x + ½) it is ¼ [h(x) t(y) + t(x) h(y)].
template <class Real>
struct Shares {
    Real of[3][3];
};

/// Hats of the three columns over the liquid, and of the rows; then with the other coordinate.
template <class Real>
struct Hats {
    Real tx[3];
    Real ty[3];
    Real y_tx[3];
    Real x_ty[3];

    explicit Hats(const OpenMoments<Real>& m)
        : tx{m.upper.x - m.first.x, m.area - ((m.upper.x + m.upper.x) - m.first.x), m.upper.x},
          ty{m.upper.y - m.first.y, m.area - ((m.upper.y + m.upper.y) - m.first.y), m.upper.y},
          y_tx{m.y_right - m.product, m.first.y - ((m.y_right + m.y_right) - m.product),
               m.y_right},
          x_ty{m.x_above - m.product, m.first.x - ((m.x_above + m.x_above) - m.product),
               m.x_above} {}
};

template <class Real>
Shares<Real> kernel_shares(const Hats<Real>& hats) {
    const auto wide = [](Real t, Real moment, std::int32_t k) {
        return k == 1 ? t : Real(0.5) * t + (k == 0 ? -moment : moment);
    };
    Shares<Real> shares;
    for (std::int32_t row = 0; row < 3; ++row) {
        for (std::int32_t column = 0; column < 3; ++column) {
            shares.of[row][column] = Real(0.25) * (wide(hats.ty[row], hats.x_ty[row], column) +
                                                   wide(hats.tx[column], hats.y_tx[column], row));
        }
    }
    return shares;
}

/// Adds the shares of a cell to those of the nine cells around it that are among some.
template <class Real>
void add_within(const GridShape& s, const NodeBox& cells, std::int32_t i, std::int32_t j,
                const Shares<Real>& shares, Walls<Real>& walls) {
    for (std::int32_t y = 0; y < 3; ++y) {
        const std::int32_t row = clamp(j + y - 1, 0, s.ny - 1);
        for (std::int32_t x = 0; row >= cells.j0 && row <= cells.j1 && x < 3; ++x) {
            const std::int32_t column = clamp(i + x - 1, 0, s.nx - 1);
            if (column >= cells.i0 && column <= cells.i1) {
                ShareOf<Real>& full = walls.full_density[s.index(column, row)];
                full = Real(full) + shares.of[y][x];
            }
        }
    }
}

}  // namespace weir
