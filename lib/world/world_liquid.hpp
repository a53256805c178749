// What calls that look at the liquid share: places, velocities and boxes of the caller's.
#pragma once

#include "step/regions.hpp"
#include "step/substep.hpp"
#include "world/sleep.hpp"
#include "world/validate.hpp"
#include "world/world_state.hpp"

namespace weir {

/// A side of the tank, with room for the caller's rounding of the same product.
inline float side_m(std::int32_t cells, float cell_m) {
    return static_cast<float>(cells) * cell_m * 1.000001F;
}

/// The upper right corner of the tank.
template <class Real>
Vec2f far_corner(const detail::WorldState<Real>& state) {
    const Capacity& capacity = state.def.capacity;
    return {side_m(capacity.cells_x, state.def.cell_m), side_m(capacity.cells_y, state.def.cell_m)};
}

template <class Real>
bool in_tank(const detail::WorldState<Real>& state, Vec2f place_m) {
    const Vec2f far = far_corner(state);
    return within(place_m.x, 0.0F, far.x) && within(place_m.y, 0.0F, far.y);
}

/// No particle of a tank of this arithmetic may be faster, along either axis.
template <class Real>
bool in_range(const detail::WorldState<Real>& state, Vec2f velocity_mps) {
    const float fastest = reach_of<Real>(state.unit_exponent).speed * state.def.cell_m;
    return within(velocity_mps, fastest);
}

template <class Real>
Vec2<Real> inner_velocity(const detail::WorldState<Real>& state, Vec2f velocity_mps) {
    return convert<Real>(pace_of(state) * convert<Face<Real>>(velocity_mps));
}

/// Steps have to be short enough for that, too.
template <class Real>
void note_speed(Simulation<Real>& simulation, Vec2<Real> velocity) {
    simulation.max_speed = maximum(simulation.max_speed,
                                   larger_part(velocity));
}

/// Whether a box of the caller's may be used now.
template <class Real>
Status check_box_in(const detail::WorldState<Real>* state, const Box& box_m) {
    const Status free = ready(state);
    return free != Status::ok ? free : check_box(box_m);
}

template <class Real>
Vec2<Real> in_cells(const detail::WorldState<Real>& state, Vec2f place_m) {
    return convert<Real>(state.cells_per_m * convert<Face<Real>>(place_m));
}

/// A box in cells. What is on its lower sides belongs to it, so that boxes side by side share
/// nothing; on the tank's upper sides there is nobody.
template <class Real>
struct BoxInCells {
    Vec2<Real> low;
    Vec2<Real> high;

    BoxInCells(const detail::WorldState<Real>& state, const Box& box_m)
        : low(cut(state, box_m.min_m)), high(cut(state, box_m.max_m)) {}

    bool holds(Vec2<PositionOf<Real>> place) const {
        const Vec2<Real> x{Real(place.x), Real(place.y)};
        return x.x >= low.x && x.x < high.x && x.y >= low.y && x.y < high.y;
    }

private:
    static Vec2<Real> cut(const detail::WorldState<Real>& state, Vec2f corner_m) {
        const Vec2f far = far_corner(state);
        return in_cells(state, {clamp(corner_m.x, 0.0F, far.x), clamp(corner_m.y, 0.0F, far.y)});
    }
};

/// The last particle takes its place, or a sleeper's another one's of the sleepers.
template <class Real>
void take_out(Simulation<Real>& simulation, std::int32_t index) {
    if (simulation.regions != nullptr) {
        index = simulation.regions->stages->part_with(simulation, index);
    }
    simulation.particles.remove(index);
}

/// There are other particles now.
template <class Real>
void note_changed(detail::WorldState<Real>& state) {
    state.density_stale = true;
    forget_rows(state.simulation.grid);
    wake(state);
}

}  // namespace weir
