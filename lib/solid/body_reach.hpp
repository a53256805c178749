// What a free body pushes into a cell through the faces that it closes there, and so how the
// cell's pressure pushes the body: each is the transpose of the other.
//
// Along the body's way that is the closed part of a face. By its spin a piece of outline from a to
// b pushes ½(b² − a²), about the centre of mass, whichever way it takes there. Where the contour
// crosses the grid's lines stands the nearest point of the body's own outline: so a round body
// pushes nothing by its spin, and no pressure turns it.
#pragma once

#include "solid/body_force.hpp"

namespace weir {

template <class Real>
Impulse<Real> reach_of_face(const BodyTable<Real>& table, const Walls<Real>& walls,
                            const ClosedFace<Real>& face);

/// By its spin, what goes through a closed face beyond what `wall_flow` has of it.
template <class Real>
inline Face<Real> spun_beyond_face(const BodyLoad<Real>& load, const ClosedFace<Real>& face,
                                   const Impulse<Real>& reach) {
    const Vec2<Face<Real>> arm = convert<Face<Real>>(face.centre) - load.at;
    return (reach.angular - cross(arm, reach.linear)) * load.unpressed.spin;
}

/// Of all faces that a body closes of one cell.
template <class Real>
struct CellReach {
    Impulse<Real> sum;
    /// The pressure's way from the cell's centre to the contour, as it is at rest. Without that the
    /// force would move in steps of a cell.
    Face<Real> beyond = Face<Real>(0);
    bool any = false;

    Impulse<Real> impulse(Real pressure) const {
        const Face<Real> there = static_cast<Face<Real>>(pressure) + beyond;
        return {there * sum.linear, there * sum.angular};
    }
};

/// Along a gradient, from a cell's centre to the contour in it.
template <class Real>
Face<Real> way_to_contour(const GridShape& shape, const Walls<Real>& walls, std::int32_t node,
                          Vec2<Real> gradient);

/// `beyond` of a cell, for bodies that close faces of it.
template <class Real>
inline Face<Real> beyond_cell(const GridShape& shape, const Walls<Real>& walls,
                              const PressedCells<Real>& cells, std::int32_t cell) {
    return way_to_contour(shape, walls, cell, gradient_at_rest(shape, walls, cells, cell));
}

/// Impulse of the pressure on a free body within the last substep, about its centre of mass.
/// Cost: a look at each cell of the body's rectangle, and for each line that the contour crosses
/// one at each edge.
template <class Real>
Impulse<Real> impulse_on_free(const GridShape& shape, const BodyTable<Real>& table,
                              const Walls<Real>& walls, std::uint16_t slot,
                              const PressedCells<Real>& cells);

}  // namespace weir
