// What bodies and tank received, and what bodies weigh.
#include "world/world_bodies.hpp"

namespace weir {

namespace {

template <class Real>
BodyForce in_metres(const Impulse<Real>& impulse, const detail::WorldState<Real>& state) {
    const auto m = static_cast<Face<Real>>(state.def.cell_m);
    const auto per_s = static_cast<Face<Real>>(units_per_s(state));
    BodyForce force;
    force.impulse_m3ps = convert<float>((m * m * m * per_s) * impulse.linear);
    force.angular_impulse_m4ps = static_cast<float>((m * m) * (m * m) * per_s * impulse.angular);
    force.dt_s = state.stepped_s;
    return force;
}

template <class Real>
Status check(const detail::WorldState<Real>* state, const void* output) {
    if (state == nullptr) {
        return Status::not_initialised;
    }
    if (output == nullptr) {
        return Status::output_missing;
    }
    return state->simulation.bodies.load == nullptr ? Status::two_way_missing : Status::ok;
}

}  // namespace

template <class Real>
Status World<Real>::force(BodyId id, BodyForce* force) const {
    const Status asked = check(state_, force);
    const Status known = asked == Status::ok ? check_id(*state_, id) : asked;
    if (known == Status::ok) {
        *force = in_metres(state_->simulation.bodies.load[id.slot].received, *state_);
    }
    return known;
}

template <class Real>
Status World<Real>::tank_force(BodyForce* force) const {
    const Status asked = check(state_, force);
    if (asked == Status::ok) {
        *force = in_metres(tank_received(state_->simulation.bodies), *state_);
    }
    return asked;
}

template <class Real>
Status World<Real>::mass(BodyId id, BodyMass* mass) const {
    const Status asked = check(state_, mass);
    const Status known = asked == Status::ok ? check_id(*state_, id) : asked;
    if (known == Status::ok) {
        const BodyLoad<Real>& load = state_->simulation.bodies.load[id.slot];
        const auto m = static_cast<Face<Real>>(state_->def.cell_m);
        mass->mass_m2 = static_cast<float>(m * m * load.mass);
        mass->inertia_m4 = static_cast<float>((m * m) * (m * m) * load.inertia);
        mass->centre_m = convert<float>(m * load.centre);
    }
    return known;
}

#define WEIR_INSTANTIATE(Real)                                    \
    template Status World<Real>::force(BodyId, BodyForce*) const; \
    template Status World<Real>::tank_force(BodyForce*) const;    \
    template Status World<Real>::mass(BodyId, BodyMass*) const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
