// What random sequences of calls found that the contract had promised otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/packed_arithmetic.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;

WEIR_SUITE(Contract, EveryScalar);

TYPED_TEST(Contract, SnapshotsHaveRoomForManyBodies) {
    WorldDef def;
    def.capacity.particles = 16;
    def.capacity.vertices = 0;
    for (int bodies = 0; bodies < 200; bodies += 9) {
        def.capacity.bodies = static_cast<decltype(def.capacity.bodies)>(bodies);
        TestWorld<TypeParam> world{def};
        saved(*world, def.capacity);
    }
}

/// By the ladder's third rung, which holds bodies unless one was put elsewhere.
TYPED_TEST(Contract, LookingChangesNoFuture) {
    for (int way = 0; way < 3; ++way) {
        WorldDef def;
        def.capacity.bodies = 1;
        def.capacity.vertices = 8;
        def.capacity.particles = 500;
        TestWorld<TypeParam> left_alone{def};
        TestWorld<TypeParam> looked_at{def};
        for (TestWorld<TypeParam>* one : {&left_alone, &looked_at}) {
            BodyId id;
            expect_ok((*one)->fill({{0, 0}, {0.4F, 0.1F}}));
            expect_ok((*one)->add_moving_body(body_of(kSquare4cm, {0.3F, 0.3F}), &id));
            (*one)->step(kDt);
            Motion motion;
            motion.position_m = {0.3F, 0.12F};
            motion.velocity_mps = {0.1F, 0};
            expect_ok((*one)->set_motion(id, motion));
        }
        Diagnostics found;
        if (way == 0) {
            expect_ok(looked_at->diagnose(&found));
        } else if (way == 1) {
            EXPECT_EQ(looked_at->fill({{0, 0}, {0.6F, 0.4F}}), Status::no_free_particle);
        } else {
            EXPECT_EQ(looked_at->add_particle({0.3F, 0.12F}, {}), Status::particle_inside_solid);
        }
        EXPECT_EQ(left_alone->state_hash(), looked_at->state_hash());
        EXPECT_FALSE(left_alone->step(kDt, 3).walls_held);
        EXPECT_FALSE(looked_at->step(kDt, 3).walls_held);
        EXPECT_EQ(left_alone->state_hash(), looked_at->state_hash());
    }
}

/// Viscous liquid that is led to rest in fixed point.
TYPED_TEST(Contract, RestoredViscousLiquidGoesOn) {
    WorldDef def = tank_def(18, 32, 400);
    def.viscosity_m2ps = 0.12F;
    def.flip_ratio = 0.5F;
    TestWorld<TypeParam> world{def};
    TestWorld<TypeParam> other{def};
    world->step(kDt);
    world->step(kDt);
    change_worlds(world, other, def);
    std::mt19937 random(1);
    const auto number = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() % 1000) / 1000.0F;
    };
    for (int k = 0; k < 200; ++k) {
        const Vec2f at{number(0.1F, 0.2F), number(0.3F, 0.4F)};
        const Vec2f velocity{number(-5.0F, 5.0F), number(-5.0F, 5.0F)};
        expect_ok(world->add_particle(at, velocity));
        expect_ok(other->add_particle(at, velocity));
    }
    for (int k = 0; k < 3; ++k) {
        world->step(kDt);
        other->step(kDt);
        EXPECT_EQ(world->state_hash(), other->state_hash());
    }
}

TYPED_TEST(Contract, RestoredForcesKnowTheirTime) {
    WorldDef def;
    def.capacity.two_way = true;
    TestWorld<TypeParam> world{def};
    TestWorld<TypeParam> other{def};
    expect_ok(world->fill({{0, 0}, {0.3F, 0.2F}}));
    world->step(kDt);
    change_worlds(world, other, def);
    BodyForce force;
    BodyForce restored;
    expect_ok(world->tank_force(&force));
    expect_ok(other->tank_force(&restored));
    EXPECT_EQ(restored.dt_s, force.dt_s);
    EXPECT_EQ(restored.impulse_m3ps.y, force.impulse_m3ps.y);
}

