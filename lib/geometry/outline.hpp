// A body's outline: rings of vertices one after the other, the outer one counter-clockwise, then
// the holes clockwise, so that the solid is to the left of every edge.
#pragma once

#include <cstdint>

#include "math/vec2.hpp"

namespace weir {

template <class Real>
struct Outline {
    const Vec2<Real>* vertex = nullptr;
    std::int32_t count = 0;                   ///< of vertices, in all rings
    std::int32_t rings = 1;
    const std::uint16_t* ring_end = nullptr;  ///< number behind each ring's last vertex

    /// Number behind the last vertex of a ring. An outline of one ring needs no table.
    std::int32_t end_of(std::int32_t ring) const {
        return rings == 1 ? count : static_cast<std::int32_t>(ring_end[ring]);
    }
    std::int32_t begin_of(std::int32_t ring) const {
        return ring == 0 ? 0 : end_of(ring - 1);
    }
};

/// Calls visit(from, to) with the two vertices of every edge.
template <class Real, class Visit>
void for_each_edge(const Outline<Real>& outline, Visit visit) {
    std::int32_t first = 0;
    for (std::int32_t ring = 0; ring < outline.rings; ++ring) {
        const std::int32_t end = outline.end_of(ring);
        Vec2<Real> from = outline.vertex[end - 1];
        for (std::int32_t i = first; i < end; ++i) {
            const Vec2<Real> to = outline.vertex[i];
            visit(from, to);
            from = to;
        }
        first = end;
    }
}

}  // namespace weir
