// The edges of a polygon's rings on their grid, one after the other. Edges without length, between
// repeated vertices, are passed over.
#pragma once

#include "geometry/rings.hpp"

namespace weir {

struct Edge {
    GridVertex a;
    GridVertex b;
    std::int32_t ring = 0;
    std::int32_t index = 0;  ///< of the vertex a
};

struct EdgeBox {
    GridVertex low;
    GridVertex high;
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
    EdgeWalk(const RingsOnGrid& rings, std::int32_t first_ring, std::int32_t last_ring)
        : rings_(&rings), vertices_(rings[first_ring]), ring_(first_ring), last_ring_(last_ring) {
        settle();
    }

    bool done() const { return ring_ > last_ring_; }

    /// False at the end.
    bool next(Edge* edge) {
        if (done()) {
            return false;
        }
        *edge = {rings_->place(vertices_[index_]), end(), ring_, index_};
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
    GridVertex end() const {
        return rings_->place(vertices_[index_ + 1 < vertices_.size ? index_ + 1 : 0]);
    }

    /// On to the next edge that has a length, or behind the last ring.
    void settle() {
        while (!done()) {
            for (; index_ < vertices_.size; ++index_) {
                if (!are_one(rings_->place(vertices_[index_]), end())) {
                    return;
                }
            }
            index_ = 0;
            if (++ring_ <= last_ring_) {
                vertices_ = (*rings_)[ring_];
            }
        }
    }

    const RingsOnGrid* rings_;
    View<Vec2f> vertices_;
    std::int32_t ring_;
    std::int32_t last_ring_;
    std::int32_t index_ = 0;
};

/// Whether edge f comes next after edge e on their ring, edges without length apart.
inline bool follows(const RingsOnGrid& rings, const Edge& e, const Edge& f) {
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
        if (!are_one(rings.place(ring[i]), e.b) ||
            !are_one(rings.place(ring[i + 1 < ring.size ? i + 1 : 0]), e.b)) {
            return false;
        }
    }
    return false;
}

}  // namespace weir
