// Regions, by single particles in tiles: who belongs together, and who wakes whom.
#include <gtest/gtest.h>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kDt = 1.0F / 60.0F;

/// Without gravity: particles stay where they are put.
WorldDef tiles_def() {
    WorldDef def = tank_def(64, 24, 300, 3, 12);
    def.capacity.sleeping_regions = true;
    def.sleep.speed_mps = 0.02F;
    def.sleep.after_s = 0.1F;
    def.gravity_mps2 = {};
    return def;
}

template <class Real>
struct Tiles {
    TestWorld<Real> world;

    Tiles() : world(tiles_def()) { expect_ok(world->let_regions_sleep()); }
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
    const BodyId id = put_moving(*tiles.world, body_of(kSquare4cm, {20 * kCell, 12 * kCell}));
    tiles.put(17.5F, 12.5F);
    tiles.put(2, 2);
    tiles.rest();
    Motion motion;
    expect_ok(tiles->motion(id, &motion));
    motion.position_m = {40 * kCell, 12 * kCell};
    expect_ok(tiles->set_motion(id, motion));
    EXPECT_EQ(tiles.asleep_after(2), 1) << "the one far from it";
}

}  // namespace
}  // namespace weir
