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

/// Impulse of the pressure on a body within the last substep, about its centre of mass: cell
/// pressure × closed parts of the faces, and the pressure's way from the cell's centre to the
/// wall, as it is at rest.
/// Cost: a look at each cell of the body's rectangle, about 60 operations for each that it cuts.
template <class Real>
Impulse<Real> pressure_impulse(const GridShape& shape, const Walls<Real>& walls,
                               std::uint16_t slot, const PressedCells<Real>& cells) {
    const Vec2<Face<Real>> centre = walls.load[slot].at;
    Impulse<Real> impulse;
    for_each_beside(shape, walls, slot, cells, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        const PressureAtRest<Real> at_rest(shape, walls, c, cells);
        const Vec2<Face<Real>> arm = centre_of_cell<Real>(i, j) - centre;
        for_each_closed_face(shape, walls, i, j, [&](const ClosedFace<Real>& face) {
            if (face.slot != slot) {
                return;
            }
            const Real pressure = cells.pressure[c];
            if (face.thin) {
                const Real there = pressure + Real(dot(at_rest.gradient, face.behind));
                impulse.add(convert<Face<Real>>(there * face.outward),
                            arm + convert<Face<Real>>(face.behind));
                return;
            }
            impulse.add(convert<Face<Real>>(pressure * face.outward),
                        convert<Face<Real>>(face.centre) - centre);
            impulse.add(convert<Face<Real>>(at_rest.more_at(walls, face) * face.outward),
                        arm + convert<Face<Real>>(at_rest.to_contour));
        });
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
