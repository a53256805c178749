// Liquid in a box: counted, measured, taken out.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr std::int32_t kCells = 16;
constexpr float kCell_m = 0.02F;
constexpr float kSide = kCells * kCell_m;

WorldDef tank() {
    WorldDef def = small_def();
    def.capacity.cells_x = def.capacity.cells_y = kCells;
    def.capacity.particles = 4 * kCells * kCells;
    def.cell_m = kCell_m;
    return def;
}

template <class Real>
LiquidIn found_in(const World<Real>& world, const Box& box) {
    LiquidIn found;
    expect_ok(world.liquid_in(box, &found));
    return found;
}

WEIR_SUITE(LiquidBox, EveryScalar);

TYPED_TEST(LiquidBox, KnowsHowMuchWhereAndHowFast) {
    TestWorld<TypeParam> world(tank());
    expect_ok(world->fill({{0.1F, 0.1F}, {0.18F, 0.2F}}));
    for (int step = 0; step < 5; ++step) {
        world->step(0.01F);  // it falls freely
    }
    const LiquidIn all = found_in(*world, {{0.0F, 0.0F}, {kSide, kSide}});
    EXPECT_EQ(all.particles, world->particle_positions().size);
    EXPECT_NEAR(all.area_m2, 0.08F * 0.1F, 1e-6F);
    EXPECT_NEAR(all.centroid_m.x, 0.14F, 1e-4F);
    EXPECT_NEAR(all.centroid_m.y, 0.15F - 0.5F * 9.81F * 0.05F * 0.05F, 0.003F);
    EXPECT_NEAR(all.velocity_mps.x, 0.0F, 1e-3F);
    EXPECT_NEAR(all.velocity_mps.y, -9.81F * 0.05F, 2e-3F);
    const LiquidIn none = found_in(*world, {{0.25F, 0.0F}, {kSide, kSide}});
    EXPECT_EQ(none.particles, 0);
    EXPECT_EQ(none.area_m2, 0.0F);
    EXPECT_EQ(none.velocity_mps.y, 0.0F);
}

/// Every particle is in one of the boxes that a tank is cut into.
TYPED_TEST(LiquidBox, BoxesSideBySideShareNothing) {
    TestWorld<TypeParam> world(tank());
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, kSide / 2}}));
    for (int step = 0; step < 20; ++step) {
        world->step(0.01F);
    }
    const std::int32_t before = world->particle_positions().size;
    std::int32_t sum = 0;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            const float edge = kSide / 4;
            const Box box{{static_cast<float>(i) * edge, static_cast<float>(j) * edge},
                          {static_cast<float>(i + 1) * edge, static_cast<float>(j + 1) * edge}};
            const LiquidIn found = found_in(*world, box);
            std::int32_t removed = -1;
            expect_ok(world->drain(box, &removed));
            EXPECT_EQ(removed, found.particles);
            EXPECT_EQ(found_in(*world, box).particles, 0);
            sum += removed;
        }
    }
    EXPECT_EQ(sum, before);
    EXPECT_EQ(world->particle_positions().size, 0);
}

/// What is drained from a pool's corner flows in again, until there is none.
TYPED_TEST(LiquidBox, AnOutletEmptiesAPool) {
    TestWorld<TypeParam> world(tank());
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, kSide / 4}}));
    const std::int32_t before = world->particle_positions().size;
    std::int32_t gone = 0;
    for (int step = 0; step < 600; ++step) {
        world->step(0.01F);
        std::int32_t removed = 0;
        expect_ok(world->drain({{0.0F, 0.0F}, {2 * kCell_m, 2 * kCell_m}}, &removed));
        gone += removed;
    }
    EXPECT_EQ(world->particle_positions().size, before - gone);
    EXPECT_GT(gone, before * 3 / 4);
}

constexpr float kWide = 64 * kCell_m;
constexpr Box kLeft{{0.0F, 0.0F}, {kWide / 2, kSide}};
constexpr Box kRight{{kWide / 2, 0.0F}, {kWide, kSide}};

WorldDef wide_tank() {
    WorldDef def = tank();
    def.capacity.cells_x = 64;
    def.capacity.sleeping_regions = true;
    def.sleep.speed_mps = 0.05F;
    return def;
}

