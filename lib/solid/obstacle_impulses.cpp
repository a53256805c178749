// What the points of free bodies before something get: sequential impulses (Catto 2006).
#include "solid/obstacles.hpp"

namespace weir {

namespace {

/// Positions are put right by such a share of what is wrong, and by no more than so many cells in a
/// substep.
template <class Number>
constexpr Number kPartedShare = Number(1.0 / 4.0);
template <class Number>
constexpr Number kMostParted = Number(1.0 / 16.0);

/// Two points that yield so nearly as one are taken in turn.
template <class Real>
constexpr Face<Real> kSeparate = Face<Real>(1.0 / 4096.0);

/// So deep bodies may lie in each other, cells: were they parted to the last, what lies on two
/// points would come free of one, fall on it, and sway.
template <class Number>
constexpr Number kAllowed = Number(1.0 / 128.0);

/// Of a gap, what is to be gone at once: what is left of it, or a part of what is too much.
template <class Number>
Number parting(Number gap) {
    const Number left = gap + kAllowed<Number>;
    return left > Number(0) ? -left : minimum(-kPartedShare<Number> * left, kMostParted<Number>);
}

/// A point is the same as before if it has moved by less, as its body sees it, cells.
template <class Real>
constexpr Face<Real> kSamePlace = Face<Real>(1.0 / 4.0);

/// The fastest that a point is sent off with what it got before, cells a substep.
template <class Real>
constexpr Face<Real> kMostRecalled = Face<Real>(2);

/// What yields by less than this, of what free bodies of its mass would, is held in that direction:
/// whatever pushes there does nothing.
template <class Real>
constexpr Face<Real> kRigid = Face<Real>(1.0e-3);
template <class Real>
constexpr Face<Real> kUnyielding = Face<Real>(1.0e30);

/// One of the two bodies at a point, and a direction: how fast it goes along it, and how it yields.
template <class Real>
struct Side {
    BodyLoad<Real>* load = nullptr;  ///< null: it does as told
    Impulse<Real> unit;

    Face<Real> yielding() const {
        return load == nullptr ? Face<Real>(0) : speed_of(answer(*load, unit));
    }
    Face<Real> speed_of(const Twist<Real>& twist) const {
        return dot(unit.linear, twist.velocity) + unit.angular * twist.spin;
    }
};

/// Both sides of a point, along one direction.
template <class Real>
struct Way {
    Side<Real> own;
    Side<Real> other;
    Face<Real> yielding;
    Face<Real> told = Face<Real>(0);  ///< speed of the other one if it does as told

    Way(const BodyTable<Real>& table, const Meeting<Real>& meeting, Wide<Real> along,
        const HeldWay<Real>& held)
        : own{table.load + meeting.slot, {along, held.own}},
          other{meeting.other_is_free ? table.load + meeting.other : nullptr,
                {along, held.other}},
          yielding(held.yielding),
          told(held.told) {}

