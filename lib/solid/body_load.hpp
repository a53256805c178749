// What liquid does to a body, and how a free body answers. There is one record a body, and one
// for the tank behind them, in worlds with room for it (`Capacity::two_way`).
#pragma once

#include "solid/body_table.hpp"

namespace weir {

/// Momentum and angular momentum, over the liquid's density and per depth: cells³/s and cells⁴/s.
/// Sums are kept in the numbers of the public face: fixed point would saturate.
template <class Real>
struct Impulse {
    Vec2<Face<Real>> linear;
    Face<Real> angular = Face<Real>(0);

    void add(Vec2<Face<Real>> push, Vec2<Face<Real>> arm) {
        linear = linear + push;
        angular += cross(arm, push);
    }
    void add(const Impulse& other) {
        linear = linear + other.linear;
        angular += other.angular;
    }
};

/// Velocity of the centre of mass, and spin.
template <class Real>
struct Twist {
    Vec2<Face<Real>> velocity;
    Face<Real> spin = Face<Real>(0);
};

template <class Real>
struct BodyLoad {
    Vec2<Face<Real>> centre;                      ///< of mass, in the body's frame, cells
    Vec2<Face<Real>> at;                          ///< the same in the tank, as last located
    Vec2<Face<Real>> arm;                         ///< from the body's origin to it, likewise
    Face<Real> area = Face<Real>(0);              ///< cells²
    Face<Real> mass = Face<Real>(0);              ///< over the liquid's density, cells²
    Face<Real> inertia = Face<Real>(0);           ///< about the centre, cells⁴
    /// 0: it moves as told. < 0: it is free, but led through this step (`World::move_body`).
    Face<Real> inverse_mass = Face<Real>(0);
    Face<Real> inverse_inertia = Face<Real>(0);  ///< on a hinge about that; 0: held
    /// Its mass over that and what it takes along of the liquid where the grid does not show it
    /// (solid/immersion.hpp), as of the last substep; since `accelerate` also of what sticks to it.
    Face<Real> ease = Face<Real>(1);
    /// 1 along axes along which it moves, 0 where it is held: along both by a hinge.
    Vec2<Face<Real>> slides{Face<Real>(1), Face<Real>(1)};
    Impulse<Real> received;    ///< in this step, about the centre of mass
    Impulse<Real> blows;       ///< of particles, which a free body has not answered yet
    Face<Real> blow_mass = Face<Real>(0);  ///< of those particles, and what sticks pulls as
    Twist<Real> unpressed;     ///< free bodies: before the pressure
    Twist<Real> change;        ///< and what the pressure adds to it, and whatever stops it
    Twist<Real> stopped;       ///< that part of the change which is due to what stops it

    void forget_blows() {
        blows = Impulse<Real>{};
        blow_mass = Face<Real>(0);
    }
    bool is_free() const { return inverse_mass > Face<Real>(0); }
    bool is_free_or_led() const { return inverse_mass != Face<Real>(0); }
    bool is_hinged() const { return slides.x == Face<Real>(0) && slides.y == Face<Real>(0); }
};
static_assert(sizeof(BodyLoad<float>) <= kBodyLoadBytes<float>, "raise kBodyLoadBytes");
static_assert(sizeof(BodyLoad<double>) <= kBodyLoadBytes<double>, "raise kBodyLoadBytes");

/// What the tank's walls receive; the world has room for it.
template <class Real>
inline Impulse<Real>& tank_received(const BodyTable<Real>& table) {
    return table.load[table.capacity].received;
}

/// What bodies and tank were given in this step to balance the ledger (step/momentum_ledger.hpp).
/// The tank's record has no centre of mass.
template <class Real>
inline Vec2<Face<Real>>& settled(const BodyTable<Real>& table) {
    return table.load[table.capacity].centre;
}

/// From the body's origin to its centre of mass, in the tank's directions.
template <class Real>
inline Vec2<Face<Real>> arm_of_centre(const Body<Real>& body, const BodyLoad<Real>& load) {
    const Rotation<Real> turn = rotation(body.angle);
    const Rotation<Face<Real>> wide{static_cast<Face<Real>>(turn.cosine),
                                    static_cast<Face<Real>>(turn.sine)};
    return wide.apply(load.centre);
}

/// What a body receives where the grid does not show that it displaces liquid: the tank gives it.
template <class Real>
inline void receive_from_tank(const BodyTable<Real>& table, Vec2<Face<Real>> push,
                              BodyLoad<Real>& load) {
    load.received.linear = load.received.linear + push;
    tank_received(table).linear = tank_received(table).linear - push;
}

/// What is left of a way where a body is held, but for hinges.
template <class Real, class Number>
inline Vec2<Number> along_slides(const BodyLoad<Real>& load, Vec2<Number> way) {
    return {load.slides.x != Face<Real>(0) ? way.x : Number(0),
            load.slides.y != Face<Real>(0) ? way.y : Number(0)};
}

/// How a free body's velocity answers an impulse.
template <class Real>
inline Twist<Real> answer(const BodyLoad<Real>& load, const Impulse<Real>& impulse) {
    if (load.is_hinged()) {
        const Face<Real> torque = impulse.angular + cross(load.arm, impulse.linear);
        const Face<Real> spin = load.ease * (load.inverse_inertia * torque);
        return {spin_velocity(spin, load.arm), spin};
    }
    return {along_slides(load, load.ease * (load.inverse_mass * impulse.linear)),
            load.ease * (load.inverse_inertia * impulse.angular)};
}

/// What an impulse changes, besides what stops the body.
template <class Real>
inline Twist<Real> answer_stopped(const BodyLoad<Real>& load, const Impulse<Real>& impulse) {
    const Twist<Real> pushed = answer(load, impulse);
    return {load.stopped.velocity + pushed.velocity, load.stopped.spin + pushed.spin};
}

}  // namespace weir
