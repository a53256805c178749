// What thin walls close of the grid: a face lies between the centres of two cells, and where a
// wall crosses the way from one to the other, no liquid flows. The closed faces of a wall without
// gaps have none either, since the ways around each node form a loop that the wall leaves as often
// as it enters it.
#include "solid/thin_sight.hpp"

namespace weir {

namespace {

constexpr std::int32_t kMostEdges = 12;
constexpr std::int32_t kMostCrossings = 4;

/// Rows of a face's kernel are summed between heights at most so far apart, and where edges begin
/// and end: among these what is seen of a row changes smoothly.
constexpr std::int32_t kBands = 4;
constexpr std::int32_t kMostHeights = kBands + 24;

/// Whether an edge crosses the way between two neighbouring centres. Which edge of a polyline
/// crosses the line through them is decided by comparing coordinates, where by the centres' sides
/// of the edge, once a centre: neighbours never disagree.
template <class Real>
bool crosses_link(Vec2<Real> low, Vec2<Real> high, bool along_x, Vec2<Real> a, Vec2<Real> b) {
    const bool straddles = along_x ? (a.y < low.y) != (b.y < low.y)
                                   : (a.x < low.x) != (b.x < low.x);
    const Product<Real> zero{};
    return straddles && (cross(b - a, low - a) >= zero) != (cross(b - a, high - a) >= zero);
}

NodeBox grown(const GridShape& s, const NodeBox& cells, std::int32_t by) {
    return {maximum(0, cells.i0 - by), maximum(0, cells.j0 - by),
            minimum(s.nx - 1, cells.i1 + by), minimum(s.ny - 1, cells.j1 + by)};
}

template <class Real>
void mark_surroundings(const GridShape& s, const NodeBox& cells, ThinWalls<Real>& thin) {
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
            thin.mark[s.index(i, j)] = 0;
        }
    }
    const NodeBox around = grown(s, cells, 2);
    for (std::int32_t j = around.j0; j <= around.j1; ++j) {
        for (std::int32_t i = around.i0; i <= around.i1; ++i) {
            if (thin.first[s.index(i, j)] == kNoEdge) {
                continue;
            }
            for (std::int32_t row = maximum(j - 2, cells.j0); row <= minimum(j + 2, cells.j1);
                 ++row) {
                for (std::int32_t column = maximum(i - 2, cells.i0);
                     column <= minimum(i + 2, cells.i1); ++column) {
                    const bool touching = absolute(row - j) < 2 && absolute(column - i) < 2;
                    std::uint8_t& mark = thin.mark[s.index(column, row)];
                    mark = static_cast<std::uint8_t>(mark | kNear | (touching ? kTouching : 0));
                }
            }
        }
    }
}

template <class Real>
void close_faces(const GridShape& s, std::int32_t i, std::int32_t j, ThinWalls<Real>& thin,
                 ShareOf<Real>* open_u, ShareOf<Real>* open_v) {
    constexpr Real kHalf = Real(0.5);
    const std::int32_t c = s.index(i, j);
    const Vec2<Real> centre{static_cast<Real>(i) + kHalf, static_cast<Real>(j) + kHalf};
    const auto close = [&](std::int32_t before, Vec2<Real> way, std::uint32_t closed,
                           std::uint32_t unseen, std::uint32_t unseen_before, ShareOf<Real>* open) {
        const Vec2<Real> other = centre - way;
        const Vec2<Real> face = centre - kHalf * way;
        if (edge_between(thin, face, before, c, way.x > Real(0)) == nullptr) {
            return;
        }
        open[c] = Real(0);
        const std::uint32_t bits = (hidden(thin, s, face, centre) ? unseen : 0U) |
                                   (hidden(thin, s, face, other) ? unseen_before : 0U);
        thin.mark[c] = static_cast<std::uint8_t>(thin.mark[c] | closed | bits);
    };
    if (i > 0) {
        close(c - 1, {Real(1), Real(0)}, kLeftClosed, kLeftUnseen, kLeftUnseenBefore, open_u);
    }
    if (j > 0) {
        close(c - s.stride, {Real(0), Real(1)}, kLowerClosed, kLowerUnseen, kLowerUnseenBefore,
              open_v);
    }
}

/// Edges around a face. Of more than there is room for always the same ones.
template <class Real>
struct Edges {
    const WallEdge* edge[kMostEdges];
    Vec2<Real> a[kMostEdges];
    Vec2<Real> b[kMostEdges];
    std::int32_t count = 0;

    /// In their bodies' order, each once.
    void add(const WallEdge& one) {
        std::int32_t place = count;
        while (place > 0 && goes_before(one, *edge[place - 1])) {
            --place;
        }
        if (place == kMostEdges || (place > 0 && !goes_before(*edge[place - 1], one))) {
            return;
        }
        count = minimum(count + 1, kMostEdges);
        for (std::int32_t k = count - 1; k > place; --k) {
            edge[k] = edge[k - 1];
        }
        edge[place] = &one;
    }
};

