// Where two convex pieces face each other: the face of either one that the other is furthest in
// front of (separating axes), and the other's nearest edge cut off at that face's ends, which
// leaves two points at most (as in Catto's Box2D Lite, 2006).
#pragma once

#include "solid/body_table.hpp"

namespace weir {

/// Vertices of a body, counter-clockwise, as seen from a place in the tank. An edge of a polyline
/// is a piece of two vertices, with a face on each side.
template <class Real>
struct ConvexPiece {
    Outline<Real> outline;
    const std::uint16_t* vertex = nullptr;  ///< numbers in the outline; null: `first` and the next
    std::int32_t count = 2;
    std::int32_t first = 0;

    std::int32_t number(std::int32_t k) const {
        return vertex != nullptr ? vertex[k] : first + k;
    }
    Vec2<Face<Real>> at(std::int32_t k, Vec2<Real> from) const {
        return convert<Face<Real>>(outline.vertex[number(k)] - from);
    }
    std::int32_t next(std::int32_t k) const { return k + 1 < count ? k + 1 : 0; }
    /// Whether the edge behind a vertex is one of the outline's, not a cut between two pieces.
    bool is_outer(std::int32_t k) const;
};

/// Points of one piece before a face of the other.
template <class Real>
struct PieceContact {
    struct Point {
        Vec2<Face<Real>> at;
        Face<Real> gap = Face<Real>(0);  ///< to the face, negative inside
    };
    Vec2<Face<Real>> normal;  ///< from the second piece towards the first
    Point point[2];
    std::int32_t count = 0;
};

/// Calls visit(piece) for the pieces of a body, at its pose. One of an entry in the list costs one.
template <class Real, class Visit>
void for_each_piece(const BodyTable<Real>& table, const Body<Real>& body, Visit visit) {
    ConvexPiece<Real> piece;
    piece.outline = table.outline(body);
    if (body.open) {
        for (; piece.first + 1 < body.vertex_count; ++piece.first) {
            visit(piece);
        }
        return;
    }
    const std::uint16_t* list = table.piece_list(body);
    for (std::int32_t at = 0; at < body.piece_length; at += 1 + piece.count) {
        piece.count = list[at];
        piece.vertex = list + at + 1;
        visit(piece);
    }
}

/// Nothing if they are further than `margin` from each other.
/// @param from everything is told from there, for the sake of rounding.
/// Cost: both numbers of vertices multiplied, and a square root for each of them.
template <class Real>
PieceContact<Real> contact_of(const ConvexPiece<Real>& one, const ConvexPiece<Real>& other,
                              Vec2<Real> from, Face<Real> margin);

}  // namespace weir
