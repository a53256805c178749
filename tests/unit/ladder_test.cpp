// The ladder of a deadline: every rung costs less, is reported, stays tame, and a run that is
// repeated with the recorded rungs has the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "busy_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 30.0F;

WorldDef dam_def() {
    return tank_def(32, 24, 4 * 12 * 18);
}

WEIR_SUITE(LadderOf, EveryScalar);

TYPED_TEST(LadderOf, EveryRungCostsLessAndSaysSo) {
    std::int64_t before = 0;
    for (std::int32_t rung = 0; rung < kRungs; ++rung) {
        TestWorld<TypeParam> world(dam_def());
        expect_ok(world->fill({{0, 0}, {0.24F, 0.36F}}));
        for (int k = 0; k < 6; ++k) {
            world->step(kDt);
        }
        const StepReport report = world->step(kDt, rung);
        EXPECT_EQ(report.rung, rung);
        EXPECT_EQ(report.has(Clamped::time_step), rung >= 4);
        EXPECT_EQ(report.dt_s < kDt, rung >= 4);
        if (rung == 5) {
            EXPECT_EQ(report.substeps, 1);
        }
        EXPECT_FALSE(report.walls_held) << "nothing moves";
        EXPECT_TRUE(rung == 0 || rung == 3 || work_of(report) < before) << rung;
        before = work_of(report);
    }
}

/// Half of the substeps, and of one substep one.
TEST(Ladder, HalvesSubstepsUpwards) {
    bool seen[6] = {};
    for (float dt_s = 0.005F; dt_s < 0.2F; dt_s *= 1.3F) {
        TestWorld<float> whole(dam_def());
        TestWorld<float> half(dam_def());
        for (TestWorld<float>* world : {&whole, &half}) {
            expect_ok((*world)->fill({{0, 0}, {0.24F, 0.36F}}));
        }
        const std::int32_t all = whole->step(dt_s).substeps;
        EXPECT_EQ(half->step(dt_s, 4).substeps, (all + 1) / 2);
        seen[std::min(all, 5)] = true;
    }
    EXPECT_TRUE(seen[1] && seen[3]);
}

/// Rungs chosen by a budget, then replayed from the record, in one and in slices.
TYPED_TEST(LadderOf, RecordedRungsReplayToTheBit) {
    const WorldDef def = busy_def(0);
    TestWorld<TypeParam> live(def);
    TestWorld<TypeParam> replay(def);
    TestWorld<TypeParam> cut(def);
    Dice dice(21);
    Dice budgets(22);
    bool seen[kRungs] = {};
    for (int step = 0; step < 60; ++step) {
        Dice one = dice;
        Dice two = dice;
        disturb(*live, dice);
        disturb(*replay, one);
        disturb(*cut, two);
        const std::int64_t budget = 2000 << budgets.below(8);
        const std::int32_t rung = live->rung_within(kDt, budget);
        EXPECT_EQ(rung, cut->rung_within(kDt, budget));
        seen[rung] = true;
        WorkBound last;
        expect_ok(live->work_bound(kDt, &last, kRungs - 1));
        const StepReport report = live->step(kDt, rung);
        if (last.step <= budget) {
            EXPECT_LE(work_of(report), budget) << "kept";
        }
        EXPECT_EQ(replay->step(kDt, report.rung).dt_s, report.dt_s);
        StepReport slices;
        expect_ok(cut->begin_step(kDt, &slices, report.rung));
        while (!cut->advance(911)) {
        }
        ASSERT_EQ(replay->state_hash(), live->state_hash()) << step;
        ASSERT_EQ(cut->state_hash(), live->state_hash()) << step;
    }
    EXPECT_TRUE(seen[0] && seen[kRungs - 1]);
}

/// On the third rung a bar that turns is drawn every other step, and where it belongs. Nobody comes
/// through it or is caught by it.
TYPED_TEST(LadderOf, BodiesAreHeldEveryOtherStep) {
    WorldDef def = dam_def();
    def.capacity.bodies = 2;
    def.capacity.vertices = 8;
    TestWorld<TypeParam> world(def);
    TestWorld<TypeParam> exact(def);
    const Ring ring = rectangle(0.2F, 0.04F);
    BodyDef bar = body_of(ring, {0.32F, 0.12F});
    bar.motion.spin_radps = 3.0F;
    BodyId id;
    BodyId other;
    for (TestWorld<TypeParam>* one : {&world, &exact}) {
        expect_ok((*one)->add_moving_body(bar, one == &world ? &id : &other));
        expect_ok((*one)->fill({{0, 0}, {0.24F, 0.36F}}));
    }
    const std::int32_t all = world->particle_positions().size;
    std::int32_t stuck = 0;
    for (int step = 0; step < 200; ++step) {
        WorkBound bound;
        expect_ok(world->work_bound(1.0F / 60.0F, &bound, 3));
        const StepReport report = world->step(1.0F / 60.0F, 3);
        const StepReport full = exact->step(1.0F / 60.0F, 2);
        ASSERT_EQ(report.walls_held, step % 2 == 0);
        EXPECT_EQ(report.nodes_rasterized == 0, report.walls_held);
        EXPECT_EQ(bound.substep[0] < 50, report.walls_held) << "the bound knows";
        EXPECT_LE(work_of(report), bound.step);
        EXPECT_EQ(report.particles, all - report.particles_removed_stuck);
        stuck += report.particles_stuck + report.particles_removed_stuck;
        Motion held;
        Motion told;
        expect_ok(world->motion(id, &held));
        expect_ok(exact->motion(other, &told));
        const float turned = std::remainder(told.angle_rad - held.angle_rad, 6.2831853F);
        EXPECT_NEAR(turned, report.walls_held ? 3.0F * full.dt_s : 0.0F, 2.0e-3F);
    }
    EXPECT_EQ(stuck, 0);
    expect_ok(world->set_motion(id, {{0.32F, 0.16F}, 0.0F, {}, 1.0F}));
    EXPECT_FALSE(world->step(1.0F / 60.0F, 3).walls_held) << "it was put elsewhere";
    expect_ok(world->set_motion(id, {{0.32F, 0.16F}, 0.0F, {4.0F, 0.0F}, 0.0F}));
    world->step(1.0F / 60.0F, 3);
    EXPECT_FALSE(world->step(1.0F / 60.0F, 3).walls_held) << "too fast";
}

