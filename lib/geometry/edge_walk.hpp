// The edges of a polygon's rings as the caller gave them, one after the other. Edges without
// length, between repeated vertices, are passed over.
#pragma once

#include "math/vec2.hpp"
#include "weir/types.hpp"

namespace weir {

/// Ring 0 is the outer one, ring k is holes[k - 1].
struct PolygonRings {
    View<Vec2f> outer;
    View<View<Vec2f>> holes;

    std::int32_t count() const { return 1 + holes.size; }
    View<Vec2f> operator[](std::int32_t ring) const {
        return ring == 0 ? outer : holes[ring - 1];
    }
};

struct Edge {
    Vec2f a;
    Vec2f b;
    std::int32_t ring = 0;
    std::int32_t index = 0;  ///< of the vertex a
};

struct EdgeBox {
    Vec2f low;
    Vec2f high;
};

inline EdgeBox unite(const EdgeBox& p, const EdgeBox& q) {
    return {{minimum(p.low.x, q.low.x), minimum(p.low.y, q.low.y)},
            {maximum(p.high.x, q.high.x), maximum(p.high.y, q.high.y)}};
}
inline EdgeBox box_of(const Edge& e) { return unite({e.a, e.a}, {e.b, e.b}); }
inline EdgeBox box_of(const Edge* edges, std::int32_t count) {
    EdgeBox box = box_of(edges[0]);
    for (std::int32_t i = 1; i < count; ++i) {
        box = unite(box, box_of(edges[i]));
    }
    return box;
}
inline bool overlap(const EdgeBox& p, const EdgeBox& q) {
    return p.low.x <= q.high.x && q.low.x <= p.high.x && p.low.y <= q.high.y && q.low.y <= p.high.y;
}

/// Walks over the edges of some rings. Copying it keeps a place.
class EdgeWalk {
public:
    EdgeWalk(const PolygonRings& rings, std::int32_t first_ring, std::int32_t last_ring)
        : rings_(&rings), vertices_(rings[first_ring]), ring_(first_ring), last_ring_(last_ring) {
        settle();
    }

    bool done() const { return ring_ > last_ring_; }

    /// False at the end.
    bool next(Edge* edge) {
        if (done()) {
            return false;
        }
        *edge = {vertices_[index_], end(), ring_, index_};
        ++index_;
        settle();
        return true;
    }

    std::int32_t take(Edge* edges, std::int32_t most) {
        std::int32_t taken = 0;
        while (taken < most && next(edges + taken)) {
            ++taken;
        }
        return taken;
    }

    /// Goes on by up to so many edges, at least one; their box.
    EdgeBox skip(std::int32_t most) {
        Edge edge;
        next(&edge);
        EdgeBox box = box_of(edge);
        for (std::int32_t i = 1; i < most && next(&edge); ++i) {
            box = unite(box, box_of(edge));
        }
        return box;
    }

private:
    Vec2f end() const { return vertices_[index_ + 1 < vertices_.size ? index_ + 1 : 0]; }

    /// On to the next edge that has a length, or behind the last ring.
    void settle() {
        while (!done()) {
            for (; index_ < vertices_.size; ++index_) {
                const Vec2f a = vertices_[index_];
                const Vec2f b = end();
                if (a.x != b.x || a.y != b.y) {
                    return;
                }
            }
            index_ = 0;
            if (++ring_ <= last_ring_) {
                vertices_ = (*rings_)[ring_];
            }
        }
    }

    const PolygonRings* rings_;
    View<Vec2f> vertices_;
    std::int32_t ring_;
    std::int32_t last_ring_;
    std::int32_t index_ = 0;
};

/// Whether edge f comes next after edge e on their ring, edges without length apart.
inline bool follows(const PolygonRings& rings, const Edge& e, const Edge& f) {
    if (e.ring != f.ring) {
        return false;
    }
    const View<Vec2f> ring = rings[e.ring];
    for (std::int32_t step = 1; step < ring.size; ++step) {
        const std::int32_t at = e.index + step;
        const std::int32_t i = at < ring.size ? at : at - ring.size;
        if (i == f.index) {
            return true;
        }
        if (ring[i].x != e.b.x || ring[i].y != e.b.y) {
            return false;
        }
        const Vec2f next = ring[i + 1 < ring.size ? i + 1 : 0];
        if (next.x != e.b.x || next.y != e.b.y) {
            return false;
        }
    }
    return false;
}

}  // namespace weir
