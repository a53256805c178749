// Which points of free bodies are before something.
#include "solid/obstacles.hpp"

#include "base/work.hpp"
#include "solid/piece_contact.hpp"

namespace weir {

namespace {

/// Points are listed that are so near, besides what their speed brings near: the pressure may
/// change it. Cells.
template <class Real>
constexpr Face<Real> kNear = Face<Real>(1.0 / 4.0);

/// From a wall to the cell before it, cells.
template <class Real>
constexpr Face<Real> kHair = Face<Real>(1.0 / 64.0);

/// Case of a cell of which all corners are inside.
constexpr std::uint8_t kAllInside = 15;

/// No body goes further than half of this in a substep, cells.
template <class Real>
constexpr Face<Real> kFurthest = Face<Real>(4);

/// What approaches no faster than what it falls in so many substeps comes to rest.
constexpr std::int32_t kSlowFall = 2;

/// Velocity of a body's material before the pressure.
template <class Real>
Wide<Real> unpressed_at(const BodyTable<Real>& table, std::uint16_t slot, Wide<Real> at) {
    if (slot == kNoBody) {
        return {};
    }
    const BodyLoad<Real>& load = table.load[slot];
    if (load.is_free()) {
        return load.unpressed.velocity + spin_velocity(load.unpressed.spin, at - load.at);
    }
    return convert<Face<Real>>(velocity_at(table.body[slot], convert<Real>(at)));
}

template <class Real>
Face<Real> fastest(const BodyTable<Real>& table, std::int32_t slot) {
    const BodyLoad<Real>& load = table.load[slot];
    const auto radius = static_cast<Face<Real>>(table.body[slot].radius);
    return load.is_free()
               ? furthest_way(load.unpressed.velocity, load.unpressed.spin, radius + radius)
               : static_cast<Face<Real>>(table.body[slot].fastest_point());
}

template <class Real>
class Finder {
public:
    explicit Finder(const Obstacles<Real>& obstacles)
        : obstacles_(obstacles), table_(obstacles.bodies), list_(obstacles.bodies) {
        *list_.used = 0;
    }

    /// The free body before the tank and all bodies; of two free ones the lower slot sees to it.
    void look_from(std::int32_t slot) {
        before_walls(slot);
        for (std::int32_t other = 0; other < table_.capacity; ++other) {
            const Body<Real>& body = table_.body[other];
            const bool done = other == slot || (other < slot && table_.load[other].is_free());
            if (body.kind != BodyKind::free && !done) {
                before_body(slot, other);
            }
        }
        cost_ += table_.capacity;
    }

    /// Under faces that lie on something. Between free bodies there is none: those that come and go
    /// pumped liquid together there (ten crates of 0.9 in a pool lost a quarter of its volume).
    void lay_films() const {
        std::int32_t* link = list_.first_film;
        *link = -1;
        list_.for_each_face([&](Meeting<Real>* meeting, std::int32_t count) {
            const std::uint16_t other = meeting[0].other;
            if (other != kNoBody && is_free_body(table_, other)) {
                return;
            }
            const Wide<Real> way = meeting[count - 1].at - meeting[0].at;
            const Number size = length(way);
            if (meeting[0].gap < kNear<Real> && meeting[count - 1].gap < kNear<Real> &&
                size > Number(0)) {
                lay_film((Number(1) / size) * way, size, meeting, link);
            }
        });
    }

    std::int64_t cost() const { return cost_; }

private:
    using Number = Face<Real>;

    Number margin(Number speed) const {
        return minimum(kNear<Real> + obstacles_.dt * speed, kFurthest<Real>);
    }

    void before_walls(std::int32_t slot) {
        const Body<Real>& body = table_.body[slot];
        const Number most = margin(fastest(table_, slot));
        if (!near_walls(obstacles_.tank, body, static_cast<Real>(most))) {
            return;
        }
        const Wide<Real> size{static_cast<Number>(obstacles_.tank.nx),
                              static_cast<Number>(obstacles_.tank.ny)};
        const auto wall = [&](Number at, Wide<Real> inward) {
            for (std::int32_t k = 0; k < body.vertex_count; ++k) {
                const Wide<Real> x = convert<Number>(table_.ring(body)[k]);
                const Number gap = dot(inward, x) + at;
                if (gap <= most) {
                    enter(slot, kNoBody, x, inward, gap);
                }
            }
        };
        wall(Number(0), {Number(1), Number(0)});
        wall(size.x, {Number(-1), Number(0)});
        wall(Number(0), {Number(0), Number(1)});
        wall(size.y, {Number(0), Number(-1)});
    }

