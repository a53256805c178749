// Forces of the liquid on bodies: by its pressure, and by particles that hit them.
#pragma once

#include "solid/body_load.hpp"
#include "solid/thin_sight.hpp"
#include "solid/walls.hpp"

namespace weir {

/// What the pressure stage left for the solids to read.
template <class Real>
struct PressedCells {
    const Real* pressure = nullptr;  ///< dt p / ρ
    const LevelOf<Real>* level = nullptr;  ///< > 0: liquid
    Vec2<Real> gravity_dt;           ///< gravity × dt: the pressure's gradient at rest
    const DensityOf<Real>* density = nullptr;  ///< 1: full
    const VelocityOf<Real>* u = nullptr;       ///< on the faces
    const VelocityOf<Real>* v = nullptr;
    const VelocityOf<Real>* light_u = nullptr;  ///< 1/density there; null: 1 everywhere
    const VelocityOf<Real>* light_v = nullptr;
};

/// How dense the liquid in a cell is, over the first one's: its open faces tell.
template <class Real>
inline Real density_at_rest(const GridShape& s, const Walls<Real>& walls,
                            const PressedCells<Real>& cells, std::int32_t c) {
    if (Stored<Real>::shares_momentum || cells.light_u == nullptr) {
        return Real(1);
    }
    Real open = Real(0);
    Real light = Real(0);
    const auto look = [&](const ShareOf<Real>* shares, const VelocityOf<Real>* lights,
                          std::int32_t face) {
        const Real share = walls.active ? Real(shares[face]) : Real(1);
        open += share;
        light += share * Real(lights[face]);
    };
    look(walls.open_u, cells.light_u, c);
    look(walls.open_u, cells.light_u, c + 1);
    look(walls.open_v, cells.light_v, c);
    look(walls.open_v, cells.light_v, c + s.stride);
    return light > Real(0) ? open / light : Real(1);
}

/// The pressure's gradient at rest in a cell.
template <class Real>
inline Vec2<Real> gradient_at_rest(const GridShape& s, const Walls<Real>& walls,
                                   const PressedCells<Real>& cells, std::int32_t c) {
    return density_at_rest(s, walls, cells, c) * cells.gravity_dt;
}

/// Cells of a box around the nodes that a body wrote.
inline NodeBox cells_of(const GridShape& shape, const NodeBox& drawn) {
    return {maximum(0, drawn.i0 - 1), maximum(0, drawn.j0 - 1), minimum(shape.nx - 1, drawn.i1),
            minimum(shape.ny - 1, drawn.j1)};
}

/// Centre of a cell by its column and row, and by its place among all.
template <class Real>
inline Wide<Real> centre_of_cell(std::int32_t i, std::int32_t j) {
    using Number = Face<Real>;
    return {static_cast<Number>(i) + Number(0.5), static_cast<Number>(j) + Number(0.5)};
}
template <class Real>
inline Wide<Real> centre_of_cell(const GridShape& s, std::int32_t cell) {
    const std::int32_t inner = cell - s.index(0, 0);
    return centre_of_cell<Real>(inner % s.stride, inner / s.stride);
}

/// A closed part of a cell's face, as the pressure in the cell sees it.
template <class Real>
struct ClosedFace {
    Vec2<Real> outward;     ///< length: how much of the face is closed
    Vec2<Real> centre;      ///< of the face
    std::int32_t node = 0;  ///< at its left or lower end
    std::int32_t next = 0;  ///< and at the other
    std::uint16_t slot = kNoBody;
    std::uint8_t bit = 0;           ///< 1, 2, 4, 8: left, right, lower, upper
    bool thin = false;              ///< by a thin wall, which stands `behind` the cell's centre
    Vec2<Real> behind{};
};

/// Whose thin wall closes a face between two cells, and where, seen from the centre of one of them.
template <class Real>
[[gnu::noinline]] void find_thin(const ThinWalls<Real>& thin, std::int32_t before,
                                 std::int32_t cell, Vec2<Real> from, ClosedFace<Real>& face) {
    const WallEdge* edge = edge_between(thin, face.centre, before, cell, face.bit < 4);
    if (edge != nullptr) {
        const Vec2<Real> half = face.centre - from;
        const Vec2<Real> way = half + half;
        face.slot = edge->slot;
        face.thin = true;
        face.behind = cross_edge(from, from + way, thin.vertex[edge->from],
                                 thin.vertex[edge->to]).part * way;
    }
}

/// Calls visit(ClosedFace) for the faces of the cell (i, j) that solids close in part. They are
/// those through which wall_flow pushes: the same numbers, so that what the pressure does to a
/// body is the transpose of what the body does to the pressure.
/// @param among bits of the faces that are asked for.
template <class Real, class Visit>
inline void for_each_closed_face(const GridShape& s, const Walls<Real>& walls, std::int32_t i,
                                 std::int32_t j, Visit visit, std::uint32_t among = 15) {
    const std::int32_t node = s.index(i, j);
    const std::int32_t up = node + s.stride;
    const Real x = static_cast<Real>(i);
    const Real y = static_cast<Real>(j);
    constexpr Real kHalf = Real(0.5);
    const auto look = [&](Real open, Vec2<Real> outward, Vec2<Real> centre, std::int32_t a,
                          std::int32_t b, std::uint8_t bit) {
        if ((among & bit) != 0 && open < Real(1)) {
            ClosedFace<Real> face{(Real(1) - open) * outward, centre, a, b,
                                  nearest_body(walls, a, b), bit};
            if constexpr (kHasThinWalls<Real>) {
                if (walls.thin != nullptr &&
                    (walls.thin->mark[a] & (bit < 4 ? kLeftClosed : kLowerClosed)) != 0) {
                    find_thin(*walls.thin, a - (bit < 4 ? 1 : s.stride), a,
                              {x + kHalf, y + kHalf}, face);
                }
            }
            visit(face);
        }
    };
    look(walls.open_u[node], {Real(-1), Real(0)}, {x, y + kHalf}, node, up, 1);
    look(walls.open_u[node + 1], {Real(1), Real(0)}, {x + Real(1), y + kHalf}, node + 1, up + 1,
         2);
    look(walls.open_v[node], {Real(0), Real(-1)}, {x + kHalf, y}, node, node + 1, 4);
    look(walls.open_v[up], {Real(0), Real(1)}, {x + kHalf, y + Real(1)}, up, up + 1, 8);
}

/// Whether solids close all of a cell's faces: it has no pressure.
template <class Real>
inline bool is_shut(const GridShape& s, const Walls<Real>& walls, std::int32_t cell) {
    const auto shut = [](ShareOf<Real> open) { return !(Real(open) > Real(0)); };
    return shut(walls.open_u[cell]) && shut(walls.open_u[cell + 1]) &&
           shut(walls.open_v[cell]) && shut(walls.open_v[cell + s.stride]);
}

/// Calls visit(i, j, cell) for the cells that solids cut, of a body's rectangle.
template <class Real, class Visit>
inline void for_each_cut(const GridShape& s, const Walls<Real>& walls, std::uint16_t slot,
                         const Visit& visit) {
    const NodeBox box = cells_of(s, walls.body[slot].drawn);
    for (std::int32_t j = box.j0; j <= box.j1; ++j) {
        for (std::int32_t i = box.i0; i <= box.i1; ++i) {
            const std::int32_t c = s.index(i, j);
            if (!untouched(walls, c, c + s.stride)) {
                visit(i, j, c);
            }
        }
    }
}

/// Whether a cell is all within a body: what the body closes of it sums up to nothing, exactly.
template <class Real>
inline bool is_within(const GridShape& s, const Walls<Real>& walls, std::uint16_t slot,
                      std::int32_t cell) {
    const auto own = [&](std::int32_t node) { return nearest_at(walls, node) == slot; };
    const std::int32_t up = cell + s.stride;
    return is_shut(s, walls, cell) && own(cell) && own(cell + 1) && own(up) && own(up + 1);
}

/// Without the cells that are within the body.
template <class Real, class Visit>
inline void for_each_rim(const GridShape& s, const Walls<Real>& walls, std::uint16_t slot,
                         const Visit& visit) {
    for_each_cut(s, walls, slot, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        if (!is_within(s, walls, slot, c)) {
            visit(i, j, c);
        }
    });
}

