// A ring as the library keeps it: turned the right way, without repeated vertices and without
// corners that are straight, as the grid sees them that they were checked on.
#pragma once

#include "geometry/rings.hpp"

namespace weir {

/// Reads a ring forwards or backwards from a given vertex on.
struct RingReader {
    const RingsOnGrid& rings;
    View<Vec2f> ring;
    std::int32_t start;
    bool backwards;

    Vec2f vertex(std::int32_t k) const {
        const std::int32_t step = k % ring.size;
        const std::int32_t i = start + (backwards ? ring.size - step : step);
        return ring[i < ring.size ? i : i - ring.size];
    }
    GridVertex at(std::int32_t k) const { return rings.place(vertex(k)); }
};

/// The first vertex that is a corner; 0 if none is.
inline std::int32_t first_corner(const RingsOnGrid& rings, View<Vec2f> ring) {
    const RingReader reader{rings, ring, 0, false};
    for (std::int32_t i = 0; i < ring.size; ++i) {
        const GridVertex before = reader.at(i + ring.size - 1);
        const GridVertex here = reader.at(i);
        if (are_one(before, here)) {
            continue;
        }
        std::int32_t ahead = 1;
        while (ahead < ring.size && are_one(here, reader.at(i + ahead))) {
            ++ahead;
        }
        if (turn(before, here, reader.at(i + ahead)) != 0) {
            return i;
        }
    }
    return 0;
}

/// Calls put(vertex) for each vertex that stays, the first corner first.
/// @param rings as `check_polygon` lets pass.
/// @return how many there were.
template <class Put>
std::int32_t copy_ring(const RingsOnGrid& rings, std::int32_t ring, Put put) {
    const bool counter_clockwise = ring == 0;
    const bool backwards = (twice_area(rings, ring) > 0) != counter_clockwise;
    const RingReader reader{rings, rings[ring], first_corner(rings, rings[ring]), backwards};
    std::int32_t kept = 1;
    std::int32_t last = 0;  // stays if the way bends there
    GridVertex settled = reader.at(0);  // stays
    put(reader.vertex(0));
    for (std::int32_t k = 1; k <= reader.ring.size; ++k) {
        const GridVertex next = reader.at(k);
        const GridVertex bend = reader.at(last);
        if (are_one(next, bend)) {
            continue;
        }
        if (!are_one(bend, settled) && turn(settled, bend, next) != 0) {
            put(reader.vertex(last));
            settled = bend;
            ++kept;
        }
        last = k;
    }
    return kept;
}

}  // namespace weir