/// A pool on each side of a wall, which sleep each by itself.
template <class Real>
void fill_both_sides(World<Real>& world) {
    const Ring wall = rectangle(8 * kCell_m, kSide);
    put_static(world, body_of(wall, {kWide / 2, kSide / 2}));
    expect_ok(world.let_regions_sleep());
    expect_ok(world.fill({{0.0F, 0.0F}, {28 * kCell_m, 0.08F}}));
    expect_ok(world.fill({{36 * kCell_m, 0.0F}, {kWide, 0.08F}}));
}

TYPED_TEST(LiquidBox, SleepersAreTakenOutAndWakeTheirNeighbours) {
    TestWorld<TypeParam> world(wide_tank());
    fill_both_sides(*world);
    const Box beside_wall{{kWide / 2, 0.0F}, {40 * kCell_m, kSide}};
    StepReport report;
    for (int step = 0; step < 300; ++step) {
        report = world->step(0.01F);
    }
    EXPECT_GT(report.particles_asleep, 0);
    const std::int32_t kept = found_in(*world, kLeft).particles;
    const std::int32_t there = found_in(*world, kRight).particles;
    std::int32_t removed = 0;
    expect_ok(world->drain(beside_wall, &removed));
    EXPECT_GT(removed, 40);
    EXPECT_EQ(found_in(*world, kLeft).particles, kept);
    EXPECT_EQ(found_in(*world, kRight).particles, there - removed);
    for (int step = 0; step < 100; ++step) {
        world->step(0.01F);
    }
    EXPECT_GT(found_in(*world, beside_wall).particles, 20);  // it flowed in
    EXPECT_EQ(world->particle_positions().size, kept + there - removed);
}

TYPED_TEST(LiquidBox, MayReachBeyondTheTank) {
    TestWorld<TypeParam> world(tank());
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, kSide / 2}}));
    const std::int32_t all = world->particle_positions().size;
    EXPECT_EQ(found_in(*world, {{-1.0e30F, -1.0F}, {1.0e30F, 1.0F}}).particles, all);
    EXPECT_EQ(found_in(*world, {{kSide, 0.0F}, {2 * kSide, kSide}}).particles, 0);
    EXPECT_EQ(found_in(*world, {{-3.0F, -3.0F}, {-2.0F, -2.0F}}).particles, 0);
    expect_ok(world->drain({{-1.0F, -1.0F}, {kSide / 2, 2 * kSide}}));
    EXPECT_EQ(world->particle_positions().size, all / 2);
}

TYPED_TEST(LiquidBox, IsStirred) {
    TestWorld<TypeParam> world(tank());
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, kSide / 2}}));
    const Box left{{-1.0F, 0.0F}, {kSide / 2, kSide}};
    const Box right{{kSide / 2, 0.0F}, {1.0F, kSide}};
    const auto expect_velocity = [&](const Box& box, Vec2f expected) {
        const Vec2f v = found_in(*world, box).velocity_mps;
        EXPECT_NEAR(v.x, expected.x, 2.0e-4F);
        EXPECT_NEAR(v.y, expected.y, 2.0e-4F);
    };
    expect_ok(world->stir(left, {0.4F, -0.2F}, 1.0F));
    expect_velocity(left, {0.4F, -0.2F});
    expect_velocity(right, {0.0F, 0.0F});
    expect_ok(world->stir(left, {-0.4F, 0.2F}, 0.25F));
    expect_velocity(left, {0.2F, -0.1F});
    const std::uint64_t before = world->state_hash();
    expect_ok(world->stir(left, {3.0F, 3.0F}, 0.0F));
    expect_velocity(left, {0.2F, -0.1F});
    EXPECT_NE(world->step(0.01F).substeps, 0);
    EXPECT_NE(world->state_hash(), before);
}