    /// Whether circles around two bodies come within a distance of each other.
    static bool circles_meet(const Body<Real>& one, const Body<Real>& other, Number distance) {
        const Wide<Real> arm = convert<Number>(one.position - other.position);
        const Number reach =
            (static_cast<Number>(one.radius) + static_cast<Number>(other.radius)) + distance;
        return dot(arm, arm) <= reach * reach;
    }

    void before_body(std::int32_t slot, std::int32_t other) {
        const Body<Real>& body = table_.body[slot];
        const Body<Real>& its = table_.body[other];
        if (!circles_meet(body, its, kFurthest<Real>)) {
            return;  // however fast they are
        }
        const Number most = margin(fastest(table_, slot) + fastest(table_, other));
        if (!circles_meet(body, its, most)) {
            return;
        }
        const Vec2<Real> from = body.position;
        const Number reach = static_cast<Number>(body.radius) + most;
        for_each_piece(table_, its, [&](const ConvexPiece<Real>& its_piece) {
            cost_ += its_piece.count;
            if (!within_reach(its_piece, from, reach)) {
                return;
            }
            for_each_piece(table_, body, [&](const ConvexPiece<Real>& piece) {
                cost_ += piece.count * its_piece.count;
                const PieceContact<Real> contact = contact_of(piece, its_piece, from, most);
                for (std::int32_t k = 0; k < contact.count; ++k) {
                    enter(slot, static_cast<std::uint16_t>(other), contact.point[k].at,
                          contact.normal, contact.point[k].gap);
                }
            });
        });
    }

    /// Whether a box around a piece is.
    static bool within_reach(const ConvexPiece<Real>& piece, Vec2<Real> from, Number reach) {
        Wide<Real> low = piece.at(0, from);
        Wide<Real> high = low;
        for (std::int32_t k = 1; k < piece.count; ++k) {
            const Wide<Real> x = piece.at(k, from);
            low = {minimum(low.x, x.x), minimum(low.y, x.y)};
            high = {maximum(high.x, x.x), maximum(high.y, x.y)};
        }
        return low.x <= reach && low.y <= reach && high.x >= -reach && high.y >= -reach;
    }

    /// Bodies that are led have moved already: the gap was as much larger as they came nearer.
    /// Who is thrown back leaves as fast as it came, before this substep's gravity: gravity did not
    /// act for all of it.
    void enter(std::int32_t slot, std::uint16_t other, Wide<Real> at, Wide<Real> normal,
               Number gap) {
        const auto own = static_cast<std::uint16_t>(slot);
        Meeting<Real> meeting{at, normal, gap, Number(0), Number(0), Number(0), own, other, -1};
        const Wide<Real> its = unpressed_at(table_, other, at);
        const bool free = other != kNoBody && table_.load[other].is_free();
        meeting.gap += free ? Number(0) : obstacles_.led_dt * dot(normal, its);
        const Number approach = dot(normal, unpressed_at(table_, own, at) - its);
        const Number fall = free ? Number(0) : dot(normal, obstacles_.fall);
        const Number slow = static_cast<Number>(kSlowFall) *
                            maximum(absolute(obstacles_.fall.x), absolute(obstacles_.fall.y));
        const auto restitution = static_cast<Number>(
            maximum(table_.body[own].surface.restitution,
                    law_before(obstacles_, other, normal).restitution));
        if (approach < -slow && meeting.gap + obstacles_.dt * approach < Number(0)) {
            meeting.leaves = restitution * maximum(fall - approach, Number(0));
        }
        keep(meeting);
    }

