#include "solid/body_force.hpp"

#include "contour/marching_squares.hpp"

namespace weir {

template <class Real>
Vec2<Real> middle_of_contour(const GridShape& s, const Walls<Real>& walls, std::int32_t node) {
    const DistanceOf<Real>* low = walls.distance + node;
    const Real corner[4] = {low[0], low[1], low[s.stride + 1], low[s.stride]};
    const ContourCell<Real> cell = contour_cell(corner);
    Vec2<Real> sum;
    Real weight = Real(0);
    for (std::int32_t k = 0; k < cell.lines; ++k) {
        const ContourLine<Real>& line = cell.line[k];
        const Real size = length(line.to - line.from);
        sum = sum + size * (Real(0.5) * (line.from + line.to));
        weight += size;
    }
    return weight > Real(0) ? (Real(1) / weight) * sum : Vec2<Real>{Real(0.5), Real(0.5)};
}

namespace {

template <class Real>
Vec2<Real> at_corner(std::int32_t i, std::int32_t j) {
    return {static_cast<Real>(i), static_cast<Real>(j)};
}

/// Of the pressure's way from a cell's centre to the contour that a body closes there.
/// @param closed sum of the faces that it closes.
template <class Real>
Impulse<Real> contour_impulse(const GridShape& shape, const Walls<Real>& walls, std::int32_t i,
                              std::int32_t j, Vec2<Real> closed, Vec2<Real> gravity_dt,
                              Vec2<Face<Real>> centre) {
    const Vec2<Real> middle = middle_of_contour(shape, walls, shape.index(i, j));
    const Vec2<Real> half{Real(0.5), Real(0.5)};
    const Real more = dot(gravity_dt, middle - half);
    Impulse<Real> impulse;
    impulse.add(convert<Face<Real>>(more * closed),
                convert<Face<Real>>(at_corner<Real>(i, j) + middle) - centre);
    return impulse;
}

/// Impulse of the pressure on a body within the last substep, about its centre of mass: cell
/// pressure × closed parts of the faces, and the pressure's way from the cell's centre to the
/// wall, as it is at rest. Without that the force would move in steps of a cell.
/// Cost: a look at each cell of the body's rectangle, about 60 operations for each that it cuts.
template <class Real>
Impulse<Real> pressure_impulse(const GridShape& shape, const Walls<Real>& walls,
                               std::uint16_t slot, const PressedCells<Real>& cells) {
    const Vec2<Face<Real>> centre = walls.load[slot].at;
    Impulse<Real> impulse;
    for_each_beside(shape, walls, slot, cells, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        Vec2<Real> closed;
        const Vec2<Real> gradient = gradient_at_rest(shape, walls, cells, c);
        for_each_closed_face(shape, walls, i, j, [&](const ClosedFace<Real>& face) {
            if (face.slot != slot) {
                return;
            }
            const Real pressure = cells.pressure[c];
            if (face.thin) {
                const Real there = pressure + Real(dot(gradient, face.behind));
                impulse.add(convert<Face<Real>>(there * face.outward),
                            (centre_of_cell<Real>(i, j) - centre) +
                                convert<Face<Real>>(face.behind));
                return;
            }
            closed = closed + face.outward;
            impulse.add(convert<Face<Real>>(pressure * face.outward),
                        convert<Face<Real>>(face.centre) - centre);
        });
        if (closed.x != Real(0) || closed.y != Real(0)) {
            impulse.add(contour_impulse(shape, walls, i, j, closed, gradient, centre));
        }
    });
    return impulse;
}

}  // namespace

template <class Real>
void locate_bodies(BodyTable<Real>& table) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.kind != BodyKind::free) {
            BodyLoad<Real>& load = table.load[slot];
            load.arm = arm_of_centre(body, load);
            load.at = convert<Face<Real>>(body.position) + load.arm;
        }
    }
}

template <class Real>
void press_on_bodies(const GridShape& shape, const Walls<Real>& walls, BodyTable<Real>& table,
                     const PressedCells<Real>& cells) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.kind != BodyKind::free && !table.load[slot].is_free()) {
            table.load[slot].received.add(
                pressure_impulse(shape, walls, static_cast<std::uint16_t>(slot), cells));
        }
    }
}

template <class Real>
void forget_impulses(BodyTable<Real>& table) {
    for (std::int32_t slot = 0; slot <= table.capacity; ++slot) {
        table.load[slot].received = Impulse<Real>{};
    }
    settled(table) = {};
}

#define WEIR_INSTANTIATE(Real)                                                         \
    template void locate_bodies(BodyTable<Real>&);                                     \
    template Vec2<Real> middle_of_contour(const GridShape&, const Walls<Real>&,        \
                                          std::int32_t);                               \
    template void press_on_bodies(const GridShape&, const Walls<Real>&,                \
                                  BodyTable<Real>&, const PressedCells<Real>&);        \
    template void forget_impulses(BodyTable<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
