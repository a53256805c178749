#include "solid/films.hpp"

#include "solid/contour_hit.hpp"

namespace weir {

namespace {

/// From a wall to the cell before it, cells.
template <class Real>
constexpr Face<Real> kHair = Face<Real>(1.0 / 64.0);

template <class Real>
class Films {
public:
    Films(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells)
        : obstacles_(obstacles), cells_(cells), list_(obstacles.bodies) {}

    /// Between free bodies there is none: those that come and go pumped liquid together there (ten
    /// crates of 0.9 in a pool lost a quarter of its volume).
    void lay() const {
        std::int32_t* link = list_.first_film;
        if (*link != kFilmsNotLaid) {
            return;
        }
        *link = -1;
        list_.for_each_face([&](Meeting<Real>* meeting, std::int32_t count) {
            const std::uint16_t other = meeting[0].other;
            if (other != kNoBody && is_free_body(obstacles_.bodies, other)) {
                return;
            }
            const Wide<Real> way = meeting[count - 1].at - meeting[0].at;
            const Number size = length(way);
            if (meeting[0].gap < kWidestFilm<Real> && meeting[count - 1].gap < kWidestFilm<Real> &&
                size > Number(0)) {
                lay((Number(1) / size) * way, size, meeting, link);
            }
        });
    }

private:
    using Number = Face<Real>;

    /// Cell of a place, if that is in the tank and not all solid; otherwise negative.
    std::int32_t open_cell_at(Wide<Real> x) const {
        const GridShape& s = obstacles_.tank;
        if (x.x < Number(0) || x.x >= static_cast<Number>(s.nx) || x.y < Number(0) ||
            x.y >= static_cast<Number>(s.ny)) {
            return -1;
        }
        const std::int32_t cell = s.index(floor_to_int(x.x), floor_to_int(x.y));
        return obstacles_.walls.cell_case[cell] == kCellInside ? -1 : cell;
    }
    /// The same if it has a pressure.
    std::int32_t wet_cell_at(Wide<Real> x) const {
        const std::int32_t cell = open_cell_at(x);
        return cell >= 0 && cells_.level[cell] > Real(0) && !is_closed(cell) ? cell : -1;
    }
    bool is_closed(std::int32_t cell) const {
        const Walls<Real>& walls = obstacles_.walls;
        const auto shut = [](ShareOf<Real> open) { return !(Real(open) > Real(0)); };
        return shut(walls.open_u[cell]) && shut(walls.open_u[cell + 1]) &&
               shut(walls.open_v[cell]) && shut(walls.open_v[cell + obstacles_.tank.stride]);
    }

    /// How much of a face the liquid in the cell at a place presses on, if the face has so much of
    /// the cell: what the contour shows, or all where it shows no solid.
    Number shown_at(Wide<Real> x, const Meeting<Real>& end, std::int32_t cell, Number most) const {
        const std::int32_t i = floor_to_int(x.x);
        const std::int32_t j = floor_to_int(x.y);
        const auto inner = convert<Real>(x);
        const Stencil<Real> at{cell, inner.x - static_cast<Real>(i),
                               inner.y - static_cast<Real>(j)};
        if (interpolate(obstacles_.walls.distance, obstacles_.tank.stride, at) > Real(0)) {
            return most;
        }
        Wide<Real> pressed{};
        for_each_closed_face(obstacles_.tank, obstacles_.walls, i, j,
                             [&](const ClosedFace<Real>& face) {
                                 if (face.slot == end.slot) {
                                     pressed = pressed + convert<Number>(face.outward);
                                 }
                             });
        return clamp(dot(pressed, end.normal), Number(0), most);
    }

    /// How far it is from a place to the end of its cell.
    static Number way_out(Number x, Number way) {
        const auto low = static_cast<Number>(floor_to_int(x));
        return way > Number(0) ? (low + Number(1) - x) / way
                               : (way < Number(0) ? (low - x) / way : Number(kLooksUnder));
    }

    /// How much of a face cells press on from one of its ends, and the last of them. Looks halfway
    /// between the face and what it lies on.
    Number shown_from(const Meeting<Real>& end, Wide<Real> inwards, Number steeper, Number most,
                      std::int32_t& last) const {
        Number shown = Number(0);
        Number way = Number(0);
        for (std::int32_t look = 0; look < kLooksUnder && way < most; ++look) {
            const Number ahead = way + kHair<Real>;
            const Number gap = end.gap + ahead * steeper;
            const Wide<Real> x = end.at + ahead * inwards - (Number(0.5) * gap) * end.normal;
            const std::int32_t cell = wet_cell_at(x);
            if (cell < 0) {
                break;
            }
            last = cell;
            const Number next =
                minimum(most, ahead + minimum(way_out(x.x, inwards.x), way_out(x.y, inwards.y)));
            shown += shown_at(x, end, cell, next - way);
            way = next;
        }
        return shown;
    }

    /// To both ends of a face its half of the film, or all to the one that is open.
    void lay(Wide<Real> way, Number size, Meeting<Real>* meeting, std::int32_t*& link) const {
        constexpr Number kBeside = Number(0.3);
        const Wide<Real> out[2] = {Number(-1) * way, way};
        std::int32_t cell[2];
        for (std::int32_t k = 0; k < 2; ++k) {
            cell[k] = open_cell_at(meeting[k].at + kBeside * (out[k] + meeting[k].normal));
        }
        for (std::int32_t k = 0; k < 2; ++k) {
            Meeting<Real>& end = meeting[k];
            if (cell[k] < 0 || !(cells_.level[cell[k]] > Real(0))) {
                continue;
            }
            const Number most = cell[1 - k] >= 0 ? Number(0.5) * size : size;
            end.film_cell = cell[k];
            const Wide<Real> inwards = Number(-1) * out[k];
            const Number steeper = (meeting[1 - k].gap - end.gap) / size;
            const Number shown = shown_from(end, inwards, steeper, most, end.film_cell);
            end.film = most - shown;
            end.middle = end.at + (Number(0.5) * (most + shown)) * inwards;
            if (end.film > Number(0)) {
                *link = static_cast<std::int32_t>(&end - list_.entry);
                link = &end.next_film;
                *link = -1;
            }
        }
    }

    const Obstacles<Real>& obstacles_;
    const PressedCells<Real>& cells_;
    Meetings<Real> list_;
};

}  // namespace

template <class Real>
void lay_films(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells) {
    Films<Real>(obstacles, cells).lay();
}

template <class Real>
Impulse<Real> film_impulse(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                           std::uint16_t slot) {
    using Number = Face<Real>;
    Impulse<Real> sum;
    Meetings<Real>(obstacles.bodies).for_each_film([&](const Meeting<Real>& meeting) {
        if (meeting.slot != slot) {
            return;
        }
        const std::int32_t stride = obstacles.tank.stride;
        const std::int32_t inner = meeting.film_cell - obstacles.tank.index(0, 0);
        const Wide<Real> centre{static_cast<Number>(inner % stride) + Number(0.5),
                                static_cast<Number>(inner / stride) + Number(0.5)};
        const Number pressure =
            static_cast<Number>(cells.pressure[meeting.film_cell]) +
            dot(convert<Number>(cells.gravity_dt), meeting.middle - centre);
        sum.add(meeting.pushes(obstacles.bodies.load[slot], pressure));
    });
    return sum;
}

#define WEIR_INSTANTIATE(Real)                                                                  \
    template void lay_films(const Obstacles<Real>&, const PressedCells<Real>&);                 \
    template Impulse<Real> film_impulse(const Obstacles<Real>&, const PressedCells<Real>&,      \
                                        std::uint16_t);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
