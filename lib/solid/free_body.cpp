#include "solid/free_body.hpp"

#include "base/work.hpp"

#include "math/rotation.hpp"
#include "solid/body_levers.hpp"
#include "solid/films.hpp"
#include "solid/immersion.hpp"

namespace weir {

namespace {

/// Bodies are slowed to this many cells a substep, as particles are.
constexpr std::int32_t kLongestWay = 2;

/// Velocity of the centre of mass, from that of the body's origin.
template <class Real>
Twist<Real> twist_of(const Body<Real>& body, const BodyLoad<Real>& load) {
    const Face<Real> spin = static_cast<Face<Real>>(body.spin);
    const Wide<Real> arm = arm_of_centre(body, load);
    return {convert<Face<Real>>(body.velocity) + spin_velocity(spin, arm), spin};
}

template <class Real>
void set_twist(const BodyLoad<Real>& load, const Twist<Real>& twist, Body<Real>& body) {
    if (!load.is_hinged()) {
        const Wide<Real> arm = arm_of_centre(body, load);
        body.velocity = convert<Real>(twist.velocity - spin_velocity(twist.spin, arm));
    }
    body.spin = static_cast<Real>(twist.spin);
}

/// No body is so light: the kept number may come from outside.
constexpr double kLeastEase = 1.0e-4;

/// What gravity adds to a body's velocity in a substep.
template <class Real>
Twist<Real> falling(const Obstacles<Real>& obstacles, const BodyLoad<Real>& load) {
    // Less what lifts it, with what it takes along.
    const Face<Real> share = (load.ease + load.ease) - Face<Real>(1);
    if (load.is_hinged()) {
        const Face<Real> weight = share * (load.mass / load.ease);
        return answer(load, Impulse<Real>{weight * obstacles.fall});
    }
    return {along_slides(load, share * obstacles.fall)};
}

/// Before the pressure, and what has changed.
template <class Real>
Twist<Real> whole_twist(const BodyLoad<Real>& load) {
    return {load.unpressed.velocity + load.change.velocity, load.unpressed.spin + load.change.spin};
}

template <class Real, class Visit>
void for_each_free(BodyTable<Real>& table, Visit visit) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (is_free_body(table, slot)) {
            visit(table.body[slot], table.load[slot]);
        }
    }
}

/// How far the body reaches beyond the tank on each side.
template <class Real>
struct Overhang {
    Real low_x = Real(0);
    Real high_x = Real(0);
    Real low_y = Real(0);
    Real high_y = Real(0);
};

template <class Real>
Overhang<Real> overhang(const GridShape& s, const BodyTable<Real>& table,
                        const Body<Real>& body) {
    Overhang<Real> beyond;
    for (std::int32_t k = 0; k < body.vertex_count; ++k) {
        const Vec2<Real> x = table.ring(body)[k];
        beyond.low_x = maximum(beyond.low_x, -x.x);
        beyond.high_x = maximum(beyond.high_x, x.x - static_cast<Real>(s.nx));
        beyond.low_y = maximum(beyond.low_y, -x.y);
        beyond.high_y = maximum(beyond.high_y, x.y - static_cast<Real>(s.ny));
    }
    return beyond;
}

/// What of an impulse a body does not take itself: liquid does that it takes along where the grid
/// does not show it. No particle has that, so it is to be settled (step/momentum_ledger.hpp).
template <class Real>
void pass_on(BodyLoad<Real>& load, Wide<Real> impulse) {
    load.received.linear = load.received.linear - along_slides(load, impulse);
}