/// Where a body is free, pictures are binary, or all stand still.
TEST(Ladder, HoldsNobodyWhereThereIsNothingToHold) {
    const auto holds = [](bool free, Contour contour, float spin_radps) {
        WorldDef def = small_def();
        def.capacity.two_way = true;
        def.contour = contour;
        TestWorld<float> world(def);
        BodyDef bar = body_of(kSquare4cm, {0.1F, 0.1F});
        bar.motion.spin_radps = spin_radps;
        put_moving(*world, bar);
        if (free) {
            put_free(*world, body_of(kSquare4cm, {0.2F, 0.2F}));
        }
        return world->step(1.0F / 60.0F, 3).walls_held;
    };
    EXPECT_TRUE(holds(false, Contour::interpolated, 1.0F));
    EXPECT_FALSE(holds(true, Contour::interpolated, 1.0F));
    EXPECT_FALSE(holds(false, Contour::mid_edge, 1.0F));
    EXPECT_FALSE(holds(false, Contour::interpolated, 0.0F));
}

/// Who was put elsewhere is drawn there in the next step, in that of a restored world, too.
TYPED_TEST(LadderOf, SnapshotKnowsWhoWasPutElsewhere) {
    const WorldDef def = small_def();
    TestWorld<TypeParam> world(def);
    TestWorld<TypeParam> restored(def);
    BodyDef body = body_of(kSquare4cm, {0.1F, 0.1F});
    body.motion.velocity_mps = {0.1F, 0.0F};
    const BodyId id = put_moving(*world, body);
    world->step(1.0F / 60.0F);
    Motion motion = motion_of(*world, id);
    motion.position_m.y += 0.01F;
    expect_ok(world->set_motion(id, motion));
    change_worlds(world, restored, def);
    EXPECT_FALSE(world->step(1.0F / 60.0F, 3).walls_held);
    EXPECT_FALSE(restored->step(1.0F / 60.0F, 3).walls_held);
    EXPECT_EQ(restored->state_hash(), world->state_hash());
}

/// Whoever stays on a rung for ever gets slower and rougher water, nothing worse.
TYPED_TEST(LadderOf, EveryRungStaysTame) {
    for (std::int32_t rung = 1; rung < kRungs; ++rung) {
        SCOPED_TRACE(rung);
        TestWorld<TypeParam> world(dam_def());
        std::int32_t added = 0;
        expect_ok(world->fill({{0, 0}, {0.24F, 0.36F}}, &added));
        Diagnostics start;
        expect_ok(world->diagnose(&start));
        const double full = start.kinetic_energy_m4ps2 + start.potential_energy_m4ps2;
        for (int k = 0; k < 300; ++k) {
            const StepReport report = world->step(kDt, rung);
            ASSERT_EQ(report.particles, added);
        }
        Diagnostics end;
        expect_ok(world->diagnose(&end));
        EXPECT_TRUE(all_inside(*world));
        EXPECT_LE(end.kinetic_energy_m4ps2 + end.potential_energy_m4ps2, 1.01 * full);
        EXPECT_GT(end.volume_m2, 0.85 * start.volume_m2);
    }
}

TEST(Ladder, RungsBeyondItAreItsEnds) {
    TestWorld<float> world(dam_def());
    expect_ok(world->fill({{0, 0}, {0.24F, 0.36F}}));
    EXPECT_EQ(world->step(kDt, -3).rung, 0);
    EXPECT_EQ(world->step(kDt, 99).rung, kRungs - 1);
    for (const std::int32_t rung : {-3, 99}) {
        const std::int32_t end = rung < 0 ? 0 : kRungs - 1;
        StepReport report;
        expect_ok(world->begin_step(kDt, &report, rung));
        EXPECT_EQ(report.rung, end);
        while (!world->advance(10000)) {
        }
        WorkBound beyond;
        WorkBound of_end;
        expect_ok(world->work_bound(kDt, &beyond, rung));
        expect_ok(world->work_bound(kDt, &of_end, end));
        EXPECT_EQ(beyond.step, of_end.step);
        EXPECT_EQ(beyond.substeps, of_end.substeps);
    }
    EXPECT_EQ(world->rung_within(kDt, 0), kRungs - 1);
    EXPECT_EQ(world->rung_within(kDt, std::int64_t{1} << 40), 0);
    const World<float> none;
    EXPECT_EQ(none.rung_within(kDt, 1000000), kRungs - 1);
}

}  // namespace
}  // namespace weir
