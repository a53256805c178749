// Where bodies are and how they move: told, and asked.
#include "step/regions.hpp"
#include "world/sleep.hpp"
#include "world/world_bodies.hpp"

namespace weir {

namespace {

using detail::WorldState;

/// Whether that body can be given that motion now.
template <class Real>
Status check_movable(const WorldState<Real>* state, BodyId id) {
    const Status known = check_known(state, id);
    if (known != Status::ok) {
        return known;
    }
    return state->simulation.bodies.body[id.slot].kind == BodyKind::fixed ? Status::body_is_static
                                                                          : Status::ok;
}

template <class Real>
Status check_reach(const WorldState<Real>& state, const Motion& motion) {
    return check_motion(motion, state.def.cell_m, reach_of<Real>(state.unit_exponent));
}

/// Of an angle within a whole turn.
float shorter_turn(float angle_rad) {
    constexpr float kHalf = 3.14159265F;
    if (angle_rad > kHalf) {
        return angle_rad - 2.0F * kHalf;
    }
    return angle_rad < -kHalf ? angle_rad + 2.0F * kHalf : angle_rad;
}

/// Of the way to somewhere, which that velocity and spin would take, what a body can go at most.
float share_of_way(const Motion& motion, float cell_m, const Reach& reach) {
    const float speed = larger_part(motion.velocity_mps);
    const float fastest = reach.speed * cell_m;
    const float spin = absolute(motion.spin_radps);
    constexpr float kBelow = 0.999999F;  // the product is rounded
    return minimum(speed > fastest ? kBelow * (fastest / speed) : 1.0F,
                   spin > reach.spin ? kBelow * (reach.spin / spin) : 1.0F);
}

/// What `World::motion` says of it.
template <class Real>
Motion told(const WorldState<Real>& state, const Body<Real>& body) {
    const auto cell_m = static_cast<Face<Real>>(state.def.cell_m);
    const auto per_s = static_cast<Face<Real>>(units_per_s(state));
    Motion motion;
    motion.position_m = convert<float>(cell_m * convert<Face<Real>>(body.position));
    motion.velocity_mps = convert<float>((cell_m * per_s) * convert<Face<Real>>(body.velocity));
    motion.angle_rad = static_cast<float>(body.angle);
    motion.spin_radps = static_cast<float>(per_s * static_cast<Face<Real>>(body.spin));
    return motion;
}

bool same(Vec2f a, Vec2f b) { return a.x == b.x && a.y == b.y; }

/// Metres are rounded: who says of a body what it was told leaves it as it is.
template <class Real>
void change_pose(const WorldState<Real>& state, const Motion& motion, Body<Real>& body) {
    const Motion now = told(state, body);
    const Vec2<Real> position = body.position;
    const Real angle = body.angle;
    set_pose(state, motion, body);
    body.position = same(motion.position_m, now.position_m) ? position : body.position;
    body.angle = motion.angle_rad == now.angle_rad ? angle : body.angle;
}

template <class Real>
void change_velocity(WorldState<Real>& state, const Motion& motion, Body<Real>& body) {
    const Motion now = told(state, body);
    const Vec2<Real> velocity = body.velocity;
    const Real spin = body.spin;
    set_velocity(state, motion, body);
    body.velocity = same(motion.velocity_mps, now.velocity_mps) ? velocity : body.velocity;
    body.spin = motion.spin_radps == now.spin_radps ? spin : body.spin;
    if (velocity.x != body.velocity.x || velocity.y != body.velocity.y || spin != body.spin) {
        touch_regions(state.simulation.regions, body.drawn);
        wake(state);
    }
}

}  // namespace

template <class Real>
Status World<Real>::set_motion(BodyId id, const Motion& motion) {
    Status valid = check_movable(state_, id);
    if (valid == Status::ok) {
        valid = check_reach(*state_, motion);
    }
    if (valid != Status::ok) {
        return valid;
    }
    BodyTable<Real>& table = state_->simulation.bodies;
    Body<Real>& body = table.body[id.slot];
    const Vec2<Real> position = body.position;
    const Real angle = body.angle;
    lead(table, id.slot, false);
    change_pose(*state_, motion, body);
    if (position.x != body.position.x || position.y != body.position.y || angle != body.angle) {
        body.moved = body.leapt = true;
        place(table, body);
        touch_regions(state_->simulation.regions, body.drawn);
        touch_regions(state_->simulation.regions, box_of(state_->simulation, body));
        wake(*state_);
    }
    change_velocity(*state_, motion, body);
    return Status::ok;
}

template <class Real>
Status World<Real>::move_body(BodyId id, Vec2f position_m, float angle_rad, float dt_s) {
    Motion now;
    Motion motion{position_m, angle_rad, {}, 0.0F};
    Status valid = check_movable(state_, id);
    if (valid == Status::ok) {
        valid = check_reach(*state_, motion);
    }
    if (valid == Status::ok && !(dt_s > 0.0F && is_finite(dt_s))) {
        valid = Status::motion_not_finite;
    }
    if (valid == Status::ok) {
        valid = this->motion(id, &now);
    }
    if (valid != Status::ok) {
        return valid;
    }
    // A body that was held goes for both steps in the next one.
    const float behind_s =
        unit_of(*state_) * static_cast<float>(state_->simulation.walls_behind_s);
    constexpr float kShortest = 1.0e-20F;  // whatever is faster than it can be, and not infinite
    const float per_s = 1.0F / maximum(dt_s + behind_s, kShortest);
    motion.velocity_mps = {per_s * (position_m.x - now.position_m.x),
                           per_s * (position_m.y - now.position_m.y)};
    motion.spin_radps = per_s * shorter_turn(wrapped_angle(angle_rad - now.angle_rad));
    const float share =
        share_of_way(motion, state_->def.cell_m, reach_of<Real>(state_->unit_exponent));
    motion.velocity_mps = {share * motion.velocity_mps.x, share * motion.velocity_mps.y};
    motion.spin_radps = share * motion.spin_radps;
    valid = check_reach(*state_, motion);
    if (valid == Status::ok) {
        lead(state_->simulation.bodies, id.slot, true);
        change_velocity(*state_, motion, state_->simulation.bodies.body[id.slot]);
    }
    return valid;
}

template <class Real>
Status World<Real>::motion(BodyId id, Motion* motion) const {
    if (state_ == nullptr) {
        return Status::not_initialised;
    }
    if (motion == nullptr) {
        return Status::output_missing;
    }
    const Status known = check_id(*state_, id);
    if (known != Status::ok) {
        return known;
    }
    *motion = told(*state_, state_->simulation.bodies.body[id.slot]);
    return Status::ok;
}

#define WEIR_INSTANTIATE(Real)                                           \
    template Status World<Real>::set_motion(BodyId, const Motion&);      \
    template Status World<Real>::move_body(BodyId, Vec2f, float, float); \
    template Status World<Real>::motion(BodyId, Motion*) const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