/// The same as `for_each_cut` for cells of liquid.
template <class Real, class Visit>
inline void for_each_beside(const GridShape& s, const Walls<Real>& walls, std::uint16_t slot,
                            const PressedCells<Real>& cells, const Visit& visit) {
    for_each_cut(s, walls, slot, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        if (cells.level[c] > Real(0)) {
            visit(i, j, c);
        }
    });
}

/// Finds the centres of mass, once the bodies have moved.
template <class Real>
void locate_bodies(BodyTable<Real>& table);

/// Middle of the contour within a cell, from the cell's lower left corner.
template <class Real>
Vec2<Real> middle_of_contour(const GridShape& shape, const Walls<Real>& walls, std::int32_t node);

/// Where the middle of a face's closed part, at one of its ends, stands along it from its own.
template <class Real>
inline Real middle_of_closed(const Walls<Real>& walls, const ClosedFace<Real>& face) {
    const auto is_solid = [&](std::int32_t node) {
        return !(Real(walls.distance[node]) > Real(0));
    };
    const Real open = Real(1) - (absolute(face.outward.x) + absolute(face.outward.y));
    const Real half = Real(0.5) * open;
    if (is_solid(face.node) == is_solid(face.next)) {
        return Real(0);
    }
    return is_solid(face.node) ? Real(0) - half : half;
}

