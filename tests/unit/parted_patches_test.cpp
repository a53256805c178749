// Walls that part patches of the pressure's coarse grid: what happens on one side is nothing to the
// liquid on the other, and what pushes is felt at once.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "pressure/patch_links.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

Ring upright_line(float x, float low, float high) {
    return {{kCell * x, kCell * low}, {kCell * x, kCell * high}};
}
Ring upright_slab(float x, float width, float low, float high) {
    const float left = kCell * x;
    const float right = kCell * (x + width);
    return {{left, kCell * low}, {right, kCell * low}, {right, kCell * high}, {left, kCell * high}};
}

/// Of a pool at rest beyond a wall from which a dam breaks, m/s, rms at most. `width` 0: a line.
template <class Real>
float most_stirred(float wall, float width) {
    WorldDef def = tank_def(64, 40, 4000, 1, 4);
    def.capacity.wall_edges = width > 0.0F ? 0 : 2000;
    def.cell_m = kCell;
    TestWorld<Real> world(def);
    const Ring ring =
        width > 0.0F ? upright_slab(wall, width, -1, 41) : upright_line(wall, 0, 40);
    BodyDef body = body_of(ring, {0, 0});
    body.open = width == 0.0F;
    put_static(*world, body);
    expect_ok(world->fill({{0, 0}, {kCell * 14.0F, kCell * 32.0F}}));
    expect_ok(world->fill({{kCell * (wall + width), 0}, {kCell * 64.0F, kCell * 16.0F}}));
    float most = 0.0F;
    for (int step = 0; step < 60; ++step) {
        world->step(1.0F / 60.0F);
        float sum = 0.0F;
        int count = 0;
        for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
            if (static_cast<float>(world->particle_positions()[k].x) > wall + width) {
                const Vec2f v = convert<float>(world->particle_velocities()[k]);
                sum += dot(v, v);
                ++count;
            }
        }
        most = std::fmax(most, kCell * std::sqrt(sum / static_cast<float>(count)));
    }
    return most;
}

template <class Real>
class PartedPatches : public testing::Test {};
using Roomy = testing::Types<float, double, Fixed>;
TYPED_TEST_SUITE(PartedPatches, Roomy, ScalarNumber);

// 0.06 to 0.1 m/s while one unknown stood for both sides.
TYPED_TEST(PartedPatches, LeaveAPoolAloneThatIsBesideADam) {
    for (const float wall : {36.0F, 37.0F, 38.0F, 39.0F}) {
        EXPECT_LT((most_stirred<TypeParam>(wall, 0.0F)), 0.012F) << "a line at " << wall;
        EXPECT_LT((most_stirred<TypeParam>(wall, 2.0F)), 0.012F) << "a slab at " << wall;
    }
}

/// Impulse that an upright plate of half a height of 8 cells gives to still liquid around it in the
/// step that sets it in motion, over its added mass πa² (Lamb 1932, §71) times its speed.
template <class Real>
float first_blow(float place, float width) {
    WorldDef def = tank_def(64, 64, 4 * 64 * 64, 1, 4);
    def.capacity.wall_edges = width > 0.0F ? 0 : 2000;
    def.capacity.two_way = true;
    def.cell_m = kCell;
    TestWorld<Real> world(def);
    const Ring ring =
        width > 0.0F ? upright_slab(-0.5F * width, width, -8, 8) : upright_line(0, -8, 8);
    BodyDef plate = body_of(ring, {kCell * place, kCell * 32.4F});
    plate.open = width == 0.0F;
    const BodyId id = put_moving(*world, plate);
    expect_ok(world->fill({{0, 0}, {kCell * 64.0F, kCell * 64.0F}}));
    world.run(20, 1.0F / 240.0F);
    constexpr float kSpeed = 0.02F;
    Motion motion = motion_of(*world, id);
    motion.velocity_mps = {kSpeed, 0};
    expect_ok(world->set_motion(id, motion));
    world->step(1.0F / 240.0F);
    BodyForce force;
    expect_ok(world->force(id, &force));
    constexpr float kHalf = 8.0F * kCell;
    return -force.impulse_m3ps.x / (3.14159F * kHalf * kHalf * kSpeed);
}

// 0.35 to 0.45 of it before, for patches that the plate went through.
TYPED_TEST(PartedPatches, AreNoWeaknessOfAPlateThatPushes) {
    for (const float place : {32.3F, 33.3F, 34.3F, 35.3F}) {
        EXPECT_NEAR((first_blow<TypeParam>(place, 0.0F)), 1.1F, 0.2F) << "a line at " << place;
        EXPECT_NEAR((first_blow<TypeParam>(place, 2.0F)), 1.05F, 0.2F) << "a slab at " << place;
    }
}

/// A patch all of liquid, with closed faces between columns and rows.
PatchLinks full_patch(std::uint32_t closed_right, std::uint32_t closed_up) {
    return {0xFFFF, 0x7777U & ~closed_right, 0x0FFFU & ~closed_up};
}

TEST(CutOffCells, AreThoseOfTheSmallerSide) {
    EXPECT_EQ(cells_cut_off(full_patch(0, 0)), 0U);
    EXPECT_EQ(cells_cut_off(full_patch(0x1111, 0)), 0x1111U);  // a line behind the first column
    EXPECT_EQ(cells_cut_off(full_patch(0x4444, 0)), 0x8888U);
    EXPECT_EQ(cells_cut_off(full_patch(0, 0x0F00)), 0xF000U);
    EXPECT_EQ(cells_cut_off(full_patch(0x1111, 0x0F00)), 0xF111U);  // three are left, or one
    EXPECT_EQ(cells_cut_off(full_patch(0x2222, 0)), 0xCCCCU);  // of two alike the first is kept
}

TEST(CutOffCells, HangTogetherAroundTheEndOfAWall) {
    EXPECT_EQ(cells_cut_off(full_patch(0x0111, 0)), 0U);
    const PatchLinks snake = full_patch(0, 0x07E7);
    EXPECT_EQ(snake.part_of(1), 0xFFFFU);  // from row to row at alternate ends
    EXPECT_EQ(cells_cut_off({0x9009, 0, 0}), 0x9008U);  // single cells: one is the patch's
    EXPECT_EQ(cells_cut_off({0, 0, 0}), 0U);
}

}  // namespace
}  // namespace weir
