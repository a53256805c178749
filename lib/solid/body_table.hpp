// The bodies: a table of slots with generations, and one pool of vertices behind it.
#pragma once

#include "base/array_view.hpp"
#include "contour/raster.hpp"
#include "grid/surface_law.hpp"
#include "math/rotation.hpp"
#include "weir/config.hpp"
#include "weir/memory.hpp"

namespace weir {

/// A place or a way in the numbers of the public face, for sums that fixed point would saturate.
template <class Real>
using Wide = Vec2<Face<Real>>;

enum class BodyKind : std::uint8_t { free, fixed, moving };

/// `World::move_body`: whether a body has a place to be at by the end of the step; or had one in
/// the last step, which held it, and was not told another.
enum class Lead : std::uint8_t { none, now, held };

/// How far a body's furthest point goes along an axis at most, if its position goes that way and
/// it turns by so much. The same of velocities.
template <class Number>
Number furthest_way(Vec2<Number> way, Number turn, Number radius) {
    return larger_part(way) + absolute(turn) * radius;
}

/// Cells and seconds. Vertices stand at first_vertex in the pools, pieces at
/// per_vertex() × first_vertex, so that one number says where everything is.
template <class Real>
struct Body {
    Vec2<Real> position;
    Vec2<Real> velocity;
    Real angle = Real(0);
    Real spin = Real(0);
    SurfaceLaw<Real> surface;
    Real radius = Real(0);           ///< of the circle about `position` that holds it
    std::int32_t first_vertex = 0;
    std::int32_t vertex_count = 0;  ///< in all rings
    std::int32_t room = 0;          ///< places that it takes in the pools
    std::int32_t rings = 1;         ///< 1 + holes
    std::int32_t piece_length = 0;  ///< used entries of its piece list
    NodeBox drawn;                  ///< nodes that it wrote when it was last rasterized
    NodeBox left;                   ///< while it is rasterized anew: the time before
    Vec2<Real> met_position;        ///< where it was when particles last met it
    Real met_angle = Real(0);
    std::uint16_t generation = 0;
    BodyKind kind = BodyKind::free;
    bool moved = false;             ///< since it was last rasterized
    bool open = false;              ///< a polyline
    bool hollow = false;            ///< thin all over: the nodes do not show it
    Lead led = Lead::none;          ///< until the step is done: `World::move_body`
    bool leapt = false;             ///< a call has put it elsewhere since the last step

    bool has_speed() const {
        return velocity.x != Real(0) || velocity.y != Real(0) || spin != Real(0);
    }
    Real fastest_point() const { return furthest_way(velocity, spin, radius); }
};
static_assert(sizeof(Body<float>) <= kBodyBytes<float>, "raise kBodyBytes");
static_assert(sizeof(Body<double>) <= kBodyBytes<double>, "raise kBodyBytes");

template <class Real>
struct BodyLoad;

/// Slots first … end − 1.
struct Slots {
    std::int16_t first = 0;
    std::int16_t end = 0;
};

template <class Real>
struct BodyTable {
    Body<Real>* body = nullptr;
    std::int16_t capacity = 0;
    std::int16_t used = 0;          ///< bodies that exist
    Slots movable;                  ///< steps need not go through the others
    Vec2<Real>* local = nullptr;    ///< vertices in the bodies' own frames
    Vec2<Real>* placed = nullptr;   ///< the same vertices in the tank, at the current poses
    std::uint16_t* pieces = nullptr;
    ArrayView<std::uint16_t> scratch;  ///< of the decomposition; empty: bodies have no pieces
    /// What bodies receive, and behind them the tank. Null: the world has no room for it.
    BodyLoad<Real>* load = nullptr;
    std::int32_t vertex_capacity = 0;
    std::int32_t vertices_used = 0;

    const Vec2<Real>* ring(const Body<Real>& of) const { return placed + of.first_vertex; }
    /// Numbers in `pieces` for each vertex.
    std::int32_t per_vertex() const {
        return scratch.empty() ? 1 : static_cast<std::int32_t>(kPieceIndicesPerVertex);
    }
    /// They stand at the end of the body's room for pieces.
    std::uint16_t* ring_ends(const Body<Real>& of) const {
        return piece_list(of) + per_vertex() * of.room - of.rings;
    }
    Outline<Real> outline(const Body<Real>& of) const {
        return {ring(of), of.vertex_count, of.rings, ring_ends(of)};
    }
    std::uint16_t* piece_list(const Body<Real>& of) const {
        return pieces + per_vertex() * of.first_vertex;
    }
};

/// Slot of a free body, or −1.
template <class Real>
std::int32_t find_free_slot(const BodyTable<Real>& table);

/// Whether the id names a body that exists.
template <class Real>
bool exists(const BodyTable<Real>& table, BodyId id);

/// How polygons are cut into convex pieces (geometry/convex_decomposition.hpp).
template <class Real>
using Decompose = std::int32_t (*)(const Outline<Real>& outline, ArrayView<std::uint16_t> scratch,
                                   ArrayView<std::uint16_t> pieces);

/// Copies the polygon behind the vertices in use and cuts it into convex pieces, if `cut` is not
/// null. The caller has checked it and that there is room. False: rounding has left no area;
/// nothing changed.
template <class Real>
bool add_polygon(BodyTable<Real>& table, const BodyDef& def, Face<Real> cells_per_m,
                 Decompose<Real> cut, Body<Real>& body);

/// Copies an open polyline, without repeated vertices.
template <class Real>
void add_polyline(BodyTable<Real>& table, const BodyDef& def, Face<Real> cells_per_m,
                  Body<Real>& body);

/// Finds the slots from the first body that can move to the last one.
template <class Real>
void note_movable(BodyTable<Real>& table);

/// Whether viscous liquid would stick to any body.
template <class Real>
bool any_without_slip(const BodyTable<Real>& table);

/// Whether any body is free, also if it is led.
template <class Real>
bool any_free(const BodyTable<Real>& table);

/// Turns and moves the vertices to the body's pose.
template <class Real>
void place(BodyTable<Real>& table, const Body<Real>& body);

/// Begins or ends that a body is led: a free one yields to nothing meanwhile.
template <class Real>
void lead(BodyTable<Real>& table, std::int32_t slot, bool led);

/// Ends it for all: who is not free stands still. `held`: not yet, the next step takes them there.
template <class Real>
void end_leads(BodyTable<Real>& table, bool held);

/// A step begins that takes as much longer as the last one held: who was led there, and is led on
/// no further, takes all of it for that way.
template <class Real>
void slow_leads(BodyTable<Real>& table, Face<Real> share);

/// Frees the slot and closes the gap that its vertices leave.
template <class Real>
void remove(BodyTable<Real>& table, std::int32_t slot);

}  // namespace weir
