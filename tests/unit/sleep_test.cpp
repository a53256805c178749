// Sleep: liquid at rest stands still until something changes, and goes on as it
// fell asleep.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "busy_world.hpp"
#include "weir/snapshot.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr float kGravity = 9.81F;

/// A pool 6 cells deep in a tank of 16 × 16 cells of 2 cm, with bodies below
/// and above its surface.
WorldDef pool_def() {
    WorldDef def = tank_def(16, 16, 600, 4, 16);
    def.sleep.speed_mps = 0.02F;
    def.sleep.after_s = 0.5F;
    return def;
}

/// p / ρ in the middle of the lowest row of cells, away from bodies, m²/s²; and what it has to be.
constexpr double kPressureThere = 9.81 * 0.11;
template <class Real>
double bottom_pressure(const World<Real>& world) {
    return static_cast<double>(world.pressure_scale()) *
           static_cast<double>(world.pressure().at(12, 0));
}

template <class Real>
struct Pool {
    TestWorld<Real> world;
    BodyId still;  ///< a body that may move, in the water
    BodyId fixed;

    explicit Pool(const WorldDef& def = pool_def()) : world(def) {
        still = put_moving(*world, body_of(rectangle(0.04F, 0.04F), {0.16F, 0.10F}));
        fixed = put_static(*world, body_of(rectangle(0.04F, 0.04F), {0.06F, 0.02F}));
        expect_ok(world->fill({{0, 0}, {0.32F, 0.12F}}));
    }
    /// Steps until it is asleep; how many that took.
    std::int32_t fall_asleep() {
        for (std::int32_t step = 1; step <= 3000; ++step) {
            if (world->step(kDt).asleep) {
                return step;
            }
        }
        ADD_FAILURE() << "still awake";
        return 0;
    }
    World<Real>& operator*() { return *world; }
    World<Real>* operator->() { return &*world; }
};

WEIR_SUITE(SleepOf, EveryScalar);

TYPED_TEST(SleepOf, AtRestItFallsAsleepAndNothingChanges) {
    Pool<TypeParam> pool;
    EXPECT_GE(pool.fall_asleep(), 30) << "half a second at least";
    const std::uint64_t hash = pool->state_hash();
    for (int k = 0; k < 100; ++k) {
        const StepReport report = pool->step(kDt);
        EXPECT_TRUE(report.asleep);
        EXPECT_EQ(report.substeps, 0);
        EXPECT_EQ(report.dt_s, kDt);
        EXPECT_EQ(report.clamped, 0U);
        EXPECT_EQ(report.particles, pool->particle_positions().size);
        EXPECT_LE(report.max_speed_mps, 0.02F);
        EXPECT_EQ(pool->state_hash(), hash);
    }
}

/// It falls onto the solid in each substep, and is stopped: that is no motion. Such a world never
/// slept.
TYPED_TEST(SleepOf, DropThatLiesOnASolidIsAtRest) {
    Pool<TypeParam> pool;
    put_static(*pool, body_of(rectangle(0.08F, 0.04F), {0.163F, 0.23F}));
    expect_ok(pool->add_particle({0.15F, 0.253F}, {}));
    expect_ok(pool->add_particle({0.17F, 0.253F}, {}));
    pool.fall_asleep();
    const auto at = pool->particle_positions();
    EXPECT_GT(static_cast<float>(at[at.size - 1].y) * 0.02F, 0.24F) << "it lies there";
}

