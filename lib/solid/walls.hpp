// What solids leave open, as the liquid sees them: the contour of all bodies merged.
#pragma once

#include "grid/staggered_grid.hpp"
#include "solid/body_table.hpp"

namespace weir {

inline constexpr std::uint16_t kNoBody = 0xFFFF;

/// Arrays share the grid's numbering. `active` false: no body exists and none of them is read.
template <class Real>
struct Walls {
    bool active = false;
    bool moving = false;                ///< a body has a velocity or a spin
    bool binary = false;                ///< Contour::mid_edge
    Real* distance = nullptr;           ///< signed distance at nodes, cells, negative inside
    std::uint16_t* nearest = nullptr;   ///< slot of the nearest body at nodes, or kNoBody
    std::uint8_t* cell_case = nullptr;  ///< marching squares case of the cell
    Real* open_u = nullptr;             ///< open fraction of the u face, 0 … 1
    Real* open_v = nullptr;
    Real* full_density = nullptr;       ///< density that a cell shows when all around it is full
    const Body<Real>* body = nullptr;
};

/// Velocity of the body's material at a point of the tank, cells/s.
template <class Real>
inline Vec2<Real> velocity_at(const Body<Real>& body, Vec2<Real> point) {
    return body.velocity + spin_velocity(body.spin, point - body.position);
}

/// Slot of the body that is nearest to an edge between two nodes, or kNoBody.
template <class Real>
inline std::uint16_t nearest_body(const Walls<Real>& walls, std::int32_t a, std::int32_t b) {
    return walls.distance[a] < walls.distance[b] ? walls.nearest[a] : walls.nearest[b];
}

/// Velocity of the nearest wall at a point between two nodes; 0 where no body is near.
template <class Real>
inline Vec2<Real> wall_velocity(const Walls<Real>& walls, std::int32_t a, std::int32_t b,
                                Vec2<Real> point) {
    const std::uint16_t slot = nearest_body(walls, a, b);
    return slot == kNoBody ? Vec2<Real>{} : velocity_at(walls.body[slot], point);
}

/// What moving walls push into the cell (i, j) through the closed parts of its faces, counted
/// outwards, cells/s: added to the divergence (Batty, Bertails & Bridson 2007).
template <class Real>
Real wall_flow(const GridShape& shape, const Walls<Real>& walls, std::int32_t i, std::int32_t j);

}  // namespace weir
