// Regions, by single particles in tiles: who belongs together, who wakes whom, and who must not
// fall asleep: what flies from tile to tile between two looks, and what is on its way out of a
// solid, also of a world that was restored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "step/regions.hpp"
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

    explicit Tiles(const WorldDef& def = tiles_def(64, 24)) : world(def) {
        expect_ok(world->let_regions_sleep());
    }
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

/// In a world's first substep there was no pressure yet: they wake with none, which is a number.
TYPED_TEST(SleepingTiles, FromTheFirstSubstepOn) {
    TestWorld<TypeParam> world(tiles_def(64, 24));
    expect_ok(world->add_particle({12.5F * kCell, 12.5F * kCell}, {}));
    expect_ok(world->add_particle({40.5F * kCell, 12.5F * kCell}, {}));
    expect_ok(world->let_regions_sleep());
    EXPECT_EQ(world->step(0.1F).particles_asleep, 2);
    expect_ok(world->add_particle({12.75F * kCell, 12.5F * kCell}, {0.5F, 0.0F}));
    world->step(kDt);
    EXPECT_EQ(world->step(kDt).particles_asleep, 1);
    const auto pressure = world->pressure();
    for (std::int32_t j = 0; j < pressure.rows; ++j) {
        for (std::int32_t i = 0; i < pressure.columns; ++i) {
            const auto here = static_cast<double>(pressure.at(i, j));
            ASSERT_TRUE(here >= -1.0 && here <= 1.0) << i << " " << j << ": " << here;
        }
    }
}

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

/// So may what goes further within one substep than anybody looks around it, led or set going: who
/// lay beside it wakes, and who lies where it comes to.
TYPED_TEST(SleepingTiles, WakeAtBothEndsOfABodysLongWay) {
    constexpr float kLong = 0.1F;
    for (const bool led : {false, true}) {
        WorldDef def = tiles_def(64, 24);
        def.max_substeps = 1;
        Tiles<TypeParam> tiles(def);
        const BodyId id = put_moving(*tiles.world, tiles.square());
        tiles.put(41, 12.5F);
        tiles.rest_beside_square();
        Motion motion = motion_of(*tiles.world, id);
        const Vec2f there{38 * kCell, 12 * kCell};
        if (led) {
            expect_ok(tiles->move_body(id, there, 0.0F, kLong));
        } else {
            motion.velocity_mps = {(there.x - motion.position_m.x) / kLong, 0.0F};
            expect_ok(tiles->set_motion(id, motion));
        }
        tiles->step(kLong);
        EXPECT_NEAR(motion_of(*tiles.world, id).position_m.x, there.x, 0.1F * kCell);
        motion = motion_of(*tiles.world, id);
        motion.velocity_mps = {};
        expect_ok(tiles->set_motion(id, motion));
        EXPECT_EQ(tiles.asleep_after(1), 1) << led << ", the one far from it";
    }
}

/// It may be a belt that carries them.
TYPED_TEST(SleepingTiles, WakeWhenASurfaceChanges) {
    Tiles<TypeParam> tiles;
    const BodyId id = put_static(*tiles.world, tiles.square());
    tiles.rest_beside_square();
    expect_ok(tiles->set_surface(id, {0.0F, 0.5F, false, 0.1F}));
    EXPECT_EQ(tiles.asleep_after(2), 1) << "the one far from it";
}

/// And stay awake for as long as it took them to fall asleep, whenever it is next asked who sleeps.
TYPED_TEST(SleepingTiles, OnceWokenStayAwakeForAWhile) {
    for (int wait = 0; wait < 8; ++wait) {
        Tiles<TypeParam> tiles;
        tiles.put(17.5F, 12.5F);
        tiles.rest();
        tiles.asleep_after(wait);
        tiles.put(17.6F, 12.6F);
        for (int k = 0; k < 6; ++k) {
            EXPECT_EQ(tiles.asleep_after(1), 0) << wait << " " << k;
        }
        EXPECT_EQ(tiles.asleep_after(12), 2) << "and sleep again";
    }
}

