// Ear clipping over a linked ring, then merging in place. Orientation is tested in double, where
// products of floats are exact: this is set-up, and a wrong sign here is a hole in a solid.
#include "geometry/convex_decomposition.hpp"

#include "base/assert.hpp"
#include "geometry/polygon.hpp"
#include "weir/config.hpp"

namespace weir {

namespace {

// A vertex number leaves the top bit of its link free; set on `previous`, it says that the vertex
// is known to be no ear until one of its neighbours goes.
constexpr std::uint32_t kBlocked = 0x8000U;
static_assert(kMaxBodyVertices <= 0x8000, "the top bit of a link is taken");

// Sines of the bends that a piece may have. Between two edges of the outline a slight right bend
// passes, because vertices meant to lie on one straight edge are rounded. Where a diagonal ends
// the bend must be clearly to the left: were it straight, rounding would let the line of the
// outline's edge, prolonged, cut off points next to the diagonal that no other piece claims.
constexpr double kOutlineBend = -1e-6;
constexpr double kDiagonalBend = 1.0 / 4096.0;

template <class Real>
struct Ring {
    const Vec2<Real>* vertex;
    std::int32_t count;

    Vec2<double> at(std::int32_t i) const { return convert<double>(vertex[i]); }
    double turn_at(std::int32_t a, std::int32_t b, std::int32_t c) const {
        return turn(at(a), at(b), at(c));
    }
    bool is_edge(std::int32_t from, std::int32_t to) const {
        return to == (from + 1 < count ? from + 1 : 0);
    }
    /// Whether a convex piece may go from a over b to c.
    bool may_bend(std::int32_t a, std::int32_t b, std::int32_t c) const {
        const Vec2<double> in = at(b) - at(a);
        const Vec2<double> out = at(c) - at(b);
        const double bend = cross(in, out);
        if (dot(in, out) <= 0.0) {
            return bend > 0.0;
        }
        const double size = square_root(dot(in, in) * dot(out, out));
        return bend >= (is_edge(a, b) && is_edge(b, c) ? kOutlineBend : kDiagonalBend) * size;
    }
};

/// What is left of the ring while ears are clipped.
struct Chain {
    ArrayView<std::uint16_t> links;  // next of vertex i at 2i, previous at 2i + 1
    std::int32_t left;

    std::int32_t next(std::int32_t i) const { return links[2 * i]; }
    std::int32_t previous(std::int32_t i) const {
        return static_cast<std::int32_t>(links[2 * i + 1] & ~kBlocked);
    }
    bool blocked(std::int32_t i) const { return (links[2 * i + 1] & kBlocked) != 0; }
    void block(std::int32_t i) const { set_previous(i, previous(i), kBlocked); }
    void unblock(std::int32_t i) const { set_previous(i, previous(i), 0); }
    void join(std::int32_t a, std::int32_t b) const {
        links[2 * a] = static_cast<std::uint16_t>(b);
        set_previous(b, a, 0);
    }
    void set_previous(std::int32_t i, std::int32_t to, std::uint32_t mark) const {
        links[2 * i + 1] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(to) | mark);
    }
};

/// Pieces one after the other: a count, then that many vertex numbers.
struct PieceList {
    ArrayView<std::uint16_t> data;
    std::int32_t used;

