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
    const auto wide = [](Real t, Real moment) {
        const Real half = Real(0.5) * t;
        return Vec2<Real>{half - moment, half + moment};
    };
    Shares<Real> shares;
    Vec2<Real> up[3];
    for (std::int32_t column = 0; column < 3; ++column) {
        up[column] = wide(hats.tx[column], hats.y_tx[column]);
    }
    for (std::int32_t row = 0; row < 3; ++row) {
        const Vec2<Real> across = wide(hats.ty[row], hats.x_ty[row]);
        const auto up_of = [&](std::int32_t column) {
            return row == 1 ? hats.tx[column] : row == 0 ? up[column].x : up[column].y;
        };
        shares.of[row][0] = Real(0.25) * (across.x + up_of(0));
        shares.of[row][1] = Real(0.25) * (hats.ty[row] + up_of(1));
        shares.of[row][2] = Real(0.25) * (across.y + up_of(2));
    }
    return shares;
}

/// Adds the shares of a cell to those of the nine cells around it that are among some.
template <class Real>
void add_within(const GridShape& s, const NodeBox& cells, std::int32_t i, std::int32_t j,
                const Shares<Real>& shares, Walls<Real>& walls) {
    const auto within = [](std::int32_t at, std::int32_t first, std::int32_t last) {
        return first <= at && at <= last;
    };
    std::int32_t column[3];
    std::int32_t first = 0;
    std::int32_t end = 0;
    for (std::int32_t x = 0; x < 3; ++x) {
        column[x] = clamp(i + x - 1, 0, s.nx - 1);
        if (within(column[x], cells.i0, cells.i1)) {
            first = end == 0 ? x : first;
            end = x + 1;
        }
    }
    for (std::int32_t y = 0; y < 3; ++y) {
        const std::int32_t row = clamp(j + y - 1, 0, s.ny - 1);
        if (within(row, cells.j0, cells.j1)) {
            ShareOf<Real>* full = walls.full_density + s.index(0, row);
            for (std::int32_t x = first; x < end; ++x) {
                full[column[x]] = Real(full[column[x]]) + shares.of[y][x];
            }
        }
    }
}

}  // namespace weir
