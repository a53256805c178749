// WorldDef::top_speed_mps: a packed world's own unit of time. What is slower by a power of two goes
// the same way to the bit, and everything at the face is in seconds all the same.
#include <vector>

#include "bad_input.hpp"
#include "measure/world_memory.hpp"
#include "weir/snapshot.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

/// A tank with all that knows time, which goes `slower` times as slowly as one whose unit is 1 s.
WorldDef slow_def(float slower) {
    WorldDef def = small_def();
    def.capacity.particles = 300;
    def.capacity.contacts = 3;
    def.capacity.two_way = true;
    def.cell_m = kCell;
    def.top_speed_mps = kMaxSpeedSmallFixed * kCell / slower;
    def.gravity_mps2 = {1.0F / (slower * slower), -9.81F / (slower * slower)};
    def.viscosity_m2ps = 1.0e-3F / slower;
    def.walls.bottom.friction = 0.5F;
    def.walls.bottom.conveyor_mps = 0.3F / slower;
    def.sleep = {0.4F / slower, 0.5F * slower, 0.0F};
    return def;
}

/// Liquid that falls over a block that turns and wanders.
struct SlowTank {
    float slower;
    TestWorld<SmallFixed> world;
    BodyId block;

    explicit SlowTank(float by, const WorldDef& def) : slower(by), world(def) {
        BodyDef body = body_of(kSquare4cm, {0.2F, 0.08F}, 0.3F);
        body.motion.velocity_mps = {-0.1F / slower, 0.0F};
        body.motion.spin_radps = 3.0F / slower;
        body.surface.friction = 0.2F;
        body.surface.conveyor_mps = 0.1F / slower;
        block = put_moving(*world, body);
        expect_ok(world->fill({{0.0F, 0.0F}, {0.14F, 0.18F}}));
        expect_ok(world->add_particle({0.25F, 0.25F}, {-1.0F / slower, 2.0F / slower}));
    }
    void stop() {
        Motion motion;
        expect_ok(world->motion(block, &motion));
        motion.velocity_mps = {};
        motion.spin_radps = 0.0F;
        expect_ok(world->set_motion(block, motion));
    }
};

void expect_same_liquid(const World<SmallFixed>& one, const World<SmallFixed>& other) {
    const auto x = one.particle_positions();
    const auto v = one.particle_velocities();
    const auto other_x = other.particle_positions();
    const auto other_v = other.particle_velocities();
    ASSERT_EQ(x.size, other_x.size);
    for (std::int32_t k = 0; k < x.size; ++k) {
        ASSERT_EQ(x[k].x.raw, other_x[k].x.raw);
        ASSERT_EQ(x[k].y.raw, other_x[k].y.raw);
        ASSERT_EQ(v[k].x.raw, other_v[k].x.raw);
        ASSERT_EQ(v[k].y.raw, other_v[k].y.raw);
    }
}

