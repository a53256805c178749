// Who must not fall asleep in a region: what flies from tile to tile between two looks, and what is
// on its way out of a solid, also of a world that was restored.
#include <gtest/gtest.h>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kDt = 1.0F / 60.0F;

WorldDef def_of(std::int32_t cells_x) {
    WorldDef def = tank_def(cells_x, 16, 400, 1, 4);
    def.capacity.sleeping_regions = true;
    def.cell_m = kCell;
    def.sleep = {0.02F, 0.1F, 0.0F};
    return def;
}

/// A particle in four is looked at in a substep. Two cells in each take it from one tile to the
/// next but one meanwhile, away from the mark that it left.
TEST(FastSleeper, WhatFliesFromTileToTileStaysAwake) {
    WorldDef def = def_of(400);
    def.gravity_mps2 = {};
    def.cfl = 2.0F;
    def.max_substeps = 1;
    for (int wait = 0; wait < 8; ++wait) {
        TestWorld<float> world(def);
        expect_ok(world->let_regions_sleep());
        for (int k = 0; k < wait; ++k) {
            world->step(kDt);
        }
        const float speed = 1.9F * kCell / kDt;
        expect_ok(world->add_particle({kCell, 8 * kCell}, {speed, 0.0F}));
        for (int k = 0; k < 150; ++k) {
            ASSERT_EQ(world->step(kDt).particles_asleep, 0) << wait << " " << k;
        }
        EXPECT_GT(world->particle_positions()[0].x, 200.0F);
    }
}

/// That somebody was on the way out of a solid is kept until it is next asked who sleeps.
TEST(FastSleeper, WhoWasOnTheWayOutIsKnownAfterARestore) {
    const WorldDef def = def_of(16);
    TestWorld<float> world(def);
    TestWorld<float> other(def);
    expect_ok(world->let_regions_sleep());
    expect_ok(other->let_regions_sleep());
    expect_ok(world->fill({{0.0F, 0.0F}, {16 * kCell, 6 * kCell}}));
    world->step(kDt);
    put_static(*world, body_of(rectangle(10 * kCell, 10 * kCell), {8 * kCell, 5 * kCell}));
    std::int32_t stuck = 0;
    for (int k = 0; k < 12; ++k) {
        stuck += world->step(kDt).particles_stuck;
        const std::vector<std::byte> bytes = saved(*world, def.capacity);
        expect_ok(other->restore(bytes.data(), bytes.size()));
        ASSERT_EQ(other->state_hash(), world->state_hash()) << k;
    }
    EXPECT_GT(stuck, 0);
}

}  // namespace
}  // namespace weir
