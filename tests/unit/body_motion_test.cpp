// How bodies move as told: what was told of one and is said again changes nothing, and what creeps.
#include "measure/random.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

WEIR_SUITE(BodyMotion, EveryScalar);

/// In float, whose metres are rounded, the place was another one for 4 bodies in 9, and in double
/// for all: blows were leaps.
TYPED_TEST(BodyMotion, SaidAgainIsNoLeap) {
    constexpr bool kFree = !std::is_same_v<TypeParam, SmallFixed>;
    for (const float cell_m : {0.02F, 0.0123F}) {
        WorldDef def = small_def();
        def.cell_m = cell_m;
        def.top_speed_mps = 200.0F * cell_m;
        def.capacity.two_way = true;
        TestWorld<TypeParam> world(def);
        const Ring square = rectangle(3.0F * cell_m, 3.0F * cell_m);
        BodyId id[2];
        id[0] = put_moving(*world, body_of(square, {4.0F * cell_m, 8.0F * cell_m}));
        const BodyDef other = body_of(square, {11.0F * cell_m, 8.0F * cell_m});
        expect_ok(kFree ? world->add_free_body(other, &id[1])
                        : world->add_moving_body(other, &id[1]));
        measure::Random dice(1);
        for (std::int32_t k = 0; k < 50; ++k) {
            for (const BodyId& each : id) {
                const float way = dice.uniform(-9.0F, 9.0F);
                expect_ok(world->set_motion(each, {{dice.uniform(4.0F, 12.0F) * cell_m,
                                                    dice.uniform(4.0F, 12.0F) * cell_m},
                                                   dice.uniform(-3.0F, 3.0F),
                                                   {way * cell_m, -way * cell_m}, way}));
            }
            world->step(1.0F / 60.0F);
            const std::uint64_t hash = world->state_hash();
            for (const BodyId& each : id) {
                expect_ok(world->set_motion(each, motion_of(*world, each)));
            }
            ASSERT_EQ(world->state_hash(), hash) << "step " << k << ", cells of " << cell_m;
        }
    }
}

/// A hand that turns once in twelve hours on a body that goes 14 cm a day: less than half a unit of
/// fixed point in each step, which by `set_motion` is none.
TYPED_TEST(BodyMotion, WhatCreepsIsLedInTime) {
    TestWorld<TypeParam> world(small_def());
    const Ring hand = rectangle(0.1F, 0.02F);
    const BodyId id = put_moving(*world, body_of(hand, {0.16F, 0.16F}));
    constexpr float kDt = 1.0F / 60.0F;
    for (std::int32_t step = 1; step <= 3000; ++step) {
        const float time = kDt * static_cast<float>(step);
        const Vec2f place{0.16F + 1.6e-6F * time, 0.16F};
        const float angle = 1.4544e-4F * time;
        expect_ok(world->move_body(id, place, angle, kDt));
        world->step(kDt);
        const Motion now = motion_of(*world, id);
        ASSERT_NEAR(now.position_m.x, place.x, 4.0e-7F) << step;
        ASSERT_NEAR(now.angle_rad, angle, 2.0e-5F) << step;
    }
}

/// A step of no time is none of those that a body has.
TYPED_TEST(BodyMotion, IsLedAcrossAPause) {
    TestWorld<TypeParam> world(small_def());
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    expect_ok(world->move_body(id, {0.11F, 0.1F}, 0.0F, 0.01F));
    world->step(0.0F);
    world->step(0.01F);
    EXPECT_NEAR(motion_of(*world, id).position_m.x, 0.11F, 1e-4F);
}

}  // namespace
}  // namespace weir