template <class Real>
Edges<Real> edges_around(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> face) {
    Edges<Real> edges;
    for_each_wall_edge(thin, s, floor_to_int(face.x) - 1, floor_to_int(face.y) - 1,
                       floor_to_int(face.x) + 1, floor_to_int(face.y) + 1,
                       [&](const WallEdge& edge) { edges.add(edge); });
    for (std::int32_t k = 0; k < edges.count; ++k) {
        edges.a[k] = thin.vertex[edges.edge[k]->from];
        edges.b[k] = thin.vertex[edges.edge[k]->to];
    }
    return edges;
}

/// Integral of the hat function from −1.
template <class Real>
Real hat_integral(Real x) {
    constexpr Real kHalf = Real(0.5);
    const Real in = clamp(x, Real(-1), Real(1));
    return in < Real(0) ? kHalf * ((Real(1) + in) * (Real(1) + in))
                        : Real(1) - kHalf * ((Real(1) - in) * (Real(1) - in));
}

/// Places along an axis, seen from the face, in order. What there is no room for is left out.
template <class Real, std::int32_t kMost>
struct Places {
    Real at[kMost];
    std::int32_t count = 0;

    void add(Real x) {
        if (count == kMost) {
            return;
        }
        std::int32_t place = count++;
        for (; place > 0 && x < at[place - 1]; --place) {
            at[place] = at[place - 1];
        }
        at[place] = x;
    }
};

/// Share of a row of the face's kernel that the face sees.
template <class Real>
Real seen_of_row(const Edges<Real>& edges, Vec2<Real> face, Real y, Real left, Real right) {
    Places<Real, kMostCrossings + 2> crossings;
    crossings.add(left);
    crossings.add(right);
    for (std::int32_t k = 0; k < edges.count; ++k) {
        const Vec2<Real> a = edges.a[k];
        const Vec2<Real> b = edges.b[k];
        if ((a.y < y) == (b.y < y)) {
            continue;
        }
        const Real x = (a.x - face.x) + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        if (left < x && x < right) {
            crossings.add(x);
        }
    }
    Real seen = Real(0);
    for (std::int32_t k = 0; k + 1 < crossings.count; ++k) {
        const Real middle = Real(0.5) * (crossings.at[k] + crossings.at[k + 1]);
        const Vec2<Real> place{face.x + middle, y};
        bool blocked = false;
        for (std::int32_t e = 0; e < edges.count; ++e) {
            blocked = blocked || cross_edge(face, place, edges.a[e], edges.b[e]).found;
        }
        seen += blocked ? Real(0)
                        : hat_integral(crossings.at[k + 1]) - hat_integral(crossings.at[k]);
    }
    return seen / (hat_integral(right) - hat_integral(left));
}

/// Heights between which the rows of a face's kernel are summed: those where what is seen of a row
/// jumps, or begins to change, are where edges end and where they come into the kernel.
template <class Real>
struct Heights : Places<Real, kMostHeights> {
    Heights(const Edges<Real>& edges, Vec2<Real> face, Real left, Real right, Real tank_height) {
        const auto add = [&](Real y) {
            if (Real(-1) < y && y < Real(1)) {
                this->add(y);
            }
        };
        const auto add_all = [&](Real y) { // with its images beyond the tank's floor and ceiling
            add(y - face.y);
            add(Real(0) - y - face.y);
            add((tank_height - face.y) + (tank_height - y));
        };
        for (std::int32_t band = 0; band <= kBands; ++band) {
            this->add(static_cast<Real>(2 * band - kBands) / static_cast<Real>(kBands));
        }
        add(Real(0) - face.y);
        add(tank_height - face.y);
        for (std::int32_t k = 0; k < edges.count; ++k) {
            const Vec2<Real> a = edges.a[k];
            const Vec2<Real> b = edges.b[k];
            add_all(a.y);
            add_all(b.y);
            const Real sides[] = {face.x + left, face.x + right};
            for (const Real side : sides) {
                if ((a.x < side) != (b.x < side)) {
                    add_all(a.y + (side - a.x) / (b.x - a.x) * (b.y - a.y));
                }
            }
        }
    }
};

/// Share of the mass that a face would get in a full tank which gets there past thin walls. Beyond
/// the tank's own walls liquid and walls are mirrored.
template <class Real>
Real seen_share(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> face) {
    const Edges<Real> edges = edges_around(thin, s, face);
    if (edges.count == 0) {
        return Real(1);
    }
    const Real height = static_cast<Real>(s.ny);
    const Real left = maximum(Real(-1), Real(0) - face.x);
    const Real right = minimum(Real(1), static_cast<Real>(s.nx) - face.x);
    const Heights<Real> heights(edges, face, left, right, height);
    constexpr Real kHalf = Real(0.5);
    const Real gauss = Real(0.57735027);  // two places, exact for cubics
    Real sum = Real(0);
    for (std::int32_t k = 0; k + 1 < heights.count; ++k) {
        const Real middle = kHalf * (heights.at[k] + heights.at[k + 1]);
        const Real half = kHalf * (heights.at[k + 1] - heights.at[k]);
        const Real offsets[] = {middle - gauss * half, middle + gauss * half};
        for (const Real offset : offsets) {
            Real y = absolute(face.y + offset);
            y = y > height ? height + height - y : y;
            const Real weight = half * (Real(1) - absolute(offset));
            sum += weight * seen_of_row(edges, face, y, left, right);
        }
    }
    return sum;
}