    Face<Real> changed() const {
        const Face<Real> its =
            other.load == nullptr ? Face<Real>(0) : other.speed_of(other.load->change);
        return own.speed_of(own.load->change) - its;
    }
    /// Of the free body against the other.
    Face<Real> speed() const {
        const Face<Real> its =
            other.load == nullptr ? told : other.speed_of(other.load->unpressed);
        return (own.speed_of(own.load->unpressed) - its) + changed();
    }
    /// Equal to both, and opposite.
    void push(Face<Real> strength) const {
        give(own, strength);
        if (other.load != nullptr) {
            give(other, -strength);
        }
    }

private:
    static void give(const Side<Real>& side, Face<Real> strength) {
        const Twist<Real> way = answer(*side.load, side.unit);
        const auto add = [&](Twist<Real>& twist) {
            twist.velocity = twist.velocity + strength * way.velocity;
            twist.spin += strength * way.spin;
        };
        add(side.load->change);
        add(side.load->stopped);
    }
};

template <class Real>
Way<Real> ahead(const BodyTable<Real>& table, const Meeting<Real>& meeting) {
    return {table, meeting, meeting.normal, meeting.ahead};
}
template <class Real>
Way<Real> aside(const BodyTable<Real>& table, const Meeting<Real>& meeting) {
    return {table, meeting, meeting.side(), meeting.aside};
}

template <class Real>
HeldWay<Real> held_way(const BodyTable<Real>& table, const Meeting<Real>& meeting,
                       Wide<Real> along) {
    HeldWay<Real> held{};
    held.own = cross(meeting.at - table.load[meeting.slot].at, along);
    if (meeting.other_is_free) {
        held.other = cross(meeting.at - table.load[meeting.other].at, along);
    } else if (meeting.other != kNoBody) {
        const Vec2<Real> at = convert<Real>(meeting.at);
        held.told = dot(along, convert<Face<Real>>(velocity_at(table.body[meeting.other], at)));
    }
    const Way<Real> way(table, meeting, along, held);
    const auto ease = [](const BodyLoad<Real>* load) {
        return load == nullptr ? Face<Real>(0) : load->ease * load->inverse_mass;
    };
    held.yielding = way.own.yielding() + way.other.yielding();
    if (held.yielding < kRigid<Real> * (ease(way.own.load) + ease(way.other.load))) {
        held.yielding = kUnyielding<Real>;
    }
    return held;
}

/// Nothing comes nearer than the gap.
template <class Real>
Face<Real> least_speed(const Obstacles<Real>& obstacles, const Meeting<Real>& meeting) {
    return meeting.leaves > Face<Real>(0)
               ? meeting.leaves
               : -maximum(meeting.gap, Face<Real>(0)) / obstacles.dt;
}

/// Sets the impulse at a point; never a pull.
template <class Real>
void set_push(const Way<Real>& way, Face<Real> all, Meeting<Real>& meeting) {
    way.push(all - meeting.push);
    meeting.push = all;
}

template <class Real>
void push_one(const Way<Real>& way, Face<Real> wanted, Meeting<Real>& meeting) {
    set_push(way, maximum(meeting.push + wanted / way.yielding, Face<Real>(0)), meeting);
}

/// How a push at one point of a face moves the other one along the same normal.
template <class Real>
Face<Real> yielding_between(const Way<Real>& one, const Way<Real>& two) {
    const auto side = [](const Side<Real>& a, const Side<Real>& b) {
        return a.load == nullptr ? Face<Real>(0) : b.speed_of(answer(*a.load, a.unit));
    };
    return side(one.own, two.own) + side(one.other, two.other);
}

/// Both points of a face at once: what lies on it would rock if they took turns. Of the four cases,
/// either one pushing or not, the one is taken that fits.
template <class Real>
void push_both(const Way<Real> (&way)[2], const Face<Real> (&wanted)[2], Meeting<Real>* meeting) {
    using Number = Face<Real>;
    const Number across = yielding_between(way[0], way[1]);
    const Number a = way[0].yielding;
    const Number b = way[1].yielding;
    // Speeds that are lacking if neither pushed.
    const Number lack[2] = {wanted[0] + (a * meeting[0].push + across * meeting[1].push),
                            wanted[1] + (across * meeting[0].push + b * meeting[1].push)};
    const Number area = a * b - across * across;
    if (!(area > kSeparate<Real> * (a * b))) {
        const Number before = meeting[0].push;
        push_one(way[0], wanted[0], meeting[0]);
        push_one(way[1], wanted[1] - across * (meeting[0].push - before), meeting[1]);
        return;
    }
    Number all[2] = {(b * lack[0] - across * lack[1]) / area,
                     (a * lack[1] - across * lack[0]) / area};
    if (all[0] < Number(0) || all[1] < Number(0)) {
        const bool first = lack[0] > Number(0) && across * (lack[0] / a) >= lack[1];
        all[0] = first ? lack[0] / a : Number(0);
        all[1] = first ? Number(0) : maximum(lack[1] / b, Number(0));
    }
    set_push(way[0], all[0], meeting[0]);
    set_push(way[1], all[1], meeting[1]);
}

/// wanted(way, meeting): the speed that is lacking there. Where nothing pushes and none is lacking
/// there is nothing to do.
template <class Real, class Wanted>
void push_face(const BodyTable<Real>& table, Meeting<Real>* meeting, std::int32_t count,
               Wanted wanted) {
    const auto rests = [](const Meeting<Real>& at, Face<Real> speed) {
        return at.push == Face<Real>(0) && speed <= Face<Real>(0);
    };
    const Way<Real> way = ahead(table, meeting[0]);
    const Face<Real> speed = wanted(way, meeting[0]);
    if (count == 1) {
        if (!rests(meeting[0], speed)) {
            push_one(way, speed, meeting[0]);
        }
        return;
    }
    const Way<Real> both[2] = {way, ahead(table, meeting[1])};
    const Face<Real> speeds[2] = {speed, wanted(both[1], meeting[1])};
    if (!rests(meeting[0], speed) || !rests(meeting[1], speeds[1])) {
        push_both(both, speeds, meeting);
    }
}

/// Coulomb's law, against a surface that may run as a conveyor.
template <class Real>
void rub_there(const Obstacles<Real>& obstacles, Meeting<Real>& meeting) {
    using Number = Face<Real>;
    const SurfaceLaw<Real>& own = obstacles.bodies.body[meeting.slot].surface;
    const SurfaceLaw<Real>& its = law_before(obstacles, meeting.other, meeting.normal);
    const Number most = static_cast<Number>(maximum(own.friction, its.friction)) * meeting.push;
    if (!(most > Number(0)) && meeting.rub == Number(0)) {
        return;
    }
    // The free body is ahead on the left of this way: its own surface runs against it.
    const Way<Real> way = aside(obstacles.bodies, meeting);
    const auto conveyed = static_cast<Number>(its.conveyor);
    const Number wanted = ((meeting.other == kNoBody ? conveyed : -conveyed) -
                           static_cast<Number>(own.conveyor)) -
                          way.speed();
    const Number all = clamp(meeting.rub + wanted / way.yielding, -most, most);
    way.push(all - meeting.rub);
    meeting.rub = all;
}

template <class Number>
Number named(std::uint16_t slot) {
    return static_cast<Number>(slot) + Number(1);
}

/// The push of the same bodies at about the same place; they mostly come in the same order.
template <class Real>
const Push<Real>* find_push(const BodyTable<Real>& table, const Meetings<Real>& meetings,
                            const Meeting<Real>& meeting, const Push<Real>*& cursor,
                            std::int32_t& cost) {
    const Wide<Real> arm = meeting.at - table.load[meeting.slot].at;
    const Push<Real>* const end = meetings.before + meetings.room;
    const Push<Real>* const start = cursor;
    const auto fits = [&](const Push<Real>& push) {
        ++cost;
        const Wide<Real> off = push.arm - arm;
        return push.slot == named<Face<Real>>(meeting.slot) &&
               push.other == named<Face<Real>>(meeting.other) &&
               absolute(off.x) < kSamePlace<Real> && absolute(off.y) < kSamePlace<Real>;
    };
    for (const Push<Real>* at = start; at != end && at->slot != Face<Real>(0); ++at) {
        if (fits(*at)) {
            cursor = at + 1;
            return at;
        }
    }
    for (const Push<Real>* at = meetings.before; at != start; ++at) {
        if (fits(*at)) {
            cursor = at + 1;
            return at;
        }
    }
    return nullptr;
}

/// At most what would send the body as far as bodies go: the kept numbers may come from outside.
template <class Real>
void begin_with(const Obstacles<Real>& obstacles, const Push<Real>& kept,
                Meeting<Real>& meeting) {
    using Number = Face<Real>;
    const BodyTable<Real>& table = obstacles.bodies;
    const Way<Real> way = ahead(table, meeting);
    const Number most = kMostRecalled<Real> / (obstacles.dt * way.yielding);
    set_push(way, clamp(obstacles.dt * kept.push, Number(0), most), meeting);
    const Way<Real> along = aside(table, meeting);
    meeting.rub = clamp(obstacles.dt * kept.rub, -meeting.push, meeting.push);
    along.push(meeting.rub);
}

/// What the free body received there.
template <class Real>
void tell(const BodyTable<Real>& table, const Meeting<Real>& meeting, Contacts<Real>& contacts) {
    const auto name = [&](std::uint16_t slot) {
        return BodyId{slot, table.body[slot].generation, contacts.world};
    };
    const float m = contacts.cell_m;
    Contact met;
    met.body = name(meeting.slot);
    met.with = meeting.other == kNoBody ? ContactWith::tank : ContactWith::body;
    met.other = meeting.other == kNoBody ? BodyId{} : name(meeting.other);
    met.impulse_m3ps = (m * m * m) * convert<float>(meeting.push * meeting.normal +
                                                    meeting.rub * meeting.side());
    met.place_m = m * convert<float>(meeting.at);
    record(contacts, met);
}

}  // namespace

template <class Real>
void stop(const Obstacles<Real>& obstacles, std::int32_t rounds) {
    const Meetings<Real> meetings(obstacles.bodies);
    const auto visit = [&](Meeting<Real>* meeting, std::int32_t count) {
        for (std::int32_t k = 0; k < count; ++k) {
            rub_there(obstacles, meeting[k]);
        }
        push_face(obstacles.bodies, meeting, count,
                  [&](const Way<Real>& way, const Meeting<Real>& at) {
                      return least_speed(obstacles, at) - way.speed();
                  });
    };
    for (std::int32_t round = 0; round < rounds; ++round) {
        if (round % 2 == 0) {
            meetings.for_each_face(visit);
        } else {
            meetings.for_each_face_back(visit);
        }
    }
}

template <class Real>
std::int32_t recall(const Obstacles<Real>& obstacles) {
    const Meetings<Real> meetings(obstacles.bodies);
    const Push<Real>* cursor = meetings.before;
    std::int32_t cost = 0;
    for (Meeting<Real>& meeting : meetings) {
        meeting.other_is_free =
            meeting.other != kNoBody && is_free_body(obstacles.bodies, meeting.other);
        meeting.ahead = held_way(obstacles.bodies, meeting, meeting.normal);
        meeting.aside = held_way(obstacles.bodies, meeting, meeting.side());
        const Push<Real>* push = find_push(obstacles.bodies, meetings, meeting, cursor, cost);
        if (push != nullptr && !(meeting.leaves > Face<Real>(0))) {
            begin_with(obstacles, *push, meeting);
        }
    }
    return cost;
}

template <class Real>
void remember(const Obstacles<Real>& obstacles, Contacts<Real>& contacts) {
    const Meetings<Real> meetings(obstacles.bodies);
    Push<Real>* push = meetings.before;
    for (const Meeting<Real>& meeting : meetings) {
        if (meeting.push > Face<Real>(0)) {
            *push++ = {meeting.at - obstacles.bodies.load[meeting.slot].at,
                       meeting.push / obstacles.dt, meeting.rub / obstacles.dt,
                       named<Face<Real>>(meeting.slot), named<Face<Real>>(meeting.other)};
            if (contacts.capacity > 0) {
                tell(obstacles.bodies, meeting, contacts);
            }
        }
    }
    push->slot = Face<Real>(0);
}

template <class Real>
void part(const Obstacles<Real>& obstacles) {
    const Meetings<Real> meetings(obstacles.bodies);
    for (Meeting<Real>& meeting : meetings) {
        meeting.gap += obstacles.dt * ahead(obstacles.bodies, meeting).speed();
        meeting.push = Face<Real>(0);
        // What bodies take along has changed: where they yield by over twice of what was found
        // when the substep began the rounds would not converge, and each push outgrow the last.
        meeting.ahead = held_way(obstacles.bodies, meeting, meeting.normal);
    }
    for (std::int32_t slot = 0; slot < obstacles.bodies.capacity; ++slot) {
        obstacles.bodies.load[slot].change = Twist<Real>{};
    }
    for (std::int32_t round = 0; round < kRoundsOfParting; ++round) {
        meetings.for_each_face([&](Meeting<Real>* meeting, std::int32_t count) {
            push_face(obstacles.bodies, meeting, count,
                      [](const Way<Real>& way, const Meeting<Real>& at) {
                          return parting(at.gap) - way.changed();
                      });
        });
    }
}

#define WEIR_INSTANTIATE(Real)                                   \
    template void stop(const Obstacles<Real>&, std::int32_t);    \
    template std::int32_t recall(const Obstacles<Real>&);        \
    template void remember(const Obstacles<Real>&, Contacts<Real>&); \
    template void part(const Obstacles<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
