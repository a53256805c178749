#include "solid/obstacles.hpp"

namespace weir {

namespace {

/// A vertex this near to a wall of the tank bounces off it, cells.
template <class Real>
constexpr Face<Real> kTouch = Face<Real>(1.0 / 256.0);

/// A body has three ways to yield; where friction lets it slip, it may meet more than that.
constexpr std::int32_t kMostContacts = 6;

/// Blows are found one after the other, so often.
constexpr std::int32_t kRoundsOfBlows = 4;

/// Of what a direction yields when nothing stops the body: less is held already.
template <class Real>
constexpr Face<Real> kHeld = Face<Real>(1.0 / 1024.0);

template <class Real>
using Wide = Vec2<Face<Real>>;

template <class Real>
Face<Real> along(const Impulse<Real>& direction, const Twist<Real>& twist) {
    return dot(direction.linear, twist.velocity) + direction.angular * twist.spin;
}

/// Takes a direction, and the way that the body yields along it, out of what it yields to.
template <class Real>
void hold(const Twist<Real>& way, Face<Real> yielding, Yield<Real>& yield) {
    const Twist<Real> share{(Face<Real>(1) / yielding) * way.velocity, way.spin / yielding};
    yield.xx -= share.velocity.x * way.velocity.x;
    yield.yy -= share.velocity.y * way.velocity.y;
    yield.turn -= share.spin * way.spin;
    yield.xy -= share.velocity.x * way.velocity.y;
    yield.x_turn -= share.velocity.x * way.spin;
    yield.y_turn -= share.velocity.y * way.spin;
}

/// A point of a body before an obstacle.
template <class Real>
struct Touch {
    Wide<Real> arm;     ///< from the centre of mass
    Wide<Real> inward;  ///< the obstacle's normal
    const SurfaceLaw<Real>* law = nullptr;
    Face<Real> change = Face<Real>(0);  ///< of its velocity along the normal that it needs
    bool bounces = false;
};

/// A direction in which a point can be pushed, and how the body yields to it, given what holds it.
template <class Real>
struct Way {
    Impulse<Real> direction;
    Twist<Real> way;
    Face<Real> yielding;