    void append(std::int32_t value) { data[used++] = static_cast<std::uint16_t>(value); }
    /// Moves what is behind `at` by `by` places, either way.
    void shift(std::int32_t at, std::int32_t by) {
        if (by < 0) {
            for (std::int32_t i = at; i < used; ++i) {
                data[i + by] = data[i];
            }
        } else {
            for (std::int32_t i = used - 1; i >= at; --i) {
                data[i + by] = data[i];
            }
        }
        used += by;
    }
};

/// Whether the triangle at v can be cut off: a left turn with no other vertex in it. A vertex on
/// the triangle's rim blocks too, so that no later triangle is a mere line.
template <class Real>
bool is_ear(const Ring<Real>& ring, const Chain& chain, std::int32_t v) {
    const std::int32_t a = chain.previous(v);
    const std::int32_t c = chain.next(v);
    if (!(ring.turn_at(a, v, c) > 0.0)) {
        return false;
    }
    for (std::int32_t w = chain.next(c); w != a; w = chain.next(w)) {
        if (ring.turn_at(c, a, w) >= 0.0 && ring.turn_at(a, v, w) >= 0.0 &&
            ring.turn_at(v, c, w) >= 0.0) {
            return false;
        }
    }
    return true;
}

/// No proper ear: rounding has made the ring touch or cross itself. The flattest corner goes, which
/// moves the outline least: not at all for a doubled vertex or the tip of a spike.
template <class Real>
std::int32_t find_flattest(const Ring<Real>& ring, const Chain& chain, std::int32_t start) {
    std::int32_t flattest = start;
    double least = -1.0;
    std::int32_t v = start;
    for (std::int32_t tried = 0; tried < chain.left; ++tried) {
        const double area = absolute(ring.turn_at(chain.previous(v), v, chain.next(v)));
        if (least < 0.0 || area < least) {
            flattest = v;
            least = area;
        }
        v = chain.next(v);
    }
    return flattest;
}

/// The next ear from `start` on. Each vertex is tested again only after a neighbour went.
template <class Real>
std::int32_t find_ear(const Ring<Real>& ring, const Chain& chain, std::int32_t start) {
    std::int32_t v = start;
    for (std::int32_t tried = 0; tried < chain.left; ++tried) {
        if (!chain.blocked(v)) {
            if (is_ear(ring, chain, v)) {
                return v;
            }
            chain.block(v);
        }
        v = chain.next(v);
    }
    // What a makeshift cut takes away may have blocked vertices anywhere.
    for (std::int32_t tried = 0; tried < chain.left; ++tried) {
        chain.unblock(v);
        v = chain.next(v);
    }
    return find_flattest(ring, chain, start);
}

template <class Real>
void append_triangle(const Ring<Real>& ring, const Chain& chain, std::int32_t v,
                     PieceList& pieces) {
    const std::int32_t a = chain.previous(v);
    const std::int32_t c = chain.next(v);
    if (ring.turn_at(a, v, c) > 0.0) {  // a makeshift ear may be flat or turned over
        pieces.append(3);
        pieces.append(a);
        pieces.append(v);
        pieces.append(c);
    }
}

template <class Real>
void triangulate(const Ring<Real>& ring, ArrayView<std::uint16_t> links, PieceList& pieces) {
    Chain chain{links, ring.count};
    for (std::int32_t i = 0; i < ring.count; ++i) {
        chain.join(i, i + 1 < ring.count ? i + 1 : 0);
    }
    std::int32_t v = 0;
    while (chain.left > 3) {
        v = find_ear(ring, chain, v);
        append_triangle(ring, chain, v, pieces);
        chain.join(chain.previous(v), chain.next(v));
        chain.unblock(chain.previous(v));
        v = chain.next(v);
        --chain.left;
    }
    append_triangle(ring, chain, v, pieces);
}

/// An edge of a piece: from its k-th vertex to the next. `at` is the place of the piece's count.
struct PieceEdge {
    std::int32_t at;
    std::int32_t k;
};

/// The vertex `steps` after an edge's first one, around its piece; steps ≥ -1.
std::int32_t vertex_of(const PieceList& pieces, PieceEdge edge, std::int32_t steps) {
    const std::int32_t count = pieces.data[edge.at];
    return pieces.data[edge.at + 1 + (edge.k + steps + count) % count];
}

/// Finds the edge from → to in the pieces from place `at` on; `at` = used if there is none.
PieceEdge find_edge(const PieceList& pieces, std::int32_t at, std::int32_t from,
                    std::int32_t to) {
    PieceEdge edge{at, 0};
    while (edge.at < pieces.used) {
        const std::int32_t count = pieces.data[edge.at];
        for (edge.k = 0; edge.k < count; ++edge.k) {
            if (vertex_of(pieces, edge, 0) == from && vertex_of(pieces, edge, 1) == to) {
                return edge;
            }
        }
        edge.at += 1 + count;
    }
    return edge;
}

/// Joins two pieces along a common edge: the other's remaining vertices come after vertex k.
void join_pieces(PieceList& pieces, PieceEdge edge, PieceEdge other,
                 ArrayView<std::uint16_t> scratch) {
    const std::int32_t other_count = pieces.data[other.at];
    const std::int32_t added = other_count - 2;
    for (std::int32_t i = 0; i < added; ++i) {
        scratch[i] = static_cast<std::uint16_t>(vertex_of(pieces, other, 2 + i));
    }
    pieces.shift(other.at + 1 + other_count, -(other_count + 1));
    const std::int32_t place = edge.at + 1 + edge.k + 1;
    pieces.shift(place, added);
    for (std::int32_t i = 0; i < added; ++i) {
        pieces.data[place + i] = scratch[i];
    }
    pieces.data[edge.at] = static_cast<std::uint16_t>(pieces.data[edge.at] + added);
}

/// One pass over all diagonals, dropping those without which both ends stay convex.
template <class Real>
bool drop_diagonals(const Ring<Real>& ring, ArrayView<std::uint16_t> scratch,
                    PieceList& pieces) {
    bool dropped = false;
    for (PieceEdge edge{0, 0}; edge.at < pieces.used; edge.at += 1 + pieces.data[edge.at]) {
        edge.k = 0;
        while (edge.k < pieces.data[edge.at]) {
            const std::int32_t from = vertex_of(pieces, edge, 0);
            const std::int32_t to = vertex_of(pieces, edge, 1);
            const std::int32_t behind = edge.at + 1 + pieces.data[edge.at];
            const PieceEdge other = ring.is_edge(from, to)
                                        ? PieceEdge{pieces.used, 0}
                                        : find_edge(pieces, behind, to, from);
            if (other.at < pieces.used &&
                ring.may_bend(vertex_of(pieces, edge, -1), from, vertex_of(pieces, other, 2)) &&
                ring.may_bend(vertex_of(pieces, other, -1), to, vertex_of(pieces, edge, 2))) {
                join_pieces(pieces, edge, other, scratch);
                dropped = true;
            } else {
                ++edge.k;
            }
        }
    }
    return dropped;
}

template <class Real>
bool is_convex(const Ring<Real>& ring) {
    std::int32_t a = ring.count - 2;
    std::int32_t b = ring.count - 1;
    for (std::int32_t c = 0; c < ring.count; ++c) {
        if (!ring.may_bend(a, b, c)) {
            return false;
        }
        a = b;
        b = c;
    }
    return true;
}

}  // namespace

