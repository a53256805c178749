#include "solid/cut_cells.hpp"

#include "solid/cut_cells_groups.hpp"

namespace weir {

namespace {

NodeBox within(const GridShape& shape, const NodeBox& cells) {
    return common(cells, {0, 0, shape.nx - 1, shape.ny - 1});
}
NodeBox cells_around(const GridShape& shape, const NodeBox& nodes) {
    return within(shape, {nodes.i0 - 1, nodes.j0 - 1, nodes.i1, nodes.j1});
}
NodeBox with_those_beside(const GridShape& shape, const NodeBox& cells) {
    return within(shape, {cells.i0 - 1, cells.j0 - 1, cells.i1 + 1, cells.j1 + 1});
}

/// Of some cells a box of those that have a node in a solid, or had one when they were last looked
/// at. Nothing depends on how far the nodes of others are from it.
template <class Real>
NodeBox touched_cells(const GridShape& s, const NodeBox& cells, const Walls<Real>& walls) {
    NodeBox found{cells.i1 + 1, cells.j1 + 1, cells.i0 - 1, cells.j0 - 1};
    const auto add = [&](std::int32_t i, std::int32_t j, std::int32_t more) {
        found = {minimum(found.i0, i - more), minimum(found.j0, j - more), maximum(found.i1, i),
                 maximum(found.j1, j)};
    };
    for (std::int32_t j = cells.j0; j <= cells.j1 + 1; ++j) {
        std::int32_t c = s.index(cells.i0, j);
        for (std::int32_t i = cells.i0; i <= cells.i1 + 1; ++i, ++c) {
            if (!is_positive(Real(walls.distance[c]))) {
                add(i, j, 1);
            } else if (walls.cell_case[c] != kOpen) {
                add(i, j, 0);
            }
        }
    }
    return common(found, cells);
}

/// Cases of the cells whose nodes changed, and the faces around them.
template <class Real>
void contour_matrix(const GridShape& s, const NodeBox& cells, Walls<Real>& walls) {
    const DistanceOf<Real>* const d = walls.distance;
    const std::int32_t up = s.stride;
    std::uint8_t* const cases = walls.cell_case;
    ShareOf<Real>* const open_u = walls.open_u;
    ShareOf<Real>* const open_v = walls.open_v;
    // The bits of a node and of the one above it, as they stand on the left side of a case.
    const auto side = [&](std::int32_t node) {
        return (is_positive(Real(d[node])) ? 0U : 1U) | (is_positive(Real(d[node + up])) ? 0U : 8U);
    };
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        std::int32_t c = s.index(cells.i0, j);
        const std::int32_t end = s.index(cells.i1 + 1, j);
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            c = cut_loops().contour(cut_task(s, walls), c, end);
        }
#endif
        std::uint32_t left = side(c);
        for (; c < end; ++c) {
            const std::uint32_t right = side(c + 1);
            const auto solid_nodes =
                static_cast<std::uint8_t>(left | (right & 1U) << 1U | (right & 8U) >> 1U);
            cases[c] = solid_nodes;
            if (is_cut(solid_nodes)) {
                open_u[c] = open_fraction<Real>(d[c], d[c + up]);
                open_v[c] = open_fraction<Real>(d[c], d[c + 1]);
            } else {
                open_u[c] = open_v[c] = Real(solid_nodes == kOpen ? 1 : 0);
            }
            left = right;
        }
        open_u[c] = open_fraction<Real>(d[c], d[c + up]);
    }
    const std::int32_t top = s.index(cells.i1, cells.j1 + 1);
    for (std::int32_t c = s.index(cells.i0, cells.j1 + 1); c <= top; ++c) {
        open_v[c] = open_fraction<Real>(d[c], d[c + 1]);
    }
}

/// visit(i, j) for the cut ones of some cells, row by row.
template <class Real, class Visit>
void for_each_cut(const GridShape& s, const NodeBox& cells, const Walls<Real>& walls,
                  Visit visit) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        const std::uint8_t* row = walls.cell_case + s.index(0, j);
        for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
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

/// Slivers among some cells, by looking at cut ones alone.
template <class Real>
void close_lone_slivers(const GridShape& s, const NodeBox& cells, Walls<Real>& walls) {
#if WEIR_HAS_LANES
    if constexpr (kHasLanes<Real>) {
        close_sliver_groups(s, cells, walls);
        return;
    }
#endif
    for_each_cut(s, cells, walls, [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        if (!is_roomy(walls.cell_case[c]) &&
            open_area(corners_of(s, walls, c).distance) < kSliver<Real>) {
            close_faces(s, c, walls);
        }
    });
}

/// Open areas of some cells, and slivers among them.
template <class Real>
void open_areas(const GridShape& s, const NodeBox& cells, VelocityOf<Real>* area,
                Walls<Real>& walls) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        const std::int32_t last = s.index(cells.i1, j);
        for (std::int32_t c = s.index(cells.i0, j); c <= last; ++c) {
            const std::uint8_t solid_nodes = walls.cell_case[c];
            area[c] = Real(solid_nodes == kOpen ? 1 : 0);
            if (is_cut(solid_nodes)) {
                const Real open = open_area(corners_of(s, walls, c).distance);
                if (open < kSliver<Real>) {
                    close_faces(s, c, walls);
                } else {
                    area[c] = open;
                }
            }
        }
    }
}

