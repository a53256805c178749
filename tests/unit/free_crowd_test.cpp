// More free bodies than liquid can pass between.
#include <gtest/gtest.h>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr float kCell = 0.02F;
constexpr float kDepth = 15 * kCell;
constexpr int kCrates = 24;

WorldDef pool_def() {
    WorldDef def = tank_def(32, 48, 4 * 32 * 15, kCrates, 4 * kCrates);
    def.capacity.two_way = true;
    return def;
}

/// Crates over a pool: as they float they cover it twice. Returns the number of particles.
template <class Real>
std::int32_t fill_pool(World<Real>& world, BodyId (&id)[kCrates]) {
    std::int32_t added = 0;
    expect_ok(world.fill({{0, 0}, {32 * kCell, kDepth}}, &added));
    const Ring box = rectangle(3 * kCell, 3 * kCell);
    for (int k = 0; k < kCrates; ++k) {
        const Vec2f at{kCell * (3.5F + 5.0F * static_cast<float>(k % 6)),
                       kDepth + kCell * (3.0F + 4.5F * static_cast<float>(k / 6))};
        BodyDef crate = body_of(box, at, 0.2F * static_cast<float>(k % 5) - 0.4F);
        crate.density_ratio = 0.6F;
        id[k] = put_free(world, crate);
    }
    return added;
}

WEIR_SUITE(FreeCrowd, RoomyScalars);

/// Liquid under crates cannot rise past them where they have pressed it together. What is caught
/// between two of them is removed. The crates are taken out again.
TYPED_TEST(FreeCrowd, LeavesThePoolItsVolume) {
    TestWorld<TypeParam> world{pool_def()};
    BodyId id[kCrates];
    const auto added = static_cast<double>(fill_pool(*world, id));
    for (int step = 0; step < 480; ++step) {
        world->step(kDt);
    }
    EXPECT_GT(volume_left(*world), 0.95);
    for (const BodyId each : id) {
        expect_ok(world->remove_body(each));
    }
    for (int step = 0; step < 180; ++step) {
        world->step(kDt);
    }
    LiquidIn all;
    expect_ok(world->liquid_in({{0, 0}, {32 * kCell, 48 * kCell}}, &all));
    const double share = static_cast<double>(world->particle_positions().size) / added;
    EXPECT_NEAR(static_cast<double>(all.centroid_m.y / (0.5F * kDepth)) / share, 1.0, 0.02);
    EXPECT_GT(share, 0.97);
}

/// Where it is pressed together it is not flung, however short the step: it was at 316 m/s.
TYPED_TEST(FreeCrowd, AShortStepDoesNotFling) {
    WorldDef def = pool_def();
    def.capacity.particles += 4 * 32 * 4;
    TestWorld<TypeParam> world{def};
    BodyId id[kCrates];
    fill_pool(*world, id);
    expect_ok(world->fill({{0, 0}, {32 * kCell, 4 * kCell}}));  // a second time
    world->step(kDt);
    EXPECT_LT(world->step(1.0e-6F).max_speed_mps, 0.6F);
}

/// Pressed together by crates that were just thrown in.
TYPED_TEST(FreeCrowd, HasTheSameBitsInSlicesAndStaysWithinItsBound) {
    TestWorld<TypeParam> whole{pool_def()};
    TestWorld<TypeParam> cut{pool_def()};
    BodyId id[kCrates];
    fill_pool(*whole, id);
    fill_pool(*cut, id);
    for (int step = 0; step < 60; ++step) {
        WorkBound bound;
        expect_ok(cut->work_bound(kDt, &bound));
        whole->step(kDt);
        StepReport report;
        ASSERT_EQ(cut->begin_step(kDt, &report), Status::ok);
        while (!cut->advance(500 + 700 * (step % 7))) {
        }
        EXPECT_LE(work_of(report), bound.step);
        ASSERT_EQ(cut->state_hash(), whole->state_hash()) << "step " << step;
    }
}

}  // namespace
}  // namespace weir
