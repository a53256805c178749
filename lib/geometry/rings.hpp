// A polygon's rings as the caller gave them, and their vertices in whole numbers.
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

using GridVertex = Vec2<std::int32_t>;

inline bool are_one(GridVertex a, GridVertex b) { return a.x == b.x && a.y == b.y; }

inline Vec2<std::int64_t> way(GridVertex from, GridVertex to) {
    return convert<std::int64_t>(to - from);
}

/// Twice the area of the triangle a b c: positive where the way a → b → c turns left.
std::int64_t turn(GridVertex a, GridVertex b, GridVertex c);

/// The rings on a grid on which the furthest coordinate is below 2^29: turns are exact in 64 bits,
/// so that a touch is told from a near miss, and no finite input misbehaves. A float's last digit
/// is 32 steps there, of coordinates that are a 64th as large half a step.
struct RingsOnGrid : PolygonRings {
    float steps_per_m;

    explicit RingsOnGrid(const PolygonRings& rings);
    GridVertex place(Vec2f vertex) const;
};

/// Twice the area of a ring, positive if it turns left. Only of one that does not cross itself is
/// it sure to fit.
std::int64_t twice_area(const RingsOnGrid& rings, std::int32_t ring);

}  // namespace weir
