#include "solid/cut_cells.hpp"

#include "contour/marching_squares.hpp"
#include "solid/cut_cells_lanes.hpp"

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
    const DistanceOf<Real>* low = walls.distance + cell;
    return {{low[0], low[1], low[s.stride + 1], low[s.stride]}};
}

constexpr std::uint8_t kOpen = 0;
constexpr std::uint8_t kSolid = 15;

constexpr bool is_cut(std::uint8_t solid_nodes) {
    return solid_nodes != kOpen && solid_nodes != kSolid;
}

/// Cases of the cells whose nodes changed, and the faces around them.
template <class Real>
void contour_matrix(const GridShape& s, const NodeBox& cells, Walls<Real>& walls) {
    const DistanceOf<Real>* d = walls.distance;
    // The bits of a node and of the one above it, as they stand on the left side of a case.
    const auto side = [&](std::int32_t node) {
        return (d[node] <= Real(0) ? 1U : 0U) | (d[node + s.stride] <= Real(0) ? 8U : 0U);
    };
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        std::int32_t c = s.index(cells.i0, j);
        const std::int32_t end = s.index(cells.i1 + 1, j);
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            c = contour_fours(s.stride, c, end, walls);
        }
#endif
        std::uint32_t left = side(c);
        for (; c < end; ++c) {
            const std::uint32_t right = side(c + 1);
            const auto solid_nodes =
                static_cast<std::uint8_t>(left | (right & 1U) << 1U | (right & 8U) >> 1U);
            walls.cell_case[c] = solid_nodes;
            const bool cut = is_cut(solid_nodes);
            const Real whole = Real(solid_nodes == kOpen ? 1 : 0);
            walls.open_u[c] = cut ? open_fraction<Real>(d[c], d[c + s.stride]) : whole;
            walls.open_v[c] = cut ? open_fraction<Real>(d[c], d[c + 1]) : whole;
            left = right;
        }
        walls.open_u[c] = open_fraction<Real>(d[c], d[c + s.stride]);
    }
    const std::int32_t top = s.index(cells.i1, cells.j1 + 1);
    for (std::int32_t c = s.index(cells.i0, cells.j1 + 1); c <= top; ++c) {
        walls.open_v[c] = open_fraction<Real>(d[c], d[c + 1]);
    }
}

/// visit(i, j) for the cut ones of some cells, row by row.
template <class Real, class Visit>
void for_each_cut(const GridShape& s, const NodeBox& cells, const Walls<Real>& walls,
                  Visit visit) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        const std::uint8_t* row = walls.cell_case + s.index(0, j);
        for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
#if WEIR_HAS_LANES
            if (i + 3 <= cells.i1 && !any_cut(row + i)) {
                i += 3;
                continue;
            }
#endif
            if (is_cut(row[i])) {
                visit(i, j);
            }
        }
    }
}

/// Whether cut cells add to the cells around them what the kernel finds in them, exactly. Else the
/// liquid in a cut cell is taken for spread evenly. In packed worlds sums of shares of 1/128 would
/// be no better.
template <class Real>
constexpr bool kExactShares = !Stored<Real>::coarse;

template <class Real>
void close_faces(const GridShape& s, std::int32_t c, Walls<Real>& walls) {
    walls.open_u[c] = Real(0);
    walls.open_u[c + 1] = Real(0);
    walls.open_v[c] = Real(0);
    walls.open_v[c + s.stride] = Real(0);
}

template <class Real>
void open_areas(const GridShape& s, const NodeBox& cells, const Walls<Real>& walls,
                VelocityOf<Real>* area) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        const std::int32_t last = s.index(cells.i1, j);
        for (std::int32_t c = s.index(cells.i0, j); c <= last; ++c) {
            const std::uint8_t solid_nodes = walls.cell_case[c];
            area[c] = Real(solid_nodes == kOpen ? 1 : 0);
            if (is_cut(solid_nodes)) {
                const Real open = open_area(corners_of(s, walls, c).distance);
                area[c] = open < kSliver<Real> ? Real(0) : open;
            }
        }
    }
}

template <class Real>
void close_slivers(const GridShape& s, const NodeBox& cells, const VelocityOf<Real>* area,
                   Walls<Real>& walls) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        const std::int32_t last = s.index(cells.i1, j);
        for (std::int32_t c = s.index(cells.i0, j); c <= last; ++c) {
            if (area[c] == Real(0) && walls.cell_case[c] != kSolid) {
                close_faces(s, c, walls);
            }
        }
    }
}