/// Particles bounce off a body as if it were too heavy to yield. One that is lighter than all that
/// hit it takes only as much as brings it to their speed. Viscous liquid that sticks to it pulls
/// by its speed: what of that is heavier than the body counts with its mass until the substep is
/// done, against pressure and gravity too, so that at one speed it gets all that it is told.
template <class Real>
std::int32_t accelerate(const Obstacles<Real>& obstacles, BodyTable<Real>& table) {
    using Number = Face<Real>;
    const bool viscous = obstacles.walls.sticking != nullptr;
    for_each_free(table, [&](Body<Real>& body, BodyLoad<Real>& load) {
        Twist<Real> twist = twist_of(body, load);
        const Twist<Real> blown = answer(load, load.blows);
        const bool sticks = viscous && body.surface.no_slip;
        const bool light = load.blow_mass > load.mass;
        const Number bound = sticks && light ? load.blow_mass - load.mass : Number(0);
        const Number ease = clamp(load.ease, Number(kLeastEase), Number(1));
        const Number whole = load.mass / ease;
        const Number yields = whole / (whole + bound);
        const Number share = light && !sticks ? load.mass / load.blow_mass : yields;
        const Number left = sticks ? Number(1) - share * load.ease
                                   : share * (Number(1) - load.ease);
        pass_on(load, left * load.blows.linear);
        load.forget_blows();
        load.ease = ease;
        const Twist<Real> fall = falling(obstacles, load);
        receive_from_tank(obstacles.bodies, (-(whole * (Number(1) - ease))) * obstacles.fall, load);
        pass_on(load, (yields * bound) * fall.velocity);
        load.ease = yields * ease;
        twist.velocity = (twist.velocity + yields * fall.velocity) + share * blown.velocity;
        twist.spin = (twist.spin + yields * fall.spin) + share * blown.spin;
        load.unpressed = twist;
        load.change = load.stopped = Twist<Real>{};
    });
    *KeptLevers<Real>(table).bytes = -1;  // until there is a solve
    std::int32_t cost = find_meetings(obstacles);
    cost = minimum(cost, kMostWork / 2) + recall(obstacles);
    stop(obstacles, kRoundsBefore);
    for_each_free(table, [&](Body<Real>& body, BodyLoad<Real>& load) {
        load.unpressed = whole_twist(load);
        load.change = load.stopped = Twist<Real>{};
        set_twist(load, load.unpressed, body);
    });
    return cost;
}

template <class Real>
std::int32_t rounds(const BodyTable<Real>& table, std::int32_t half_sweeps, std::int32_t cycles,
                    bool most) {
    const Meetings<Real> meetings(table);
    const std::int32_t points = most ? meetings.room : *meetings.used;
    return points * (kRoundsBefore + cycles * (kRoundsBefore + half_sweeps * kRoundsBetween) +
                     kRoundsAfter + kRoundsOfParting + kLooksUnder);
}

/// Twist within what a substep can bear; NaN becomes rest.
template <class Real>
bool limit(Face<Real> fastest, Face<Real> radius, Twist<Real>& twist) {
    using Number = Face<Real>;
    if (!is_finite(twist.velocity) || !is_finite(twist.spin)) {
        twist = Twist<Real>{};
        return true;
    }
    const Number speed = furthest_way(twist.velocity, twist.spin, radius);
    const Number spin = clamp(twist.spin, -Number(kMaxAngle), Number(kMaxAngle));
    if (!(speed > fastest) && spin == twist.spin) {
        return false;
    }
    const Number share = speed > fastest ? fastest / speed : Number(1);
    twist = {share * twist.velocity, share * spin};
    return true;
}

/// How far mass is from a body's centre of mass, in the mean, cells: of what is smaller than this
/// (a square of 2.4 cells) a few cut cells tell its turning no longer.
constexpr double kLeastGyration = 1.0;

/// Which share of its spin a small body loses in a substep, to liquid that it is in. What turns it
/// is mostly noise: the lighter it is the faster it had spun, for ever.
template <class Real>
Face<Real> drag_on_spin(const Obstacles<Real>& obstacles, const BodyLoad<Real>& load) {
    using Number = Face<Real>;
    const Vec2<Number> pushed = load.change.velocity - load.stopped.velocity;
    const bool wet = pushed.x != Number(0) || pushed.y != Number(0);
    const Number short_by = Number(kLeastGyration) - square_root(load.inertia / load.mass);
    if (!wet || !(short_by > Number(0))) {
        return Number(0);
    }
    const Number fall = length(obstacles.fall);
    return minimum(Number(1), Number(4) * short_by * square_root(fall * obstacles.dt));
}

