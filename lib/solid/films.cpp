#include "solid/films.hpp"

#include "solid/at_rest.hpp"
#include "solid/body_reach.hpp"
#include "solid/contour_hit.hpp"

namespace weir {

namespace {

/// Liquid is looked for so far beside and above a body's lowest points, and beyond, cells.
constexpr double kBeside = 0.3;

/// In place of a cell.
constexpr std::int32_t kSolidBeside = -1;
constexpr std::int32_t kAirBeside = -2;

template <class Real>
class Films {
public:
    Films(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells)
        : obstacles_(obstacles), cells_(cells), list_(obstacles.bodies) {}

    /// Under what lies on walls and bodies that do as told, and between free ones that both do:
    /// those that come and go pump liquid together there.
    void lay() const {
        std::int32_t* link = list_.first_film;
        if (*link != kFilmsNotLaid) {
            return;
        }
        *link = -1;
        for (Meeting<Real>* first = list_.begin(); first != list_.end();) {
            const std::uint16_t slot = first->slot;
            const std::int32_t* const begun = link;
            Laid laid;
            while (first != list_.end() && first->slot == slot) {
                Meeting<Real>* last = first;
                while (last + 1 != list_.end() && list_.of_one_face(*first, last[1])) {
                    ++last;
                }
                if (is_free(first->other)) {
                    while (last + 1 != list_.end() && last[1].slot == slot &&
                           last[1].other == first->other) {
                        ++last;
                    }
                    if (rests(slot) && rests(first->other)) {
                        lay_between(first, link);
                    }
                } else if (minimum(first->gap, last->gap) < kWidestFilm<Real>) {
                    lay(first, last, link, laid);
                }
                first = last + 1;
            }
            if (*begun >= 0 && laid.size > Number(0)) {
                put_right(slot, *begun, laid);
            }
        }
    }

private:
    using Number = Face<Real>;

    bool is_free(std::uint16_t slot) const {
        return slot != kNoBody && is_free_body(obstacles_.bodies, slot);
    }
    /// Whether a body lies on what does as told.
    bool rests(std::uint16_t slot) const {
        const Wide<Real> gravity = convert<Number>(cells_.gravity_dt);
        for (const Meeting<Real>& point : list_) {
            if (point.slot > slot) {
                break;
            }
            if (point.slot == slot && point.gap < kWidestFilm<Real> && !is_free(point.other) &&
                dot(point.normal, gravity) < Number(0)) {
                return true;
            }
        }
        return false;
    }

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
    /// Whether a cell has a pressure.
    bool is_wet(std::int32_t cell) const {
        return cells_.level[cell] > Real(0) && !is_shut(obstacles_.tank, obstacles_.walls, cell);
    }

    /// Where points of a body are before one plane.
    struct Strip {
        Wide<Real> middle;  ///< as far from the plane as the nearest point
        Wide<Real> along;
        Number half;        ///< of its length
    };
    Strip strip_of(const Meeting<Real>* first, const Meeting<Real>* last) const {
        const Meeting<Real>* nearest = first;
        const Wide<Real> along = first->side();
        Number low = Number(0);
        Number high = Number(0);
        for (const Meeting<Real>* one = first; one <= last; ++one) {
            const Number place = dot(along, one->at - first->at);
            low = minimum(low, place);
            high = maximum(high, place);
            nearest = one->gap < nearest->gap ? one : nearest;
        }
        const Number to = Number(0.5) * (low + high) - dot(along, nearest->at - first->at);
        return {nearest->at + to * along, along, Number(0.5) * (high - low)};
    }

    /// The first cell with a pressure beyond an end of a strip; else whether there is air or solid.
    std::int32_t cell_beside(const Strip& strip, const Meeting<Real>& point, Number way) const {
        const NodeBox box =
            cells_of(obstacles_.tank, obstacles_.bodies.body[point.slot].drawn);
        std::int32_t found = kSolidBeside;
        Number out = strip.half + Number(kBeside);
        for (std::int32_t look = 0; look < kLooksUnder; ++look) {
            const Wide<Real> x =
                strip.middle + (way * out) * strip.along + Number(kBeside) * point.normal;
            const std::int32_t cell = open_cell_at(x);
            if (cell < 0 || !is_in(box, floor_to_int(x.x), floor_to_int(x.y))) {
                break;
            }
            if (is_wet(cell)) {
                return cell;
            }
            found = kAirBeside;
            out += Number(1);
        }
        return found;
    }
    /// Only what is in a body's rectangle is solved with it.
    static bool is_in(const NodeBox& box, std::int32_t i, std::int32_t j) {
        return i >= box.i0 && i <= box.i1 && j >= box.j0 && j <= box.j1;
    }