    /// Cell of a place, if that is in the tank and not all solid; otherwise negative.
    std::int32_t open_cell_at(Wide<Real> x) const {
        const GridShape& s = obstacles_.tank;
        if (x.x < Number(0) || x.x >= static_cast<Number>(s.nx) || x.y < Number(0) ||
            x.y >= static_cast<Number>(s.ny)) {
            return -1;
        }
        const std::int32_t cell = s.index(floor_to_int(x.x), floor_to_int(x.y));
        return obstacles_.walls.cell_case[cell] == kAllInside ? -1 : cell;
    }

    /// To both ends of a face its half of the film, or all to the one that is open.
    void lay_film(Wide<Real> way, Number size, Meeting<Real>* meeting,
                  std::int32_t*& link) const {
        constexpr Number kBeside = Number(0.3);
        const Wide<Real> out[2] = {Number(-1) * way, way};
        std::int32_t cell[2];
        for (std::int32_t k = 0; k < 2; ++k) {
            cell[k] = open_cell_at(meeting[k].at + kBeside * (out[k] + meeting[k].normal));
        }
        for (std::int32_t k = 0; k < 2; ++k) {
            if (cell[k] >= 0) {
                meeting[k].film = cell[1 - k] >= 0 ? Number(0.5) * size : size;
                meeting[k].film_cell = cell[k];
                meeting[k].middle = meeting[k].at - (Number(0.5) * meeting[k].film) * out[k];
                meeting[k].under =
                    open_cell_at(meeting[k].middle + kHair<Real> * meeting[k].normal);
                *link = static_cast<std::int32_t>(meeting + k - list_.entry);
                link = &meeting[k].next_film;
            }
        }
    }

    void keep(const Meeting<Real>& meeting) {
        if (*list_.used < list_.room) {
            list_.entry[(*list_.used)++] = meeting;
            return;
        }
        Meeting<Real>* furthest = list_.begin();
        for (Meeting<Real>& one : list_) {
            furthest = one.gap > furthest->gap ? &one : furthest;
        }
        if (meeting.gap < furthest->gap) {
            *furthest = meeting;
        }
    }

    const Obstacles<Real>& obstacles_;
    const BodyTable<Real>& table_;
    Meetings<Real> list_;
    std::int64_t cost_ = 0;
};

template <class Real>
std::int64_t list_length(const Body<Real>& body) {
    return body.open ? 2 * body.vertex_count : body.piece_length;
}

}  // namespace

template <class Real>
std::int32_t find_meetings(const Obstacles<Real>& obstacles) {
    Finder<Real> finder(obstacles);
    for (std::int32_t slot = 0; slot < obstacles.bodies.capacity; ++slot) {
        if (is_free_body(obstacles.bodies, slot)) {
            finder.look_from(slot);
        }
    }
    finder.lay_films();
    return static_cast<std::int32_t>(minimum(finder.cost(), std::int64_t{kMostWork}));
}

template <class Real>
Impulse<Real> film_impulse(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                           std::uint16_t slot) {
    using Number = Face<Real>;
    Impulse<Real> sum;
    Meetings<Real>(obstacles.bodies).for_each_film([&](const Meeting<Real>& meeting) {
        if (meeting.slot != slot || !meeting.is_wet(cells)) {
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

template <class Real>
std::int32_t most_looks(const BodyTable<Real>& table) {
    const std::int64_t room = Meetings<Real>(table).room;
    std::int64_t all = 0;
    std::int64_t looks = room * room;  // at what is kept
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        all += table.body[slot].kind != BodyKind::free ? list_length(table.body[slot]) : 0;
    }
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (is_free_body(table, slot)) {
            looks += table.capacity + all * (1 + list_length(table.body[slot]));
        }
    }
    return static_cast<std::int32_t>(minimum(looks, std::int64_t{kMostWork}));
}

#define WEIR_INSTANTIATE(Real)                                    \
    template std::int32_t find_meetings(const Obstacles<Real>&); \
    template Impulse<Real> film_impulse(const Obstacles<Real>&, const PressedCells<Real>&,      \
                                         std::uint16_t);                                        \
    template std::int32_t most_looks(const BodyTable<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