/// What the worlds answer, the slow one's scaled: powers of two lose no bit.
void expect_same_answers(SlowTank& one, SlowTank& slow) {
    const float by = slow.slower;
    Motion motion[2];
    expect_ok(one.world->motion(one.block, &motion[0]));
    expect_ok(slow.world->motion(slow.block, &motion[1]));
    EXPECT_EQ(motion[0].position_m.x, motion[1].position_m.x);
    EXPECT_EQ(motion[0].angle_rad, motion[1].angle_rad);
    EXPECT_EQ(motion[0].velocity_mps.x, by * motion[1].velocity_mps.x);
    EXPECT_EQ(motion[0].spin_radps, by * motion[1].spin_radps);
    BodyForce force[2];
    expect_ok(one.world->tank_force(&force[0]));
    expect_ok(slow.world->tank_force(&force[1]));
    EXPECT_EQ(force[0].impulse_m3ps.y, by * force[1].impulse_m3ps.y);
    EXPECT_EQ(force[0].dt_s * by, force[1].dt_s);
    expect_ok(one.world->force(one.block, &force[0]));
    expect_ok(slow.world->force(slow.block, &force[1]));
    EXPECT_EQ(force[0].angular_impulse_m4ps, by * force[1].angular_impulse_m4ps);
    ASSERT_EQ(one.world->contacts().size, slow.world->contacts().size);
    for (std::int32_t k = 0; k < one.world->contacts().size; ++k) {
        const Contact& hit = one.world->contacts()[k];
        EXPECT_EQ(hit.impulse_m3ps.y, by * slow.world->contacts()[k].impulse_m3ps.y);
        EXPECT_EQ(hit.place_m.x, slow.world->contacts()[k].place_m.x);
    }
    Diagnostics sums[2];
    const auto by_exactly = static_cast<double>(by);
    expect_ok(one.world->diagnose(&sums[0]));
    expect_ok(slow.world->diagnose(&sums[1]));
    EXPECT_EQ(sums[0].momentum_m3ps.y, by_exactly * sums[1].momentum_m3ps.y);
    EXPECT_EQ(sums[0].angular_momentum_m4ps, by_exactly * sums[1].angular_momentum_m4ps);
    EXPECT_EQ(sums[0].kinetic_energy_m4ps2, by_exactly * by_exactly * sums[1].kinetic_energy_m4ps2);
    EXPECT_EQ(sums[0].potential_energy_m4ps2, by_exactly * by_exactly * sums[1].potential_energy_m4ps2);
    EXPECT_EQ(sums[0].divergence_per_s, by_exactly * sums[1].divergence_per_s);
    EXPECT_EQ(one.world->pressure_scale(), by * by * slow.world->pressure_scale());
    EXPECT_EQ(one.world->velocity_scale(), by * slow.world->velocity_scale());
    WorkBound bound[2];
    expect_ok(one.world->work_bound(1.0F / 60.0F, &bound[0]));
    expect_ok(slow.world->work_bound(by / 60.0F, &bound[1]));
    EXPECT_EQ(bound[0].step, bound[1].step);
}

// Three units of time, the same bits: a second, eight, and half of one.
TEST(UnitOfTime, WhatIsSlowerGoesTheSameWay) {
    for (const float slower : {8.0F, 0.5F}) {
        SCOPED_TRACE(slower);
        WorldDef plain = slow_def(1.0F);
        plain.top_speed_mps = 0.0F;
        SlowTank one(1.0F, plain);
        SlowTank slow(slower, slow_def(slower));
        bool was_asleep = false;
        for (int step = 0; step < 400; ++step) {
            if (step == 60) {
                one.stop();
                slow.stop();
            }
            const std::int32_t rung = step % 50 == 7 ? 4 : 0;
            const StepReport here = one.world->step(1.0F / 60.0F, rung);
            const StepReport there = slow.world->step(slower / 60.0F, rung);
            ASSERT_EQ(here.substeps, there.substeps) << step;
            ASSERT_EQ(here.clamped, there.clamped) << step;
            ASSERT_EQ(here.dt_s * slower, there.dt_s) << step;
            ASSERT_EQ(here.max_speed_mps, slower * there.max_speed_mps) << step;
            ASSERT_EQ(here.asleep, there.asleep) << step;
            was_asleep = was_asleep || here.asleep;
            expect_same_liquid(*one.world, *slow.world);
            if (step == 30 || step == 41) {
                expect_same_answers(one, slow);
            }
            if (::testing::Test::HasFailure()) {
                return;
            }
        }
        EXPECT_TRUE(was_asleep);
        ASSERT_EQ(one.world->set_gravity({0.0F, 9.81F}), Status::ok);
        ASSERT_EQ(slow.world->set_gravity({0.0F, 9.81F / (slower * slower)}), Status::ok);
        for (int step = 0; step < 30; ++step) {
            one.world->step(1.0F / 60.0F);
            slow.world->step(slower / 60.0F);
        }
        expect_same_liquid(*one.world, *slow.world);
    }
}

