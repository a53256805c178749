// Regions, by single particles in tiles: who belongs together, who wakes whom, and who must not
// fall asleep: what flies from tile to tile between two looks, and what is on its way out of a
// solid, also of a world that was restored.
#include <gtest/gtest.h>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kDt = 1.0F / 60.0F;

/// Without gravity: particles stay where they are put.
WorldDef tiles_def(std::int32_t columns, std::int32_t rows) {
    WorldDef def = tank_def(columns, rows, 400, 3, 12);
    def.capacity.sleeping_regions = true;
    def.sleep = {0.02F, 0.1F, 0.0F};
    def.gravity_mps2 = {};
    return def;
}

template <class Real>
struct Tiles {
    TestWorld<Real> world;

    Tiles() : world(tiles_def(64, 24)) { expect_ok(world->let_regions_sleep()); }
    World<Real>* operator->() { return &*world; }
    void put(float column, float row, Vec2f velocity_mps = {}) {
        expect_ok(world->add_particle({column * kCell, row * kCell}, velocity_mps));
    }
    /// All sleep but for one in a corner, which keeps the world from it.
    void rest() {
        const std::int32_t count = world->particle_positions().size;
        put(62, 1, {-0.05F, 0.0F});
        EXPECT_EQ(asleep_after(20), count);
    }
    static BodyDef square() { return body_of(kSquare4cm, {20 * kCell, 12 * kCell}); }
    /// One beside it and one far from it.
    void rest_beside_square() {
        put(17.5F, 12.5F);
        put(2, 2);
        rest();
    }
    std::int32_t asleep_after(int steps) {
        StepReport report;
        for (int step = 0; step < steps; ++step) {
            report = world->step(kDt);
        }
        return report.particles_asleep;
    }
};

WEIR_SUITE(SleepingTiles, EveryScalar);

/// However far a chain of neighbours reaches; and nobody else.
TYPED_TEST(SleepingTiles, WakeAsOneWithTheirNeighbours) {
    Tiles<TypeParam> tiles;
    tiles.put(2, 2);
    for (int column = 1; column <= 40; ++column) {
        tiles.put(static_cast<float>(column) + 0.5F, 14.5F);
    }
    tiles.rest();
    tiles.put(42.5F, 14.5F, {0.1F, 0.0F});
    EXPECT_EQ(tiles.asleep_after(2), 1) << "the lone one below";
}

/// What stood beside them may have held them.
TYPED_TEST(SleepingTiles, WakeWhenABodyIsTakenAway) {
    Tiles<TypeParam> tiles;
    const BodyId id = put_moving(*tiles.world, tiles.square());
    tiles.rest_beside_square();
    Motion motion;
    expect_ok(tiles->motion(id, &motion));
    motion.position_m = {40 * kCell, 12 * kCell};
    expect_ok(tiles->set_motion(id, motion));
    EXPECT_EQ(tiles.asleep_after(2), 1) << "the one far from it";
}

/// It may be a belt that carries them.
TYPED_TEST(SleepingTiles, WakeWhenASurfaceChanges) {
    Tiles<TypeParam> tiles;
    const BodyId id = put_static(*tiles.world, tiles.square());
    tiles.rest_beside_square();
    expect_ok(tiles->set_surface(id, {0.0F, 0.5F, false, 0.1F}));
    EXPECT_EQ(tiles.asleep_after(2), 1) << "the one far from it";
}

/// A particle in four is looked at in a substep. Two cells in each take it from one tile to the
/// next but one meanwhile, away from the mark that it left.
TEST(FastSleeper, WhatFliesFromTileToTileStaysAwake) {
    WorldDef def = tiles_def(400, 16);
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
    WorldDef def = tiles_def(16, 16);
    def.gravity_mps2 = WorldDef{}.gravity_mps2;
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