/// All that wakes: each makes the very next step one that is carried out.
TYPED_TEST(SleepOf, EveryChangeWakesWithinOneStep) {
    using Change = void (*)(Pool<TypeParam>&);
    struct Row {
        const char* name;
        Change change;
    };
    const Row rows[] = {
        {"tilt",
         [](Pool<TypeParam>& p) {
             expect_ok(p->set_gravity({0.3F, -9.8F}));
         }},
        {"weight",
         [](Pool<TypeParam>& p) {
             expect_ok(p->set_gravity({0.0F, -9.0F}));
         }},
        {"body put elsewhere",
         [](Pool<TypeParam>& p) {
             Motion motion;
             expect_ok(p->motion(p.still, &motion));
             motion.position_m.x += 0.01F;
             expect_ok(p->set_motion(p.still, motion));
         }},
        {"body turned",
         [](Pool<TypeParam>& p) {
             Motion motion;
             expect_ok(p->motion(p.still, &motion));
             motion.angle_rad += 0.1F;
             expect_ok(p->set_motion(p.still, motion));
         }},
        {"body set going, slower than the threshold",
         [](Pool<TypeParam>& p) {
             Motion motion;
             expect_ok(p->motion(p.still, &motion));
             motion.velocity_mps.y = 0.01F;
             expect_ok(p->set_motion(p.still, motion));
         }},
        {"body set spinning",
         [](Pool<TypeParam>& p) {
             Motion motion;
             expect_ok(p->motion(p.still, &motion));
             motion.spin_radps = 0.1F;
             expect_ok(p->set_motion(p.still, motion));
         }},
        {"moving body added",
         [](Pool<TypeParam>& p) {
             put_moving(*p, body_of(kSquare4cm, {0.28F, 0.08F}));
         }},
        {"static body added",
         [](Pool<TypeParam>& p) {
             put_static(*p, body_of(kSquare4cm, {0.28F, 0.08F}));
         }},
        {"moving body removed", [](Pool<TypeParam>& p) { expect_ok(p->remove_body(p.still)); }},
        {"static body removed", [](Pool<TypeParam>& p) { expect_ok(p->remove_body(p.fixed)); }},
        {"particle added",
         [](Pool<TypeParam>& p) {
             expect_ok(p->add_particle({0.25F, 0.25F}, {}));
         }},
        {"box filled",
         [](Pool<TypeParam>& p) {
             expect_ok(p->fill({{0.2F, 0.2F}, {0.24F, 0.24F}}));
         }},
        {"particle removed", [](Pool<TypeParam>& p) { expect_ok(p->remove_particle(3)); }},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(row.name);
        Pool<TypeParam> pool;
        pool.fall_asleep();
        ASSERT_TRUE(pool->step(kDt).asleep);
        row.change(pool);
        const StepReport report = pool->step(kDt);
        EXPECT_GT(report.substeps, 0);
        EXPECT_FALSE(report.asleep);
    }
}

TYPED_TEST(SleepOf, WhatChangesNothingWakesNobody) {
    Pool<TypeParam> pool;
    pool.fall_asleep();
    const std::uint64_t hash = pool->state_hash();
    Motion motion;
    expect_ok(pool->motion(pool.still, &motion));
    motion.position_m = {0.16F, 0.10F};
    expect_ok(pool->set_motion(pool.still, motion));
    expect_ok(pool->set_gravity({0.0F, -kGravity}));
    Diagnostics diagnostics;
    expect_ok(pool->diagnose(&diagnostics));
    EXPECT_EQ(pool->remove_particle(-1), Status::no_such_particle);
    EXPECT_EQ(pool->add_particle({9.0F, 0.0F}, {}), Status::particle_outside_domain);
    expect_ok(pool->drain({{0.0F, 0.2F}, {0.32F, 0.32F}}));
    std::int32_t added = -1;
    expect_ok(pool->fill({{0.251F, 0.251F}, {0.252F, 0.252F}}, &added));
    EXPECT_EQ(added, 0) << "no point of the lattice is there";
    EXPECT_TRUE(pool->step(kDt).asleep);
    EXPECT_EQ(pool->state_hash(), hash);
}

/// Time has stood still: the same world that never slept, at that moment, goes
/// on with the same bits; energy, pressure and volume are those of before.
TYPED_TEST(SleepOf, AwokenItGoesOnAsItWas) {
    WorldDef sleepless = pool_def();
    sleepless.sleep.speed_mps = 0.0F;
    Pool<TypeParam> pool;
    Pool<TypeParam> twin(sleepless);
    const std::int32_t steps = pool.fall_asleep();
    for (int k = 0; k < steps; ++k) {
        EXPECT_FALSE(twin->step(kDt).asleep);
    }
    Diagnostics before;
    expect_ok(pool->diagnose(&before));
    for (int k = 0; k < 50; ++k) {
        pool->step(kDt);
    }
    for (Pool<TypeParam>* each : {&pool, &twin}) {
        expect_ok((*each)->set_gravity({0.2F, -kGravity}));
    }
    for (int k = 0; k < 20; ++k) {
        pool->step(kDt);
        twin->step(kDt);
        const auto a = pool->particle_positions();
        const auto b = twin->particle_positions();
        ASSERT_EQ(std::memcmp(a.data, b.data, static_cast<std::size_t>(a.size) * sizeof a[0]), 0);
        if (k == 0) {
            Diagnostics after;
            expect_ok(pool->diagnose(&after));
            EXPECT_NEAR(after.volume_m2, before.volume_m2, 0.02 * before.volume_m2);
            const double tilt_work = 0.001 * before.mass_m2;
            EXPECT_LE(after.kinetic_energy_m4ps2, before.kinetic_energy_m4ps2 + tilt_work);
            EXPECT_NEAR(bottom_pressure(*pool), kPressureThere, 0.2 * kPressureThere);
        }
    }
}