/// How the pressure at rest goes on from a cell's centre to where bodies close the cell. Without
/// that their force would move in steps of a cell.
template <class Real>
struct PressureAtRest {
    Vec2<Real> gradient;
    Vec2<Real> to_contour;  ///< to the middle of the contour in the cell

    PressureAtRest(const GridShape& s, const Walls<Real>& walls, std::int32_t cell, Vec2<Real> way)
        : gradient(way),
          to_contour(middle_of_contour(s, walls, cell) - Vec2<Real>{Real(0.5), Real(0.5)}) {}
    PressureAtRest(const GridShape& s, const Walls<Real>& walls, std::int32_t cell,
                   const PressedCells<Real>& cells)
        : PressureAtRest(s, walls, cell, gradient_at_rest(s, walls, cells, cell)) {}

    /// How much more there is at a closed face: along its normal the contour stands there, along
    /// the face its closed part. With the contour's middle for both, what a sliver behind the face
    /// adds to the closed part would be pressed at another height than in the cell beside it, and a
    /// body that leans would be driven along level liquid.
    Real more_at(const Walls<Real>& walls, const ClosedFace<Real>& face) const {
        const Real along = middle_of_closed(walls, face);
        return (face.bit & 3) != 0 ? dot(gradient, Vec2<Real>{to_contour.x, along})
                                   : dot(gradient, Vec2<Real>{along, to_contour.y});
    }
};

/// Adds what the pressure did in the last substep to the records of all bodies but free ones
/// (solid/body_reach.hpp).
template <class Real>
void press_on_bodies(const GridShape& shape, const Walls<Real>& walls, BodyTable<Real>& table,
                     const PressedCells<Real>& cells);

/// What a body takes at a point of the tank: the velocity that a mass of liquid lost there.
/// @param bound how much of the impulse goes as the body's velocity at that point does, a mass:
/// by that the body would yield too far if it were lighter.
template <class Real>
inline void receive(const Walls<Real>& walls, std::uint16_t slot, Face<Real> mass,
                    Vec2<Real> point, Vec2<Real> lost, Face<Real> bound) {
    const Vec2<Face<Real>> impulse = mass * convert<Face<Real>>(lost);
    BodyLoad<Real>& load = walls.load[slot];
    const Vec2<Face<Real>> arm = convert<Face<Real>>(point) - load.at;
    load.received.add(impulse, arm);
    load.blows.add(impulse, arm);
    load.blow_mass += bound;
}

/// A blow: the velocity that a particle lost.
template <class Real>
inline void receive_blow(const Walls<Real>& walls, std::uint16_t slot, Liquid kind,
                         Vec2<Real> point, Vec2<Real> lost) {
    const Face<Real> mass = walls.particle_mass[kind == Liquid::second ? 1 : 0];
    receive(walls, slot, mass, point, lost, mass);
}

/// Before a step.
template <class Real>
void forget_impulses(BodyTable<Real>& table);

}  // namespace weir
