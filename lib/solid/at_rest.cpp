#include "solid/at_rest.hpp"

#include "solid/body_reach.hpp"

namespace weir {

template <class Real>
AtRest<Real> at_rest(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                     std::uint16_t slot, Turning turning) {
    using Number = Face<Real>;
    const GridShape& s = obstacles.tank;
    const Walls<Real>& walls = obstacles.walls;
    const Wide<Real> gravity = convert<Number>(cells.gravity_dt);
    const Wide<Real> from = obstacles.bodies.load[slot].at;
    AtRest<Real> rest;
    Meetings<Real>(obstacles.bodies).for_each_film_of(slot, [&](const Meeting<Real>& film) {
        const std::int32_t c = film.film_cell;
        const auto density = static_cast<Number>(density_at_rest(s, walls, cells, c));
        rest.press(felt_by(obstacles.bodies, slot, film, film.film),
                   dot(gravity, centre_of_cell<Real>(s, c) - from) + film.beyond / density);
        const Impulse<Real> besides = felt_by(obstacles.bodies, slot, film, film.besides);
        const Number light = Number(1) / density;
        rest.push.add(Impulse<Real>{light * besides.linear, light * besides.angular});
        rest.has_film = true;
    });
    if (!rest.has_film) {
        return rest;
    }
    for_each_rim(s, walls, slot, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        if (!(cells.level[c] > Real(0)) || is_shut(s, walls, c)) {
            return;
        }
        const PressureAtRest<Real> there(s, walls, c, cells.gravity_dt);
        const Number in_cell = dot(gravity, centre_of_cell<Real>(i, j) - from);
        for_each_closed_face(s, walls, i, j, [&](const ClosedFace<Real>& face) {
            if (face.slot == slot) {
                rest.press(turning == Turning::asked
                               ? reach_of_face(obstacles.bodies, walls, face)
                               : Impulse<Real>{convert<Number>(face.outward)},
                           in_cell + static_cast<Number>(there.more_at(walls, face)));
            }
        });
    });
    return rest;
}

#define WEIR_INSTANTIATE(Real)                                                                \
    template AtRest<Real> at_rest(const Obstacles<Real>&, const PressedCells<Real>&,          \
                                  std::uint16_t, Turning);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