/// What a cell's density would be if it were full and only faces that its centre sees counted.
template <class Real>
Real seen_density(const ThinWalls<Real>& thin, const GridShape& s, std::int32_t i,
                  std::int32_t j) {
    constexpr Real kHalf = Real(0.5);
    const std::int32_t c = s.index(i, j);
    const Vec2<Real> centre{static_cast<Real>(i) + kHalf, static_cast<Real>(j) + kHalf};
    const Vec2<Real> way[] = {{Real(0) - kHalf, Real(0)}, {kHalf, Real(0)},
                              {Real(0), Real(0) - kHalf}, {Real(0), kHalf}};
    const SeenFaces sees = faces_seen(thin, s, c);
    const bool seen[] = {sees.left, sees.right, sees.lower, sees.upper};
    Real sum = Real(0);
    for (std::int32_t face = 0; face < 4; ++face) {
        sum += seen[face] ? seen_share(thin, s, centre + way[face]) : Real(0);
    }
    return Real(0.25) * sum;
}

}  // namespace

template <class Real>
const WallEdge* edge_between(const ThinWalls<Real>& thin, Vec2<Real> face, std::int32_t before,
                             std::int32_t cell, bool along_x) {
    constexpr Real kHalf = Real(0.5);
    const Vec2<Real> half = along_x ? Vec2<Real>{kHalf, Real(0)} : Vec2<Real>{Real(0), kHalf};
    const std::int32_t cells[] = {before, cell};
    const WallEdge* nearest = nullptr;
    Real least = Real(2);
    for (const std::int32_t at_cell : cells) {
        for (std::uint16_t at = thin.first[at_cell]; at != kNoEdge; at = thin.edge[at].next) {
            const WallEdge& edge = thin.edge[at];
            if (!crosses_link(face - half, face + half, along_x, thin.vertex[edge.from],
                              thin.vertex[edge.to])) {
                continue;
            }
            const Real height =
                absolute(static_cast<Real>(dot(face - thin.vertex[edge.from],
                                               left_normal(thin, edge))));
            if (height < least ||
                (height == least && nearest != nullptr && goes_before(edge, *nearest))) {
                least = height;
                nearest = thin.edge + at;
            }
        }
    }
    return nearest;
}

template <class Real>
Real flow_of_thin_wall(const ThinWalls<Real>& thin, const Body<Real>* bodies, Vec2<Real> face,
                       std::int32_t before, std::int32_t cell, bool along_x) {
    const WallEdge* edge = edge_between(thin, face, before, cell, along_x);
    if (edge == nullptr) {
        return Real(0);
    }
    // Without its part along itself: a staircase of faces would drag the liquid along.
    const Body<Real>& body = bodies[edge->slot];
    const Vec2<Real> velocity = body.velocity + spin_velocity(body.spin, face - body.position);
    const Vec2<Real> normal = left_normal(thin, *edge);
    const Real through = dot(velocity, normal);
    return through * (along_x ? normal.x : normal.y);
}

template <class Real>
void close_thin_faces(const GridShape& s, const NodeBox& nodes, ThinWalls<Real>& thin,
                      ShareOf<Real>* open_u, ShareOf<Real>* open_v,
                      ShareOf<Real>* full_density) {
    const NodeBox cells{maximum(0, nodes.i0 - 2), maximum(0, nodes.j0 - 2),
                        minimum(s.nx - 1, nodes.i1 + 1), minimum(s.ny - 1, nodes.j1 + 1)};
    mark_surroundings(s, cells, thin);
    const auto each_marked = [&](std::uint8_t bit, auto visit) {
        for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
            for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
                if ((thin.mark[s.index(i, j)] & bit) != 0) {
                    visit(i, j);
                }
            }
        }
    };
    each_marked(kTouching, [&](std::int32_t i, std::int32_t j) {
        close_faces(s, i, j, thin, open_u, open_v);
    });
    each_marked(kNear, [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        full_density[c] = Real(full_density[c]) * seen_density(thin, s, i, j);
    });
}

#define WEIR_INSTANTIATE(Real)                                                              \
    template const WallEdge* edge_between(const ThinWalls<Real>&, Vec2<Real>, std::int32_t, \
                                          std::int32_t, bool);                              \
    template Real flow_of_thin_wall(const ThinWalls<Real>&, const Body<Real>*, Vec2<Real>,  \
                                    std::int32_t, std::int32_t, bool);                      \
    template void close_thin_faces(const GridShape&, const NodeBox&, ThinWalls<Real>&,      \
                                   ShareOf<Real>*, ShareOf<Real>*, ShareOf<Real>*);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
