// What a step can cost is known before it begins: no stage of any step does more, and where the
// tank is full that is not far more than what it does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "busy_world.hpp"
#include "step/stage_clock.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;

/// One step in slices of such a budget, 0: in one. `first`: of the world's life.
template <class Real>
void expect_within_bound(World<Real>& world, float dt_s, std::int32_t budget, bool first) {
    WorkBound bound;
    expect_ok(world.work_bound(dt_s, &bound));
    StepReport report;
    expect_ok(world.begin_step(dt_s, &report));
    std::int64_t done = 0;
    bool more = true;
    while (more) {
        more = !world.advance(budget > 0 ? budget : 0x7FFFFFFF);
        const std::int64_t now = work_of(report);
        if (budget > 0) {
            EXPECT_LT(now - done, std::int64_t{budget} + bound.largest_item);
        }
        done = now;
    }
    EXPECT_EQ(report.substeps, bound.substeps);
    EXPECT_LE(done, bound.step);
    for (std::int32_t k = 0; k < kStageCount; ++k) {
        const std::int64_t most = bound.substep[k] * report.substeps +
                                  (first ? bound.first_substep[k] - bound.substep[k] : 0);
        EXPECT_LE(report.work[k], most) << stage_name(static_cast<Stage>(k));
    }
}

WEIR_SUITE(WorkBoundOf, EveryScalar);

TYPED_TEST(WorkBoundOf, NoStepDoesMore) {
    for (std::int32_t kind = 0; kind < kBusyKinds; ++kind) {
        if (!busy_kind_is_borne<TypeParam>(kind)) {
            continue;
        }
        SCOPED_TRACE(kind);
        TestWorld<TypeParam> world(busy_def(kind));
        Dice dice(static_cast<std::uint64_t>(kind) + 5);
        for (std::int32_t step = 0; step < 60 && !testing::Test::HasFailure(); ++step) {
            disturb(*world, dice);
            expect_within_bound(*world, dice.uniform(0.0F, 0.03F),
                                step % 2 == 0 ? 0 : 1 + dice.below(3000), step == 0);
        }
    }
}

/// At a step's end all particles are looked at, whether they may sleep.
TEST(WorkBound, HoldsForTheLookBeforeSleep) {
    WorldDef def = tank_def(16, 16, 1000, 3, 12);
    def.sleep.speed_mps = 1.0F;
    def.sleep.after_s = 0.1F;
    TestWorld<float> world(def);
    put_static(*world, body_of(kSquare4cm, {0.2F, 0.2F}));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.32F, 0.16F}}));
    for (std::int32_t step = 0; step < 30 && !world->step(0.0F).asleep; ++step) {
        expect_within_bound(*world, kDt, 20, step == 0);
    }
    EXPECT_TRUE(world->step(0.0F).asleep);
}

/// That look is in the bound of a step as it is in that of its last stage.
TEST(WorkBound, TheLookBeforeSleepIsToldOnce) {
    WorkBound bounds[2];
    for (const bool sleeps : {false, true}) {
        WorldDef def = tank_def(16, 16, 1000, 3, 12);
        def.sleep.speed_mps = sleeps ? 0.02F : 0.0F;
        const TestWorld<float> world(def);
        expect_ok(world->work_bound(kDt, bounds + (sleeps ? 1 : 0)));
    }
    constexpr std::int32_t kLast = kStageCount - 1;
    EXPECT_EQ(bounds[1].step - bounds[0].step,
              bounds[1].substep[kLast] - bounds[0].substep[kLast]);
    EXPECT_GT(bounds[1].step, bounds[0].step + 1000);
}

TEST(WorkBound, HoldsForFreeBodies) {
    WorldDef def = busy_def(0);
    def.capacity.two_way = true;
    def.viscosity_m2ps = 1.0e-3F;
    TestWorld<float> world(def);
    const Ring bar = rectangle(0.10F, 0.03F);
    for (const float x : {0.08F, 0.2F, 0.3F}) {
        BodyDef body = body_of(bar, {x, 0.15F});
        body.surface.no_slip = true;
        put_free(*world, body);
    }
    expect_ok(world->fill({{0, 0}, {0.2F, 0.18F}}));
    for (std::int32_t step = 0; step < 60; ++step) {
        expect_within_bound(*world, kDt, step % 2 == 0 ? 0 : 700, step == 0);
    }
}

/// Asking changes nothing.
TYPED_TEST(WorkBoundOf, AskingChangesNothing) {
    TestWorld<TypeParam> asked(busy_def(0));
    TestWorld<TypeParam> twin(busy_def(0));
    Dice one(3);
    Dice other(3);
    for (std::int32_t step = 0; step < 40; ++step) {
        disturb(*asked, one);
        disturb(*twin, other);
        WorkBound bound;
        expect_ok(asked->work_bound(kDt, &bound));
        EXPECT_GT(bound.step, 0);
        asked->step(kDt);
        twin->step(kDt);
        ASSERT_EQ(asked->state_hash(), twin->state_hash());
    }
}