TYPED_TEST(SleepOf, SlicesSleepAlike) {
    Pool<TypeParam> whole;
    Pool<TypeParam> cut;
    bool slept = false;
    bool woken = false;
    for (int step = 0; step < 900 && !woken; ++step) {
        if (slept) {
            expect_ok(whole->set_gravity({1.0F, -9.0F}));
            expect_ok(cut->set_gravity({1.0F, -9.0F}));
        }
        const StepReport expected = whole->step(kDt);
        StepReport report;
        expect_ok(cut->begin_step(kDt, &report));
        while (!cut->advance(997)) {
            EXPECT_FALSE(report.asleep);
        }
        EXPECT_EQ(report.asleep, expected.asleep);
        EXPECT_EQ(report.substeps, expected.substeps);
        ASSERT_EQ(cut->state_hash(), whole->state_hash());
        woken = slept && !expected.asleep;
        slept = expected.asleep;
    }
    EXPECT_TRUE(woken);
}

/// The time at rest is part of a snapshot: half-way through it, and asleep.
TYPED_TEST(SleepOf, SnapshotsKeepIt) {
    Pool<TypeParam> pool;
    const std::int32_t steps = pool.fall_asleep();
    Pool<TypeParam> half;
    for (int k = 0; k < steps - 12; ++k) {
        half->step(kDt);
    }
    std::vector<std::byte> snapshot(snapshot_bytes<TypeParam>(pool_def().capacity));
    Pool<TypeParam> other;
    for (Pool<TypeParam>* from : {&half, &pool}) {
        expect_ok((*from)->save(snapshot.data(), snapshot.size()));
        expect_ok(other->restore(snapshot.data(), snapshot.size()));
        EXPECT_EQ(other->state_hash(), (*from)->state_hash());
        for (int k = 0; k < 20; ++k) {
            const StepReport expected = (*from)->step(kDt);
            const StepReport report = other->step(kDt);
            ASSERT_EQ(report.asleep, expected.asleep) << k;
            ASSERT_EQ(report.substeps, expected.substeps) << k;
            ASSERT_EQ(other->state_hash(), (*from)->state_hash());
        }
        EXPECT_TRUE(other->step(kDt).asleep);
    }
}

/// Whoever does not ask for it gets the bits and hashes of before, and never
/// sleeps.
TYPED_TEST(SleepOf, OffItIsNoPartOfTheState) {
    WorldDef off = pool_def();
    off.sleep = {};
    WorldDef other = off;
    other.sleep.after_s = 3.0F;
    other.sleep.gravity_mps2 = 1.0F;
    Pool<TypeParam> a(off);
    Pool<TypeParam> b(other);
    for (int k = 0; k < 200; ++k) {
        EXPECT_FALSE(a->step(kDt).asleep);
        b->step(kDt);
    }
    EXPECT_EQ(a->state_hash(), b->state_hash());
}

/// A sensor's noise wakes nobody, nor does it add up to a tilt unseen.
TEST(Sleep, GravityMayTrembleButNotDrift) {
    WorldDef def = pool_def();
    def.sleep.gravity_mps2 = 0.1F;
    Pool<float> pool(def);
    Dice dice(7);
    const auto tremble = [&](float tilt) {
        expect_ok(pool->set_gravity(
            {tilt + dice.uniform(-0.02F, 0.02F), -kGravity + dice.uniform(-0.02F, 0.02F)}));
        return pool->step(kDt);
    };
    bool asleep = false;
    for (int k = 0; k < 3000 && !asleep; ++k) {
        asleep = tremble(0.0F).asleep;
    }
    EXPECT_TRUE(asleep);
    for (int k = 0; k < 500; ++k) {
        EXPECT_TRUE(tremble(0.0F).asleep);
    }
    EXPECT_NEAR(bottom_pressure(*pool), kPressureThere, 0.2 * kPressureThere);
    std::int32_t slept = 0;
    for (float tilt = 0.0F; tremble(tilt).asleep && slept < 1000; tilt += 0.001F) {
        ++slept;
    }
    EXPECT_LT(slept, 125) << "woken at 0.1 m/s² of tilt";
}

