// Free bodies: only a program that adds one links their stages.
#include "world/world_bodies.hpp"

namespace weir {

namespace {

/// How it will answer impulses, by what holds it.
template <class Real>
void hold(Hold hold, BodyLoad<Real>& load) {
    using Number = Face<Real>;
    const bool turns = hold == Hold::none || hold == Hold::hinge;
    const bool hinged = hold == Hold::hinge;
    const Number about_origin = load.inertia + load.mass * dot(load.centre, load.centre);
    load.inverse_mass = Number(1) / load.mass;
    load.inverse_inertia = turns ? Number(1) / (hinged ? about_origin : load.inertia) : Number(0);
    load.slides = {Number(hinged || hold == Hold::rail_y ? 0 : 1),
                   Number(hinged || hold == Hold::rail_x ? 0 : 1)};
}

}  // namespace

template <class Real>
Status World<Real>::add_free_body(const BodyDef& def, BodyId* id) {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    if constexpr (Stored<Real>::shares_momentum) {
        return Status::free_body_in_small_world;
    } else {
        Simulation<Real>& simulation = state_->simulation;
        if (simulation.bodies.load == nullptr) {
            return Status::two_way_missing;
        }
        if (def.open) {
            return Status::polygon_zero_area;  // it weighs nothing
        }
        const Status added = add_body(*state_, def, BodyKind::moving, id, hold<Real>);
        if (added == Status::ok) {
            simulation.free_bodies = &free_body_stages<Real>();
        }
        return added;
    }
}

#define WEIR_INSTANTIATE(Real) \
    template Status World<Real>::add_free_body(const BodyDef&, BodyId*);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
