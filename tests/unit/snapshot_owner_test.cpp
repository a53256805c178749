// Whose snapshot it is: whatever a definition or a capacity says tells worlds apart, but for what no
// state follows from.
#include "test_world.hpp"

namespace weir {
namespace {

WorldDef sleepy_def() {
    WorldDef def = small_def();
    def.sleep = {0.02F, 0.5F, 0.1F};
    def.capacity.cells_x = 80;
    def.capacity.cells_y = 40;
    return def;
}

using Change = void (*)(WorldDef&);

/// What a world says to the snapshot of another one, whose definition was changed.
Status restored_of_changed(Change change) {
    WorldDef def = sleepy_def();
    TestWorld<float> world(def);
    change(def);
    TestWorld<float> other(def);
    expect_ok(other->fill({{0.0F, 0.0F}, {0.06F, 0.06F}}));
    const std::vector<std::byte> bytes = saved(*other, def.capacity);
    return world->restore(bytes.data(), bytes.size());
}

template <std::size_t Count>
void expect_each(const Change (&changes)[Count], Status status) {
    for (std::size_t row = 0; row < Count; ++row) {
        EXPECT_EQ(restored_of_changed(changes[row]), status) << row;
    }
}

TEST(SnapshotOwner, EveryNumberOfADefinitionTells) {
    const Change changes[] = {
        [](WorldDef& d) { d.cell_m = 0.021F; },
        [](WorldDef& d) { d.gravity_mps2.x = 0.1F; },
        [](WorldDef& d) { d.gravity_mps2.y = -9.8F; },
        [](WorldDef& d) { d.top_speed_mps = 3.0F; },
        [](WorldDef& d) { d.particles_per_cell = 9; },
        [](WorldDef& d) { d.pressure = Pressure::equation_of_state; },
        [](WorldDef& d) { d.contour = Contour::mid_edge; },
        [](WorldDef& d) { ++d.pressure_sweeps; },
        [](WorldDef& d) { d.cfl = 0.9F; },
        [](WorldDef& d) { ++d.max_substeps; },
        [](WorldDef& d) { d.flip_ratio = 0.9F; },
        [](WorldDef& d) { d.volume_gain = 0.1F; },
        [](WorldDef& d) { d.sound_speed_mps = 5.0F; },
        [](WorldDef& d) { d.viscosity_m2ps = 1.0e-3F; },
        [](WorldDef& d) { d.surface_tension_m3ps2 = 1.0e-4F; },
        [](WorldDef& d) { d.second_density_ratio = 2.0F; },
        [](WorldDef& d) { d.walls.bottom.restitution = 0.1F; },
        [](WorldDef& d) { d.walls.right.friction = 0.1F; },
        [](WorldDef& d) { d.walls.top.no_slip = true; },
        [](WorldDef& d) { d.walls.left.conveyor_mps = 0.1F; },
        [](WorldDef& d) { d.sleep.speed_mps = 0.03F; },
        [](WorldDef& d) { d.sleep.after_s = 0.6F; },
        [](WorldDef& d) { d.sleep.gravity_mps2 = 0.2F; },
        [](WorldDef& d) { d.keep_sorted = true; },
    };
    expect_each(changes, Status::snapshot_of_other_definition);
}

TEST(SnapshotOwner, EveryNumberOfACapacityTells) {
    const Change changes[] = {
        [](WorldDef& d) { ++d.capacity.particles; },
        [](WorldDef& d) { ++d.capacity.cells_x; },
        [](WorldDef& d) { ++d.capacity.cells_y; },
        [](WorldDef& d) { ++d.capacity.bodies; },
        [](WorldDef& d) { d.capacity.moving_bodies = false; },
        [](WorldDef& d) { ++d.capacity.vertices; },
        [](WorldDef& d) { d.capacity.wall_edges = 10; },
        [](WorldDef& d) { d.capacity.contacts = 1; },
        [](WorldDef& d) { d.capacity.two_way = true; },
        [](WorldDef& d) { d.capacity.second_liquid = true; },
        [](WorldDef& d) { d.capacity.particle_tags = true; },
        [](WorldDef& d) { d.capacity.sleeping_regions = true; },
        [](WorldDef& d) { d.capacity.window_cells = 66 * 26; },
    };
    expect_each(changes, Status::snapshot_of_other_capacity);
}

/// Who counts and who shares out work; and a window that is no smaller than the tank.
TEST(SnapshotOwner, WhatIsNoStateDoesNotTell) {
    const Change changes[] = {
        [](WorldDef&) {},
        [](WorldDef& d) { d.ticks = [] { return std::uint64_t{1}; }; },
        [](WorldDef& d) {
            d.parallel_for = [](void (*task)(void*, std::int32_t), void* context,
                                std::int32_t count) {
                for (std::int32_t k = 0; k < count; ++k) {
                    task(context, k);
                }
            };
        },
        [](WorldDef& d) { d.capacity.window_cells = 82 * 42; },
    };
    expect_each(changes, Status::ok);
}

}  // namespace
}  // namespace weir