/// A tank of 24 × 16 cells as full as it can be.
WorldDef full_def() {
    return tank_def(24, 16, 4 * 24 * 16, 8, 64);
}

void expect_tight(World<float>& world, const char* what) {
    WorkBound bound;
    std::int64_t most[kStageCount] = {};
    world.step(kDt);
    for (int step = 0; step < 40; ++step) {
        expect_ok(world.work_bound(kDt, &bound));
        const StepReport report = world.step(kDt);
        for (std::int32_t k = 0; k < kStageCount; ++k) {
            const std::int64_t work = report.work[k] / static_cast<std::uint32_t>(report.substeps);
            most[k] = std::max(most[k], work);
            EXPECT_LE(work, bound.substep[k]);
        }
        EXPECT_LE(work_of(report), bound.step);
    }
    for (std::int32_t k = 0; k < kStageCount; ++k) {
        const char* stage = stage_name(static_cast<Stage>(k));
        std::printf("%s, %s: %lld of at most %lld a substep\n", what, stage,
                    static_cast<long long>(most[k]), static_cast<long long>(bound.substep[k]));
        EXPECT_LE(bound.substep[k], 2 * most[k]) << what << ", " << stage;
    }
}

TEST(WorkBound, IsReachedWithinAFactorOfTwo) {
    {
        WorldDef def = full_def();
        def.capacity.bodies = 0;
        TestWorld<float> full(def);
        expect_ok(full->fill({{0, 0}, {0.48F, 0.32F}}));
        expect_tight(*full, "full tank");
    }
    {
        // Eight wheels that turn and drive at once, and water everywhere else.
        TestWorld<float> crowd(full_def());
        const Ring bar = rectangle(0.10F, 0.02F);
        for (int k = 0; k < 8; ++k) {
            BodyDef wheel = body_of(bar, {0.06F + 0.12F * static_cast<float>(k % 4),
                                          0.08F + 0.16F * static_cast<float>(k / 4)});
            wheel.motion.spin_radps = 3.0F;
            put_moving(*crowd, wheel);
        }
        expect_ok(crowd->fill({{0, 0}, {0.48F, 0.32F}}));
        expect_tight(*crowd, "all bodies moving");
    }
}

/// Layouts that look bad are within the bound all the same.
TEST(WorkBound, HoldsForCrowdedLayouts) {
    Dice dice(11);
    TestWorld<float> pile(full_def());
    for (int k = 0; k < 4 * 24 * 16; ++k) {
        expect_ok(pile->add_particle({0.461F + dice.uniform(0, 0.018F), 0.301F}, {}));
    }
    TestWorld<float> rim(full_def());
    for (int k = 0; k < 4 * 24 * 16; ++k) {
        const float along = dice.uniform(0.0F, 1.0F);
        const float off = dice.uniform(0.0F, 0.005F);
        const bool flat = k % 2 == 0;
        const bool far = k % 4 < 2;
        expect_ok(rim->add_particle({flat ? 0.48F * along : (far ? 0.48F - off : off),
                                     flat ? (far ? 0.32F - off : off) : 0.32F * along}, {}));
    }
    for (int step = 0; step < 20; ++step) {
        expect_within_bound(*pile, kDt, step % 2 == 0 ? 0 : 500, step == 0);
        expect_within_bound(*rim, kDt, step % 2 == 0 ? 0 : 500, step == 0);
    }
}

TEST(WorkBound, WhatWasDoneIsNotToldAsLess) {
    StepReport report;
    std::uint32_t& sum = report.work[static_cast<std::int32_t>(Stage::collide)];
    Progress progress;
    progress.resume(1000);
    StageClock clock(nullptr, Work(progress), report);
    progress.spend(100);
    clock.charge(Stage::collide);
    EXPECT_EQ(sum, 100U);
    sum = 0xFFFFFFF0U;
    progress.spend(100);
    clock.charge(Stage::collide);
    EXPECT_EQ(sum, 0xFFFFFFFFU);
}

TEST(WorkBound, RefusesWhatItCannotTell) {
    World<float> none;
    WorkBound bound;
    EXPECT_EQ(none.work_bound(kDt, &bound), Status::not_initialised);
    TestWorld<float> world(full_def());
    EXPECT_EQ(world->work_bound(kDt, nullptr), Status::output_missing);
    expect_ok(world->work_bound(-1.0F, &bound));
    EXPECT_EQ(bound.step, 0) << "no step";
    StepReport report;
    expect_ok(world->begin_step(kDt, &report));
    EXPECT_EQ(world->work_bound(kDt, &bound), Status::step_in_progress);
}

}  // namespace
}  // namespace weir