// A pool on each side of a block; in one a bar goes on turning.
TEST(UnitOfTime, RegionsFallAsleepAtTheSameStep) {
    std::vector<std::int32_t> asleep[2];
    for (const bool slow : {false, true}) {
        const float by = slow ? 16.0F : 1.0F;
        WorldDef def = small_def();
        def.capacity.cells_x = 40;
        def.capacity.particles = 600;
        def.capacity.sleeping_regions = true;
        def.top_speed_mps = slow ? kMaxSpeedSmallFixed * kCell / by : 0.0F;
        def.gravity_mps2.y = -9.81F / (by * by);
        def.sleep = {0.1F / by, 0.5F * by, 0.0F};
        TestWorld<SmallFixed> world(def);
        const Ring block = rectangle(0.2F, 0.4F);
        put_static(*world, body_of(block, {0.34F, 0.0F}));
        BodyDef bar = body_of(kSquare4cm, {0.62F, 0.06F});
        bar.motion.spin_radps = 6.0F / by;
        put_moving(*world, bar);
        expect_ok(world->let_regions_sleep());
        expect_ok(world->fill({{0.0F, 0.0F}, {0.24F, 0.06F}}));
        expect_ok(world->fill({{0.44F, 0.0F}, {0.8F, 0.1F}}));
        for (int step = 0; step < 300; ++step) {
            const StepReport report = world->step(by / 60.0F);
            ASSERT_FALSE(report.asleep);
            asleep[slow].push_back(report.particles_asleep);
        }
    }
    EXPECT_EQ(asleep[0], asleep[1]);
    EXPECT_EQ(asleep[0].back(), 4 * 36);
}

// Floats and Q15.16 know what is slow: not a bit changes.
WEIR_SUITE(OtherScalar, RoomyScalars);

TYPED_TEST(OtherScalar, HasNoNeedOfATopSpeed) {
    WorldDef def = small_def();
    TestWorld<TypeParam> plain(def);
    def.top_speed_mps = 0.1F;
    TestWorld<TypeParam> told(def);
    for (TestWorld<TypeParam>* world : {&plain, &told}) {
        expect_ok((*world)->fill({{0.0F, 0.0F}, {0.14F, 0.14F}}));
        for (int step = 0; step < 30; ++step) {
            (*world)->step(1.0F / 60.0F);
        }
    }
    EXPECT_EQ(plain->state_hash(), told->state_hash());
    EXPECT_EQ(told->velocity_scale(), def.cell_m);
}

Status init_at(float top_speed_mps, float gravity_mps2) {
    WorldDef def = small_def();
    def.top_speed_mps = top_speed_mps;
    def.gravity_mps2.y = gravity_mps2;
    const auto memory = measure::memory_for<SmallFixed>(def);
    World<SmallFixed> world;
    return world.init(def, memory.data(), memory.size());
}

TEST(UnitOfTime, WhatNoUnitBearsIsRefusedByName) {
    const float most = kMaxTopSpeedSmallFixed * kCell;
    EXPECT_EQ(init_at(kNan, 0.0F), Status::top_speed_out_of_range);
    EXPECT_EQ(init_at(kInf, 0.0F), Status::top_speed_out_of_range);
    EXPECT_EQ(init_at(-0.1F, 0.0F), Status::top_speed_out_of_range);
    EXPECT_EQ(init_at(1.001F * most, 0.0F), Status::top_speed_out_of_range);
    EXPECT_EQ(init_at(most, 0.0F), Status::ok);
    EXPECT_EQ(init_at(1.0e-30F, 0.0F), Status::ok);
    // As strong as the text says, and where units change twice as strong and not more.
    for (const float top : {0.3F, 0.6F, 1.0F, 2.0F, 5.0F}) {
        const float strongest = 0.46F * top * top / kCell;
        EXPECT_EQ(init_at(top, -strongest), Status::ok) << top;
        EXPECT_EQ(init_at(top, -4.1F * strongest), Status::gravity_out_of_range) << top;
    }
}