/// The kernel with which particles reach a cell's density, over the whole of a cell by another.
template <class Real>
constexpr Real kOwnShare = Real(0.375);
template <class Real>
constexpr Real kSideShare = Real(0.125);
template <class Real>
constexpr Real kCornerShare = Real(0.03125);

/// The same over the open areas of the nine cells around one. At the tank's walls the cells are
/// mirrored, as masses are.
template <class Real>
Real kernel_over(const GridShape& s, std::int32_t i, std::int32_t j, const VelocityOf<Real>* area) {
    const std::int32_t left = maximum(0, i - 1);
    const std::int32_t right = minimum(s.nx - 1, i + 1);
    const std::int32_t low = maximum(0, j - 1);
    const std::int32_t high = minimum(s.ny - 1, j + 1);
    const auto at = [&](std::int32_t column, std::int32_t row) -> Real {
        return area[s.index(column, row)];
    };
    const Real sides = (at(left, j) + at(right, j)) + (at(i, low) + at(i, high));
    const Real corners = (at(left, low) + at(right, low)) + (at(left, high) + at(right, high));
    return kOwnShare<Real> * at(i, j) + (kSideShare<Real> * sides + kCornerShare<Real> * corners);
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

/// Cut cells in and around some cells add theirs to them.
template <class Real>
void add_cut_cells(const GridShape& s, const NodeBox& cells, Walls<Real>& walls) {
    const NodeBox around{maximum(0, cells.i0 - 1), maximum(0, cells.j0 - 1),
                         minimum(s.nx - 1, cells.i1 + 1), minimum(s.ny - 1, cells.j1 + 1)};
    for_each_cut(s, around, walls, [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        const Hats<Real> hats(open_moments(corners_of(s, walls, c).distance));
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            if (i > cells.i0 && i < cells.i1 && j > cells.j0 && j < cells.j1) {
                add_shares(hats.tx, hats.ty, hats.y_tx, hats.x_ty, s.stride,
                           walls.full_density + c);
                return;
            }
        }
#endif
        const Shares<Real> shares = kernel_shares(hats);
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
    });
}

/// Cases of a cell and the ones below and above it, joined, and how many of them are open.
struct Column {
    std::uint32_t any;
    std::uint32_t all;
    std::int32_t own;
    std::int32_t ends;
};

/// Density that a cell shows when all around it is full: without the cut cells if they add theirs.
template <class Real>
Real full_density(const GridShape& s, const VelocityOf<Real>* area, std::int32_t i,
                  std::int32_t j, const Column& left, const Column& middle,
                  const Column& right) {
    if constexpr (kExactShares<Real>) {
        // Shares of the kernel are so many 32nds.
        const std::int32_t sides = (left.own + right.own) + middle.ends;
        return kCornerShare<Real> *
               static_cast<Real>(12 * middle.own + 4 * sides + (left.ends + right.ends));
    }
    return kernel_over<Real>(s, i, j, area);
}

/// Whether the mirror writes the face between two nodes: it is closed and not too deep, or the
/// liquid may stick near it.
template <class Real>
bool is_mirrored(const Walls<Real>& walls, Real open, std::int32_t a, std::int32_t b) {
    const Real distance = Real(0.5) * (Real(walls.distance[a]) + Real(walls.distance[b]));
    return open > Real(0) ? distance < kBoundLayer<Real> && sticking_body(walls, a, b) != kNoBody
                          : !(distance < kDeepestMirror<Real>);
}

/// What is around cells i0 … i1 of a row.
template <class Real>
void look_around_row(const GridShape& s, std::int32_t j, std::int32_t i0, std::int32_t i1,
                     const VelocityOf<Real>* area, bool thin, Walls<Real>& walls) {
    const std::int32_t below = j > 0 ? -s.stride : 0;
    const std::int32_t above = j + 1 < s.ny ? s.stride : 0;
    const auto column = [&](std::int32_t i) {
        const std::uint8_t* at = walls.cell_case + s.index(clamp(i, 0, s.nx - 1), j);
        const std::uint32_t low = at[below];
        const std::uint32_t here = at[0];
        const std::uint32_t high = at[above];
        const auto open = [](std::uint32_t nodes) { return nodes == kOpen ? 1 : 0; };
        return Column{low | here | high, low & here & high, open(here), open(low) + open(high)};
    };
    Column left = column(i0 - 1);
    Column middle = column(i0);
    for (std::int32_t i = i0; i <= i1; ++i) {
        const Column right = column(i + 1);
        const std::uint32_t any = left.any | middle.any | right.any;
        const bool near = any != kOpen && (left.all & middle.all & right.all) != kSolid;
        const std::int32_t c = s.index(i, j);
        walls.full_density[c] = near ? full_density<Real>(s, area, i, j, left, middle, right)
                                     : Real(any == kOpen ? 1 : 0);
        mark_near(walls, s, i, j,
                  near && (thin || is_mirrored<Real>(walls, walls.open_u[c], c, c + s.stride) ||
                           is_mirrored<Real>(walls, walls.open_v[c], c, c + 1)));
        left = middle;
        middle = right;
    }
}

