// Each ear's diagonal leads to the ear that uses it up as an edge, so triangles form a tree, and
// whether a diagonal stays is decided when the second of its triangles is cut off: by then the
// piece behind it is as large as it gets.
#include "geometry/convex_decomposition.hpp"

#include "base/assert.hpp"
#include "geometry/bridges.hpp"
#include "geometry/ear_clipping.hpp"
#include "weir/config.hpp"

namespace weir {

namespace {

constexpr std::int32_t kNone = 0x7FFF;     // no corner
constexpr std::uint16_t kMerged = 0x8000;  // this corner's triangle is in that corner's piece
static_assert(kMaxBodyVertices < kNone, "corner numbers leave the top bit free");

// Sines of the bends that a piece may have. Between two edges of the outline a slight right bend
// passes, because vertices meant to lie on one straight edge are rounded. Where a diagonal ends
// the bend must be clearly to the left: were it straight, rounding would let the line of the
// outline's edge, prolonged, cut off points next to the diagonal that no other piece claims.
constexpr double kOutlineBend = -1e-6;
constexpr double kDiagonalBend = 1.0 / 4096.0;

/// Whether a convex piece may go from corner a over b to c.
template <class Real>
bool may_bend(const CornerRing<Real>& ring, std::int32_t a, std::int32_t b, std::int32_t c) {
    const Vec2<double> in = ring.at(b) - ring.at(a);
    const Vec2<double> out = ring.at(c) - ring.at(b);
    const double bend = cross(in, out);
    if (dot(in, out) <= 0.0) {
        return bend > 0.0;
    }
    const bool outline = ring.is_outline_edge(a, b) && ring.is_outline_edge(b, c);
    const double size = square_root(dot(in, in) * dot(out, out));
    return bend >= (outline ? kOutlineBend : kDiagonalBend) * size;
}

template <class Real>
bool is_convex(const CornerRing<Real>& ring) {
    std::int32_t a = ring.count() - 2;
    std::int32_t b = ring.count() - 1;
    for (std::int32_t c = 0; c < ring.count(); ++c) {
        if (!may_bend(ring, a, b, c)) {
            return false;
        }
        a = b;
        b = c;
    }
    return true;
}

/// The pieces as they grow. A piece is named after the tip of its last triangle and goes from that
/// triangle's a, over `first`, to `last` and c.
template <class Real>
struct Merger {
    CornerRing<Real> ring;
    CornerLinks links;  // of a tip: its triangle's a and c
    /// Of a corner that is left: the piece behind the edge to the next corner, or kNone. Of a tip:
    /// its piece's first; then, with kMerged, the corner into whose piece it went.
    ArrayView<std::uint16_t> first;
    /// Of a tip: its piece's last; in the end, where its piece is written.
    ArrayView<std::uint16_t> last;