/// From one end of a world's speeds to the other and back.
TYPED_TEST(LiquidBox, IsStirredAsHardAsCanBe) {
    WorldDef def = tank();
    TestWorld<TypeParam> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, kSide / 2}}));
    const Box all{{0.0F, 0.0F}, {kSide, kSide}};
    float fastest = 1.0e6F;
    while (world->stir(all, {fastest, -fastest}, 1.0F) != Status::ok) {
        fastest *= 0.99F;
    }
    ASSERT_GT(fastest, 1.0F);
    EXPECT_NEAR(found_in(*world, all).velocity_mps.x, fastest, 1.0e-4F * fastest);
    expect_ok(world->stir(all, {-fastest, fastest}, 0.5F));
    EXPECT_NEAR(found_in(*world, all).velocity_mps.x, 0.0F, 1.0e-4F * fastest);
    expect_ok(world->stir(all, {-fastest, fastest}, 1.0F));
    EXPECT_NEAR(found_in(*world, all).velocity_mps.y, fastest, 1.0e-4F * fastest);
    const std::int32_t count = world->particle_positions().size;
    for (int step = 0; step < 50; ++step) {
        EXPECT_EQ(world->step(0.01F).particles, count);
    }
}

/// The next step is cut as who was pushed needs it.
TYPED_TEST(LiquidBox, WhoIsStirredIsNotSlowed) {
    WorldDef def = tank();
    def.gravity_mps2 = {};
    TestWorld<TypeParam> world(def);
    expect_ok(world->fill({{0.02F, 0.1F}, {0.06F, 0.14F}}));
    world->step(0.01F);
    expect_ok(world->stir({{0.0F, 0.0F}, {kSide, kSide}}, {4.5F, 0.0F}, 1.0F));
    const StepReport report = world->step(1.0F / 60.0F);
    EXPECT_EQ(report.particles_slowed, 0);
    EXPECT_GE(report.substeps, 3);
    EXPECT_NEAR(found_in(*world, {{0.0F, 0.0F}, {kSide, kSide}}).centroid_m.x, 0.115F, 0.003F);
}

/// Steps until the world sleeps, at most so many.
template <class Real>
std::int32_t steps_to_sleep(World<Real>& world, float share, std::int32_t most) {
    std::int32_t steps = 0;
    while (world.step(0.01F).substeps > 0 && ++steps < most) {
        expect_ok(world.stir({{0.0F, 0.0F}, {kSide, kSide}}, {}, share));
    }
    return steps;
}

TYPED_TEST(LiquidBox, IsCalmedAndSleepsTheSooner) {
    WorldDef def = tank();
    def.sleep.speed_mps = 0.01F;
    TestWorld<TypeParam> calmed(def), other(def);
    for (TestWorld<TypeParam>* world : {&calmed, &other}) {
        expect_ok((*world)->fill({{0.0F, 0.0F}, {kSide / 2, kSide / 2}}));
    }
    EXPECT_LT(steps_to_sleep(*calmed, 0.05F, 900), 300);
    EXPECT_EQ(steps_to_sleep(*other, 0.0F, 900), 900);
    const std::uint64_t asleep = calmed->state_hash();
    expect_ok(calmed->stir({{0.0F, 0.0F}, {kSide, kSide}}, {}, 0.5F));
    EXPECT_EQ(calmed->state_hash(), asleep) << "calm wakes nobody";
    EXPECT_EQ(calmed->step(0.01F).substeps, 0);
    expect_ok(calmed->stir({{0.0F, 0.0F}, {0.1F, 0.1F}}, {0.5F, 0.0F}, 0.5F));
    EXPECT_GT(calmed->step(0.01F).substeps, 0) << "a push does";
}

TYPED_TEST(LiquidBox, OnlyWhoIsPushedWakes) {
    TestWorld<TypeParam> world(wide_tank());
    fill_both_sides(*world);
    const std::int32_t there = found_in(*world, kRight).particles;
    std::int32_t asleep = 0;
    for (int step = 0; step < 600 && asleep < there; ++step) {
        expect_ok(world->stir(kLeft, {0.3F, 0.0F}, 0.2F));  // is kept awake
        asleep = world->step(0.01F).particles_asleep;
    }
    EXPECT_EQ(asleep, there);
    const std::uint64_t before = world->state_hash();
    expect_ok(world->stir(kRight, {}, 1.0F));
    EXPECT_EQ(world->state_hash(), before);
    expect_ok(world->stir(kRight, {0.2F, 0.1F}, 0.5F));
    EXPECT_EQ(world->step(0.01F).particles_asleep, 0);
}

WEIR_SUITE(OfOneLiquid, RoomyScalars);

