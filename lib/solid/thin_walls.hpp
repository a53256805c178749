// Walls thinner than a cell, which the grid's nodes cannot show: open polylines, thin plates and
// spikes. Their edges are kept cell by cell, so that whoever stands near one finds it.
#pragma once

#include "base/never.hpp"
#include "solid/body_table.hpp"
#include "grid/staggered_grid.hpp"

namespace weir {

inline constexpr std::uint16_t kNoEdge = 0xFFFF;

/// A closed polygon is thin where its inside is narrower than this, cells: the contour of wider
/// ones holds what it shows.
template <class Real>
inline constexpr Real kThin = Real(1.5);

/// A body that moves further than this in a substep is taken as put there, cells: it takes nothing
/// along.
template <class Real>
inline constexpr Real kLongestSweep = Real(4);

/// An edge of a body in one of the cells that it passes.
struct WallEdge {
    std::int32_t cell = 0;
    std::int32_t from = 0;  ///< places of its vertices in the pool
    std::int32_t to = 0;
    std::uint16_t slot = 0;
    std::uint16_t next = kNoEdge;  ///< another one in the same cell
};

static_assert(sizeof(WallEdge) <= kWallEdgeBytes, "raise kWallEdgeBytes");

/// Of two walls at the same place always the same one answers, in whatever order the records stand.
inline bool goes_before(const WallEdge& edge, const WallEdge& other) {
    return edge.slot != other.slot ? edge.slot < other.slot : edge.from < other.from;
}

/// What a body's thin edges take of the pool.
template <class Real>
struct ThinBody {
    Rotation<Real> turned;   ///< since particles last met it
    std::int32_t first = 0;  ///< of its records
    std::int32_t room = 0;
    std::int32_t count = 0;
    bool swept = false;      ///< it moved since, and not too far to be followed
};

static_assert(sizeof(ThinBody<float>) <= kThinBodyBytes<float>, "raise kThinBodyBytes");
static_assert(sizeof(ThinBody<double>) <= kThinBodyBytes<double>, "raise kThinBodyBytes");

/// What of an edge is thin, in 255ths of its length: up to `head` and from `tail` on.
struct ThinSpan {
    std::uint8_t head = 0;
    std::uint8_t tail = 255;

