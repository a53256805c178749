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

/// What another free body closes of a free one, or all others (kNoBody), in a cell without a
/// pressure: each of them has alike of what they close together, which is nothing where nothing
/// else is. The other one has the opposite.
template <class Real>
Impulse<Real> closed_by_free(const BodyTable<Real>& table, const GridShape& shape,
                             const Walls<Real>& walls, std::uint16_t slot, std::uint16_t other,
                             std::int32_t i, std::int32_t j);

/// Of all faces that a body closes of one cell.
template <class Real>
struct CellReach {
    Impulse<Real> sum;
    Impulse<Real> beyond;  ///< of what the pressure at rest is more there than in the cell's centre
    bool any = false;

    void add(const Impulse<Real>& face, Real more_there) {
        const auto more = static_cast<Face<Real>>(more_there);
        sum.add(face);
        beyond.add(Impulse<Real>{more * face.linear, more * face.angular});
        any = true;
    }
    Impulse<Real> impulse(Real pressure) const {
        const Face<Real> in_cell = static_cast<Face<Real>>(pressure);
        Impulse<Real> all{in_cell * sum.linear, in_cell * sum.angular};
        all.add(beyond);
        return all;
    }
};

/// Impulse of the pressure on a free body within the last substep, about its centre of mass.
/// Cost: a look at each cell of the body's rectangle, and for each line that the contour crosses
/// one at each edge.
template <class Real>
Impulse<Real> impulse_on_free(const GridShape& shape, const BodyTable<Real>& table,
                              const Walls<Real>& walls, std::uint16_t slot,
                              const PressedCells<Real>& cells);

}  // namespace weir