/// Mixed in every cell: each call finds its own.
TYPED_TEST(OfOneLiquid, CallsLeaveTheOtherAlone) {
    WorldDef def = tank();
    def.capacity.second_liquid = true;
    def.capacity.particle_tags = true;
    TestWorld<TypeParam> world(def);
    const Box all{{0.0F, 0.0F}, {kSide, kSide}};
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, 0.1F}}));
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, 0.05F}}, nullptr, Liquid::second));
    LiquidIn first;
    LiquidIn second;
    expect_ok(world->stir(all, {0.5F, 0.0F}, 1.0F, Liquids::second));
    expect_ok(world->tag(all, 7, Liquids::first));
    expect_ok(world->liquid_in(all, &first, Liquids::first));
    expect_ok(world->liquid_in(all, &second, Liquids::second));
    EXPECT_EQ(first.particles + second.particles, found_in(*world, all).particles);
    EXPECT_NEAR(first.area_m2, 0.1F * kSide, 1e-6F);
    EXPECT_NEAR(second.area_m2, 0.05F * kSide, 1e-6F);
    EXPECT_NEAR(second.velocity_mps.x, 0.5F, 1e-3F);
    EXPECT_EQ(first.velocity_mps.x, 0.0F);
    for (std::int32_t k = 0; k < first.particles + second.particles; ++k) {
        const bool is_first = world->particle_kinds()[k] == Liquid::first;
        EXPECT_EQ(world->particle_tags()[k], is_first ? 7 : 0);
    }
    std::int32_t removed = 0;
    expect_ok(world->drain(all, &removed, Liquids::second));
    EXPECT_EQ(removed, second.particles);
    EXPECT_EQ(found_in(*world, all).particles, first.particles);
    EXPECT_EQ(world->drain(all, nullptr, static_cast<Liquids>(3)), Status::unknown_option);
}

TYPED_TEST(LiquidBox, RefusesAndChangesNothing) {
    TestWorld<TypeParam> world(tank());
    expect_ok(world->fill({{0.0F, 0.0F}, {kSide, kSide / 2}}));
    const std::uint64_t before = world->state_hash();
    const Box box{{0.0F, 0.0F}, {kSide, kSide}};
    LiquidIn found;
    EXPECT_EQ(world->liquid_in(box, nullptr), Status::output_missing);
    EXPECT_EQ(world->drain({{0.1F, 0.1F}, {0.1F, 0.2F}}), Status::box_is_empty);
    EXPECT_EQ(world->fill({{0.1F, 0.1F}, {2 * kSide, 0.2F}}), Status::box_outside_domain);
    EXPECT_EQ(world->stir(box, {0.1F, std::nanf("")}, 0.5F), Status::velocity_out_of_range);
    EXPECT_EQ(world->stir(box, {-1.0e9F, 0.0F}, 0.5F), Status::velocity_out_of_range);
    EXPECT_EQ(world->stir(box, {0.1F, 0.0F}, 1.001F), Status::share_out_of_range);
    EXPECT_EQ(world->stir(box, {0.1F, 0.0F}, std::nanf("")), Status::share_out_of_range);
    EXPECT_EQ(world->stir({{0.0F, 0.0F}, {INFINITY, 1.0F}}, {}, 0.5F), Status::box_not_finite);
    EXPECT_EQ(world->drain(box, nullptr, Liquids::second), Status::no_second_liquid);
    StepReport report;
    expect_ok(world->begin_step(0.01F, &report));
    EXPECT_EQ(world->drain(box), Status::step_in_progress);
    EXPECT_EQ(world->liquid_in(box, &found), Status::step_in_progress);
    EXPECT_EQ(world->stir(box, {}, 0.5F), Status::step_in_progress);
    World<TypeParam> none;
    EXPECT_EQ(none.drain(box), Status::not_initialised);
    EXPECT_EQ(found.particles, 0);
    while (!world->advance(1000)) {
    }
    TestWorld<TypeParam> other(tank());
    expect_ok(other->fill({{0.0F, 0.0F}, {kSide, kSide / 2}}));
    EXPECT_EQ(other->state_hash(), before);
    other->step(0.01F);
    EXPECT_EQ(other->state_hash(), world->state_hash());
}

}  // namespace
}  // namespace weir
