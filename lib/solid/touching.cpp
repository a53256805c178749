#include "solid/touching.hpp"

namespace weir {

namespace {

/// An edge is covered where a body is so far in front of it, cells.
template <class Real>
constexpr Real kInFront = Real(1.0 / 16.0);

/// What a node has to be deeper by than its bodies say, cells: more than by rounding.
template <class Real>
constexpr Real kDeeper = Real(1.0 / 64.0);

/// Distances are exact up to here.
template <class Real>
constexpr Real kDeepest = Real(1);

/// Nodes of which the bodies are listed together, along an axis: slots are gone through once for
/// all of them, so that a map of thousands of tiles is drawn in a moment. Those of a block are
/// looked for among those of a wider one.
constexpr std::int32_t kBlock = 4;
constexpr std::int32_t kWide = 16;

/// Whether a body is one of those that make the union.
template <class Real>
bool is_part(const Body<Real>& body) {
    return body.kind == BodyKind::fixed && !body.hollow;
}

template <class Real>
void list_static(const DrawnBodies<Real>& all, const NodeBox& block, DrawnBodies<Real>& listed) {
    listed.narrow(all, block, is_part<Real>);
}

template <class Real>
struct Union {
    Bounds<Real> tank;
    BodyRoom<Real> room;
    DrawnBodies<Real> bodies;  ///< static ones, of a block

    Union(const GridShape& shape, const DrawnBodies<Real>& all)
        : tank{{}, {static_cast<Real>(shape.nx), static_cast<Real>(shape.ny)}}, bodies(all, room) {}

    /// Whether there are two static bodies, of which any node of a block may have been drawn by
    /// both.
    bool list(const DrawnBodies<Real>& all, const NodeBox& block) {
        list_static(all, block, bodies);
        return !bodies.fewer_than(2);
    }

    template <class Visit>
    void for_each_at(std::int32_t i, std::int32_t j, const Visit& visit) const {
        bodies.for_each_at({i, j, i, j}, [&](std::uint16_t, const Body<Real>& body) {
            if (is_part(body)) {
                visit(body);
            }
        });
    }

    /// Whether a body that has drawn the node (i, j) is at a point.
    bool holds(std::int32_t i, std::int32_t j, Vec2<Real> point) const {
        bool found = false;
        for_each_at(i, j, [&](const Body<Real>& body) {
            found = found || covers(bodies.outline(body), point);
        });
        return found;
    }

    /// From a node to the nearest point of an edge that is in front of nothing; at most kDeepest.
    Real depth(std::int32_t i, std::int32_t j) const {
        const Vec2<Real> node{static_cast<Real>(i), static_cast<Real>(j)};
        Real least = kDeepest<Real>;
        for_each_at(i, j, [&](const Body<Real>& body) {
            for_each_edge(bodies.outline(body), [&](Vec2<Real> from, Vec2<Real> to) {
                const bool none = (from.x == to.x && from.y == to.y) || beyond(tank, from, to);
                const Real away = none ? least : distance_to_segment(node, from, to);
                if (away < least && !holds(i, j, before_edge(node, from, to))) {
                    least = away;
                }
            });
        });
        return least;
    }

    /// A little before the point of an edge that is nearest to another one.
    static Vec2<Real> before_edge(Vec2<Real> other, Vec2<Real> from, Vec2<Real> to) {
        const Vec2<Real> edge = to - from;
        const Real size = length(edge);
        const Vec2<Real> along{edge.x / size, edge.y / size};
        const Vec2<Real> arm = other - from;
        const Real at = clamp<Real>(along.x * arm.x + along.y * arm.y, Real(0), size);
        return from + at * along + kInFront<Real> * Vec2<Real>{along.y, -along.x};
    }
};

/// Whether a node is inside, but not so deep that no edge is near.
template <class Real>
bool is_shallow(Real inside) {
    return inside <= Real(0) && inside > -kDeepest<Real>;
}

/// Whether there is one in a block: in most of a tank there is none, and no slot is asked.
template <class Real>
bool any_shallow(const NodeBox& block, const NodeField<Real>& field) {
    for (std::int32_t j = block.j0; j <= block.j1; ++j) {
        for (std::int32_t i = block.i0; i <= block.i1; ++i) {
            if (is_shallow<Real>(field.distance[field.origin + j * field.stride + i])) {
                return true;
            }
        }
    }
    return false;
}

template <class Real>
void deepen_block(const Union<Real>& bodies, const NodeBox& block, const NodeField<Real>& field) {
    for (std::int32_t j = block.j0; j <= block.j1; ++j) {
        for (std::int32_t i = block.i0; i <= block.i1; ++i) {
            const std::int32_t node = field.origin + j * field.stride + i;
            const Real inside = field.distance[node];
            if (!is_shallow(inside)) {
                continue;
            }
            std::int32_t drawn = 0;
            bodies.for_each_at(i, j, [&](const Body<Real>&) { ++drawn; });
            if (drawn < 2) {
                continue;
            }
            const Real depth = bodies.depth(i, j);
            if (depth > kDeeper<Real> - inside) {
                field.distance[node] = Real(0) - depth;
            }
        }
    }
}

template <class Visit>
void for_each_block(const NodeBox& box, std::int32_t nodes, const Visit& visit) {
    for (std::int32_t j = box.j0; j <= box.j1; j += nodes) {
        for (std::int32_t i = box.i0; i <= box.i1; i += nodes) {
            visit(NodeBox{i, j, minimum(i + nodes - 1, box.i1), minimum(j + nodes - 1, box.j1)});
        }
    }
}

}  // namespace

template <class Real>
void deepen_where_bodies_touch(const GridShape& tank, const DrawnBodies<Real>& all,
                               const NodeBox& box, const NodeField<Real>& field) {
    Union<Real> bodies(tank, all);
    BodyRoom<Real> room;
    DrawnBodies<Real> near(all, room);
    for_each_block(box, kWide, [&](const NodeBox& wide) {
        if (!any_shallow(wide, field)) {
            return;
        }
        list_static(all, wide, near);
        if (near.fewer_than(2)) {
            return;
        }
        for_each_block(wide, kBlock, [&](const NodeBox& block) {
            if (any_shallow(block, field) && bodies.list(near, block)) {
                deepen_block(bodies, block, field);
            }
        });
    });
}

template <class Real>
const detail::Touching<Real>& detail::touching() {
    static constexpr Touching<Real> kTouching{deepen_where_bodies_touch<Real>};
    return kTouching;
}

#define WEIR_INSTANTIATE(Real)                                                                \
    template const detail::Touching<Real>& detail::touching();                                \
    template void deepen_where_bodies_touch(const GridShape&, const DrawnBodies<Real>&,       \
                                            const NodeBox&, const NodeField<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
