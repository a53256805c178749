// What the files of World's body calls share.
#pragma once

#include "world/world_state.hpp"

namespace weir {

/// Makes a body free, by what holds it.
template <class Real>
using SetFree = void (*)(Hold, BodyLoad<Real>&);

template <class Real>
Status add_body(detail::WorldState<Real>& state, const BodyDef& def, BodyKind kind, BodyId* id,
                SetFree<Real> set_free = nullptr);

/// stale_body, or ok.
template <class Real>
Status check_id(const detail::WorldState<Real>& state, BodyId id);

/// Whether anything can be done with that body now.
template <class Real>
Status check_known(const detail::WorldState<Real>* state, BodyId id) {
    const Status free = ready(state);
    return free != Status::ok ? free : check_id(*state, id);
}

template <class Real>
void set_pose(const detail::WorldState<Real>& state, const Motion& motion, Body<Real>& body) {
    body.position = convert<Real>(state.cells_per_m * convert<Face<Real>>(motion.position_m));
    body.angle = static_cast<Real>(wrapped_angle(static_cast<Face<Real>>(motion.angle_rad)));
}

template <class Real>
void set_velocity(const detail::WorldState<Real>& state, const Motion& motion, Body<Real>& body) {
    body.velocity = convert<Real>(pace_of(state) * convert<Face<Real>>(motion.velocity_mps));
    body.spin = static_cast<Real>(motion.spin_radps * unit_of(state));
}

/// Nodes that it is drawn on.
template <class Real>
NodeBox box_of(const Simulation<Real>& simulation, const Body<Real>& body) {
    const GridShape& shape = simulation.layers.shape;
    return nodes_near(simulation.bodies.ring(body), body.vertex_count, Real(0.5), shape.nx,
                      shape.ny);
}

}  // namespace weir
