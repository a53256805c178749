#include "solid/piece_contact.hpp"

namespace weir {

namespace {

/// The second piece's face is taken only if it is by so much the better one, cells: of two that
/// are as good it should not be now this one, now that one.
template <class Real>
constexpr Face<Real> kBetter = Face<Real>(1.0 / 256.0);

/// Ends of faces reach so much further, cells: corners on top of each other touch.
template <class Real>
constexpr Face<Real> kEnd = Face<Real>(1.0 / 256.0);

template <class Real>
constexpr Face<Real> kFar = Face<Real>(1.0e9);

template <class Real>
struct BestFace {
    std::int32_t edge = -1;
    Wide<Real> normal;
    Face<Real> gap = -kFar<Real>;  ///< of the other piece to it
    bool apart = false;            ///< the other is further in front of some face than asked
};

/// Outward normal of the edge behind a vertex; false: the edge has no length.
template <class Real>
bool normal_of(const ConvexPiece<Real>& piece, std::int32_t k, Vec2<Real> from,
               Wide<Real>& normal) {
    const Wide<Real> edge = piece.at(piece.next(k), from) - piece.at(k, from);
    const Face<Real> size = length(edge);
    if (!(size > Face<Real>(0))) {
        return false;
    }
    normal = {edge.y / size, -edge.x / size};
    return true;
}

template <class Real>
BestFace<Real> best_face(const ConvexPiece<Real>& of, const ConvexPiece<Real>& other,
                         Vec2<Real> from, Face<Real> margin) {
    BestFace<Real> best;
    for (std::int32_t k = 0; k < of.count && !best.apart; ++k) {
        Wide<Real> normal;
        if (!normal_of(of, k, from, normal)) {
            continue;
        }
        const Face<Real> face = dot(normal, of.at(k, from));
        Face<Real> gap = kFar<Real>;
        for (std::int32_t i = 0; i < other.count; ++i) {
            gap = minimum(gap, dot(normal, other.at(i, from)) - face);
        }
        best.apart = gap > margin;
        if (gap > best.gap && of.is_outer(k)) {
            best.edge = k;
            best.normal = normal;
            best.gap = gap;
        }
    }
    return best;
}

/// The edge of a piece that looks most against a normal.
template <class Real>
std::int32_t edge_against(const ConvexPiece<Real>& piece, Vec2<Real> from, Wide<Real> normal) {
    std::int32_t best = 0;
    Face<Real> least = Face<Real>(2);
    for (std::int32_t k = 0; k < piece.count; ++k) {
        Wide<Real> own;
        if (normal_of(piece, k, from, own) && dot(own, normal) < least) {
            least = dot(own, normal);
            best = k;
        }
    }
    return best;
}

/// Cuts off what of a segment lies further along a direction than `most`. False: nothing is left.
template <class Real>
bool cut_off(Wide<Real> along, Face<Real> most, Wide<Real> (&end)[2]) {
    const Face<Real> beyond[2] = {dot(along, end[0]) - most, dot(along, end[1]) - most};
    if (beyond[0] > Face<Real>(0) && beyond[1] > Face<Real>(0)) {
        return false;
    }
    for (std::int32_t k = 0; k < 2; ++k) {
        if (beyond[k] > Face<Real>(0)) {
            const Face<Real> share = beyond[k] / (beyond[k] - beyond[1 - k]);
            end[k] = end[k] + share * (end[1 - k] - end[k]);
        }
    }
    return true;
}

/// A corner before a corner: no edge is before the other.
template <class Real>
void corner_before(const Wide<Real> (&face)[2], const Wide<Real> (&end)[2], Vec2<Real> from,
                   Face<Real> margin, PieceContact<Real>& contact) {
    for (const Wide<Real>& corner : face) {
        for (const Wide<Real>& at : end) {
            const Wide<Real> arm = at - corner;
            const Face<Real> gap = length(arm);
            if (gap <= margin && gap > Face<Real>(0)) {
                margin = gap;
                contact.normal = (Face<Real>(1) / gap) * arm;
                contact.point[0] = {convert<Face<Real>>(from) + at, gap};
                contact.count = 1;
            }
        }
    }
}

/// The other piece's points before a face.
template <class Real>
void points_before(const ConvexPiece<Real>& of, const BestFace<Real>& face,
                   const ConvexPiece<Real>& other, Vec2<Real> from, Face<Real> margin,
                   PieceContact<Real>& contact) {
    contact.normal = face.normal;
    const Wide<Real> begin = of.at(face.edge, from);
    const Wide<Real> finish = of.at(of.next(face.edge), from);
    const Wide<Real> along{-face.normal.y, face.normal.x};
    const std::int32_t k = edge_against(other, from, face.normal);
    const Wide<Real> edge[2] = {other.at(k, from), other.at(other.next(k), from)};
    Wide<Real> end[2] = {edge[0], edge[1]};
    if (!cut_off<Real>(along, dot(along, finish) + kEnd<Real>, end) ||
        !cut_off<Real>(Face<Real>(-1) * along, kEnd<Real> - dot(along, begin), end)) {
        corner_before<Real>({begin, finish}, edge, from, margin, contact);
        return;
    }
    for (const Wide<Real>& at : end) {
        const Face<Real> gap = dot(face.normal, at - begin);
        if (gap <= margin) {
            contact.point[contact.count++] = {convert<Face<Real>>(from) + at, gap};
        }
    }
}

}  // namespace

template <class Real>
bool ConvexPiece<Real>::is_outer(std::int32_t k) const {
    if (vertex == nullptr) {
        return true;
    }
    const std::int32_t here = number(k);
    std::int32_t ring = 0;
    while (ring + 1 < outline.rings && here >= outline.end_of(ring)) {
        ++ring;
    }
    const std::int32_t behind =
        here + 1 < outline.end_of(ring) ? here + 1 : outline.begin_of(ring);
    return number(next(k)) == behind;
}

template <class Real>
PieceContact<Real> contact_of(const ConvexPiece<Real>& one, const ConvexPiece<Real>& other,
                              Vec2<Real> from, Face<Real> margin) {
    PieceContact<Real> contact;
    const BestFace<Real> mine = best_face(one, other, from, margin);
    if (mine.apart) {
        return contact;
    }
    const BestFace<Real> its = best_face(other, one, from, margin);
    if (its.apart || (mine.edge < 0 && its.edge < 0)) {
        return contact;
    }
    if (its.edge >= 0 && (mine.edge < 0 || its.gap > mine.gap + kBetter<Real>)) {
        points_before(other, its, one, from, margin, contact);
    } else {
        points_before(one, mine, other, from, margin, contact);
        contact.normal = Face<Real>(-1) * contact.normal;
    }
    return contact;
}

#define WEIR_INSTANTIATE(Real)                                                               \
    template struct ConvexPiece<Real>;                                                       \
    template PieceContact<Real> contact_of(const ConvexPiece<Real>&, const ConvexPiece<Real>&, \
                                           Vec2<Real>, Face<Real>);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