/// Cut cells in and around some cells add theirs to them.
template <class Real>
void add_cut_cells(const GridShape& s, const NodeBox& cells, Walls<Real>& walls) {
    const NodeBox around = with_those_beside(s, cells);
#if WEIR_HAS_LANES
    if constexpr (kHasLanes<Real>) {
        add_cut_groups(s, cells, around, walls);
        return;
    }
#endif
    for_each_cut(s, around, walls, [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        const Hats<Real> hats(open_moments(corners_of(s, walls, c).distance));
        add_within(s, cells, i, j, kernel_shares(hats), walls);
    });
}

/// Cases of a cell and the ones below and above it, joined, and how much liquid they hold: how many
/// are open, as cut cells add theirs; in packed worlds open areas, in 128ths.
struct Column {
    std::uint32_t any;
    std::uint32_t all;
    std::int32_t own;
    std::int32_t ends;
};

/// Density that a cell shows when all around it is full, without cut cells that add theirs. Shares
/// of the kernel with which particles reach it are so many 32nds. Areas of packed worlds are known
/// to 1/128: the sum is exact.
template <class Real>
Real full_density(const Column& left, const Column& middle, const Column& right) {
    const std::int32_t sum =
        12 * middle.own + 4 * (left.own + right.own + middle.ends) + (left.ends + right.ends);
    if constexpr (kExactShares<Real>) {
        return kCornerShare<Real> * static_cast<Real>(sum);
    } else {
        return Real::of_raw(16 * sum);
    }
}

/// Whether the mirror writes the face between two nodes: it is closed and not too deep, or the
/// liquid may stick near it.
template <class Real>
bool is_mirrored(const Walls<Real>& walls, Real open, std::int32_t a, std::int32_t b) {
    const Real twice = Real(walls.distance[a]) + Real(walls.distance[b]);
    return is_positive(open) ? walls.any_sticking && twice < Real(2) * kBoundLayer<Real> &&
                                   sticking_body(walls, a, b) != kNoBody
                             : !(twice < Real(2) * kDeepestMirror<Real>);
}

/// What is around cells i0 … i1 of a row.
template <class Real>
void look_around_row(const GridShape& shape, std::int32_t j, std::int32_t i0, std::int32_t i1,
                     const VelocityOf<Real>* area, bool thin, Walls<Real>& walls) {
    const GridShape s = shape;  // what a byte that is stored cannot change
    const std::int32_t row = s.index(0, j);
    const std::int32_t down = j > 0 ? s.stride : 0;
    const std::int32_t up = j + 1 < s.ny ? s.stride : 0;
    const std::uint8_t* const here = walls.cell_case + row;
    ShareOf<Real>* const full = walls.full_density + row;
    MarksNear marks(walls, s, i0, j);
    const VelocityOf<Real>* const open = area + row;
    const auto column = [&](std::int32_t i) {
        const std::uint32_t low = here[i - down];
        const std::uint32_t own = here[i];
        const std::uint32_t high = here[i + up];
        if constexpr (kExactShares<Real>) {
            return Column{low | own | high, low & own & high, own == kOpen ? 1 : 0,
                          (low == kOpen ? 1 : 0) + (high == kOpen ? 1 : 0)};
        } else {
            return Column{low | own | high, low & own & high, open[i].raw,
                          open[i - down].raw + open[i + up].raw};
        }
    };
    Column left = column(maximum(i0 - 1, 0));
    Column middle = column(i0);
    for (std::int32_t i = i0; i <= i1; ++i) {
        const Column right = column(minimum(i + 1, s.nx - 1));
        const std::uint32_t any = left.any | middle.any | right.any;
        bool mirrored = false;
        if (any != kOpen && (left.all & middle.all & right.all) != kSolid) {
            const std::int32_t c = row + i;
            full[i] = full_density<Real>(left, middle, right);
            mirrored = thin || is_mirrored<Real>(walls, walls.open_u[c], c, c + s.stride) ||
                       is_mirrored<Real>(walls, walls.open_v[c], c, c + 1);
        } else {
            full[i] = Real(any == kOpen ? 1 : 0);
        }
        marks.put(mirrored);
        left = middle;
        middle = right;
    }
}

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
            i = look_around_eights(s, j, i, cells.i1, thin, walls);
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
    // Thin walls and those that liquid sticks to are felt further away; lanes are done sooner with
    // all cells than with looking at them.
    const bool all = kHasLanes<Real> || thin || walls.any_sticking;
    const NodeBox around = cells_around(shape, nodes);
    const NodeBox cells = all ? around : touched_cells(shape, around, walls);
    if (cells.empty()) {
        return;
    }
    // Changed cells reach the faces around them, the slivers beside those, and by the density
    // kernel one cell more, for which areas are wanted one further still.
    const NodeBox inner = with_those_beside(shape, cells);
    contour_matrix(shape, cells, walls);
    if constexpr (kExactShares<Real>) {
        close_lone_slivers(shape, inner, walls);
    } else {
        open_areas(shape, with_those_beside(shape, inner), scratch, walls);
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