    /// What is to press on one half of an underside, and its first moment along the strip.
    struct Missing {
        Number size = Number(0);
        Number turn = Number(0);

        void take(Missing& other) {
            size += other.size;
            turn += other.turn;
            other = Missing{};
        }
    };

    /// What all films of a body close of it, along the normals only.
    struct Laid {
        Number size = Number(0);
        Impulse<Real> sum;  ///< less what cells show where films are

        void leave_out(const Impulse<Real>& reach) {
            sum.add(Impulse<Real>{Number(-1) * reach.linear, -reach.angular});
        }
    };

    /// What closes the body with what cells press on. What cells without liquid do above the
    /// lowest points counts as pressed: that is air.
    void close(const Strip& strip, const Meeting<Real>& point, Missing (&missing)[2],
               Laid& laid) const {
        const GridShape& s = obstacles_.tank;
        const Walls<Real>& walls = obstacles_.walls;
        for_each_rim(s, walls, point.slot, [&](std::int32_t i, std::int32_t j, std::int32_t cell) {
            const Wide<Real> arm = centre_of_cell<Real>(i, j) - strip.middle;
            const Number place = dot(arm, strip.along);
            if (absolute(place) > strip.half + Number(1)) {
                return;
            }
            Number up = Number(0);
            for_each_closed_face(s, walls, i, j, [&](const ClosedFace<Real>& face) {
                if (face.slot == point.slot) {
                    up += dot(convert<Number>(face.outward), point.normal);
                }
            });
            const bool low = dot(arm, point.normal) < Number(0.5 + kBeside);
            if (!(up > Number(0) && low) || is_wet(cell)) {
                Missing& half = missing[place > Number(0) ? 1 : 0];
                half.size -= up;
                half.turn -= up * place;
                return;
            }
            if (is_shut(s, walls, cell)) {
                return;
            }
            for_each_closed_face(s, walls, i, j, [&](const ClosedFace<Real>& face) {
                if (face.slot == point.slot) {
                    laid.leave_out(reach_of_face(obstacles_.bodies, walls, face));
                }
            });
        });
    }

    /// To both ends its half, or all to the one that is open. A single point has room for one.
    void lay(Meeting<Real>* first, Meeting<Real>* last, std::int32_t*& link, Laid& laid) const {
        const Strip strip = strip_of(first, last);
        const std::int32_t cell[2] = {cell_beside(strip, *first, Number(-1)),
                                      cell_beside(strip, *first, Number(1))};
        if (cell[0] < 0 && cell[1] < 0) {
            return;
        }
        Missing missing[2];
        close(strip, *first, missing, laid);
        const std::int32_t wet = cell[0] >= 0 ? 0 : 1;
        if (first == last || cell[1 - wet] == kSolidBeside) {
            missing[wet].take(missing[1 - wet]);
        }
        // What one half shows too much of, the other lacks less.
        for (std::int32_t k = 0; k < 2; ++k) {
            if (missing[k].size < Number(0)) {
                missing[1 - k].take(missing[k]);
            }
        }
        const Number most = strip.half + Number(1);
        for (std::int32_t k = 0; k < 2; ++k) {
            if (!(missing[k].size > Number(0))) {
                continue;
            }
            Meeting<Real>& point = k == 0 ? *first : *last;
            const Number place = clamp(missing[k].turn / missing[k].size, -most, most);
            const Wide<Real> middle = strip.middle + place * strip.along;
            Impulse<Real> film;
            film.add(missing[k].size * point.normal,
                     middle - obstacles_.bodies.load[point.slot].at);
            laid.size += missing[k].size;
            laid.sum.add(film);
            if (cell[k] < 0) {
                continue;
            }
            give(film, middle, cell[k], point);
            *link = static_cast<std::int32_t>(&point - list_.entry);
            link = &point.next_film;
            *link = -1;
        }
    }

