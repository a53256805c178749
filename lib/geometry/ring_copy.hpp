// A ring as the library keeps it: turned the right way, without repeated vertices and without
// corners that are exactly straight.
#pragma once

#include "geometry/polygon.hpp"

namespace weir {

/// Reads a ring forwards or backwards from a given vertex on.
struct RingReader {
    View<Vec2f> ring;
    std::int32_t start;
    bool backwards;

    Vec2f at(std::int32_t k) const {
        const std::int32_t step = k % ring.size;
        const std::int32_t i = start + (backwards ? ring.size - step : step);
        return ring[i < ring.size ? i : i - ring.size];
    }
};

inline bool same_vertex(Vec2f a, Vec2f b) { return a.x == b.x && a.y == b.y; }

inline bool is_straight(Vec2f a, Vec2f b, Vec2f c) {
    return turn(convert<double>(a), convert<double>(b), convert<double>(c)) == 0.0;
}

/// The first vertex that is a corner; 0 if none is.
inline std::int32_t first_corner(View<Vec2f> ring) {
    const RingReader reader{ring, 0, false};
    for (std::int32_t i = 0; i < ring.size; ++i) {
        const Vec2f before = reader.at(i + ring.size - 1);
        if (same_vertex(before, ring[i])) {
            continue;
        }
        std::int32_t ahead = 1;
        while (ahead < ring.size && same_vertex(ring[i], reader.at(i + ahead))) {
            ++ahead;
        }
        if (!is_straight(before, ring[i], reader.at(i + ahead))) {
            return i;
        }
    }
    return 0;
}

/// Calls put(vertex) for each vertex that stays, the first corner first.
/// @param ring as `check_polygon` lets pass.
/// @return how many there were.
template <class Put>
std::int32_t copy_ring(View<Vec2f> ring, bool counter_clockwise, Put put) {
    const bool backwards = (twice_area_in_double(ring) > 0.0) != counter_clockwise;
    const RingReader reader{ring, first_corner(ring), backwards};
    std::int32_t kept = 1;
    Vec2f settled = reader.at(0);  // stays
    Vec2f last = settled;          // stays if the way bends there
    put(settled);
    for (std::int32_t k = 1; k <= ring.size; ++k) {
        const Vec2f next = reader.at(k);
        if (same_vertex(next, last)) {
            continue;
        }
        if (!same_vertex(last, settled) && !is_straight(settled, last, next)) {
            put(last);
            settled = last;
            ++kept;
        }
        last = next;
    }
    return kept;
}

}  // namespace weir
