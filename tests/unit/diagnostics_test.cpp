// Diagnostics against sums by hand, and that looking changes nothing.
#include <gtest/gtest.h>

#include "busy_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr double kCellM = 0.02;

WorldDef pool_def() {
    return tank_def(20, 20, 2000);
}

TEST(Diagnostics, OneParticleByHand) {
    TestWorld<float> world(pool_def());
    ASSERT_EQ(world->add_particle({0.1F, 0.3F}, {2.0F, -1.0F}), Status::ok);
    Diagnostics d;
    ASSERT_EQ(world->diagnose(&d), Status::ok);
    const double share = kCellM * kCellM / 4.0;
    EXPECT_NEAR(d.mass_m2, share, 1e-10);
    EXPECT_NEAR(d.momentum_m3ps.x, 2.0 * share, 1e-9);
    EXPECT_NEAR(d.momentum_m3ps.y, -share, 1e-9);
    EXPECT_NEAR(d.angular_momentum_m4ps, share * (0.1 * -1.0 - 0.3 * 2.0), 1e-9);
    EXPECT_NEAR(d.kinetic_energy_m4ps2, share * 2.5, 1e-9);
    EXPECT_NEAR(d.potential_energy_m4ps2, share * 9.81 * 0.3, 1e-9);
}

TEST(Diagnostics, AFullPoolHasItsVolumeAndNoDivergence) {
    TestWorld<float> world(pool_def());
    ASSERT_EQ(world->fill({{0, 0}, {0.4F, 0.2F}}), Status::ok);
    Diagnostics d;
    ASSERT_EQ(world->diagnose(&d), Status::ok);
    EXPECT_NEAR(d.volume_m2, 0.4 * 0.2, 1e-5);
    EXPECT_NEAR(d.largest_density, 1.0, 1e-5);
    EXPECT_EQ(d.divergence_per_s, 0.0);
    for (int step = 0; step < 30; ++step) {
        world->step(1.0F / 60.0F);
    }
    ASSERT_EQ(world->diagnose(&d), Status::ok);
    EXPECT_LT(d.divergence_per_s, 0.2);
    EXPECT_LT(d.kinetic_energy_m4ps2, 1e-6 * d.potential_energy_m4ps2);
}

TEST(Diagnostics, LookingChangesNothing) {
    TestWorld<float> watched(pool_def());
    TestWorld<float> alone(pool_def());
    for (TestWorld<float>* world : {&watched, &alone}) {
        ASSERT_EQ((*world)->fill({{0, 0}, {0.16F, 0.3F}}), Status::ok);
    }
    Diagnostics d;
    for (int step = 0; step < 60; ++step) {
        watched->step(1.0F / 60.0F);
        alone->step(1.0F / 60.0F);
        const std::uint64_t before = watched->state_hash();
        ASSERT_EQ(watched->diagnose(&d), Status::ok);
        EXPECT_EQ(watched->state_hash(), before);
    }
    EXPECT_EQ(watched->state_hash(), alone->state_hash());
}

/// A body that was put elsewhere since the last step is where it is, as in a restored world.
TEST(Diagnostics, KnowWhereBodiesAre) {
    const WorldDef def = tank_def(20, 20, 2000, 1, 4);
    TestWorld<float> world(def);
    TestWorld<float> restored(def);
    const BodyId id = put_moving(*world, body_of(rectangle(0.09F, 0.09F), {0.2F, 0.3F}));
    expect_ok(world->fill({{0, 0}, {0.4F, 0.2F}}));
    world->step(1.0F / 60.0F);
    Motion motion = motion_of(*world, id);
    motion.position_m.y = 0.1F;
    expect_ok(world->set_motion(id, motion));
    change_worlds(world, restored, def);
    Diagnostics d;
    Diagnostics expected;
    expect_ok(world->diagnose(&d));
    expect_ok(restored->diagnose(&expected));
    EXPECT_EQ(d.volume_m2, expected.volume_m2);
    EXPECT_EQ(d.largest_density, expected.largest_density);
}

/// Whatever unit a packed world has for its velocities, divergence is told in 1/s.
TEST(Diagnostics, DivergenceIsToldInSeconds) {
    for (const float top_speed_mps : {0.0F, 0.7F}) {
        WorldDef def = tank_def(16, 16, 1024);
        def.top_speed_mps = top_speed_mps;
        TestWorld<SmallFixed> world(def);
        expect_ok(world->fill({{0.0F, 0.0F}, {0.32F, 0.2F}}));
        expect_ok(world->stir({{0.0F, 0.0F}, {0.16F, 0.32F}}, {-0.4F, 0.0F}, 1.0F));
        expect_ok(world->stir({{0.16F, 0.0F}, {0.32F, 0.32F}}, {0.4F, 0.0F}, 1.0F));
        Diagnostics d;
        expect_ok(world->diagnose(&d));
        EXPECT_NEAR(d.divergence_per_s, 0.4 / kCellM, 2.0) << "the velocity's change over a cell";
    }
}

/// A world that was restored has not made the step that moved its bodies.
TEST(Diagnostics, AreThoseOfTheWorldThatWasSaved) {
    TestWorld<float> world(busy_def(0));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.3F, 0.1F}}));
    Dice dice(1);
    for (std::int32_t step = 0; step < 300; ++step) {
        live(*world, dice, 1);
        TestWorld<float> other(busy_def(0));
        change_worlds(world, other, busy_def(0));
        Diagnostics a;
        Diagnostics b;
        expect_ok(world->diagnose(&a));
        expect_ok(other->diagnose(&b));
        EXPECT_EQ(a.divergence_per_s, b.divergence_per_s) << "step " << step;
        EXPECT_EQ(a.volume_m2, b.volume_m2) << "step " << step;
    }
}

TEST(Diagnostics, RefusesWhatCannotBe) {
    World<float> none;
    Diagnostics d;
    EXPECT_EQ(none.diagnose(&d), Status::not_initialised);
    TestWorld<float> world(pool_def());
    EXPECT_EQ(world->diagnose(nullptr), Status::output_missing);
}

}  // namespace
}  // namespace weir
