// The liquid in a world: particles added, removed and seen.
#include <type_traits>

#include "fluid/seeding.hpp"
#include "step/regions.hpp"
#include "step/substep.hpp"
#include "weir/world.hpp"
#include "world/sleep.hpp"
#include "world/world_state.hpp"

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

/// A side of the tank, with room for the caller's rounding of the same product.
float side_m(std::int32_t cells, float cell_m) {
    return static_cast<float>(cells) * cell_m * 1.000001F;
}

template <class Real>
Status check_particle(const WorldState<Real>& state, Vec2f position_m, Vec2f velocity_mps) {
    if (!is_finite(position_m) || !is_finite(velocity_mps)) {
        return Status::particle_not_finite;
    }
    const Capacity& capacity = state.def.capacity;
    const float cell_m = state.def.cell_m;
    if (!within(position_m.x, 0.0F, side_m(capacity.cells_x, cell_m)) ||
        !within(position_m.y, 0.0F, side_m(capacity.cells_y, cell_m))) {
        return Status::particle_outside_domain;
    }
    const float fastest = reach_of<Real>(state.unit_exponent).speed * cell_m;
    if (!within(velocity_mps.x, -fastest, fastest) || !within(velocity_mps.y, -fastest, fastest)) {
        return Status::velocity_out_of_range;
    }
    return state.simulation.particles.full() ? Status::no_free_particle : Status::ok;
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

template <class Real>
void add(Simulation<Real>& simulation, Vec2<Real> at, Vec2<Real> velocity, Liquid kind) {
    Particles<Real>& particles = simulation.particles;
    particles.add(at, velocity, kind);
    if (simulation.regions != nullptr) {
        simulation.regions->stages->touch_at(*simulation.regions,
                                             particles.position[particles.count - 1]);
    }
}

/// The last particle takes its place, or a sleeper's another one's of the sleepers.
template <class Real>
void take_out(Simulation<Real>& simulation, std::int32_t index) {
    if (simulation.regions != nullptr) {
        index = simulation.regions->stages->part_with(simulation, index);
    }
    simulation.particles.remove(index);
}

/// Whether a box of the caller's may be used now.
template <class Real>
Status check_box_in(const WorldState<Real>* state, const Box& box_m) {
    const Status free = ready(state);
    if (free != Status::ok) {
        return free;
    }
    const Capacity& capacity = state->def.capacity;
    const float cell_m = state->def.cell_m;
    return check_box(box_m, side_m(capacity.cells_x, cell_m), side_m(capacity.cells_y, cell_m));
}

/// A box in cells. What is on its lower sides belongs to it, so that boxes side by side share
/// nothing; on the tank's upper sides there is nobody.
template <class Real>
struct BoxInCells {
    Vec2<Real> low;
    Vec2<Real> high;

    BoxInCells(const WorldState<Real>& state, const Box& box_m)
        : low(in_cells(state, box_m.min_m)), high(in_cells(state, box_m.max_m)) {}

    bool holds(Vec2<PositionOf<Real>> place) const {
        const Vec2<Real> x{Real(place.x), Real(place.y)};
        return x.x >= low.x && x.x < high.x && x.y >= low.y && x.y < high.y;
    }

private:
    static Vec2<Real> in_cells(const WorldState<Real>& state, Vec2f metres) {
        return convert<Real>(state.cells_per_m * convert<Face<Real>>(metres));
    }
};

/// A sum over many numbers of one kind, exact in fixed point, in double else.
template <class Number>
class Mean {
public:
    void add(Number number) {
        if constexpr (std::is_floating_point<Number>::value) {
            sum_ += static_cast<double>(number);
        } else {
            sum_ += number.raw;
        }
    }
    float over(std::int32_t count) const {
        const float mean = static_cast<float>(sum_) / static_cast<float>(count);
        if constexpr (std::is_floating_point<Number>::value) {
            return mean;
        } else {
            return mean * static_cast<float>(Number::of_raw(1));
        }
    }

private:
    std::conditional_t<std::is_floating_point<Number>::value, double, std::int64_t> sum_{};
};

/// There are other particles now.
template <class Real>
void note_changed(WorldState<Real>& state) {
    state.density_stale = true;
    forget_rows(state.simulation.grid);
    wake(state);
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
    const BoxInCells<Real> box(*state_, box_m);
    const std::int32_t per_axis = lattice_per_axis(state_->def.particles_per_cell);
    const GridShape& shape = simulation.grid.shape;
    const Walls<Real>& walls = simulation.layers.walls;
    simulation.stages->draw_moved(simulation.layers, simulation.bodies);
    const auto each_seed = [&](auto visit) {
        for_each_seed(shape, box.low, box.high, per_axis, [&](Vec2<Real> at) {
            if (!walls.active || !simulation.stages->inside_solid(shape, walls, at)) {
                visit(at);
            }
        });
    };
    std::int32_t seeds = 0;
    each_seed([&](Vec2<Real>) { ++seeds; });
    if (seeds > particles.capacity - particles.count) {
        return Status::no_free_particle;
    }
    each_seed([&](Vec2<Real> at) { add(simulation, at, {}, kind); });
    note_changed(*state_);
    if (added != nullptr) {
        *added = seeds;
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
    const Vec2<Real> at =
        convert<Real>(state_->cells_per_m * convert<Face<Real>>(position_m));
    const Vec2<Real> inside = within_tank(simulation.grid.shape, at);
    const Walls<Real>& walls = simulation.layers.walls;
    simulation.stages->draw_moved(simulation.layers, simulation.bodies);
    if (walls.active &&
        simulation.stages->inside_solid(simulation.grid.shape, walls, inside)) {
        return Status::particle_inside_solid;
    }
    const Vec2<Real> velocity =
        convert<Real>(pace_of(*state_) * convert<Face<Real>>(velocity_mps));
    add(simulation, inside, velocity, kind);
    note_changed(*state_);
    simulation.max_speed = maximum(simulation.max_speed,
                                   maximum(absolute(velocity.x), absolute(velocity.y)));
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
Status World<Real>::drain(const Box& box_m, std::int32_t* removed) {
    const Status valid = check_box_in(state_, box_m);
    if (valid != Status::ok) {
        return valid;
    }
    Simulation<Real>& simulation = state_->simulation;
    const BoxInCells<Real> box(*state_, box_m);
    const std::int32_t before = simulation.particles.count;
    for (std::int32_t k = before - 1; k >= 0; --k) {  // who takes a place was looked at
        if (box.holds(simulation.particles.position[k])) {
            take_out(simulation, k);
        }
    }
    const std::int32_t gone = before - simulation.particles.count;
    if (gone > 0) {
        note_changed(*state_);
    }
    if (removed != nullptr) {
        *removed = gone;
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::liquid_in(const Box& box_m, LiquidIn* found) const {
    const Status valid = check_box_in(state_, box_m);
    if (valid != Status::ok) {
        return valid;
    }
    if (found == nullptr) {
        return Status::output_missing;
    }
    const Particles<Real>& particles = state_->simulation.particles;
    const BoxInCells<Real> box(*state_, box_m);
    Mean<PositionOf<Real>> x, y;
    Mean<VelocityOf<Real>> u, v;
    *found = {};
    for (std::int32_t k = 0; k < particles.count; ++k) {
        if (box.holds(particles.position[k])) {
            ++found->particles;
            x.add(particles.position[k].x);
            y.add(particles.position[k].y);
            u.add(particles.velocity[k].x);
            v.add(particles.velocity[k].y);
        }
    }
    if (found->particles > 0) {
        const std::int32_t n = found->particles;
        const float cell_m = state_->def.cell_m;
        const float mps = velocity_scale();
        found->area_m2 = static_cast<float>(n) * cell_m * cell_m /
                         static_cast<float>(state_->def.particles_per_cell);
        found->centroid_m = {x.over(n) * cell_m, y.over(n) * cell_m};
        found->velocity_mps = {u.over(n) * mps, v.over(n) * mps};
    }
    return Status::ok;
}

template <class Real>
View<Vec2<PositionOf<Real>>> World<Real>::particle_positions() const {
    if (state_ == nullptr) {
        return {};
    }
    const Particles<Real>& particles = state_->simulation.particles;
    const std::int32_t hidden = hidden_of(state_->simulation);
    return {particles.position - hidden, particles.count + hidden};
}

template <class Real>
View<Vec2<VelocityOf<Real>>> World<Real>::particle_velocities() const {
    if (state_ == nullptr) {
        return {};
    }
    const Particles<Real>& particles = state_->simulation.particles;
    const std::int32_t hidden = hidden_of(state_->simulation);
    return {particles.velocity - hidden, particles.count + hidden};
}

template <class Real>
View<Liquid> World<Real>::particle_kinds() const {
    if (state_ == nullptr || state_->simulation.particles.kind == nullptr) {
        return {};
    }
    const Particles<Real>& particles = state_->simulation.particles;
    const std::int32_t hidden = hidden_of(state_->simulation);
    return {particles.kind - hidden, particles.count + hidden};
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template Status World<Real>::fill(const Box&, std::int32_t*, Liquid);           \
    template Status World<Real>::add_particle(Vec2f, Vec2f, Liquid);                \
    template Status World<Real>::remove_particle(std::int32_t);                     \
    template Status World<Real>::drain(const Box&, std::int32_t*);                  \
    template Status World<Real>::liquid_in(const Box&, LiquidIn*) const;            \
    template View<Vec2<PositionOf<Real>>> World<Real>::particle_positions() const;  \
    template View<Vec2<VelocityOf<Real>>> World<Real>::particle_velocities() const; \
    template View<Liquid> World<Real>::particle_kinds() const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