    bool whole() const { return head >= tail; }
    bool any() const { return head > 0 || tail < 255; }
};

/// Bits of a cell's mark. Left and lower face are the cell's own.
enum ThinMark : std::uint8_t {
    kNear = 1,            ///< an edge within two cells
    kTouching = 2,        ///< an edge within one cell
    kLeftClosed = 4,      ///< between the centres of this cell and the one on the left is a wall
    kLowerClosed = 8,
    kLeftUnseen = 16,     ///< and it stands before the face, seen from this cell's centre
    kLowerUnseen = 32,
    kLeftUnseenBefore = 64,  ///< seen from the other cell's centre
    kLowerUnseenBefore = 128,
};

template <class Real>
struct ThinWalls {
    WallEdge* edge = nullptr;
    std::uint16_t* first = nullptr;  ///< a cell's first record, or kNoEdge
    std::uint8_t* mark = nullptr;    ///< a cell's ThinMark bits
    ThinSpan* span = nullptr;        ///< of the edge that begins at each vertex of the pool
    ThinBody<Real>* body = nullptr;
    const Vec2<Real>* vertex = nullptr;  ///< the pool, placed in the tank
    std::uint16_t capacity = 0;      ///< records; 0: this world has no room for thin walls
    bool any_closed = false;         ///< some are polygons', which have an inside
    std::int32_t used = 0;           ///< records; 0: nothing is looked at, either
    Real reach = Real(0);            ///< furthest way of any of them since particles met them
};

/// The marks of the cell that a place lies in.
template <class Real>
inline std::uint32_t mark_at(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> x) {
    return thin.mark[s.index(static_cast<std::int32_t>(x.x), static_cast<std::int32_t>(x.y))];
}

/// The first column from i on, before `end`, in which a cell of some rows has that mark; `end` if
/// none has. What lies before it is done in lanes. Null: there are no thin walls.
template <class Real>
inline std::int32_t next_marked(const ThinWalls<Real>* thin, const GridShape& s,
                                std::int32_t first_j, std::int32_t last_j, std::int32_t i,
                                std::int32_t end, ThinMark mark) {
    if (thin == nullptr) {
        return end;
    }
    const std::int32_t low = maximum(first_j, 0);
    const std::int32_t rows = minimum(last_j, s.ny - 1) - low;
    const std::uint8_t* const marks = thin->mark + s.index(0, low);
    const auto marks_of = [&](auto columns, std::int32_t first) {
        const std::uint8_t* at = marks + first;
        auto all = columns;
        for (std::int32_t j = 0; j <= rows; ++j, at += s.stride) {
            WEIR_COPY_BYTES(&columns, at, sizeof columns);
            all = static_cast<decltype(all)>(all | columns);
        }
        return all;
    };
    while (i + 8 <= end && (marks_of(std::uint64_t{0}, i) & (0x0101010101010101U * mark)) == 0) {
        i += 8;
    }
    while (i < end && (marks_of(std::uint8_t{0}, i) & mark) == 0) {
        ++i;
    }
    return i;
}

/// Which of its faces a cell's centre sees.
struct SeenFaces {
    bool left;
    bool right;
    bool lower;
    bool upper;
};
template <class Real>
inline SeenFaces faces_seen(const ThinWalls<Real>& thin, const GridShape& s, std::int32_t c) {
    return {(thin.mark[c] & kLeftUnseen) == 0, (thin.mark[c + 1] & kLeftUnseenBefore) == 0,
            (thin.mark[c] & kLowerUnseen) == 0,
            (thin.mark[c + s.stride] & kLowerUnseenBefore) == 0};
}

/// Records that a body of so many edges and that length (cells) needs at any pose; of one that is
/// longer than any world has room for, more than there is.
template <class Real>
inline std::int32_t records_needed(Real length, std::int32_t edges) {
    return 3 * (floor_to_int(minimum(length, Real(kMaxWallEdges))) + 1) + 6 * edges;
}

/// No wall anywhere.
template <class Real>
void clear_thin_walls(ThinWalls<Real>& thin, const GridShape& shape, std::int32_t bodies);

/// Finds what of a new body's edges is thin and keeps records of it. False: there is no room, and
/// nothing changed. Cost: for each half cell of outline a test against all of its edges.
template <class Real>
bool add_thin_edges(ThinWalls<Real>& thin, const GridShape& shape, const BodyTable<Real>& table,
                    std::int32_t slot);

/// Whether all edges of a body are thin all along.
template <class Real>
bool is_thin_all_over(const ThinWalls<Real>& thin, const BodyTable<Real>& table,
                      std::int32_t slot);

/// Forgets a body's records before `remove` of the body table. All others want `relink_all` after.
template <class Real>
void remove_thin_edges(ThinWalls<Real>& thin, const BodyTable<Real>& table, std::int32_t slot);

/// Records of a body that moved, anew.
template <class Real>
void relink(ThinWalls<Real>& thin, const GridShape& shape, const BodyTable<Real>& table,
            std::int32_t slot);

template <class Real>
void relink_all(ThinWalls<Real>& thin, const GridShape& shape, const BodyTable<Real>& table);

/// Before particles meet walls: how far each body came since they last did; after: forget it.
template <class Real>
void follow_bodies(ThinWalls<Real>& thin, const BodyTable<Real>& table);
template <class Real>
void forget_ways(ThinWalls<Real>& thin, BodyTable<Real>& table);

/// Marks, closed faces and full density of the cells whose open fractions were just computed anew
/// around a box of nodes.
template <class Real>
void close_thin_faces(const GridShape& shape, const NodeBox& nodes, ThinWalls<Real>& thin,
                      ShareOf<Real>* open_u, ShareOf<Real>* open_v,
                      ShareOf<Real>* full_density);

template <class Real>
inline constexpr bool kHasThinWalls = !Stored<Real>::coarse;
template <class Real>
using ThinWallsPointer =
    std::conditional_t<kHasThinWalls<Real>, const ThinWalls<Real>*,
                       Never<const ThinWalls<Real>>>;

}  // namespace weir