#if WEIR_HAS_LANES

/// The same four at a time, away from the tank's walls. Returns the next cell to do.
std::int32_t look_around_fours(const GridShape& s, std::int32_t j, std::int32_t i0,
                               std::int32_t i1, bool thin, Walls<float>& walls) {
    std::int32_t i = i0;
    const std::int32_t below = j > 0 ? -s.stride : 0;
    const std::int32_t above = j + 1 < s.ny ? s.stride : 0;
    const std::int32_t last = minimum(i1, s.nx - 2);
    for (; i <= last && last - 3 >= i0; i += 4) {
        i = minimum(i, last - 3);  // some twice
        const std::int32_t c = s.index(i, j);
        const FourAround around = around_four(walls.cell_case + c, below, above);
        store_lanes(walls.full_density + c, all_lanes(kCornerShare<float>) * around.in_32nds);
        std::uint32_t near = around.near;
        if (near != 0 && !thin) {
            const FourMirrored u = mirrored_of_four(walls.open_u + c, walls.distance + c, s.stride);
            const FourMirrored v = mirrored_of_four(walls.open_v + c, walls.distance + c, 1);
            std::uint32_t mirrored = u.closed | v.closed;
            for (std::int32_t k = 0; k < 4; ++k) {
                const auto has = [&](std::uint32_t bits, std::int32_t to_other) {
                    return (bits >> static_cast<std::uint32_t>(k) & 1U) != 0 &&
                           sticking_body(walls, c + k, c + k + to_other) != kNoBody;
                };
                if (has(near & u.beside, s.stride) || has(near & v.beside, 1)) {
                    mirrored |= 1U << static_cast<std::uint32_t>(k);
                }
            }
            near &= mirrored;
        }
        mark_four(walls, s, i, j, near);
    }
    return i;
}

#endif

/// What is around a cell: full densities, and whether a face of it is mirrored. Where thin walls
/// may close faces, all cells near a wall count.
template <class Real>
void look_around(const GridShape& s, const NodeBox& cells, const VelocityOf<Real>* area, bool thin,
                 Walls<Real>& walls) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        std::int32_t i = cells.i0;
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            if (i == 0) {
                look_around_row<Real>(s, j, 0, 0, area, thin, walls);
                ++i;
            }
            i = look_around_fours(s, j, i, cells.i1, thin, walls);
        }
#endif
        if (i <= cells.i1) {
            look_around_row<Real>(s, j, i, cells.i1, area, thin, walls);
        }
    }
}

}  // namespace

template <class Real>
void update_cut_cells(const GridShape& shape, const NodeBox& nodes, const Rim& rim, bool thin,
                      VelocityOf<Real>* scratch, Walls<Real>& walls) {
    // Changed nodes reach the faces around them, the slivers beside those, and by the density
    // kernel one cell more, for which areas are wanted one further still.
    const NodeBox inner = cells_around(shape, nodes, 1);
    contour_matrix(shape, cells_around(shape, nodes, 0), walls);
    if constexpr (kExactShares<Real>) {
        for_each_cut(shape, inner, walls, [&](std::int32_t i, std::int32_t j) {
            const std::int32_t c = shape.index(i, j);
            const std::uint32_t solid = walls.cell_case[c];
            const bool roomy = (solid & (solid - 1U)) == 0;  // one node in it: half at least
            if (!roomy && open_area(corners_of(shape, walls, c).distance) < kSliver<Real>) {
                close_faces(shape, c, walls);
            }
        });
    } else {
        open_areas(shape, cells_around(shape, nodes, 2), walls, scratch);
        close_slivers(shape, inner, scratch, walls);
    }
    const NodeBox asked{maximum(inner.i0, rim.left), maximum(inner.j0, rim.below), inner.i1,
                        inner.j1};
    look_around(shape, asked, scratch, thin, walls);
    if constexpr (kExactShares<Real>) {
        add_cut_cells(shape, asked, walls);
    }
}

#define WEIR_INSTANTIATE(Real)                                                                \
    template void update_cut_cells(const GridShape&, const NodeBox&, const Rim&, bool,        \
                                   VelocityOf<Real>*, Walls<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