TYPED_TEST(Contract, TinyPolygonsWeighNothing) {
    WorldDef def;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    def.capacity.two_way = true;
    TestWorld<TypeParam> world{def};
    expect_ok(world->fill({{0, 0}, {0.2F, 0.2F}}));
    for (const float side : {1e-6F, 1e-12F, 2e-22F}) {
        const Ring ring = rectangle(side, side);
        const std::uint64_t before = world->state_hash();
        BodyId id;
        EXPECT_NE(world->add_static_body(body_of(ring, {0.3F, 0.1F}), &id), Status::ok) << side;
        EXPECT_NE(world->add_free_body(body_of(ring, {0.3F, 0.1F}), &id), Status::ok) << side;
        EXPECT_EQ(world->state_hash(), before);
    }
    EXPECT_EQ(world->step(kDt).particles_reset, 0);
}

/// Of a round body that does not move, and of a fast one among many slots.
TYPED_TEST(Contract, BoundsOfContoursHold) {
    WorldDef def;
    def.capacity.bodies = 40;
    def.capacity.vertices = 64;
    def.capacity.two_way = true;
    for (const float speed : {0.0F, 0.1F}) {
        TestWorld<TypeParam> world{def};
        Vec2f ring[60];
        for (int k = 0; k < 60; ++k) {
            const float a = 0.1047F * static_cast<float>(k);
            ring[k] = {9.0F * std::cos(a), 9.0F * std::sin(a)};
        }
        BodyDef body;
        body.polygon = {ring, 60};
        body.motion.position_m = {0.3F, 0.3F};
        body.motion.velocity_mps = {speed, 0};
        put_moving(*world, body);
        for (int k = 0; k < 2; ++k) {
            WorkBound bound;
            expect_ok(world->work_bound(kDt, &bound));
            StepReport report;
            expect_ok(world->begin_step(kDt, &report));
            std::int64_t before = 0;
            for (bool done = false; !done;) {
                done = world->advance(1);
                const std::int64_t now = work_of(report);
                EXPECT_LE(now - before, bound.largest_item);
                before = now;
            }
            EXPECT_LE(report.work[0], bound.substep[0] * report.substeps);
            EXPECT_LE(before, bound.step);
        }
    }
}

/// Belts in SmallFixed make particles faster than the gather had found them.
TEST(ContractOfPackedWorlds, WhereAStepIsCutSlowsNobody) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        WorldDef def = tank_def(24, 24, 600);
        def.max_substeps = 1;
        def.gravity_mps2 = {0, -0.5F};
        def.walls = every_wall({0.0F, 1000.0F, false, 4.0F});
        TestWorld<SmallFixed> whole{def};
        TestWorld<SmallFixed> cut{def};
        const auto number = [&](float high) {
            return high * static_cast<float>(random() % 1000) / 1000.0F;
        };
        for (int k = 0; k < 500; ++k) {
            const float turn = number(6.28F);
            const float v = k == 0 ? 1.6F : 0.8F + number(0.3F);
            const Vec2f at{number(0.48F), number(0.48F)};
            const Vec2f velocity{v * std::cos(turn), v * std::sin(turn)};
            expect_ok(whole->add_particle(at, velocity));
            expect_ok(cut->add_particle(at, velocity));
        }
        const StepReport report = whole->step(1.0F / 30.0F);
        StepReport in_slices;
        expect_ok(cut->begin_step(1.0F / 30.0F, &in_slices));
        while (!cut->advance(300)) {
        }
        ASSERT_EQ(report.particles_slowed, in_slices.particles_slowed) << seed;
        ASSERT_EQ(whole->state_hash(), cut->state_hash()) << seed;
    }
}

/// Conveyors as fast as its numbers, and no faster; ends of what spins saturate.
TEST(ContractOfPackedWorlds, WhatIsTooFastSaturates) {
    WorldDef def;
    def.viscosity_m2ps = 1e-3F;
    def.walls.bottom.no_slip = true;
    def.walls.bottom.conveyor_mps = 400.0F;
    measure::WorldMemory room = measure::memory_for<SmallFixed>(def);
    World<SmallFixed> world;
    EXPECT_EQ(world.init(def, room.data(), room.size()), Status::conveyor_out_of_range);
    def.walls.bottom.conveyor_mps = 0.0F;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    def.capacity.particles = 3000;
    TestWorld<SmallFixed> spun{def};
    expect_ok(spun->fill({{0, 0}, {0.6F, 0.3F}}));
    const Ring ring = rectangle(0.32F, 0.06F);
    BodyDef bar = body_of(ring, {0.3F, 0.3F});
    bar.motion.spin_radps = 9999.0F;
    put_moving(*spun, bar);
    for (int k = 0; k < 20; ++k) {
        spun->step(kDt);
    }
    EXPECT_EQ(scaled(32767, 0x7FFFFFFF), -scaled(-32767, 0x7FFFFFFF) - 1);
    EXPECT_GT(scaled(32767, 0x7FFFFFFF), 0x7FF00000);
    EXPECT_EQ(scaled(-300, 12345), (-300 * 12345) >> 7);
}

