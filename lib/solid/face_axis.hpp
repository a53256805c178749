// Faces of one component beside solids.
#pragma once

#include "grid/staggered_grid.hpp"
#include "solid/reflect.hpp"
#include "solid/walls.hpp"

namespace weir {

/// One component's faces: their nodes, and the way to the next face across them.
template <class Real>
struct FaceAxis {
    const GridShape& s;
    const Walls<Real>& walls;
    bool is_u;  ///< else v

    std::int32_t other_node() const { return is_u ? s.stride : 1; }
    /// From a face's cell to the one before it.
    std::int32_t before() const { return is_u ? 1 : s.stride; }
    Vec2<Real> centre(std::int32_t i, std::int32_t j) const {
        const Vec2<Real> corner = corner_of<Real>(s, i, j);
        constexpr Real kHalf = Real(0.5);
        return corner + (is_u ? Vec2<Real>{Real(0), kHalf} : Vec2<Real>{kHalf, Real(0)});
    }
    /// Faces beyond the tank's sides are images of those before them.
    bool in_tank(std::int32_t i, std::int32_t j) const {
        return is_u ? j >= 0 && j < s.ny : i >= 0 && i < s.nx;
    }
    Real of(Vec2<Real> v) const { return is_u ? v.x : v.y; }
    Vec2<Real> along(Real v) const {
        return is_u ? Vec2<Real>{v, Real(0)} : Vec2<Real>{Real(0), v};
    }
    const ShareOf<Real>* open() const { return is_u ? walls.open_u : walls.open_v; }
    Real distance(std::int32_t face) const {
        const DistanceOf<Real>* d = walls.distance;
        return Real(0.5) * (Real(d[face]) + Real(d[face + other_node()]));
    }
    Vec2<Real> gradient(std::int32_t face) const {
        const DistanceOf<Real>* d = walls.distance + face;
        const std::int32_t t = s.stride;
        return is_u ? Vec2<Real>{Real(0.25) * ((d[1] + d[t + 1]) - (d[-1] + d[t - 1])),
                                 d[t] - d[0]}
                    : Vec2<Real>{d[1] - d[0], Real(0.25) * ((d[t] + d[t + 1]) -
                                                            (d[-t] + d[1 - t]))};
    }
    /// In the middle of a thin solid either side is as near: that to which the axis points.
    Vec2<Real> normal(std::int32_t face) const {
        const Vec2<Real> along = gradient(face);
        const Real steepness = length(along);
        return steepness > Real(0)
                   ? (Real(1) / steepness) * along
                   : (is_u ? Vec2<Real>{Real(1), Real(0)} : Vec2<Real>{Real(0), Real(1)});
    }
    std::uint16_t sticking(std::int32_t face) const {
        return sticking_body(walls, face, face + other_node());
    }
    Vec2<Real> wall(std::uint16_t slot, Vec2<Real> place, Vec2<Real> n) const {
        const Body<Real>& body = walls.body[slot];
        return surface_velocity(body.surface, velocity_at(body, place), n);
    }
};

/// What is asked of walls only where viscous liquid sticks to them: linked with viscosity.
template <class Real>
struct StickingWalls {
    /// Slot of the nearest body to a face if liquid sticks to it, or kNoBody.
    std::uint16_t (*body)(const FaceAxis<Real>& axis, std::int32_t face);
    /// Velocity of its surface at a place with the normal n.
    Vec2<Real> (*velocity)(const FaceAxis<Real>& axis, std::uint16_t slot, Vec2<Real> place,
                           Vec2<Real> n);
    /// These as step/no_slip.hpp says.
    void (*centre_flow)(const FaceAxis<Real>& axis, const VelocityOf<Real>* other_mass,
                        const Real* other_momentum, VelocityOf<Real>* flow);
    void (*bind_to_thin)(const Walls<Real>& walls, const LevelOf<Real>* level,
                         StaggeredGrid<Real>& grid);
};

}  // namespace weir
