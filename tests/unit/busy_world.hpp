// A world to which everything happens: bodies come, move and go, liquid is added and taken away,
// gravity turns. The same seed does the same to any world of the same definition.
#pragma once

#include <type_traits>

#include "measure/random.hpp"
#include "test_world.hpp"

namespace weir {

using Dice = measure::Random;

inline constexpr std::int32_t kBusyKinds = 10;

/// One definition for each way in which worlds differ, 0 … kBusyKinds − 1.
inline WorldDef busy_def(std::int32_t kind) {
    WorldDef def = tank_def(18, 14, 400, 5, 32);
    def.capacity.contacts = 2;
    switch (kind) {
        case 1: def.contour = Contour::mid_edge; break;
        case 2:
            def.pressure = Pressure::equation_of_state;
            def.sound_speed_mps = 3.0F;
            def.walls.top.restitution = 0.5F;
            break;
        case 3:
            def.capacity.second_liquid = true;
            def.second_density_ratio = 3.0F;
            break;
        case 4:
            def.viscosity_m2ps = 2.0e-3F;
            def.walls = every_wall({0.0F, 0.3F, true, 0.2F});
            break;
        case 5:
            def.capacity.bodies = 0;
            def.capacity.vertices = 0;
            def.capacity.contacts = 0;
            def.periodic_x = true;
            def.surface_tension_m3ps2 = 2.0e-4F;
            break;
        case 6:
            def.surface_tension_m3ps2 = 2.0e-4F;
            def.flip_ratio = 0.9F;
            break;
        case 7:
            def.capacity.bodies = 0;
            def.capacity.vertices = 0;
            def.capacity.contacts = 0;
            def.periodic_y = true;
            def.periodic_x = true;
            def.volume_gain = 0.0F;
            break;
        case 8: def.capacity.wall_edges = 500; break;
        case 9: def.gravity_mps2 = {}; break;
        default: break;
    }
    return def;
}

/// Packed fixed point knows neither surface tension nor a second liquid nor thin walls.
template <class Real>
bool busy_kind_is_borne(std::int32_t kind) {
    const WorldDef def = busy_def(kind);
    return !std::is_same_v<Real, SmallFixed> ||
           (def.surface_tension_m3ps2 == 0.0F && !def.capacity.second_liquid &&
            def.capacity.wall_edges == 0);
}

/// A `WorldDef::parallel_for` that does the last piece first.
inline void backwards(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
    for (std::int32_t k = count; k-- > 0;) {
        task(context, k);
    }
}

/// Corners on grid lines: bodies share edges, and nodes are as far from one as from the other.
inline Ring busy_ring(Dice& dice) {
    constexpr float c = 0.02F;
    switch (dice.below(4)) {
        case 0: return {{0, 0}, {3 * c, 0}, {3 * c, 2 * c}, {0, 2 * c}};
        case 1: return {{0, 0}, {4 * c, 0}, {0, 3 * c}};
        case 2: return {{0, 0}, {4 * c, 0}, {4 * c, c}, {c, c}, {c, 4 * c}, {0, 4 * c}};
        default: return {{-c, -1.5F * c}, {2 * c, -c}, {2.3F * c, c}, {0, 1.7F * c}};
    }
}

template <class Real>
void put_body(World<Real>& world, Dice& dice) {
    const Ring ring = busy_ring(dice);
    const Vec2f at{0.02F * static_cast<float>(dice.below(16)),
                   0.02F * static_cast<float>(dice.below(12))};
    BodyDef def = body_of(ring, at);
    const Ring hole = {{0.01F, 0.01F}, {0.03F, 0.01F}, {0.01F, 0.03F}};
    const View<Vec2f> holes[] = {{hole.data(), 3}};
    if (ring[1].y == 0.0F && ring.size() < 5) {
        def.holes = {holes, dice.below(2)};
    }
    def.open = ring.size() == 6 && dice.below(2) == 0;
    def.surface = {dice.uniform(0.0F, 1.0F), dice.uniform(0.0F, 0.5F), dice.below(2) == 0,
                   dice.uniform(-0.2F, 0.2F)};
    BodyId id;
    Status added = Status::ok;
    if (dice.below(2) == 0) {
        added = world.add_static_body(def, &id);
    } else {
        def.motion.angle_rad = dice.below(2) == 0 ? 0.0F : dice.uniform(-3.0F, 3.0F);
        def.motion.velocity_mps = {dice.uniform(-0.5F, 0.5F), dice.uniform(-0.5F, 0.5F)};
        def.motion.spin_radps = dice.below(2) == 0 ? 0.0F : dice.uniform(-5.0F, 5.0F);
        added = world.add_moving_body(def, &id);
    }
    EXPECT_TRUE(added == Status::ok || added == Status::no_free_body ||
                added == Status::no_free_vertex || added == Status::no_free_wall_edge ||
                added == Status::small_fixed_has_no_thin_walls ||
                added == Status::polygon_outside_domain)
        << status_text(added);
}

template <class Real>
void move_body(World<Real>& world, Dice& dice, std::int32_t slot) {
    BodyId id;
    Motion motion;
    const Vec2f way{dice.uniform(-0.04F, 0.04F), dice.uniform(-0.04F, 0.04F)};
    const float spin = dice.uniform(-5.0F, 5.0F);
    if (world.body_in_slot(slot, &id) != Status::ok || world.motion(id, &motion) != Status::ok) {
        return;
    }
    motion.position_m = {motion.position_m.x + way.x, motion.position_m.y + way.y};
    motion.spin_radps = spin;
    const Status moved = world.set_motion(id, motion);
    // A body may have flown away by itself, further than a call may put it.
    EXPECT_TRUE(moved == Status::ok || moved == Status::body_is_static ||
                moved == Status::position_out_of_range || moved == Status::motion_out_of_range)
        << status_text(moved);
}

/// One thing happens, or none.
template <class Real>
void disturb(World<Real>& world, Dice& dice) {
    const std::int32_t what = dice.below(12);
    const std::int32_t slot = dice.below(5);
    BodyId id;
    switch (what) {
        case 0:
        case 1: put_body(world, dice); break;
        case 2: move_body(world, dice, slot); break;
        case 3:
            if (world.body_in_slot(slot, &id) == Status::ok) {
                EXPECT_EQ(world.remove_body(id), Status::ok);
            }
            break;
        case 4:
            EXPECT_EQ(world.set_gravity({dice.uniform(-20, 20), dice.uniform(-20, 20)}),
                      Status::ok);
            break;
        case 5: {
            const Vec2f low{dice.uniform(0.0F, 0.2F), dice.uniform(0.0F, 0.2F)};
            const Liquid kind =
                world.particle_kinds().data != nullptr && dice.below(2) == 0 ? Liquid::second
                                                                             : Liquid::first;
            static_cast<void>(world.fill({low, {low.x + 0.05F, low.y + 0.05F}}, nullptr, kind));
            break;
        }
        case 6:
            static_cast<void>(world.add_particle({dice.uniform(0.0F, 0.36F), 0.1F}, {1.0F, 0.5F}));
            break;
        case 7: static_cast<void>(world.remove_particle(dice.below(400))); break;
        case 8: {
            const Vec2f low{dice.uniform(-0.1F, 0.3F), dice.uniform(-0.1F, 0.2F)};
            const float speed = dice.below(2) == 0 ? 0.0F : dice.uniform(-1.0F, 1.0F);
            EXPECT_EQ(world.stir({low, {low.x + 0.2F, low.y + 0.1F}}, {speed, -speed},
                                 dice.uniform(0.0F, 1.0F)),
                      Status::ok);
            break;
        }
        case 9: EXPECT_EQ(world.set_gravity({}), Status::ok); break;
        default: break;
    }
}

/// Disturbs and steps a world so many times.
template <class Real>
void live(World<Real>& world, Dice& dice, std::int32_t steps) {
    for (std::int32_t step = 0; step < steps; ++step) {
        disturb(world, dice);
        world.step(dice.uniform(0.002F, 0.03F));
    }
}

}  // namespace weir