    void set_first(std::int32_t corner, std::int32_t value) const {
        first[corner] = static_cast<std::uint16_t>(value);
    }
    void set_last(std::int32_t corner, std::int32_t value) const {
        last[corner] = static_cast<std::uint16_t>(value);
    }
    void merge(std::int32_t piece, std::int32_t into) const { set_first(piece, into | kMerged); }
    bool bend(std::int32_t a, std::int32_t b, std::int32_t c) const {
        return may_bend(ring, a, b, c);
    }
};

/// Makes a triangle a piece, and drops the diagonals to pieces behind two of its edges if both
/// ends stay convex.
template <class Real>
void add_triangle(const Merger<Real>& merger, const Ear& ear) {
    const std::int32_t left = merger.first[ear.a];
    const std::int32_t right = merger.first[ear.tip];
    merger.set_first(ear.a, ear.has_area ? ear.tip : kNone);
    if (!ear.has_area) {
        merger.merge(ear.tip, kNone);
        return;
    }
    std::int32_t first = ear.tip;
    std::int32_t last = ear.tip;
    std::int32_t before_tip = ear.a;
    if (left != kNone && merger.bend(ear.c, ear.a, merger.first[left]) &&
        merger.bend(merger.last[left], ear.tip, ear.c)) {
        first = merger.first[left];
        before_tip = merger.last[left];
        merger.merge(left, ear.tip);
    }
    if (right != kNone && merger.bend(before_tip, ear.tip, merger.first[right]) &&
        merger.bend(merger.last[right], ear.c, ear.a)) {
        last = merger.last[right];
        merger.merge(right, ear.tip);
    }
    merger.set_first(ear.tip, first);
    merger.set_last(ear.tip, last);
}

/// The last triangle has a piece behind its third edge too; its other corners count as its own.
template <class Real>
void add_last_triangle(const Merger<Real>& merger, const Ear& ear) {
    const std::int32_t behind = merger.first[ear.c];
    add_triangle(merger, ear);
    if (ear.has_area && behind != kNone &&
        merger.bend(merger.last[ear.tip], ear.c, merger.first[behind]) &&
        merger.bend(merger.last[behind], ear.a, merger.first[ear.tip])) {
        merger.merge(behind, ear.tip);
    }
    merger.merge(ear.a, ear.has_area ? ear.tip : kNone);
    merger.merge(ear.c, ear.has_area ? ear.tip : kNone);
}

/// The piece that a corner's triangle has gone into, or kNone. Halves the way for the next time.
template <class Real>
std::int32_t piece_of(const Merger<Real>& merger, std::int32_t corner) {
    while ((merger.first[corner] & kMerged) != 0) {
        const std::int32_t up = merger.first[corner] & kNone;
        if (up == kNone) {
            return kNone;
        }
        if ((merger.first[up] & kMerged) != 0) {
            merger.first[corner] = merger.first[up];
        }
        corner = up;
    }
    return corner;
}

/// Pieces one after the other in the order of their corners around the ring. `last` becomes the
/// place of each piece's count, which grows while corners are appended.
template <class Real>
struct PieceWriter {
    Merger<Real> merger;
    ArrayView<std::uint16_t> out;
    std::int32_t final_piece;  // whose three ends are among its own corners