WEIR_SUITE(ContractOfFreeBodies, RoomyScalars);

TYPED_TEST(ContractOfFreeBodies, NoneIsAddedInMidStep) {
    WorldDef def;
    def.capacity.bodies = 2;
    def.capacity.vertices = 8;
    def.capacity.two_way = true;
    TestWorld<TypeParam> world{def};
    expect_ok(world->fill({{0, 0}, {0.3F, 0.2F}}));
    StepReport report;
    expect_ok(world->begin_step(kDt, &report));
    world->advance(500);
    const std::uint64_t before = world->state_hash();
    BodyId id;
    EXPECT_EQ(world->add_free_body(body_of(kSquare4cm, {0.3F, 0.3F}), &id),
              Status::step_in_progress);
    EXPECT_EQ(world->state_hash(), before);
    while (!world->advance(500)) {
    }
}

/// Nor does a body that is refused leave anything, or make a name good that was not.
TYPED_TEST(ContractOfFreeBodies, ThoseThatAreRefusedTakeNothing) {
    WorldDef def;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    def.capacity.wall_edges = 4;
    def.capacity.two_way = true;
    TestWorld<TypeParam> world{def};
    const Ring block = rectangle(0.1F, 0.1F);
    const BodyId gone = put_static(*world, body_of(block, {0.1F, 0.1F}));
    expect_ok(world->remove_body(gone));
    const auto before = saved(*world, def.capacity);
    BodyId id;
    const Ring tiny = rectangle(1e-12F, 1e-12F);
    EXPECT_NE(world->add_static_body(body_of(tiny, {0.3F, 0.1F}), &id), Status::ok);
    EXPECT_EQ(saved(*world, def.capacity), before);
    const Ring line = {{0.0F, 0.0F}, {0.2F, 0.1F}};
    BodyDef wall = body_of(line, {0.1F, 0.1F});
    wall.open = true;
    EXPECT_EQ(world->add_static_body(wall, &id), Status::no_free_wall_edge);
    EXPECT_EQ(saved(*world, def.capacity), before);
    const Ring plate = rectangle(0.2F, 0.005F);
    EXPECT_EQ(world->add_moving_body(body_of(plate, {0.1F, 0.1F}), &id),
              Status::no_free_wall_edge);
    EXPECT_EQ(saved(*world, def.capacity), before);
    put_static(*world, body_of(block, {0.1F, 0.1F}));
    Motion motion;
    EXPECT_EQ(world->motion(gone, &motion), Status::stale_body);
}

/// Of one that was removed nothing is left that a restored world would not know of.
TYPED_TEST(ContractOfFreeBodies, TheLastOneLeavesNothing) {
    WorldDef def;
    def.capacity.bodies = 2;
    def.capacity.vertices = 16;
    def.capacity.two_way = true;
    TestWorld<TypeParam> world{def};
    TestWorld<TypeParam> other{def};
    expect_ok(world->fill({{0, 0}, {0.3F, 0.2F}}));
    BodyDef body = body_of(kSquare4cm, {0.1F, 0.1F});
    BodyId id = put_free(*world, body);
    expect_ok(world->remove_body(id));
    body.motion.velocity_mps = {0.1F, 0};
    id = put_moving(*world, body);
    world->step(kDt);
    change_worlds(world, other, def);
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(world->step(kDt, 3).walls_held, other->step(kDt, 3).walls_held);
        EXPECT_EQ(world->state_hash(), other->state_hash());
    }
    TestWorld<TypeParam> heavier{def};
    body.density_ratio = 2.0F;
    expect_ok(heavier->remove_body(put_free(*heavier, body)));
    TestWorld<TypeParam> lighter{def};
    body.density_ratio = 0.2F;
    expect_ok(lighter->remove_body(put_free(*lighter, body)));
    EXPECT_EQ(saved(*heavier, def.capacity), saved(*lighter, def.capacity));
}

}  // namespace
}  // namespace weir