template <class Real>
std::int32_t finish(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                    BodyTable<Real>& table, Contacts<Real>& contacts) {
    const Face<Real> fastest = Face<Real>(kLongestWay) / obstacles.dt;
    PressureOnFree<Real> pressure(table);
    lay_films(obstacles, cells);  // liquid that stores what pushes it is solved without bodies
    for_each_free(table, [&](const Body<Real>& body, BodyLoad<Real>& load) {
        const auto slot = static_cast<std::uint16_t>(&body - table.body);
        Impulse<Real> pressed =
            pressure.next(obstacles.tank, table, obstacles.walls, slot, cells);
        pressed.add(film_impulse(obstacles, cells, slot));
        load.received.add(pressed);
        pass_on(load, (Face<Real>(1) - load.ease) * pressed.linear);
        load.change = answer_stopped(load, pressed);
    });
    std::int32_t slowed = 0;
    stop(obstacles, kRoundsAfter);
    remember(obstacles, contacts);
    for_each_free(table, [&](Body<Real>& body, BodyLoad<Real>& load) {
        Twist<Real> twist = whole_twist(load);
        twist.spin -= drag_on_spin(obstacles, load) * twist.spin;
        immerse(obstacles, cells, static_cast<std::uint16_t>(&body - table.body), twist);
        slowed += limit<Real>(fastest, static_cast<Face<Real>>(body.radius), twist) ? 1 : 0;
        load.unpressed = twist;
        load.change = Twist<Real>{};
        set_twist(load, twist, body);
    });
    return slowed;
}

/// Back into the tank, if the body reaches beyond it.
template <class Real>
void keep_in_tank(const GridShape& s, BodyTable<Real>& table, const BodyLoad<Real>& load,
                  Body<Real>& body) {
    if (!near_walls(s, body, Real(1))) {
        return;
    }
    const Overhang<Real> beyond = overhang(s, table, body);
    const Vec2<Real> back = along_slides(
        load, Vec2<Real>{beyond.low_x - beyond.high_x, beyond.low_y - beyond.high_y});
    if (back.x != Real(0) || back.y != Real(0)) {
        body.position = body.position + back;
        place(table, body);
    }
}

/// An angle, what spin adds to it in a substep and what parting does are each within kMaxAngle.
constexpr float kFurthestTurned = 3.0F * kMaxAngle;

/// Moves a body by its velocity and as it is parted from others. False: that led nowhere, and it
/// stays where it was, at rest. Nothing else may come of it, whatever the numbers were.
template <class Real>
bool go(const Obstacles<Real>& obstacles, BodyTable<Real>& table, Seconds<Real> dt_s,
        const BodyLoad<Real>& load, Body<Real>& body) {
    const Twist<Real> twist = twist_of(body, load);
    const Twist<Real>& parted = load.change;
    const Wide<Real> centre = (convert<Face<Real>>(body.position) + arm_of_centre(body, load)) +
                              (obstacles.dt * twist.velocity + parted.velocity);
    const Real before = body.angle;
    const Real angle = before + (dt_s * body.spin + static_cast<Real>(parted.spin));
    const bool in_range = absolute(angle) <= Real(kFurthestTurned);
    body.angle = in_range ? wrapped_angle(angle) : before;
    const Vec2<Real> to = load.is_hinged() ? body.position + dt_s * body.velocity
                                           : convert<Real>(centre - arm_of_centre(body, load));
    const bool sound = in_range && is_finite(to);
    if (sound) {
        body.position = to;
    } else {
        body.angle = before;
    }
    place(table, body);
    keep_in_tank(obstacles.tank, table, load, body);
    if (sound) {
        set_twist(load, twist, body);
    } else {
        body.velocity = load.is_hinged() ? body.velocity : Vec2<Real>{};
        body.spin = Real(0);
    }
    body.moved = true;
    return sound;
}

/// Places are put right by no more than velocities may lead.
template <class Real>
std::int32_t move(const Obstacles<Real>& obstacles, BodyTable<Real>& table, Seconds<Real> dt_s) {
    part(obstacles);
    std::int32_t held_back = 0;
    for_each_free(table, [&](Body<Real>& body, BodyLoad<Real>& load) {
        const bool too_far = limit<Real>(Face<Real>(kLongestWay),
                                         static_cast<Face<Real>>(body.radius), load.change);
        if (too_far) {
            load.stopped = Twist<Real>{};  // parting added to it: it is kept, but read no more
        }
        const bool sound = go(obstacles, table, dt_s, load, body);
        held_back += too_far || !sound ? 1 : 0;
    });
    return held_back;
}

}  // namespace

template <class Real>
const FreeBodyStages<Real>& free_body_stages() {
    static constexpr FreeBodyStages<Real> kStages{
        most_looks<Real>,    rounds<Real>,       accelerate<Real>,   begin_coupling<Real>,
        yielding<Real>,      set_aside<Real>,    relax_coupled<Real>,
        end_coupling<Real>,  finish<Real>,       move<Real>};
    return kStages;
}

#define WEIR_INSTANTIATE(Real) \
    template const FreeBodyStages<Real>& free_body_stages();
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
