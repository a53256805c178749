// Who sees whom past thin walls: sides of edges, and which faces of its stencil a particle sees
// (the compatibility of Hu et al. 2018, "A moving least squares material point method with
// displacement discontinuity and two-way rigid body coupling").
#pragma once

#include "solid/thin_walls.hpp"
#include "solid/walls.hpp"

namespace weir {

/// How far edges reach beyond their ends, cells: what passes a corner meets one of its edges.
template <class Real>
inline constexpr Real kHair = Real(1.0 / 1024.0);

/// A crossing of the way p → q with the edge a → b.
template <class Real>
struct Crossing {
    bool found = false;
    bool from_left = false;  ///< p lies on the left of the edge: inside, if the polygon is closed
    Real part = Real(0);     ///< of the way
};

template <class Real>
inline bool is_left_of(Vec2<Real> p, Vec2<Real> a, Vec2<Real> b) {
    return cross(b - a, p - a) >= Product<Real>{};
}

template <class Real>
inline Crossing<Real> cross_edge(Vec2<Real> p, Vec2<Real> q, Vec2<Real> a, Vec2<Real> b) {
    const Vec2<Real> edge = b - a;
    const Product<Real> zero{};
    const Product<Real> before = cross(edge, p - a);
    const Product<Real> after = cross(edge, q - a);
    Crossing<Real> crossing;
    crossing.from_left = before >= zero;
    if (crossing.from_left == (after >= zero)) {
        return crossing;
    }
    const Real part = static_cast<Real>(before) / static_cast<Real>(before - after);
    const Product<Real> along = dot((p - a) + part * (q - p), edge);
    const Product<Real> hair = product(kHair<Real>, absolute(edge.x) + absolute(edge.y));
    crossing.found = along >= zero - hair && along <= dot(edge, edge) + hair;
    crossing.part = part;
    return crossing;
}

/// Normal of an edge, to its left.
template <class Real>
inline Vec2<Real> left_normal(const ThinWalls<Real>& thin, const WallEdge& edge) {
    const Vec2<Real> way = thin.vertex[edge.to] - thin.vertex[edge.from];
    const Real size = length(way);
    return size > Real(0) ? (Real(1) / size) * Vec2<Real>{Real(0) - way.y, way.x} : Vec2<Real>{};
}

/// The edge nearest to a face of those that cross the way between the centres on its sides, or
/// null.
template <class Real>
const WallEdge* edge_between(const ThinWalls<Real>& thin, Vec2<Real> face, std::int32_t before,
                             std::int32_t cell, bool along_x);

/// What thin walls that move push into the cell (i, j), as `MovingWalls::flow`. The faces that one
/// closes are stairs. With its velocity along itself it would drag along liquid that stands still;
/// without, liquid that goes with a leaning wall has to go around the stairs. So each face has of
/// it what the liquid in the cell shares. A wall that stands still lets nothing through: with the
/// liquid's own velocity along it stairs did work, and whirls beside them grew.
template <class Real>
Real flow_of_thin_walls(const StaggeredGrid<Real>& grid, const Walls<Real>& walls,
                        std::int32_t i, std::int32_t j);

/// Calls visit(edge) for the records of the cells i0 … i1, j0 … j1 that are in the tank; an edge
/// comes once a cell.
template <class Real, class Visit>
inline void for_each_wall_edge(const ThinWalls<Real>& thin, const GridShape& s, std::int32_t i0,
                               std::int32_t j0, std::int32_t i1, std::int32_t j1, Visit visit) {
    for (std::int32_t j = maximum(j0, 0); j <= minimum(j1, s.ny - 1); ++j) {
        for (std::int32_t i = maximum(i0, 0); i <= minimum(i1, s.nx - 1); ++i) {
            for (std::uint16_t at = thin.first[s.index(i, j)]; at != kNoEdge;
                 at = thin.edge[at].next) {
                visit(thin.edge[at]);
            }
        }
    }
}

/// The same of a cell of the tank and those around it; of the last four edges none comes again.
template <class Real, class Visit>
inline void for_each_edge_around(const ThinWalls<Real>& thin, const GridShape& s, std::int32_t i,
                                 std::int32_t j, Visit visit) {
    std::int32_t known[4] = {-1, -1, -1, -1};
    std::uint32_t visits = 0;
    const std::uint16_t* row = thin.first + s.index(i - 1, j - 1);
    for (std::int32_t y = 0; y < 3; ++y, row += s.stride) {
        for (std::int32_t x = 0; x < 3; ++x) {  // beyond the tank there is none
            for (std::uint16_t at = row[x]; at != kNoEdge; at = thin.edge[at].next) {
                const WallEdge& edge = thin.edge[at];
                if (edge.from != known[0] && edge.from != known[1] && edge.from != known[2] &&
                    edge.from != known[3]) {
                    known[visits++ % 4] = edge.from;
                    visit(edge);
                }
            }
        }
    }
}

/// Whether a thin wall stands between two points that are less than a cell apart along each axis.
template <class Real>
inline bool hidden(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> p, Vec2<Real> q) {
    bool found = false;
    for_each_wall_edge(thin, s, static_cast<std::int32_t>(minimum(p.x, q.x)),
                       static_cast<std::int32_t>(minimum(p.y, q.y)),
                       static_cast<std::int32_t>(maximum(p.x, q.x)),
                       static_cast<std::int32_t>(maximum(p.y, q.y)), [&](const WallEdge& edge) {
                           found = found || cross_edge(p, q, thin.vertex[edge.from],
                                                       thin.vertex[edge.to])
                                                .found;
                       });
    return found;
}

/// The centre of the cell that liquid in a place belongs to: a thin wall may hide it from that of
/// the cell in which it lies.
template <class Real>
Vec2<Real> centre_seen(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> place);

/// Which of the faces of its two stencils a point sees: bits 0 … 3 u, 4 … 7 v, lower left, lower
/// right, upper left, upper right.
template <class Real>
std::uint32_t seen_faces(const ThinWalls<Real>& thin, const GridShape& shape, Vec2<Real> point);

}  // namespace weir
