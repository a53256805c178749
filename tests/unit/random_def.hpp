// Definitions at random: those of busy worlds with what these lack, and any that a world may have.
#pragma once

#include <algorithm>
#include <cmath>

#include "busy_world.hpp"

namespace weir {

/// A definition, and what calls of a world of it are about.
struct RandomDef {
    WorldDef def;
    float speed_mps = 1.0F;
    float gravity_mps2 = 15.0F;

    Vec2f tank_m() const {
        return {static_cast<float>(def.capacity.cells_x) * def.cell_m,
                static_cast<float>(def.capacity.cells_y) * def.cell_m};
    }
};

/// As many of each order of magnitude.
inline float any_size(Dice& dice, float low, float high) {
    return std::exp(dice.uniform(std::log(low), std::log(high)));
}

/// What busy worlds do not have: forces and free bodies, regions that sleep, a window.
template <class Real>
RandomDef busy_random_def(Dice& dice) {
    constexpr bool kSmall = std::is_same_v<Real, SmallFixed>;
    RandomDef random;
    WorldDef& def = random.def;
    do {
        def = busy_def(dice.below(kBusyKinds));
    } while (kSmall && (def.surface_tension_m3ps2 > 0.0F || def.capacity.second_liquid ||
                        def.capacity.wall_edges > 0));
    Capacity& room = def.capacity;
    room.particle_tags = dice.chance(0.5F);
    const std::int32_t kind = room.bodies > 0 && room.wall_edges == 0 ? dice.below(4) : 0;
    room.two_way = kind == 1;
    if (kind == 2) {
        room.cells_x = 40;
        room.sleeping_regions = true;
        def.sleep = {0.1F, 0.2F, 0.5F};
    } else if (kind == 3 && !kSmall) {
        room.cells_x = 90;
        room.cells_y = 60;
        room.window_cells = 66 * 26;
    }
    def.keep_sorted = dice.chance(0.3F);
    def.max_substeps = 1 + dice.below(6);
    return random;
}

/// From the smallest tanks on; some are long or high.
inline std::int32_t any_cells(Dice& dice) {
    constexpr std::int32_t kMost[] = {4, 8, 32, 32, 64, 200};
    return dice.integer(kMinCells, dice.one_of(kMost));
}

inline Surface any_surface(Dice& dice, float speed_mps) {
    const Surface surface{dice.uniform(0.0F, 1.0F), any_size(dice, 1.0e-2F, 1.0e3F),
                          dice.chance(0.5F), dice.uniform(-speed_mps, speed_mps)};
    return dice.chance(0.5F) ? surface : Surface{};
}

/// What it has room for. Some of it goes with nothing else.
template <class Real>
Capacity any_capacity(Dice& dice) {
    constexpr bool kSmall = std::is_same_v<Real, SmallFixed>;
    Capacity room;
    do {
        room.cells_x = any_cells(dice);
        room.cells_y = any_cells(dice);
    } while (room.cells_x * room.cells_y > 3000);
    room.particles = static_cast<std::int32_t>(any_size(dice, 1.0F, 1500.0F));
    room.bodies = dice.chance(0.6F) ? dice.integer(1, dice.chance(0.2F) ? 40 : 8) : 0;
    room.vertices = dice.chance(0.8F) ? 8 * room.bodies : dice.below(20);
    room.moving_bodies = dice.chance(0.8F);
    room.wall_edges = !kSmall && dice.chance(0.2F) ? dice.integer(1, 2000) : 0;
    room.contacts = dice.chance(0.5F) ? dice.below(20) : 0;
    room.two_way = dice.chance(0.35F);
    room.second_liquid = !kSmall && dice.chance(0.25F);
    room.particle_tags = dice.chance(0.3F);
    room.sleeping_regions = dice.chance(0.1F);
    if (!kSmall && dice.chance(0.1F)) {
        room.cells_x = dice.integer(70, 200);
        room.cells_y = dice.integer(24, 60);
        room.window_cells = 68 * 28 + dice.below(1000);
    }
    return room;
}

/// How the liquid is computed, from one end of what is allowed to the other.
template <class Real>
void choose_numerics(Dice& dice, WorldDef& def) {
    constexpr std::int32_t kAtRest[] = {1, 4, 4, 9, 16};
    const float c = def.cell_m;
    def.particles_per_cell = dice.one_of(kAtRest);
    def.pressure_sweeps = dice.integer(1, dice.chance(0.05F) ? 200 : 12);
    def.max_substeps = dice.integer(1, dice.chance(0.05F) ? 100 : 6);
    def.cfl = dice.uniform(0.1F, 2.0F);
    def.flip_ratio = dice.one_of({0.0F, 0.97F, 1.0F, dice.uniform(0.0F, 1.0F)});
    def.volume_gain = dice.one_of({0.0F, 0.15F, 1.0F, dice.uniform(0.0F, 1.0F)});
    def.contour = dice.chance(0.2F) ? Contour::mid_edge : Contour::interpolated;
    if (dice.chance(0.25F)) {
        def.pressure = Pressure::equation_of_state;
        def.sound_speed_mps = dice.chance(0.5F) ? c * any_size(dice, 1.0e-3F, 1.0e5F) : 0.0F;
    } else if (dice.chance(0.3F) && !std::is_same_v<Real, SmallFixed>) {
        def.surface_tension_m3ps2 = c * c * c * any_size(dice, 1.0e-6F, 2.9e4F);
    }
    def.viscosity_m2ps = dice.chance(0.3F) ? c * c * any_size(dice, 1.0e-6F, 9.9e5F) : 0.0F;
    def.second_density_ratio = any_size(dice, 0.011F, 99.0F);
    def.keep_sorted = dice.chance(0.3F);
}

/// Any of which `init` takes most.
template <class Real>
RandomDef any_def(Dice& dice) {
    RandomDef random;
    WorldDef& def = random.def;
    def.capacity = any_capacity<Real>(dice);
    Capacity& room = def.capacity;
    const float c = dice.chance(0.3F) ? 0.02F : any_size(dice, 1.1e-6F, 9.0e2F);
    def.cell_m = c;
    const float pull = dice.chance(0.1F) ? kMaxGravity : any_size(dice, 1e-3F, 9e2F);
    random.gravity_mps2 = std::min(dice.chance(0.5F) ? 9.81F : pull,
                                   2.9e4F * c);  // what fixed point bears
    def.gravity_mps2 = {dice.one_of({0.0F, 0.5F, -0.3F}) * random.gravity_mps2,
                        dice.one_of({0.0F, -1.0F, -1.0F, 0.4F}) * random.gravity_mps2};
    const float fall = std::sqrt(2.0F * random.gravity_mps2 * random.tank_m().y) / c;
    const float fastest = std::is_same_v<Real, SmallFixed> ? 250.0F : 15000.0F;
    random.speed_mps = c * std::clamp(fall, 1.0F, fastest);
    if (dice.chance(0.4F)) {
        def.top_speed_mps = random.speed_mps * dice.uniform(0.3F, 1.2F);
    }
    choose_numerics<Real>(dice, def);
    const float belt = 0.3F * random.speed_mps;
    def.walls = {any_surface(dice, belt), any_surface(dice, belt), any_surface(dice, belt),
                 any_surface(dice, belt)};
    if (dice.chance(0.3F) || room.sleeping_regions) {
        def.sleep = {random.speed_mps * any_size(dice, 1e-3F, 1.0F), dice.uniform(0.1F, 1.0F),
                     dice.uniform(0.0F, 1.0F)};
    }
    if (room.bodies == 0) {
        def.periodic_x = dice.chance(0.4F);
        def.periodic_y = dice.chance(0.4F);
        room.cells_x += def.periodic_x ? room.cells_x % 2 : 0;
        room.cells_y += def.periodic_y ? room.cells_y % 2 : 0;
        if (room.window_cells > 0) {  // of an axis with a seam all of it is stored
            const std::int32_t columns = def.periodic_x ? room.cells_x + 2 : 68;
            const std::int32_t rows = def.periodic_y ? room.cells_y + 2 : 28;
            room.window_cells = std::max(room.window_cells, columns * rows);
        }
    }
    return random;
}

}  // namespace weir