template <class Real>
std::int32_t decompose(const Vec2<Real>* ring_vertices, std::int32_t count,
                       ArrayView<std::uint16_t> links, ArrayView<std::uint16_t> pieces) {
    WEIR_ASSERT(count >= 3 && count <= kMaxBodyVertices);
    WEIR_ASSERT(links.size >= kLinksPerVertex * count);
    WEIR_ASSERT(pieces.size >= static_cast<std::int32_t>(kPieceIndicesPerVertex) * (count - 2));
    const Ring<Real> ring{ring_vertices, count};
    PieceList list{pieces, 0};
    double twice_area = 0.0;
    for (std::int32_t i = 2; i < count; ++i) {
        twice_area += ring.turn_at(0, i - 1, i);
    }
    if (!(twice_area > 0.0)) {
        return -1;
    }
    if (is_convex(ring)) {
        list.append(count);
        for (std::int32_t i = 0; i < count; ++i) {
            list.append(i);
        }
        return list.used;
    }
    triangulate(ring, links, list);
    // A dropped diagonal can free another one, so passes go on until one drops nothing.
    while (drop_diagonals(ring, links, list)) {
    }
    return list.used > 0 ? list.used : -1;
}

template std::int32_t decompose(const Vec2<float>*, std::int32_t, ArrayView<std::uint16_t>,
                                ArrayView<std::uint16_t>);
template std::int32_t decompose(const Vec2<double>*, std::int32_t, ArrayView<std::uint16_t>,
                                ArrayView<std::uint16_t>);
template std::int32_t decompose(const Vec2<Fixed>*, std::int32_t, ArrayView<std::uint16_t>,
                                ArrayView<std::uint16_t>);

}  // namespace weir