TEST(UnitOfTime, WhatIsFasterIsRefusedOrLimitedAndReported) {
    WorldDef def = small_def();
    def.top_speed_mps = 0.5F;  // 25 cells/s: a unit of 8 s, and room for 31.875
    def.gravity_mps2.y = -1.0F;
    TestWorld<SmallFixed> world(def);
    const float fastest = kMaxSpeedSmallFixed / 8.0F * def.cell_m;
    EXPECT_EQ(world->add_particle({0.1F, 0.1F}, {1.001F * fastest, 0.0F}),
              Status::velocity_out_of_range);
    EXPECT_EQ(world->add_particle({0.1F, 0.28F}, {0.0F, -0.999F * fastest}), Status::ok);
    BodyDef body = body_of(kSquare4cm, {0.2F, 0.1F});
    BodyId id;
    body.motion.velocity_mps.x = 1.001F * fastest;
    EXPECT_EQ(world->add_moving_body(body, &id), Status::motion_out_of_range);
    body.motion.velocity_mps.x = 0.0F;
    body.motion.spin_radps = 1.001F * kMaxAngle / 8.0F;
    EXPECT_EQ(world->add_moving_body(body, &id), Status::motion_out_of_range);
    body.motion.spin_radps = 0.0F;
    id = put_moving(*world, body);
    Motion motion;
    motion.position_m = {0.2F, 0.1F};
    motion.velocity_mps.y = -1.001F * fastest;
    EXPECT_EQ(world->set_motion(id, motion), Status::motion_out_of_range);

    bool limited = false;
    for (int step = 0; step < 20; ++step) {
        const StepReport report = world->step(1.0F / 60.0F);
        limited = limited || (report.particles_slowed > 0 && report.has(Clamped::speed));
        EXPECT_LE(report.max_speed_mps, fastest);
    }
    EXPECT_TRUE(limited);
    EXPECT_EQ(world->set_gravity({0.0F, -20.0F}), Status::ok);
    EXPECT_TRUE(world->step(1.0F / 60.0F).has(Clamped::gravity));
    EXPECT_EQ(world->set_gravity({0.0F, -9.0F}), Status::ok);
    EXPECT_FALSE(world->step(1.0F / 60.0F).has(Clamped::gravity));
}

TEST(UnitOfTime, StepsTooShortForItAreReported) {
    TestWorld<SmallFixed> world(slow_def(8.0F));
    EXPECT_TRUE(world->step(4.0e-9F).has(Clamped::time_step));
    EXPECT_FALSE(world->step(1.0e-6F).has(Clamped::time_step));
}

TEST(UnitOfTime, SnapshotsKeepIt) {
    const WorldDef def = slow_def(8.0F);
    SlowTank from(8.0F, def);
    for (int step = 0; step < 20; ++step) {
        from.world->step(0.1F);
    }
    std::vector<std::byte> snapshot(snapshot_bytes<SmallFixed>(def.capacity));
    std::size_t bytes = 0;
    ASSERT_EQ(from.world->save(snapshot.data(), snapshot.size(), &bytes), Status::ok);
    WorldDef faster = def;
    faster.top_speed_mps *= 2.0F;
    TestWorld<SmallFixed> other(faster);
    EXPECT_EQ(other->restore(snapshot.data(), bytes), Status::snapshot_of_other_definition);
    TestWorld<SmallFixed> same(def);
    ASSERT_EQ(same->restore(snapshot.data(), bytes), Status::ok);
    for (int step = 0; step < 20; ++step) {
        from.world->step(0.1F);
        same->step(0.1F);
    }
    EXPECT_EQ(from.world->state_hash(), same->state_hash());
}

// Slow liquid whose unit suits it comes to rest to the bit as fast liquid does.
TEST(UnitOfTime, WhatIsSlowComesToRest) {
    WorldDef def = tank_def(16, 16, 600);
    def.gravity_mps2.y = -0.1F;
    def.top_speed_mps = 0.4F;
    TestWorld<SmallFixed> world(def);
    ASSERT_EQ(world->fill({{0.0F, 0.0F}, {0.16F, 0.20F}}), Status::ok);
    for (int step = 0; step < 6000; ++step) {
        world->step(1.0F / 8.0F);
    }
    const std::uint64_t still = world->state_hash();
    double height = 0.0;
    for (const auto& at : world->particle_positions()) {
        height += static_cast<double>(at.y) / 320.0;
    }
    for (int step = 0; step < 100; ++step) {
        ASSERT_FALSE(world->step(1.0F / 8.0F).has(Clamped::speed));
        ASSERT_EQ(world->state_hash(), still) << step;
    }
    EXPECT_NEAR(height, 2.5, 0.025);
}

}  // namespace
}  // namespace weir
