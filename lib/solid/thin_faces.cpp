// What thin walls close of the grid: a face lies between the centres of two cells, and where a
// wall crosses the way from one to the other, no liquid flows. The closed faces of a wall without
// gaps have none either, since the ways around each node form a loop that the wall leaves as often
// as it enters it.
#include "solid/seen_share.hpp"

namespace weir {

namespace {

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

/// Share of what each face of a row of cells would get in a full tank that gets there past thin
/// walls: asked once, though two cells have the face.
template <class Real>
class FaceShares {
public:
    static constexpr std::int32_t kColumns = 32;

    FaceShares(const ThinWalls<Real>& thin, const GridShape& shape) : thin_(thin), shape_(shape) {
        for (Real& share : below_) {
            share = kUnknown;
        }
    }
    /// A row's cells come from the left, `column` counted from the first.
    void begin_row() { left_ = kUnknown; }
    void pass(std::int32_t column) { left_ = below_[column] = kUnknown; }

    /// Mean of those of a cell's faces that its centre sees.
    Real of_cell(std::int32_t column, std::int32_t i, std::int32_t j) {
        constexpr Real kHalf = Real(0.5);
        const SeenFaces sees = faces_seen(thin_, shape_, shape_.index(i, j));
        const Vec2<Real> low{static_cast<Real>(i), static_cast<Real>(j)};
        const auto share = [&](bool seen, Real known, Real x, Real y) {
            return !seen ? Real(0)
                         : (known == kUnknown ? seen_share(thin_, shape_, low + Vec2<Real>{x, y})
                                              : known);
        };
        const Real left = share(sees.left, left_, Real(0), kHalf);
        const Real lower = share(sees.lower, below_[column], kHalf, Real(0));
        const Real right = share(sees.right, kUnknown, Real(1), kHalf);
        const Real upper = share(sees.upper, kUnknown, kHalf, Real(1));
        left_ = sees.right ? right : kUnknown;
        below_[column] = sees.upper ? upper : kUnknown;
        return Real(0.25) * ((left + right) + (lower + upper));
    }

private:
    static constexpr Real kUnknown = Real(-1);

    const ThinWalls<Real>& thin_;
    const GridShape& shape_;
    Real left_ = kUnknown;
    Real below_[kColumns];
};

/// What cells near a wall would show if they were full and only faces that their centres see
/// counted.
template <class Real>
void find_seen_density(const GridShape& s, const NodeBox& cells, const ThinWalls<Real>& thin,
                       ShareOf<Real>* full_density) {
    constexpr std::int32_t kColumns = FaceShares<Real>::kColumns;
    for (std::int32_t first = cells.i0; first <= cells.i1; first += kColumns) {
        FaceShares<Real> shares(thin, s);
        const std::int32_t columns = minimum(kColumns, cells.i1 + 1 - first);
        for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
            shares.begin_row();
            for (std::int32_t k = 0; k < columns; ++k) {
                const std::int32_t c = s.index(first + k, j);
                if ((thin.mark[c] & kNear) == 0) {
                    shares.pass(k);
                    continue;
                }
                full_density[c] = Real(full_density[c]) * shares.of_cell(k, first + k, j);
            }
        }
    }
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
void close_thin_faces(const GridShape& s, const NodeBox& nodes, ThinWalls<Real>& thin,
                      ShareOf<Real>* open_u, ShareOf<Real>* open_v,
                      ShareOf<Real>* full_density) {
    const NodeBox cells{maximum(0, nodes.i0 - 2), maximum(0, nodes.j0 - 2),
                        minimum(s.nx - 1, nodes.i1 + 1), minimum(s.ny - 1, nodes.j1 + 1)};
    mark_surroundings(s, cells, thin);
    for (std::int32_t j = cells.j0; j <= cells.j1; ++j) {
        for (std::int32_t i = cells.i0; i <= cells.i1; ++i) {
            if ((thin.mark[s.index(i, j)] & kTouching) != 0) {
                close_faces(s, i, j, thin, open_u, open_v);
            }
        }
    }
    find_seen_density(s, cells, thin, full_density);
}

#define WEIR_INSTANTIATE(Real)                                                              \
    template const WallEdge* edge_between(const ThinWalls<Real>&, Vec2<Real>, std::int32_t, \
                                          std::int32_t, bool);                              \
    template void close_thin_faces(const GridShape&, const NodeBox&, ThinWalls<Real>&,      \
                                   ShareOf<Real>*, ShareOf<Real>*, ShareOf<Real>*);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
