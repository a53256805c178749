// Free bodies that meet each other in liquid: they leave it its volume.
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;

WorldDef wet_def(std::int32_t cells_x, std::int32_t cells_y, std::int32_t bodies) {
    WorldDef def = tank_def(cells_x, cells_y, 6400, bodies, 64);
    def.capacity.two_way = true;
    return def;
}

WEIR_SUITE(WetContact, RoomyScalars);

/// Light crates in a tank that sways, thrown against each other, the walls and the floor.
TYPED_TEST(WetContact, FloatingCratesLeaveTheLiquidItsVolume) {
    TestWorld<TypeParam> world{wet_def(40, 30, 3)};
    expect_ok(world->fill({{0, 0}, {0.8F, 0.24F}}));
    const Ring box = rectangle(0.1F, 0.1F);
    BodyId id[3];
    for (int k = 0; k < 3; ++k) {
        id[k] = put_free(*world, body_of(box, {0.29F + 0.11F * static_cast<float>(k), 0.31F}));
    }
    for (int k = 0; k < 600; ++k) {
        const float sway = std::sin(6.2831853F * static_cast<float>(k) * kDt / 1.1F);
        expect_ok(world->set_gravity({k < 400 ? 2.0F * sway : 0.0F, -9.81F}));
        world->step(kDt);
    }
    EXPECT_GT(volume_left(*world), 0.98);
    for (const BodyId each : id) {
        EXPECT_GT(motion_of(*world, each).position_m.y, 0.15F) << "it does not float";
    }
}

/// Ten crates that nearly sink, dropped into a narrow pool, and taken out: what the liquid has lost
/// of its height, and of its particles, as shares.
template <class Real>
void lose_to_a_crowd(float shift_m, double& height, double& particles) {
    TestWorld<Real> world{wet_def(20, 64, 10)};
    const Ring box = rectangle(0.06F, 0.06F);
    BodyId id[10];
    for (int k = 0; k < 10; ++k) {
        const Vec2f at{0.05F + 0.1F * static_cast<float>(k % 4) + shift_m,
                       0.4F + 0.096F * static_cast<float>(k / 4)};
        BodyDef crate = body_of(box, at, 0.3F * static_cast<float>(k % 5) - 0.6F);
        crate.density_ratio = 0.9F;
        id[k] = put_free(*world, crate);
    }
    std::int32_t added = 0;
    expect_ok(world->fill({{0, 0}, {0.4F, 0.3F}}, &added));
    for (int step = 0; step < 1200; ++step) {
        world->step(kDt);
    }
    for (const BodyId each : id) {
        expect_ok(world->remove_body(each));
    }
    for (int step = 0; step < 900; ++step) {
        world->step(kDt);
    }
    LiquidIn all;
    expect_ok(world->liquid_in({{0, 0}, {0.4F, 64 * 0.02F}}, &all));
    height += 1.0 - static_cast<double>(all.centroid_m.y) / 0.15;
    particles += 1.0 - static_cast<double>(world->particle_positions().size) / added;
}

/// As long as there were films between crates, too, liquid was pumped together in the gaps: a
/// quarter of it and more was lost for good. What is pressed together asks for room now: without
/// that starts differ by more than a percent.
TYPED_TEST(WetContact, CrowdLeavesTheLiquidItsVolume) {
    double height = 0.0;
    double particles = 0.0;
    constexpr int kStarts = 3;
    for (int k = 0; k < kStarts; ++k) {
        lose_to_a_crowd<TypeParam>(0.0007F * static_cast<float>(k), height, particles);
    }
    EXPECT_NEAR(height / kStarts, 0.0, 0.02);
    EXPECT_NEAR(particles / kStarts, 0.0, 0.01);
}

/// A heap of more points than there is room for stays within the tank and its work bound, and a
/// snapshot of it goes on with the same bits.
TYPED_TEST(WetContact, HeapIsBoundedAndGoesOnFromASnapshot) {
    const WorldDef def = wet_def(40, 40, 8);
    TestWorld<TypeParam> world{def};
    expect_ok(world->fill({{0, 0}, {0.2F, 0.3F}}));
    const Ring wheel = regular_polygon(7, 0.08F);
    BodyId id[8];
    for (int k = 0; k < 8; ++k) {
        BodyDef body = body_of(wheel, {0.1F + 0.17F * static_cast<float>(k % 4),
                                       0.15F + 0.18F * static_cast<float>(k / 4)});
        body.density_ratio = k % 2 == 0 ? 0.3F : 3.0F;
        id[k] = put_free(*world, body);
    }
    const auto run = [](World<TypeParam>& each) {
        for (int k = 0; k < 60; ++k) {
            WorkBound bound;
            expect_ok(each.work_bound(kDt, &bound));
            const StepReport report = each.step(kDt);
            EXPECT_LE(work_of(report), bound.step);
        }
    };
    run(*world);
    TestWorld<TypeParam> twin{def};
    change_worlds(world, twin, def);
    run(*world);
    run(*twin);
    EXPECT_EQ(world->state_hash(), twin->state_hash());
    EXPECT_TRUE(all_inside(*world));
}

}  // namespace
}  // namespace weir
