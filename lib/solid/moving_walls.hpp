// What is asked of walls only while they move. By a table, which `move_bodies` hands out: a world
// without room for bodies that move links none of it.
#pragma once

#include "solid/walls.hpp"

namespace weir {

template <class Real>
struct Scene;

template <class Real>
struct MovingWalls {
    /// What they push into the cell (i, j) through the closed parts of its faces, counted outwards,
    /// cells/s: added to the divergence (Batty, Bertails & Bridson 2007).
    Real (*flow)(const StaggeredGrid<Real>& grid, const Walls<Real>& walls, std::int32_t i,
                 std::int32_t j);
    /// Whether a contour is in a cell that does not stand still: its body moves.
    bool (*shifts)(const Walls<Real>& walls, std::int32_t cell, std::int32_t up);
    /// Velocity of the nearest one at a point between two nodes; 0 where no body is near.
    Vec2<Real> (*velocity)(const Walls<Real>& walls, std::int32_t a, std::int32_t b,
                           Vec2<Real> point);
    /// Velocity of a body's material at a point of the tank.
    Vec2<Real> (*velocity_at)(const Body<Real>& body, Vec2<Real> point);
    /// Where a place of the liquid would be if it had moved with the body in this substep.
    Vec2<Real> (*carried)(const Scene<Real>& scene, const Body<Real>& body, Vec2<Real> x);
    /// The same of a particle, beside a body that is thin there: where nodes do not show it.
    Vec2<Real> (*origin)(const Scene<Real>& scene, const Body<Real>& body, Vec2<Real> before);
    /// A body whose surface is on a particle's way, or kNoBody.
    std::uint16_t (*body_on_way)(const Scene<Real>& scene, Vec2<Real> before, Vec2<Real> x);
};

template <class Real>
const MovingWalls<Real>& moving_walls();

/// Moving bodies go where their velocities take them, or stay for no time.
template <class Real>
void move_bodies(BodyTable<Real>& table, Walls<Real>& walls, Seconds<Real> dt_s);

/// Between steps: whether any move now. What the last substep knew is in no snapshot.
template <class Real>
void note_moving(const BodyTable<Real>& table, Walls<Real>& walls);

/// Velocity of a body's material at a point of the tank, cells/s.
template <class Real>
inline Vec2<Real> velocity_at(const Walls<Real>& walls, std::uint16_t slot, Vec2<Real> point) {
    return walls.moving != nullptr ? walls.moving->velocity_at(walls.body[slot], point)
                                   : Vec2<Real>{};
}

}  // namespace weir