/// A number is free again when those who had it woke: however often that was, it is theirs alone.
TYPED_TEST(SleepingTiles, SleepApartHoweverOftenTheyWoke) {
    Tiles<TypeParam> tiles;
    BodyId id[2];
    for (int k = 0; k < 2; ++k) {
        const float column = 12.0F + 20.0F * static_cast<float>(k);
        id[k] = put_static(*tiles.world, body_of(kSquare4cm, {column * kCell, 12 * kCell}));
        tiles.put(column - 2.5F, 12.5F);
    }
    BodyDef spinner = body_of(kSquare4cm, {56 * kCell, 12 * kCell});
    spinner.motion.spin_radps = 1.0F;  // keeps the world as a whole awake
    put_moving(*tiles.world, spinner);
    for (int k = 0; k < 130; ++k) {
        expect_ok(tiles->set_surface(id[0], {0.0F, 0.5F, false, 0.1F}));
        expect_ok(tiles->set_surface(id[1], {0.0F, 0.5F, false, 0.1F}));
        ASSERT_EQ(tiles.asleep_after(14), 2) << k;
    }
    expect_ok(tiles->set_surface(id[0], {0.0F, 0.5F, false, 0.1F}));
    EXPECT_EQ(tiles.asleep_after(2), 1);
}

/// What is on its way out of a solid moves with no velocity of its own: nobody sleeps meanwhile.
TYPED_TEST(SleepingTiles, NotWhileAnybodyIsOnTheWayOut) {
    TestWorld<TypeParam> world(tiles_def(64, 64));
    expect_ok(world->let_regions_sleep());
    expect_ok(world->add_particle({32.5F * kCell, 32 * kCell}, {}));
    expect_ok(world->add_particle({2 * kCell, 2 * kCell}, {0.05F, 0.0F}));
    put_static(*world, body_of(rectangle(50 * kCell, 50 * kCell), {32 * kCell, 32 * kCell}));
    StepReport report = world->step(kDt);
    int stuck = 0;
    for (; report.particles_stuck > 0 && stuck < 60; ++stuck) {
        ASSERT_EQ(report.particles_asleep, 0) << stuck;
        report = world->step(kDt);
    }
    EXPECT_GT(stuck, 18) << "asked three times who sleeps";
    for (int step = 0; step < 20; ++step) {
        report = world->step(kDt);
    }
    EXPECT_EQ(report.particles_asleep, 1) << "and then it does";
}

/// Of nodes far and near: the tiles that they are in and those beside these, as far as the tank is.
TEST(TilesNear, AreThoseOfABoxAndOneMoreOnEachSide) {
    Regions<float> regions;
    regions.tiles_x = 5;
    regions.tiles_y = 4;
    const auto beside = [](std::int32_t tile, std::int32_t first, std::int32_t last) {
        bool any = false;
        for (std::int32_t node = first; node <= last; ++node) {
            any = any || std::abs(node / kTileEdge - tile) <= 1;
        }
        return any;
    };
    for (std::int32_t i0 = 0; i0 <= 5 * kTileEdge; ++i0) {
        for (std::int32_t j0 = 0; j0 <= 4 * kTileEdge; ++j0) {
            for (std::int32_t more = 0; more < 9; ++more) {
                const NodeBox box{i0, j0, std::min(i0 + more, 5 * kTileEdge),
                                  std::min(j0 + 8 - more, 4 * kTileEdge)};
                std::vector<int> visits(20);
                for_each_tile_near(regions, box, [&](std::int32_t tile) {
                    ++visits[static_cast<std::size_t>(tile)];
                });
                for (std::int32_t tile = 0; tile < 20; ++tile) {
                    ASSERT_EQ(visits[static_cast<std::size_t>(tile)],
                              beside(tile % 5, box.i0, box.i1) &&
                                      beside(tile / 5, box.j0, box.j1)
                                  ? 1
                                  : 0)
                        << i0 << " " << j0 << " " << more << " " << tile;
                }
            }
        }
    }
    for_each_tile_near(regions, NodeBox{}, [](std::int32_t) { ADD_FAILURE() << "of nothing"; });
}

/// What turns round in the air is slow there, whoever it is: one in four is looked at in a substep,
/// and all of them in four. It does so in any substep, and so is it asked who sleeps.
TEST(FastSleeper, WhoeverTurnsRoundInTheAirStaysAwake) {
    WorldDef def = tiles_def(64, 24);
    def.gravity_mps2 = WorldDef{}.gravity_mps2;
    for (int way = 0; way < 24; ++way) {
        TestWorld<float> world(def);
        expect_ok(world->let_regions_sleep());
        for (int k = 0; k < way % 6; ++k) {
            world->step(kDt);
        }
        const float steps = 8.0F + 0.25F * static_cast<float>(way / 6);
        for (float column = 8.5F; column < 64.0F; column += 16.0F) {
            expect_ok(world->add_particle({column * kCell, 4.5F * kCell},
                                          {0.0F, steps * 9.81F * kDt}));
        }
        for (int k = 0; k < 16; ++k) {
            ASSERT_EQ(world->step(kDt).particles_asleep, 0) << way << " " << k;
        }
    }
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
