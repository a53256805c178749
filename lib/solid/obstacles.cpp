// Which points of free bodies are before something.
#include "solid/obstacles.hpp"

#include "base/work.hpp"
#include "solid/piece_contact.hpp"

namespace weir {

namespace {

/// Points are listed that are so near, besides what their speed brings near: the pressure may
/// change it. Where there may be a film, those that it may lie at. Cells.
template <class Real>
constexpr Face<Real> kNear = Face<Real>(1.0 / 4.0);

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
        *list_.first_film = kFilmsNotLaid;
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

    std::int64_t cost() const { return cost_; }

private:
    using Number = Face<Real>;

    Number margin(Number near, Number speed) const {
        return minimum(near + obstacles_.dt * speed, kFurthest<Real>);
    }

    /// Whether a vertex ends an edge that lies towards a wall: there may be a film under that.
    bool ends_face(const Body<Real>& body, std::int32_t k, Wide<Real> inward) const {
        const auto at = [&](std::int32_t n) { return convert<Number>(table_.ring(body)[n]); };
        const auto faces = [&](Wide<Real> way) {
            const Number across = cross(way, inward);
            return across > Number(0) && across * across > Number(0.75) * dot(way, way);
        };
        const std::int32_t end = body.vertex_count;
        return faces(at(k) - at(k > 0 ? k - 1 : end - 1)) ||
               faces(at(k + 1 < end ? k + 1 : 0) - at(k));
    }

    void before_walls(std::int32_t slot) {
        const Body<Real>& body = table_.body[slot];
        const Number near = margin(kNear<Real>, fastest(table_, slot));
        const Number most = margin(kWidestFilm<Real>, fastest(table_, slot));
        if (!near_walls(obstacles_.tank, body, static_cast<Real>(most))) {
            return;
        }
        const Wide<Real> size{static_cast<Number>(obstacles_.tank.nx),
                              static_cast<Number>(obstacles_.tank.ny)};
        const auto wall = [&](Number at, Wide<Real> inward) {
            for (std::int32_t k = 0; k < body.vertex_count; ++k) {
                const Wide<Real> x = convert<Number>(table_.ring(body)[k]);
                const Number gap = dot(inward, x) + at;
                if (gap <= near || (gap <= most && ends_face(body, k, inward))) {
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
        const Number near = table_.load[other].is_free() ? kNear<Real> : kWidestFilm<Real>;
        const Number most = margin(near, fastest(table_, slot) + fastest(table_, other));
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
                            larger_part(obstacles_.fall);
        const auto restitution = static_cast<Number>(
            maximum(table_.body[own].surface.restitution,
                    law_before(obstacles_, other, normal).restitution));
        if (approach < -slow && meeting.gap + obstacles_.dt * approach < Number(0)) {
            meeting.leaves = restitution * maximum(fall - approach, Number(0));
        }
        keep(meeting);
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
            for (; furthest + 1 != list_.end(); ++furthest) {  // the order of the slots stays
                furthest[0] = furthest[1];
            }
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
    return static_cast<std::int32_t>(minimum(finder.cost(), std::int64_t{kMostWork}));
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
    template std::int32_t most_looks(const BodyTable<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