    /// As much pressed as that cell, and as much more as the film lies deeper.
    void give(const Impulse<Real>& film, Wide<Real> at, std::int32_t cell,
              Meeting<Real>& point) const {
        const Vec2<Real> gradient =
            gradient_at_rest(obstacles_.tank, obstacles_.walls, cells_, cell);
        point.film = film;
        point.film_cell = cell;
        point.beyond = dot(convert<Number>(gradient),
                           at - centre_of_cell<Real>(obstacles_.tank, cell));
    }

    /// Between two free bodies: what they close of each other.
    void lay_between(Meeting<Real>* first, std::int32_t*& link) const {
        const GridShape& s = obstacles_.tank;
        const Walls<Real>& walls = obstacles_.walls;
        const bool both = first + 1 != list_.end() && list_.of_one_face(*first, first[1]);
        const Strip strip = strip_of(first, both ? first + 1 : first);
        const std::int32_t before = cell_beside(strip, *first, Number(-1));
        const std::int32_t cell =
            before >= 0 ? before : cell_beside(strip, *first, Number(1));
        if (cell < 0) {
            return;
        }
        Impulse<Real> film;
        for_each_rim(s, walls, first->slot, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
            if (is_shut(s, walls, c)) {
                film.add(closed_by_free(obstacles_.bodies, s, walls, first->slot, first->other,
                                        i, j));
            }
        });
        give(film, strip.middle, cell, *first);
        *link = static_cast<std::int32_t>(first - list_.entry);
        link = &first->next_film;
        *link = -1;
    }

    /// Along the faces, too, and in what turns the body, films close what cells show of all of it:
    /// each has as much of what is lacking as it is long. What another free body closes is not
    /// theirs: they would push both away.
    void put_right(std::uint16_t slot, std::int32_t begun, const Laid& laid) const {
        const GridShape& s = obstacles_.tank;
        const Walls<Real>& walls = obstacles_.walls;
        Impulse<Real> over = laid.sum;
        for_each_rim(s, walls, slot, [&](std::int32_t i, std::int32_t j, std::int32_t cell) {
            if (is_shut(s, walls, cell)) {
                over.add(closed_by_free(obstacles_.bodies, s, walls, slot, kNoBody, i, j));
                return;
            }
            for_each_closed_face(s, walls, i, j, [&](const ClosedFace<Real>& face) {
                if (face.slot == slot) {
                    over.add(reach_of_face(obstacles_.bodies, walls, face));
                }
            });
        });
        Meeting<Real>* own = nullptr;
        for (std::int32_t k = begun; k >= 0; k = list_.entry[k].next_film) {
            Meeting<Real>& point = list_.entry[k];
            if (point.other_is_free) {
                continue;
            }
            const Number share = dot(point.film.linear, point.normal) / laid.size;
            point.film.linear = point.film.linear - share * over.linear;
            point.film.angular -= share * over.angular;
            own = own == nullptr ? &point : own;
        }
        if (own != nullptr && list_.has_film_between(slot)) {
            take_away(slot, *own);
        }
    }

    /// Which part of a face is whose where two bodies touch is a guess. But what liquid at rest
    /// does to a body is known if cells and films close it: what is wrong of that a film takes
    /// away. What is not lifted `immerse` does, with what it takes along.
    void take_away(std::uint16_t slot, Meeting<Real>& own) const {
        const Wide<Real> gravity = convert<Number>(cells_.gravity_dt);
        const AtRest<Real> rest = at_rest(obstacles_, cells_, slot, Turning::asked);
        if (!rest.is_closed()) {
            return;
        }
        const Number lifted = rest.lifted(gravity);
        const Number most = obstacles_.bodies.load[slot].area;
        const Wide<Real> wrong = rest.push.linear + minimum(lifted, most) * gravity;
        const auto density = static_cast<Number>(
            density_at_rest(obstacles_.tank, obstacles_.walls, cells_, own.film_cell));
        own.besides = {-density * wrong, -density * rest.push.angular};
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
    Meetings<Real>(obstacles.bodies).for_each_film_of(slot, [&](const Meeting<Real>& meeting) {
        const Number pressure =
            static_cast<Number>(cells.pressure[meeting.film_cell]) + meeting.beyond;
        Impulse<Real> done{pressure * meeting.film.linear, pressure * meeting.film.angular};
        done.add(meeting.besides);
        sum.add(felt_by(obstacles.bodies, slot, meeting, done));
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
