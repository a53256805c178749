// The liquid in a world: particles added, removed and seen.
#include "fluid/seeding.hpp"
#include "weir/world.hpp"
#include "world/world_liquid.hpp"

namespace weir {

namespace {

using detail::WorldState;

std::int32_t lattice_per_axis(std::int32_t particles_per_cell) {
    std::int32_t per_axis = 1;
    while (per_axis * per_axis < particles_per_cell) {
        ++per_axis;
    }
    return per_axis;
}

template <class Real>
Status check_kind(const WorldState<Real>& state, Liquid kind) {
    if (kind == Liquid::first) {
        return Status::ok;
    }
    if (kind != Liquid::second) {
        return Status::unknown_option;
    }
    return state.def.capacity.second_liquid ? Status::ok : Status::no_second_liquid;
}

/// Whether a sleeping region is there: its pressure stands elsewhere.
template <class Real>
bool lies_asleep(const Simulation<Real>& simulation, Vec2<Real> at) {
    const Regions<Real>* const regions = simulation.regions;
    return regions != nullptr && regions->sleeps(regions->tile_of(Vec2<PositionOf<Real>>(at)));
}

template <class Real>
[[gnu::noinline]] void add(Simulation<Real>& simulation, Vec2<Real> at, Vec2<Real> velocity,
                           Liquid kind) {
    Particles<Real>& particles = simulation.particles;
    PressureFields<Real>& fields = simulation.pressure;
    const GridShape& tank = simulation.layers.shape;
    if constexpr (Stored<Real>::coarse) {  // what is at rest drifts again
        fields.crowded = simulation.settings.volume_gain > Real(0);
    }
    if (!lies_asleep(simulation, at)) {
        if constexpr (Stored<Real>::coarse) {
            // The fields' own weight of a cell is no part of a snapshot.
            note_dense(tank, at, simulation.settings.cell_weight(fields.last_dt), fields);
        } else {
            const Walls<Real>& walls = simulation.layers.walls;
            note_inlet(tank, walls, simulation.stages->centre_seen(tank, walls, at),
                       Real(1) / simulation.settings.rest_count, fields);
        }
    }
    particles.add(at, velocity, kind);
    if (simulation.regions != nullptr) {
        simulation.regions->stages->touch_at(*simulation.regions,
                                             particles.position[particles.count - 1]);
    }
}

template <class Real>
Status check_particle(const WorldState<Real>& state, Vec2f position_m, Vec2f velocity_mps) {
    if (!is_finite(position_m) || !is_finite(velocity_mps)) {
        return Status::particle_not_finite;
    }
    if (!in_tank(state, position_m)) {
        return Status::particle_outside_domain;
    }
    if (!in_range(state, velocity_mps)) {
        return Status::velocity_out_of_range;
    }
    return state.simulation.particles.full() ? Status::no_free_particle : Status::ok;
}

/// A field of all particles, those asleep or beyond the window as well, of a world that is one and
/// has it.
template <class Real, class Field>
View<Field> view_of(const WorldState<Real>* state, Field* Particles<Real>::*field) {
    if (state == nullptr || state->simulation.particles.*field == nullptr) {
        return {};
    }
    const Particles<Real>& particles = state->simulation.particles;
    const std::int32_t hidden = hidden_of(state->simulation);
    return {particles.*field - hidden, particles.count + hidden};
}

}  // namespace

template <class Real>
Status World<Real>::fill(const Box& box_m, std::int32_t* added, Liquid kind) {
    const Status valid = check_box_in(state_, box_m);
    if (valid != Status::ok) {
        return valid;
    }
    const Status known = check_kind(*state_, kind);
    if (known != Status::ok) {
        return known;
    }
    Simulation<Real>& simulation = state_->simulation;
    const Particles<Real>& particles = simulation.particles;
    if (!in_tank(*state_, box_m.min_m) || !in_tank(*state_, box_m.max_m)) {
        return Status::box_outside_domain;
    }
    const BoxInCells<Real> box(*state_, box_m);
    const std::int32_t per_axis = lattice_per_axis(state_->def.particles_per_cell);
    const GridShape& shape = simulation.grid.shape;
    const Walls<Real>& walls = simulation.layers.walls;
    simulation.stages->draw_moved(simulation.layers, simulation.bodies);
    const auto seed = [&](bool adding) {
        std::int32_t seeds = 0;
        for_each_seed(shape, box.low, box.high, per_axis, [&](Vec2<Real> at) {
            if (!walls.active || !simulation.stages->inside_solid(shape, walls, at)) {
                ++seeds;
                if (adding) {
                    add(simulation, at, {}, kind);
                }
            }
        });
        return seeds;
    };
    const std::int32_t seeds = seed(false);
    if (added != nullptr) {
        *added = seeds;
    }
    if (seeds > particles.capacity - particles.count) {
        return Status::no_free_particle;
    }
    if (seeds > 0) {
        seed(true);
        note_changed(*state_);
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::add_particle(Vec2f position_m, Vec2f velocity_mps, Liquid kind) {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    const Status valid = check_particle(*state_, position_m, velocity_mps);
    if (valid != Status::ok) {
        return valid;
    }
    const Status known = check_kind(*state_, kind);
    if (known != Status::ok) {
        return known;
    }
    Simulation<Real>& simulation = state_->simulation;
    const Vec2<Real> inside = within_tank(simulation.grid.shape, in_cells(*state_, position_m));
    const Walls<Real>& walls = simulation.layers.walls;
    simulation.stages->draw_moved(simulation.layers, simulation.bodies);
    if (walls.active &&
        simulation.stages->inside_solid(simulation.grid.shape, walls, inside)) {
        return Status::particle_inside_solid;
    }
    const Vec2<Real> velocity = inner_velocity(*state_, velocity_mps);
    add(simulation, inside, velocity, kind);
    note_changed(*state_);
    note_speed(simulation, velocity);
    return Status::ok;
}

template <class Real>
Status World<Real>::remove_particle(std::int32_t index) {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    Simulation<Real>& simulation = state_->simulation;
    if (index < 0 || index >= simulation.particles.count) {
        return Status::no_such_particle;
    }
    take_out(simulation, index);
    note_changed(*state_);
    return Status::ok;
}

template <class Real>
Status World<Real>::tag_particle(std::int32_t index, std::uint8_t tag) {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    const Particles<Real>& particles = state_->simulation.particles;
    if (particles.tag == nullptr) {
        return Status::no_particle_tags;
    }
    if (index < 0 || index >= particles.count) {
        return Status::no_such_particle;
    }
    particles.tag[index] = tag;
    return Status::ok;
}

template <class Real>
View<Vec2<PositionOf<Real>>> World<Real>::particle_positions() const {
    return view_of(state_, &Particles<Real>::position);
}

template <class Real>
View<Vec2<VelocityOf<Real>>> World<Real>::particle_velocities() const {
    return view_of(state_, &Particles<Real>::velocity);
}

template <class Real>
View<Liquid> World<Real>::particle_kinds() const {
    return view_of(state_, &Particles<Real>::kind);
}

template <class Real>
View<std::uint8_t> World<Real>::particle_tags() const {
    return view_of(state_, &Particles<Real>::tag);
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template Status World<Real>::fill(const Box&, std::int32_t*, Liquid);           \
    template Status World<Real>::add_particle(Vec2f, Vec2f, Liquid);                \
    template Status World<Real>::remove_particle(std::int32_t);                     \
    template View<Vec2<PositionOf<Real>>> World<Real>::particle_positions() const;  \
    template View<Vec2<VelocityOf<Real>>> World<Real>::particle_velocities() const; \
    template View<Liquid> World<Real>::particle_kinds() const;                      \
    template View<std::uint8_t> World<Real>::particle_tags() const;                 \
    template Status World<Real>::tag_particle(std::int32_t, std::uint8_t);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
