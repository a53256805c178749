#include "solid/free_body.hpp"

#include "math/rotation.hpp"
#include "solid/body_coupling.hpp"

namespace weir {

namespace {

/// Bodies are slowed to this many cells a substep, as particles are.
constexpr std::int32_t kLongestWay = 2;

/// A vertex this near to a wall of the tank bounces off it, cells.
template <class Real>
constexpr Face<Real> kTouch = Face<Real>(1.0 / 256.0);

/// Blows of the tank's walls on a body are found one after the other, so often.
constexpr std::int32_t kContactRounds = 4;

template <class Real>
using Wide = Vec2<Face<Real>>;

/// Velocity of the centre of mass, from that of the body's origin.
template <class Real>
Twist<Real> twist_of(const Body<Real>& body, const BodyLoad<Real>& load) {
    const Face<Real> spin = static_cast<Face<Real>>(body.spin);
    const Wide<Real> arm = arm_of_centre(body, load);
    return {convert<Face<Real>>(body.velocity) + spin_velocity(spin, arm), spin};
}

template <class Real>
void set_twist(const BodyLoad<Real>& load, const Twist<Real>& twist, Body<Real>& body) {
    const Wide<Real> arm = arm_of_centre(body, load);
    body.velocity = convert<Real>(twist.velocity - spin_velocity(twist.spin, arm));
    body.spin = static_cast<Real>(twist.spin);
}

template <class Real, class Visit>
void for_each_free(BodyTable<Real>& table, Visit visit) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (table.body[slot].kind == BodyKind::moving && table.load[slot].is_free()) {
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

/// Whether any of its points may be at the tank's walls.
template <class Real>
bool near_walls(const GridShape& s, const Body<Real>& body) {
    const Real r = body.radius + Real(1);
    return body.position.x < r || body.position.y < r ||
           body.position.x + r > static_cast<Real>(s.nx) ||
           body.position.y + r > static_cast<Real>(s.ny);
}

template <class Real>
void move(const GridShape& s, BodyTable<Real>& table, Seconds<Real> dt_s) {
    const Face<Real> dt = static_cast<Face<Real>>(dt_s);
    for_each_free(table, [&](Body<Real>& body, const BodyLoad<Real>& load) {
        const Twist<Real> twist = twist_of(body, load);
        const Wide<Real> centre = (convert<Face<Real>>(body.position) + arm_of_centre(body, load)) +
                                  dt * twist.velocity;
        body.angle = wrapped_angle(body.angle + dt_s * body.spin);
        body.position = convert<Real>(centre - arm_of_centre(body, load));
        place(table, body);
        if (near_walls(s, body)) {
            const Overhang<Real> beyond = overhang(s, table, body);
            const Vec2<Real> back{beyond.low_x - beyond.high_x, beyond.low_y - beyond.high_y};
            if (back.x != Real(0) || back.y != Real(0)) {
                body.position = body.position + back;
                place(table, body);
            }
        }
        set_twist(load, twist, body);
        body.moved = true;
    });
}

/// How walls of the tank stop a body within a substep.
template <class Real>
struct Stop {
    Face<Real> dt;
    Face<Real> slow;  ///< what approaches no faster than this comes to rest, cells/s
};

/// Impulse that lets a point come no nearer to a wall than the wall is (`gap`), or throws it back
/// if it is fast and the wall has restitution, and rubs it along. `inward`: the wall's normal.
template <class Real>
Impulse<Real> blow_of_wall(const BodyLoad<Real>& load, const Twist<Real>& twist, Wide<Real> arm,
                           Face<Real> gap, Wide<Real> inward, const SurfaceLaw<Real>& wall,
                           const Stop<Real>& stop) {
    using Number = Face<Real>;
    const Wide<Real> along{inward.y, -inward.x};
    const Wide<Real> v = twist.velocity + spin_velocity(twist.spin, arm);
    const Number approach = dot(v, inward);
    const auto restitution = static_cast<Number>(wall.restitution);
    const bool bounces = restitution > Number(0) && approach < -stop.slow;
    const Number allowed = bounces ? -restitution * approach
                                   : -maximum(gap, Number(0)) / stop.dt;
    Impulse<Real> impulse;
    if (!(approach < allowed) || (bounces && gap > kTouch<Real>)) {
        return impulse;
    }
    const auto yielding = [&](Wide<Real> direction) {
        const Number lever = cross(arm, direction);
        return load.inverse_mass + lever * lever * load.inverse_inertia;
    };
    const Number push = (allowed - approach) / yielding(inward);
    const Number most = static_cast<Number>(wall.friction) * push;
    const Number slip = dot(v, along) - static_cast<Number>(wall.conveyor);
    const Number rub = clamp(-slip / yielding(along), -most, most);
    impulse.add(push * inward + rub * along, arm);
    return impulse;
}

/// Blows of the tank's walls on all vertices.
template <class Real>
void stop_at_walls(const GridShape& s, const Borders<Real>& borders, const BodyTable<Real>& table,
                   const Body<Real>& body, const BodyLoad<Real>& load, const Stop<Real>& stop,
                   Twist<Real>& twist) {
    using Number = Face<Real>;
    const Wide<Real> size{static_cast<Number>(s.nx), static_cast<Number>(s.ny)};
    for (std::int32_t round = 0; round < kContactRounds; ++round) {
        for (std::int32_t k = 0; k < body.vertex_count; ++k) {
            const Wide<Real> x = convert<Number>(table.ring(body)[k]);
            const auto meet = [&](Number gap, Wide<Real> inward, const SurfaceLaw<Real>& wall) {
                const Twist<Real> more = answer(
                    load, blow_of_wall(load, twist, x - load.at, gap, inward, wall, stop));
                twist.velocity = twist.velocity + more.velocity;
                twist.spin += more.spin;
            };
            meet(x.x, {Number(1), Number(0)}, borders.left);
            meet(size.x - x.x, {Number(-1), Number(0)}, borders.right);
            meet(x.y, {Number(0), Number(1)}, borders.bottom);
            meet(size.y - x.y, {Number(0), Number(-1)}, borders.top);
        }
    }
}

/// Particles bounce off a body as if it were too heavy to yield. One that is lighter than all that
/// hit it takes only as much as brings it to their speed.
template <class Real>
void accelerate(const GridShape& s, const Borders<Real>& borders, BodyTable<Real>& table,
                Vec2<Real> gravity, Seconds<Real> dt_s) {
    const Face<Real> dt = static_cast<Face<Real>>(dt_s);
    const Face<Real> fall =
        dt * static_cast<Face<Real>>(maximum(absolute(gravity.x), absolute(gravity.y)));
    const Stop<Real> stop{dt, fall + fall};
    for_each_free(table, [&](Body<Real>& body, BodyLoad<Real>& load) {
        Twist<Real> twist = twist_of(body, load);
        const Twist<Real> blown = answer(load, load.blows);
        const Face<Real> share = load.blow_mass > load.mass ? load.mass / load.blow_mass
                                                            : Face<Real>(1);
        load.blows = Impulse<Real>{};
        load.blow_mass = Face<Real>(0);
        twist.velocity =
            (twist.velocity + dt * convert<Face<Real>>(gravity)) + share * blown.velocity;
        twist.spin += share * blown.spin;
        if (near_walls(s, body)) {
            stop_at_walls(s, borders, table, body, load, stop, twist);
        }
        load.unpressed = twist;
        load.change = Twist<Real>{};
        set_twist(load, twist, body);
    });
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

template <class Real>
std::int32_t finish(BodyTable<Real>& table, Seconds<Real> dt_s) {
    const Face<Real> fastest = Face<Real>(kLongestWay) / static_cast<Face<Real>>(dt_s);
    std::int32_t slowed = 0;
    for_each_free(table, [&](Body<Real>& body, const BodyLoad<Real>& load) {
        Twist<Real> twist{load.unpressed.velocity + load.change.velocity,
                          load.unpressed.spin + load.change.spin};
        slowed += limit<Real>(fastest, static_cast<Face<Real>>(body.radius), twist) ? 1 : 0;
        set_twist(load, twist, body);
    });
    return slowed;
}

}  // namespace

template <class Real>
const FreeBodyStages<Real>& free_body_stages() {
    static constexpr FreeBodyStages<Real> kStages{
        accelerate<Real>,      begin_coupling<Real>, yielding<Real>, set_aside<Real>,
        relax_coupled<Real>,   end_coupling<Real>,   finish<Real>,   move<Real>};
    return kStages;
}

#define WEIR_INSTANTIATE(Real) \
    template const FreeBodyStages<Real>& free_body_stages();
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
