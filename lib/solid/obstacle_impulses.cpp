// What the points of free bodies before something get: sequential impulses (Catto 2006).
#include "solid/obstacles.hpp"

namespace weir {

namespace {

template <class Real>
using Wide = Vec2<Face<Real>>;

/// Positions are put right in so many rounds, by such a share of what is wrong, and by no more
/// than so many cells in a substep.
constexpr std::int32_t kRoundsOfParting = 4;
template <class Real>
constexpr Face<Real> kPartedShare = Face<Real>(1.0 / 4.0);
template <class Real>
constexpr Face<Real> kMostParted = Face<Real>(1.0 / 16.0);

/// One of the two bodies at a point, and a direction: how fast it goes along it, and how it yields.
template <class Real>
struct Side {
    BodyLoad<Real>* load = nullptr;  ///< null: it does as told
    Impulse<Real> unit;

    Side(const BodyTable<Real>& table, std::uint16_t slot, Wide<Real> at, Wide<Real> along) {
        if (slot != kNoBody && is_free_body(table, slot)) {
            load = table.load + slot;
            unit.add(along, at - load->at);
        }
    }
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

    Way(const BodyTable<Real>& table, const Meeting<Real>& meeting, Wide<Real> along)
        : own(table, meeting.slot, meeting.at, along),
          other(table, meeting.other, meeting.at, along),
          yielding(own.yielding() + other.yielding()) {
        if (meeting.other != kNoBody && other.load == nullptr) {
            const Vec2<Real> at = convert<Real>(meeting.at);
            told = dot(along, convert<Face<Real>>(velocity_at(table.body[meeting.other], at)));
        }
    }

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

/// Nothing comes nearer than the gap.
template <class Real>
Face<Real> least_speed(const Obstacles<Real>& obstacles, const Meeting<Real>& meeting) {
    return meeting.leaves > Face<Real>(0)
               ? meeting.leaves
               : -maximum(meeting.gap, Face<Real>(0)) / obstacles.dt;
}

template <class Real>
void stop_there(const Obstacles<Real>& obstacles, Meeting<Real>& meeting) {
    const Way<Real> way(obstacles.bodies, meeting, meeting.normal);
    const Face<Real> wanted = least_speed(obstacles, meeting) - way.speed();
    const Face<Real> all = maximum(meeting.push + wanted / way.yielding, Face<Real>(0));
    way.push(all - meeting.push);
    meeting.push = all;
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
    const Way<Real> way(obstacles.bodies, meeting, {meeting.normal.y, -meeting.normal.x});
    const auto conveyed = static_cast<Number>(its.conveyor);
    const Number wanted = ((meeting.other == kNoBody ? conveyed : -conveyed) -
                           static_cast<Number>(own.conveyor)) -
                          way.speed();
    const Number all = clamp(meeting.rub + wanted / way.yielding, -most, most);
    way.push(all - meeting.rub);
    meeting.rub = all;
}

/// Positions instead of velocities: `gap` is that of the end of the substep.
template <class Real>
void part_there(const Obstacles<Real>& obstacles, Meeting<Real>& meeting) {
    const Way<Real> way(obstacles.bodies, meeting, meeting.normal);
    const Face<Real> most = meeting.gap > Face<Real>(0) ? Face<Real>(1) : kPartedShare<Real>;
    const Face<Real> wanted = minimum(-most * meeting.gap, kMostParted<Real>) - way.changed();
    const Face<Real> all = maximum(meeting.push + wanted / way.yielding, Face<Real>(0));
    way.push(all - meeting.push);
    meeting.push = all;
}

}  // namespace

template <class Real>
void stop(const Obstacles<Real>& obstacles, std::int32_t rounds) {
    const Meetings<Real> meetings(obstacles.bodies);
    for (std::int32_t round = 0; round < rounds; ++round) {
        for (Meeting<Real>& meeting : meetings) {
            rub_there(obstacles, meeting);
            stop_there(obstacles, meeting);
        }
    }
}

template <class Real>
void part(const Obstacles<Real>& obstacles) {
    const Meetings<Real> meetings(obstacles.bodies);
    for (Meeting<Real>& meeting : meetings) {
        const Way<Real> way(obstacles.bodies, meeting, meeting.normal);
        meeting.gap += obstacles.dt * way.speed();
        meeting.push = Face<Real>(0);
    }
    for (std::int32_t slot = 0; slot < obstacles.bodies.capacity; ++slot) {
        obstacles.bodies.load[slot].change = Twist<Real>{};
    }
    for (std::int32_t round = 0; round < kRoundsOfParting; ++round) {
        for (Meeting<Real>& meeting : meetings) {
            part_there(obstacles, meeting);
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                   \
    template void stop(const Obstacles<Real>&, std::int32_t);    \
    template void part(const Obstacles<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
