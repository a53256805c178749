// The thin wall that something stands beside.
#pragma once

#include "solid/thin_sight.hpp"

namespace weir {

/// The thin wall nearest to a place in the tank, within a cell at least.
template <class Real>
struct NextWall {
    const WallEdge* edge = nullptr;
    Vec2<Real> normal{};      ///< from the wall to the place
    Real distance = Real(2);  ///< what is further does not count

    /// @param with_ends Whether edges stand beside what lies beyond their ends, too: not all around
    /// a corner an edge's normal tells where the wall is.
    NextWall(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> x, bool with_ends) {
        const auto i = static_cast<std::int32_t>(x.x);
        const auto j = static_cast<std::int32_t>(x.y);
        for_each_edge_around(thin, s, i, j, [&](const WallEdge& one) {
            const Vec2<Real> a = thin.vertex[one.from];
            const Vec2<Real> b = thin.vertex[one.to];
            const Product<Real> zero{};
            const bool before = dot(x - a, b - a) < zero;
            if (before || dot(x - b, a - b) < zero) {
                if (with_ends) {
                    const Vec2<Real> way = x - (before ? a : b);
                    const Real far = length(way);
                    look(one, far, far > Real(0) ? (Real(1) / far) * way : left_normal(thin, one));
                }
                return;
            }
            const Vec2<Real> left = left_normal(thin, one);
            const Real height = dot(x - a, left);
            look(one, absolute(height), height >= Real(0) ? left : Vec2<Real>{} - left);
        });
    }

private:
    void look(const WallEdge& one, Real far, Vec2<Real> from_it) {
        if (far < distance || (far == distance && edge != nullptr && goes_before(one, *edge))) {
            distance = far;
            normal = from_it;
            edge = &one;
        }
    }
};

/// Where the way from a place to another, at most a cell from it, first meets a thin wall.
template <class Real>
struct FirstMet {
    const WallEdge* edge = nullptr;  ///< null: nowhere
    Real part = Real(2);             ///< of the way

    FirstMet(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> p, Vec2<Real> q) {
        for_each_wall_edge(
            thin, s, static_cast<std::int32_t>(minimum(p.x, q.x)),
            static_cast<std::int32_t>(minimum(p.y, q.y)),
            static_cast<std::int32_t>(maximum(p.x, q.x)),
            static_cast<std::int32_t>(maximum(p.y, q.y)), [&](const WallEdge& one) {
                const Crossing<Real> met =
                    cross_edge(p, q, thin.vertex[one.from], thin.vertex[one.to]);
                if (met.found && (met.part < part || (met.part == part && edge != nullptr &&
                                                      goes_before(one, *edge)))) {
                    part = met.part;
                    edge = &one;
                }
            });
    }
};

}  // namespace weir
