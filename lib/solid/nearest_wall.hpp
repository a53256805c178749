// The wall that is nearest to a face, whatever shows it: nodes, or a thin wall's edges.
#pragma once

#include "solid/face_axis.hpp"
#include "solid/thin_beside.hpp"

namespace weir {

/// Slot of an edge's body if liquid sticks to it, or kNoBody.
template <class Real>
inline std::uint16_t sticking_edge(const Walls<Real>& walls, const WallEdge& edge) {
    return walls.body[edge.slot].surface.no_slip ? edge.slot : kNoBody;
}

/// The wall that is nearest to a face, and its body if it is within reach and liquid sticks to it.
template <class Real>
struct NearestWall {
    Real distance;
    Vec2<Real> normal{};  ///< known where liquid sticks
    std::uint16_t slot = kNoBody;
    bool thin = false;

    NearestWall(const FaceAxis<Real>& axis, std::int32_t i, std::int32_t j, Real reach)
        : distance(axis.distance(axis.s.index(i, j))) {
        const std::int32_t face = axis.s.index(i, j);
        if constexpr (kHasThinWalls<Real>) {
            const ThinWalls<Real>* walls = axis.walls.thin;
            if (walls != nullptr && (walls->mark[face] & kTouching) != 0 && distance > Real(0)) {
                const NextWall<Real> next(*walls, axis.s, axis.centre(i, j), true);
                thin = next.edge != nullptr && next.distance < Real(1) + kHair<Real>;
                if (thin) {
                    distance = next.distance;
                    normal = next.normal;
                    slot = sticking_edge(axis.walls, *next.edge);
                    return;
                }
            }
        }
        slot = distance < reach ? axis.sticking(face) : kNoBody;
        if (slot != kNoBody) {
            normal = axis.normal(face);
        }
    }
};

}  // namespace weir
