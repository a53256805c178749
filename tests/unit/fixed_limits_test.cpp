// What fixed point refuses beyond what floats do, and what it saturates at.
#include <algorithm>
#include <cmath>

#include "bad_input.hpp"
#include "measure/world_memory.hpp"

namespace weir {

namespace {

// Kinds of fixed-point numbers are converted by public headers alone.
static_assert(FixedPoint<8>(Fixed(-2.5)).raw == -640 && FixedPoint<24>(Fixed(300)).raw == kMostRaw);

template <class Real>
Status init(const WorldDef& def) {
    const auto memory = measure::memory_for<Real>(def);
    World<Real> world;
    return world.init(def, memory.data(), memory.size());
}

template <class Real>
Status init_changed(void (*change)(WorldDef&)) {
    WorldDef def = small_def();
    change(def);
    return init<Real>(def);
}

#define CHANGED_INIT(Real, field, value) \
    [](Fixture&) { return init_changed<Real>([](WorldDef& def) { def.field = value; }); }

}  // namespace

const std::vector<Row>& fixed_rows() {
    static const std::vector<Row> rows = {
        {"wider than Fixed", CHANGED_INIT(Fixed, capacity.cells_x, 257),
         Status::cells_out_of_range},
        {"taller than SmallFixed", CHANGED_INIT(SmallFixed, capacity.cells_y, 256),
         Status::cells_out_of_range},
        {"gravity beyond Fixed", CHANGED_INIT(Fixed, gravity_mps2.x, 601.0F),
         Status::gravity_out_of_range},
        {"top speed NaN", CHANGED_INIT(SmallFixed, top_speed_mps, kNan),
         Status::top_speed_out_of_range},
        {"top speed below 0", CHANGED_INIT(float, top_speed_mps, -0.1F),
         Status::top_speed_out_of_range},
        {"top speed beyond SmallFixed", CHANGED_INIT(SmallFixed, top_speed_mps, 41.0F),
         Status::top_speed_out_of_range},
        {"gravity beyond a low top speed", CHANGED_INIT(SmallFixed, top_speed_mps, 0.3F),
         Status::gravity_out_of_range},
        {"tension beyond Fixed", CHANGED_INIT(Fixed, surface_tension_m3ps2, 0.25F),
         Status::surface_tension_out_of_range},
        {"more bodies than SmallFixed", CHANGED_INIT(SmallFixed, capacity.bodies, 256),
         Status::body_capacity_out_of_range},
        {"two liquids in SmallFixed", CHANGED_INIT(SmallFixed, capacity.second_liquid, true),
         Status::small_fixed_has_one_liquid},
        {"moving where only static ones are",
         [](Fixture&) {
             WorldDef def = small_def();
             def.capacity.moving_bodies = false;
             TestWorld<SmallFixed> world(def);
             BodyId id;
             return world->add_moving_body(body_of(kSquare4cm, {0.1F, 0.1F}), &id);
         },
         Status::no_moving_bodies},
        {"thin walls in SmallFixed", CHANGED_INIT(SmallFixed, capacity.wall_edges, 1),
         Status::small_fixed_has_no_thin_walls},
        {"polyline in SmallFixed",
         [](Fixture&) {
             TestWorld<SmallFixed> world(small_def());
             BodyDef def = body_of(kSquare4cm, {0.1F, 0.1F});
             def.open = true;
             BodyId id;
             return world->add_static_body(def, &id);
         },
         Status::small_fixed_has_no_thin_walls},
        {"free body in SmallFixed, without forces",
         [](Fixture&) {
             TestWorld<SmallFixed> world(small_def());
             BodyId id;
             return world->add_free_body(body_of(kSquare4cm, {0.1F, 0.1F}), &id);
         },
         Status::free_body_in_small_world},
        {"window in SmallFixed", CHANGED_INIT(SmallFixed, capacity.window_cells, 100),
         Status::small_fixed_has_no_window},
        {"tension in SmallFixed", CHANGED_INIT(SmallFixed, surface_tension_m3ps2, 1.0e-5F),
         Status::small_fixed_has_no_tension},
    };
    return rows;
}

namespace {

TEST(FixedLimits, Init) { check_all(fixed_rows()); }

using Both = testing::Types<Fixed, SmallFixed>;
WEIR_SUITE(FixedWorld, Both);

TYPED_TEST(FixedWorld, TheLargestIsAccepted) {
    WorldDef def = small_def();
    def.capacity.cells_x = def.capacity.cells_y = 255;
    def.capacity.bodies = kMaxBodiesSmallFixed;
    EXPECT_EQ(init<TypeParam>(def), Status::ok);
}

TYPED_TEST(FixedWorld, TooFastAndTooFarAreRefused) {
    TestWorld<TypeParam> world(small_def());
    const float fastest = std::is_same<TypeParam, Fixed>::value ? kMaxSpeedFixed
                                                                : kMaxSpeedSmallFixed;
    EXPECT_EQ(world->add_particle({0.1F, 0.1F}, {fastest * 0.02F * 1.01F, 0.0F}),
              Status::velocity_out_of_range);
    EXPECT_EQ(world->add_particle({0.1F, 0.1F}, {fastest * 0.02F * 0.99F, 0.0F}), Status::ok);
    BodyId id;
    EXPECT_EQ(world->add_moving_body(body_of(kSquare4cm, {400.0F, 0.0F}), &id),
              Status::position_out_of_range);
    BodyDef fast = body_of(kSquare4cm, {0.1F, 0.1F});
    fast.motion.velocity_mps.x = 400.0F;
    EXPECT_EQ(world->add_moving_body(fast, &id), Status::motion_out_of_range);
}

TYPED_TEST(FixedWorld, GravityIsLimitedAndReported) {
    TestWorld<TypeParam> world(small_def());
    EXPECT_EQ(world->fill({{0, 0}, {0.1F, 0.1F}}), Status::ok);
    EXPECT_EQ(world->set_gravity({0.0F, -900.0F}), Status::ok);
    EXPECT_TRUE(world->step(1.0F / 60.0F).has(Clamped::gravity));
    EXPECT_TRUE(all_inside(*world));
}

/// A thousand particles in one cell, as fast as they may be, under the strongest gravity.
TYPED_TEST(FixedWorld, AThousandParticlesInACellSaturate) {
    WorldDef def = small_def();
    def.capacity.particles = 1000;
    TestWorld<TypeParam> world(def);
    for (int k = 0; k < 1000; ++k) {
        const float x = 0.02F * (8.1F + 0.8F * static_cast<float>(k % 32) / 32.0F);
        const float y = 0.02F * (8.1F + 0.8F * static_cast<float>(k / 32) / 32.0F);
        ASSERT_EQ(world->add_particle({x, y}, {k % 2 == 0 ? 5.0F : 4.0F, -5.0F}), Status::ok);
    }
    ASSERT_EQ(world->set_gravity({0.0F, -500.0F}), Status::ok);
    for (int step = 0; step < 60; ++step) {
        const StepReport report = world->step(1.0F / 60.0F);
        ASSERT_EQ(report.particles, 1000);
        ASSERT_TRUE(all_inside(*world)) << step;
        // Thrown to the right and down: a sum that wrapped around would send them back at once.
        if (step == 0) {
            double right = 0.0;
            for (const auto& v : world->particle_velocities()) {
                right += static_cast<double>(v.x);
            }
            EXPECT_GT(right, 0.0);
        }
    }
}

/// How high a thousand particles in one place are that were thrown down from 8.25 cells.
template <class Real>
double height_of_crowd(StepReport& report) {
    WorldDef def = small_def();
    def.capacity.particles = 1000;
    def.gravity_mps2 = {};
    TestWorld<Real> world(def);
    for (int k = 0; k < 1000; ++k) {
        EXPECT_EQ(world->add_particle({0.165F, 0.165F}, {0.0F, -100.0F * def.cell_m}), Status::ok);
    }
    report = world->step(1.0e-3F);
    return static_cast<double>(world->particle_positions()[0].y);
}

/// Their momentum is more than a face can hold: as long as it saturated they were carried at half
/// their speed, and what falls so gains what it does not lose in height.
TEST(FixedLimits, ACrowdIsCarriedAsFastAsItGoesAndReported) {
    StepReport report;
    const double expected = height_of_crowd<double>(report);
    EXPECT_EQ(report.particles_crowded, 0);
    EXPECT_NEAR(height_of_crowd<Fixed>(report), expected, 1.0e-3);
    EXPECT_GT(report.particles_crowded, 0);
}

/// A pool that was poured, and one that was a dam before: not a bit of their state changes any
/// more, after a time that is chance. Velocities and pressure went round in last digits.
TEST(FixedLimits, WhatIsAtRestStaysAsItIs) {
    for (const Box& box : {Box{{0.0F, 0.0F}, {0.32F, 0.16F}}, Box{{0.0F, 0.0F}, {0.16F, 0.2F}}}) {
        WorldDef def = small_def();
        def.capacity.particles = 600;
        TestWorld<Fixed> world(def);
        ASSERT_EQ(world->fill(box), Status::ok);
        for (int step = 0; step < 12000; ++step) {
            world->step(1.0F / 60.0F);
        }
        const std::uint64_t still = world->state_hash();
        for (int step = 0; step < 100; ++step) {
            world->step(1.0F / 60.0F);
            ASSERT_EQ(world->state_hash(), still) << step;
        }
    }
}

/// What slow particles of a pool move by in the first step after it was poured, cells/s, summed.
/// It does not stand where a lattice at rest would.
template <class Real>
double first_creep() {
    WorldDef def = small_def();
    def.capacity.particles = 600;
    TestWorld<Real> world(def);
    for (int k = 0; k < 32 * 16; ++k) {
        const Vec2f at{0.34F + 0.5F * static_cast<float>(k % 32),
                       0.31F + 0.5F * static_cast<float>(k / 32)};
        EXPECT_EQ(world->add_particle({def.cell_m * at.x, def.cell_m * at.y}, {}), Status::ok);
    }
    world->step(1.0F / 60.0F);
    double sum = 0.0;
    for (const auto& v : world->particle_velocities()) {
        for (const double one : {static_cast<double>(v.x), static_cast<double>(v.y)}) {
            sum += std::fabs(one) < 1.0 / 256.0 ? std::fabs(one) : 0.0;
        }
    }
    return sum;
}

/// It is not led to rest before it has shown how fast it is: half of what was slow was lost.
TEST(FixedLimits, WhatWasJustPutThereIsNotLedToRest) {
    const double exact = first_creep<double>();
    EXPECT_GT(exact, 0.01);
    EXPECT_NEAR(first_creep<Fixed>(), exact, 0.1 * exact);
}

/// The speed that a blow leaves is rounded when it is kept. Reports were up to half a unit short.
TEST(FixedLimits, NothingIsFasterThanReportedAfterABlow) {
    WorldDef def = small_def();
    TestWorld<SmallFixed> world(def);
    put_static(*world, body_of(rectangle(0.16F, 0.08F), {0.16F, 0.06F}, 0.2F));
    ASSERT_EQ(world->fill({{0.1F, 0.2F}, {0.22F, 0.3F}}), Status::ok);
    for (int step = 0; step < 300; ++step) {
        const StepReport report = world->step(1.0F / 60.0F);
        double fastest = 0.0;
        for (const auto& v : world->particle_velocities()) {
            fastest = std::max({fastest, std::fabs(static_cast<double>(v.x)),
                                std::fabs(static_cast<double>(v.y))});
        }
        const auto unit = static_cast<double>(world->velocity_scale());
        ASSERT_LE(fastest * unit, static_cast<double>(report.max_speed_mps) * 1.000001) << step;
    }
}

/// The same where particles are slowed down to a limit that packed velocities do not know.
TEST(FixedLimits, NothingIsFasterThanReportedWhereItIsLimited) {
    WorldDef def = small_def();
    def.max_substeps = 1;
    TestWorld<SmallFixed> world(def);
    ASSERT_EQ(world->add_particle({0.1F, 0.3F}, {0.0F, -200.0F * def.cell_m}), Status::ok);
    const StepReport report = world->step(0.0123F);
    EXPECT_EQ(report.particles_slowed, 1);
    const auto speed = static_cast<double>(world->particle_velocities()[0].y);
    EXPECT_LE(std::fabs(speed) * static_cast<double>(world->velocity_scale()),
              static_cast<double>(report.max_speed_mps) * 1.000001);
}

/// A step that suits the viscosity just so was reported as one that does not, by rounding.
TEST(FixedLimits, ViscosityThatSubstepsBearIsNotReported) {
    WorldDef def = small_def();
    def.gravity_mps2 = {};
    def.max_substeps = 32;
    constexpr float kStep = 1.0F / 240.0F;
    def.viscosity_m2ps = 2.0F * def.cell_m * def.cell_m / kStep;
    TestWorld<Fixed> world(def);
    ASSERT_EQ(world->fill({{0.1F, 0.1F}, {0.2F, 0.2F}}), Status::ok);
    const StepReport report = world->step(kStep);
    EXPECT_EQ(report.substeps, 8);
    EXPECT_FALSE(report.has(Clamped::viscosity));
}

}  // namespace

}  // namespace weir