    Way(const BodyLoad<Real>& load, Wide<Real> along_it, Wide<Real> arm) {
        direction.add(along_it, arm);
        way = answer_within(load.yield, direction);
        yielding = along(direction, way);
    }
    bool is_free(const BodyLoad<Real>& load) const {
        return yielding > kHeld<Real> * along(direction, answer(load, direction));
    }
    Face<Real> speed(const BodyLoad<Real>& load) const {
        return along(direction, load.unpressed) + along(direction, load.change);
    }
    void push(Face<Real> strength, BodyLoad<Real>& load) const {
        load.change.velocity = load.change.velocity + strength * way.velocity;
        load.change.spin += strength * way.spin;
    }
};

/// Pushes a point as it needs it, and rubs it along: as it came, or if it is held there as it then
/// goes. Who is held already stays so.
template <class Real>
void push(const Touch<Real>& at, bool held, BodyLoad<Real>& load) {
    using Number = Face<Real>;
    const Way<Real> normal(load, at.inward, at.arm);
    const Number strength = at.change / normal.yielding;
    if (held) {
        normal.push(strength, load);
        hold(normal.way, normal.yielding, load.yield);
    }
    const Number most = static_cast<Number>(at.law->friction) * strength;
    const Way<Real> rub(load, {at.inward.y, -at.inward.x}, at.arm);
    const bool rubs = most > Number(0) && rub.is_free(load);
    const Number wanted =
        rubs ? (static_cast<Number>(at.law->conveyor) - rub.speed(load)) / rub.yielding
             : Number(0);
    if (!held) {
        normal.push(strength, load);
    }
    rub.push(clamp(wanted, -most, most), load);
    if (held && rubs && absolute(wanted) < most) {
        hold(rub.way, rub.yielding, load.yield);
    }
}

/// Looks at a point before an obstacle: `worst` becomes the one that comes nearest too fast. Who
/// is fast before a wall with restitution goes on until it is there.
template <class Real>
void look(const Obstacles<Real>& obstacles, const BodyLoad<Real>& load, Touch<Real> at,
          Face<Real> gap, bool throwing, Touch<Real>& worst) {
    using Number = Face<Real>;
    Impulse<Real> normal;
    normal.add(at.inward, at.arm);
    const Number approach = along(normal, load.unpressed) + along(normal, load.change);
    const auto restitution = static_cast<Number>(at.law->restitution);
    const bool fast = restitution > Number(0) && approach < -obstacles.slow;
    at.bounces = fast && throwing;
    const Number allowed = at.bounces ? -restitution * approach
                                      : -maximum(gap, Number(0)) / obstacles.dt;
    at.change = allowed - approach;
    if (at.change > worst.change && !(fast && gap > kTouch<Real>) &&
        Way<Real>(load, at.inward, at.arm).is_free(load)) {
        worst = at;
    }
}

/// Calls visit(contact, gap) for each vertex before each wall of the tank.
template <class Real, class Visit>
void for_each_contact(const Obstacles<Real>& obstacles, const Body<Real>& body,
                      const BodyLoad<Real>& load, Visit visit) {
    using Number = Face<Real>;
    const Borders<Real>& borders = obstacles.borders;
    const Wide<Real> size{static_cast<Number>(obstacles.tank.nx),
                          static_cast<Number>(obstacles.tank.ny)};
    for (std::int32_t k = 0; k < body.vertex_count && near_walls(obstacles.tank, body); ++k) {
        const Wide<Real> x = convert<Number>(obstacles.bodies.ring(body)[k]);
        const auto wall = [&](Number gap, Wide<Real> inward, const SurfaceLaw<Real>& law) {
            visit(Touch<Real>{x - load.at, inward, &law}, gap);
        };
        wall(x.x, {Number(1), Number(0)}, borders.left);
        wall(size.x - x.x, {Number(-1), Number(0)}, borders.right);
        wall(x.y, {Number(0), Number(1)}, borders.bottom);
        wall(size.y - x.y, {Number(0), Number(-1)}, borders.top);
    }
}

}  // namespace

/// Blows follow each other, each as if it were the only one.
template <class Real>
void throw_back(const Obstacles<Real>& obstacles, std::uint16_t slot) {
    BodyLoad<Real>& load = obstacles.bodies.load[slot];
    bool answered = !load.sinks;
    for (std::int32_t round = 0; round < kRoundsOfBlows; ++round) {
        for_each_contact(obstacles, obstacles.bodies.body[slot], load,
                         [&](const Touch<Real>& at, Face<Real> gap) {
                             Touch<Real> worst;
                             look(obstacles, load, at, gap, true, worst);
                             if (worst.law != nullptr) {
                                 push(worst, false, load);
                                 answered = answered || worst.bounces;
                             }
                         });
    }
    if (answered) {
        load.unpressed = {load.unpressed.velocity + load.change.velocity,
                          load.unpressed.spin + load.change.spin};
    }
    load.change = Twist<Real>{};
}

/// Contact after contact, the worst first.
template <class Real>
void stop(const Obstacles<Real>& obstacles, std::uint16_t slot) {
    BodyLoad<Real>& load = obstacles.bodies.load[slot];
    for (std::int32_t count = 0; count < kMostContacts && load.sinks; ++count) {
        Touch<Real> worst;
        for_each_contact(obstacles, obstacles.bodies.body[slot], load,
                         [&](const Touch<Real>& at, Face<Real> gap) {
                             look(obstacles, load, at, gap, false, worst);
                         });
        if (worst.law == nullptr) {
            return;
        }
        push(worst, true, load);
    }
}

#define WEIR_INSTANTIATE(Real)                                       \
    template void throw_back(const Obstacles<Real>&, std::uint16_t); \
    template void stop(const Obstacles<Real>&, std::uint16_t);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