/// Noise is about what gravity was when rest began, not about the first one.
TEST(Sleep, GravityMayTrembleAboutAnotherOne) {
    WorldDef def = pool_def();
    def.sleep.gravity_mps2 = 0.1F;
    Pool<float> pool(def);
    Dice dice(8);
    const auto tremble = [&] {
        expect_ok(pool->set_gravity({0.5F + dice.uniform(-0.02F, 0.02F), -kGravity}));
        return pool->step(kDt).asleep;
    };
    std::int32_t steps = 0;
    while (!tremble() && steps < 3000) {
        ++steps;
    }
    for (int k = 0; k < 50; ++k) {
        EXPECT_TRUE(tremble());
    }
}

TEST(Sleep, NotWhileABodyMovesOrLiquidFalls) {
    Pool<float> pool;
    Motion motion;
    expect_ok(pool->motion(pool.still, &motion));
    motion.velocity_mps.y = 1.0e-6F;
    expect_ok(pool->set_motion(pool.still, motion));
    for (int k = 0; k < 200; ++k) {
        EXPECT_FALSE(pool->step(kDt).asleep);
    }
    // Steps so short that gravity takes long to be seen: time counts, not steps.
    TestWorld<float> drop(pool_def());
    expect_ok(drop->fill({{0.1F, 0.2F}, {0.2F, 0.3F}}));
    for (int k = 0; k < 1000; ++k) {
        EXPECT_FALSE(drop->step(1.0e-6F).asleep);
    }
    expect_ok(drop->set_gravity({}));
    EXPECT_FALSE(drop->step(kDt).asleep);
    for (int k = 0; k < 40; ++k) {
        drop->step(kDt);
    }
    EXPECT_TRUE(drop->step(kDt).asleep) << "without gravity it hangs";
}

/// Whoever sleeps on a body presses on it as before.
TEST(Sleep, FloatingBodiesSleepTooAndForcesStay) {
    WorldDef def = pool_def();
    def.capacity.two_way = true;
    def.viscosity_m2ps = 2.0e-3F;
    Pool<float> pool(def);
    const BodyId floating = put_free(*pool, body_of(rectangle(0.06F, 0.04F), {0.25F, 0.12F}));
    pool.fall_asleep();
    BodyForce before;
    expect_ok(pool->force(floating, &before));
    const StepReport report = pool->step(2.0F * kDt);
    EXPECT_TRUE(report.asleep);
    BodyForce now;
    expect_ok(pool->force(floating, &now));
    EXPECT_EQ(now.impulse_m3ps.y, before.impulse_m3ps.y);
    EXPECT_EQ(now.dt_s, before.dt_s);
    const float weight = 0.5F * 0.06F * 0.04F * kGravity;
    EXPECT_NEAR(now.impulse_m3ps.y / now.dt_s, weight, 0.2F * weight);
    Motion motion;
    expect_ok(pool->motion(floating, &motion));
    motion.velocity_mps = {0.0F, 0.3F};
    expect_ok(pool->set_motion(floating, motion));
    EXPECT_FALSE(pool->step(kDt).asleep);
    EXPECT_GT(pool.fall_asleep(), 30) << "and again";
}

TEST(Sleep, NonsenseIsReportedAsleepToo) {
    Pool<float> pool;
    pool.fall_asleep();
    const float nan = std::nanf("");
    EXPECT_TRUE(pool->step(nan).has(Clamped::time_step));
    EXPECT_EQ(pool->set_gravity({nan, 0}), Status::gravity_not_finite);
    const StepReport report = pool->step(kDt);
    EXPECT_TRUE(report.has(Clamped::gravity));
    EXPECT_TRUE(report.asleep);
}

}  // namespace
}  // namespace weir
