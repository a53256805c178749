// Liquid that has a long way to the floor, or is carried round by a wall, keeps its volume.
#include <gtest/gtest.h>

#include <random>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

/// Packed worlds have no coarse grid: sweeps alone carry the weight of what is deep. With as many
/// as asked for, pools of 40 rows collapsed by themselves, of 32 when they were kicked.
TEST(PressedLiquid, DeepPoolsInSmallFixedStayDeep) {
    for (const std::int32_t rows : {32, 40, 64, 128}) {
        for (const float kick : {0.0F, 0.3F, 1.0F}) {
            WorldDef def = tank_def(16, rows + 16, 4 * 16 * rows);
            TestWorld<SmallFixed> world{def};
            expect_ok(world->fill({{0, 0}, {16 * kCell, static_cast<float>(rows) * kCell}}));
            world->step(1.0F / 60.0F);
            expect_ok(world->stir({{0, 0}, {4 * kCell, 1000 * kCell}}, {kick, 0}, 1.0F));
            for (int step = 0; step < 200; ++step) {
                world->step(1.0F / 60.0F);
            }
            EXPECT_NEAR(2 * mean_height(*world) / rows, 1.0, 0.006) << rows << " rows, " << kick;
        }
    }
}

/// Each blow made the old pressure worse than none, and of what was left of it too little held up:
/// 0.97 of 20 rows' height was there after twelve, 0.93 of 24 rows', 0.91 of 32.
TEST(PressedLiquid, BlowsTakeNoHeightFromSmallFixed) {
    for (const std::int32_t rows : {20, 24, 32, 64}) {
        TestWorld<SmallFixed> world{tank_def(24, rows + 16, 4 * 24 * rows)};
        expect_ok(world->fill({{0, 0}, {24 * kCell, static_cast<float>(rows) * kCell}}));
        for (int step = 0; step < 720; ++step) {
            if (step % 60 == 10) {
                expect_ok(world->stir({{0, 0}, {12 * kCell, 1000 * kCell}}, {0.3F, 0}, 1.0F));
            }
            world->step(1.0F / 60.0F);
        }
        EXPECT_NEAR(2 * mean_height(*world) / rows, 1.0, 0.01) << rows << " rows";
    }
}

/// A sensor's noise is up as often as down. The kept pressure went down with gravity, not up with it:
/// full tanks lost from a tenth to two thirds of their height within a minute.
TEST(PressedLiquid, ShakyGravityPressesNobodyTogether) {
    for (const std::int32_t sweeps : {2, 6}) {
        WorldDef def = tank_def(16, 28, 4 * 16 * 25);
        def.pressure_sweeps = sweeps;
        TestWorld<SmallFixed> world{def};
        expect_ok(world->fill({{0, 0}, {16 * kCell, 25 * kCell}}));
        std::mt19937 dice(1);
        for (int step = 0; step < (kSanitized ? 300 : 1200); ++step) {
            const float noise = static_cast<float>(dice() % 2001) / 1000.0F - 1.0F;
            expect_ok(world->set_gravity({0.0F, -9.81F + noise}));
            world->step(1.0F / 64.0F);
        }
        EXPECT_NEAR(2 * mean_height(*world) / 25, 1.0, 0.02) << sweeps << " sweeps";
    }
}

/// A drum that turns presses what it carries up against its wall. What is in a sliver of a cell
/// there pushed back by no more than the sliver's room.
WEIR_SUITE(Drum, RoomyScalars);

TYPED_TEST(Drum, LeavesTheLiquidItsVolume) {
    constexpr int kSides = 16;
    const float radius = 8 * kCell;
    WorldDef def;
    def.capacity.cells_x = def.capacity.cells_y = 22;
    def.capacity.particles = 4 * 22 * 22;
    def.capacity.bodies = 1;
    def.capacity.vertices = 80;
    TestWorld<TypeParam> world{def};
    const float edge = 10.5F * kCell;
    const Ring block = {{-edge, -edge}, {edge, -edge}, {edge, edge}, {-edge, edge}};
    const Ring round = regular_polygon(kSides, radius);
    const View<Vec2f> holes[] = {{round.data(), kSides}};
    BodyDef drum = body_of(block, {11 * kCell, 11 * kCell});
    drum.holes = {holes, 1};
    drum.motion.spin_radps = 25.0F;
    put_moving(*world, drum);
    expect_ok(world->fill({{3 * kCell, 3 * kCell}, {19 * kCell, 11 * kCell}}));
    const double before = volume_left(*world);
    for (int step = 0; step < 600; ++step) {
        world->step(1.0F / 60.0F);
    }
    EXPECT_GT(volume_left(*world) / before, 0.8);
}

}  // namespace
}  // namespace weir
