// Numbers that no world has are refused of whoever saved them.
#include <limits>

#include "solid/obstacles.hpp"
#include "step/regions.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

template <class Real>
Status restored(TestWorld<Real>& world, const WorldDef& def) {
    const std::vector<std::byte> bytes = saved(*world, def.capacity);
    return world->restore(bytes.data(), bytes.size());
}

/// Packed loops count on 29 bits.
TEST(SnapshotNumbers, PackedPressuresHaveTheirBits) {
    const WorldDef def = small_def();
    for (const std::int32_t sign : {-1, 1}) {
        TestWorld<SmallFixed> world(def);
        Simulation<SmallFixed>& simulation = state_of(world).simulation;
        auto& pressure = simulation.pressure.pressure[simulation.layers.shape.index(3, 3)];
        pressure = SmallFixed::of_raw(sign * ((1 << 28) - 1));
        EXPECT_EQ(restored(world, def), Status::ok);
        pressure = SmallFixed::of_raw(sign * (1 << 28));
        EXPECT_EQ(restored(world, def), Status::snapshot_damaged);
    }
}

TEST(SnapshotNumbers, DensitiesOfSleepersAreNumbers) {
    WorldDef def = small_def();
    def.sleep.speed_mps = 0.05F;
    def.capacity.sleeping_regions = true;
    TestWorld<float> world(def);
    expect_ok(world->let_regions_sleep());
    EXPECT_EQ(restored(world, def), Status::ok);
    state_of(world).simulation.regions->density[3] = kNone;
    EXPECT_EQ(restored(world, def), Status::snapshot_damaged);
}

TEST(SnapshotNumbers, PushesOfBodiesAreNumbers) {
    WorldDef def = small_def();
    def.capacity.two_way = true;
    TestWorld<float> world(def);
    put_free(*world, body_of(kSquare4cm, {0.1F, 0.02F}));
    EXPECT_EQ(restored(world, def), Status::ok);
    Meetings<float>(state_of(world).simulation.bodies).before[1].push = kNone;
    EXPECT_EQ(restored(world, def), Status::snapshot_damaged);
}

/// What stands still answers no push, and where no body may move none does.
TEST(SnapshotNumbers, StaticBodiesStayStatic) {
    WorldDef def = small_def();
    def.capacity.two_way = true;
    def.capacity.moving_bodies = false;
    TestWorld<float> world(def);
    const BodyId id = put_static(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    BodyTable<float>& table = state_of(world).simulation.bodies;
    table.load[id.slot].inverse_mass = 1.0F;
    EXPECT_EQ(restored(world, def), Status::ok);
    EXPECT_FALSE(table.load[id.slot].is_free_or_led());
    EXPECT_EQ(state_of(world).simulation.free_bodies, nullptr);
    table.body[id.slot].kind = BodyKind::moving;
    EXPECT_EQ(restored(world, def), Status::snapshot_damaged);
}

/// Incompressible liquid knows no sound.
TEST(SnapshotNumbers, OnlyElasticLiquidHasASpeedOfSound) {
    WorldDef def = small_def();
    TestWorld<float> world(def);
    state_of(world).simulation.pressure.sound_speed = 1.0F;
    EXPECT_EQ(restored(world, def), Status::snapshot_damaged);
    def.pressure = Pressure::equation_of_state;
    TestWorld<float> elastic(def);
    state_of(elastic).simulation.pressure.sound_speed = 1.0F;
    EXPECT_EQ(restored(elastic, def), Status::ok);
}

}  // namespace
}  // namespace weir