    std::uint16_t* at(std::int32_t piece) const { return &out[merger.last[piece]]; }
    void append(std::int32_t piece, std::int32_t corner) const {
        std::uint16_t* count = at(piece);
        ++*count;
        count[*count] = static_cast<std::uint16_t>(corner);
    }
    /// A piece's own corners come in rising order; its ends a and c go where they belong: around
    /// them, or, if the piece goes over corner 0, in between.
    void append_in_order(std::int32_t piece, std::int32_t corner) const {
        const std::uint16_t* count = at(piece);
        const std::int32_t a = merger.links.previous(piece);
        const std::int32_t c = merger.links.next(piece);
        if (piece != final_piece) {
            const bool over_zero = a > c;
            const bool none = *count == 0;
            if (over_zero && corner > a && (none || count[*count] < a)) {
                append(piece, c);
                append(piece, a);
            } else if (!over_zero && none) {
                append(piece, a);
            }
        }
        append(piece, corner);
    }
    void close(std::int32_t piece) const {
        const std::uint16_t* count = at(piece);
        const std::int32_t a = merger.links.previous(piece);
        const std::int32_t c = merger.links.next(piece);
        if (piece != final_piece && a < c) {
            append(piece, c);
        } else if (piece != final_piece && count[*count] < a) {
            append(piece, c);
            append(piece, a);
        }
    }
};

/// Room for every piece, its corners counted in `last` first. Returns what is used.
template <class Real>
std::int32_t reserve(const PieceWriter<Real>& writer) {
    const Merger<Real>& merger = writer.merger;
    const std::int32_t corners = merger.ring.count();
    for (std::int32_t k = 0; k < corners; ++k) {
        merger.set_last(k, 0);
    }
    for (std::int32_t k = 0; k < corners; ++k) {
        const std::int32_t piece = piece_of(merger, k);
        if (piece != kNone) {
            ++merger.last[piece];
        }
    }
    std::int32_t used = 0;
    for (std::int32_t k = 0; k < corners; ++k) {
        if (merger.last[k] > 0) {
            const std::int32_t ends = k == writer.final_piece ? 0 : 2;
            const std::int32_t size = 1 + ends + merger.last[k];
            merger.set_last(k, used);
            writer.out[used] = 0;
            used += size;
        }
    }
    return used;
}

template <class Real>
std::int32_t write_pieces(const PieceWriter<Real>& writer) {
    const Merger<Real>& merger = writer.merger;
    const std::int32_t used = reserve(writer);
    for (std::int32_t k = 0; k < merger.ring.count(); ++k) {
        const std::int32_t piece = piece_of(merger, k);
        if (piece != kNone) {
            writer.append_in_order(piece, k);
        }
    }
    for (std::int32_t k = 0; k < merger.ring.count(); ++k) {
        if (piece_of(merger, k) == k) {
            writer.close(k);
        }
    }
    for (std::int32_t at = 0; at < used;) {
        const std::int32_t count = writer.out[at];
        for (std::int32_t k = at + 1; k <= at + count; ++k) {
            writer.out[k] = static_cast<std::uint16_t>(merger.ring.vertex_of(writer.out[k]));
        }
        at += 1 + count;
    }
    return used;
}

template <class Real>
double twice_area(const CornerRing<Real>& ring) {
    double sum = 0.0;
    for (std::int32_t i = 2; i < ring.count(); ++i) {
        sum += ring.turn_at(0, i - 1, i);
    }
    return sum;
}

template <class Real>
std::int32_t write_ring(const CornerRing<Real>& ring, ArrayView<std::uint16_t> pieces) {
    pieces[0] = static_cast<std::uint16_t>(ring.count());
    for (std::int32_t k = 0; k < ring.count(); ++k) {
        pieces[1 + k] = static_cast<std::uint16_t>(k);
    }
    return 1 + ring.count();
}

}  // namespace

template <class Real>
std::int32_t decompose(const Outline<Real>& outline, ArrayView<std::uint16_t> scratch,
                       ArrayView<std::uint16_t> pieces) {
    const std::int32_t corners = corner_count(outline);
    WEIR_ASSERT(corners >= 3 && corners <= kMaxBodyVertices);
    WEIR_ASSERT(scratch.size >= static_cast<std::int32_t>(kScratchPerVertex) * corners);
    WEIR_ASSERT(pieces.size >= static_cast<std::int32_t>(kPieceIndicesPerVertex) * (corners - 2));
    const auto part = [&](std::int32_t at, std::int32_t size) {
        return ArrayView<std::uint16_t>{scratch.data + at * corners, size * corners};
    };
    const CornerLinks links{part(0, 2)};
    const CornerRing<Real> ring{outline.vertex, part(2, 1)};
    if (!join_holes(outline, links, pieces, ring.sequence) || !(twice_area(ring) > 0.0)) {
        return -1;
    }
    if (outline.rings == 1 && is_convex(ring)) {
        return write_ring(ring, pieces);
    }
    const Merger<Real> merger{ring, links, part(3, 1), part(4, 1)};
    for (std::int32_t k = 0; k < corners; ++k) {
        merger.set_first(k, kNone);
    }
    EarClipper<Real> clipper = start_clipping(ring, links, merger.last, pieces);
    while (clipper.left > 3) {
        add_triangle(merger, clip_ear(clipper));
    }
    const Ear last = clip_ear(clipper);
    add_last_triangle(merger, last);
    const std::int32_t used = write_pieces(PieceWriter<Real>{merger, pieces, last.tip});
    return used > 0 ? used : -1;
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template std::int32_t decompose(const Outline<Real>&, ArrayView<std::uint16_t>, \
                                    ArrayView<std::uint16_t>);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
