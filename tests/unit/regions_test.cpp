// Regions: a pool at rest sleeps beside one that splashes, costs nothing, changes nothing, and
// wakes before anything reaches it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "pools.hpp"

namespace weir {
namespace {

/// Places and velocities beyond a column, in the order of the places.
template <class Real>
std::vector<std::pair<std::pair<double, double>, std::pair<double, double>>> beyond(
    const World<Real>& world, double column) {
    std::vector<std::pair<std::pair<double, double>, std::pair<double, double>>> found;
    const auto x = world.particle_positions();
    const auto v = world.particle_velocities();
    for (std::int32_t k = 0; k < x.size; ++k) {
        if (static_cast<double>(x[k].x) > column) {
            found.push_back({{static_cast<double>(x[k].x), static_cast<double>(x[k].y)},
                             {static_cast<double>(v[k].x), static_cast<double>(v[k].y)}});
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Nearest that somebody awake is to somebody asleep, along the further axis, cells.
template <class Real>
double nearest_to_sleepers(const World<Real>& world, std::int32_t asleep) {
    const auto x = world.particle_positions();
    double nearest = 1e9;
    for (std::int32_t k = asleep; k < x.size; ++k) {
        for (std::int32_t n = 0; n < asleep; ++n) {
            const double dx = static_cast<double>(x[k].x) - static_cast<double>(x[n].x);
            const double dy = static_cast<double>(x[k].y) - static_cast<double>(x[n].y);
            nearest = std::min(nearest, std::max(std::abs(dx), std::abs(dy)));
        }
    }
    return nearest;
}

WEIR_SUITE(RegionsOf, EveryScalar);

TYPED_TEST(RegionsOf, OnePoolSleepsWhileTheOtherSplashes) {
    Pools<TypeParam> pools;
    pools.pour_left();
    pools.rest_right();
    const auto before = beyond(*pools, kMiddle);
    const auto density = static_cast<double>(pools->density().at(50, 3));
    const double pressure = static_cast<double>(pools->pressure_scale()) *
                            static_cast<double>(pools->pressure().at(50, 1));
    EXPECT_NEAR(density, 1.0, 0.1);
    EXPECT_NEAR(pressure, 9.81 * 0.13, 0.1 * 9.81 * 0.13);
    Diagnostics diagnostics;
    expect_ok(pools->diagnose(&diagnostics));
    const auto all = static_cast<double>(pools->particle_positions().size);
    EXPECT_NEAR(diagnostics.mass_m2, all / 4 * 4e-4, 1e-6);
    std::int32_t count = pools->particle_positions().size;
    for (int step = 0; step < 120; ++step) {
        if (step % 10 == 0) {
            pools.kick_left();
            ++count;
        }
        const StepReport report = pools->step(step % 3 == 0 ? kDt : 0.7F * kDt);
        ASSERT_EQ(report.particles_asleep, pools.right);
        ASSERT_EQ(report.particles, count);
        ASSERT_FALSE(report.asleep);
        ASSERT_GT(report.substeps, 0);
    }
    EXPECT_EQ(beyond(*pools, kMiddle), before) << "to the bit";
    EXPECT_EQ(static_cast<double>(pools->density().at(50, 3)), density);
    EXPECT_NEAR(static_cast<double>(pools->pressure_scale()) *
                    static_cast<double>(pools->pressure().at(50, 1)),
                pressure, 0.002 * pressure);
    EXPECT_TRUE(all_inside(*pools));
}

/// To what goes on the tank is empty where others sleep: the bits are those of a world without
/// them.
TYPED_TEST(RegionsOf, SleepersChangeNothing) {
    Pools<TypeParam> pools;
    pools.add_spinner();
    StepReport report;
    std::int32_t steps = 0;
    for (; steps < 900 && report.particles_asleep < pools.right; ++steps) {
        report = pools->step(kDt);
    }
    ASSERT_EQ(report.particles_asleep, pools.right);
    Pools<TypeParam> alone;
    alone.add_spinner();
    while (alone->particle_positions().size > 0) {
        expect_ok(alone->remove_particle(0));
    }
    for (std::int32_t step = 0; step < steps; ++step) {
        alone->step(kDt);
    }
    // Water that is let fall, spread over the pool's columns and around it.
    const Box drop{{8 * kCell, 2 * kCell}, {20 * kCell, 12 * kCell}};
    expect_ok(pools->fill(drop));
    expect_ok(alone->fill(drop));
    for (int step = 0; step < 25; ++step) {
        report = pools->step(kDt);
        alone->step(kDt);
        ASSERT_EQ(report.particles_asleep, pools.right) << step;
        const auto a = pools->particle_positions();
        const auto b = alone->particle_positions();
        ASSERT_EQ(a.size - pools.right, b.size);
        ASSERT_EQ(std::memcmp(a.data + pools.right, b.data,
                              static_cast<std::size_t>(b.size) * sizeof b[0]),
                  0)
            << step;
    }
}

/// All that wakes: with the step that comes next, or the one after it.
TYPED_TEST(RegionsOf, WhatComesNearWakes) {
    using Change = void (*)(Pools<TypeParam>&);
    struct Row {
        const char* name;
        Change change;
    };
    const Row rows[] = {
        {"tilt", [](Pools<TypeParam>& p) { expect_ok(p->set_gravity({0.3F, -9.8F})); }},
        {"drop just above it",
         [](Pools<TypeParam>& p) {
             expect_ok(p->fill({{48 * kCell, 11 * kCell}, {50 * kCell, 12 * kCell}}));
         }},
        {"particle in it",
         [](Pools<TypeParam>& p) {
             expect_ok(p->add_particle({50 * kCell, 4 * kCell}, {}));
         }},
        {"particle removed", [](Pools<TypeParam>& p) { expect_ok(p->remove_particle(3)); }},
        {"body put there",
         [](Pools<TypeParam>& p) {
             put_moving(*p, body_of(kSquare4cm, {50 * kCell, 8 * kCell}));
         }},
        {"static body put there",
         [](Pools<TypeParam>& p) {
             put_static(*p, body_of(kSquare4cm, {50 * kCell, 8 * kCell}));
         }},
        {"divider taken away",
         [](Pools<TypeParam>& p) {
             BodyId id;
             expect_ok(p->body_in_slot(0, &id));
             expect_ok(p->remove_body(id));
         }},
        {"body put nearer",
         [](Pools<TypeParam>& p) {
             const BodyId id = put_moving(*p, body_of(kSquare4cm, {50 * kCell, 20 * kCell}));
             EXPECT_EQ(p->step(kDt).particles_asleep, p.right) << "not yet";
             Motion motion;
             expect_ok(p->motion(id, &motion));
             motion.position_m.y = 8 * kCell;
             expect_ok(p->set_motion(id, motion));
         }},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(row.name);
        Pools<TypeParam> pools;
        pools.pour_left();
        pools.rest_right();
        row.change(pools);
        pools->step(kDt);
        const StepReport report = pools->step(kDt);
        EXPECT_EQ(report.particles_asleep, 0);
        const auto before = beyond(*pools, 36);
        for (int step = 0; step < 3; ++step) {
            EXPECT_EQ(pools->step(kDt).particles_asleep, 0);
        }
        EXPECT_NE(beyond(*pools, 36), before) << "it moves";
    }
}

/// Nothing is rounded: a world that slept as a region goes on with the bits of one that was stopped
/// there.
TYPED_TEST(RegionsOf, AwokenItGoesOnAsItWas) {
    Pools<TypeParam> pools;  // steps are so short that each is one substep
    Pools<TypeParam> twin(pools_def(), false);
    for (Pools<TypeParam>* each : {&pools, &twin}) {
        each->add_spinner();
    }
    StepReport report;
    for (int step = 0; step < 900 && report.particles_asleep == 0; ++step) {
        report = pools->step(0.5F * kDt);
        if (report.particles_asleep == 0) {
            twin->step(0.5F * kDt);
        }
    }
    ASSERT_EQ(report.particles_asleep, pools.right);
    for (int step = 0; step < 5; ++step) {
        pools->step(0.4F * kDt);
    }
    for (Pools<TypeParam>* each : {&pools, &twin}) {
        expect_ok((*each)->set_gravity({9.81F, 0.0F}));  // as strong as it was
    }
    for (int step = 0; step < 6; ++step) {
        EXPECT_EQ(pools->step(0.4F * kDt).particles_asleep, 0);
        twin->step(0.4F * kDt);
        const auto a = pools->particle_positions();
        const auto b = twin->particle_positions();
        ASSERT_EQ(std::memcmp(a.data, b.data, static_cast<std::size_t>(a.size) * sizeof a[0]), 0)
            << step;
    }
}

/// Who falls asleep in steps of another length than those who sleep already keeps its pressure.
TYPED_TEST(RegionsOf, PressureIsThatOfAnyStep) {
    Pools<TypeParam> pools;
    pools.add_spinner();
    StepReport report;
    for (int step = 0; step < 900 && report.particles_asleep < pools.right; ++step) {
        report = pools->step(kDt);
    }
    ASSERT_EQ(report.particles_asleep, pools.right);
    pools.pour_left();
    const std::int32_t all = pools->particle_positions().size;
    for (int step = 0; step < 1500 && report.particles_asleep < all; ++step) {
        report = pools->step(0.4F * kDt);
    }
    ASSERT_EQ(report.particles_asleep, all);
    const auto at_bottom = [&](std::int32_t column) {
        return static_cast<double>(pools->pressure_scale()) *
               static_cast<double>(pools->pressure().at(column, 1));
    };
    EXPECT_NEAR(at_bottom(50), 9.81 * 0.13, 0.1 * 9.81 * 0.13);
    EXPECT_NEAR(at_bottom(10), 9.81 * 0.09, 0.1 * 9.81 * 0.09);
}

/// A body that passes wakes before it touches.
TYPED_TEST(RegionsOf, BodiesThatComeNearWake) {
    Pools<TypeParam> pools;
    pools.pour_left();
    pools.rest_right();
    BodyDef bar = body_of(kSquare4cm, {50 * kCell, 20 * kCell});
    bar.motion.velocity_mps = {0.0F, -0.6F};
    const BodyId id = put_moving(*pools, bar);
    for (int step = 0; step < 60; ++step) {
        const StepReport report = pools->step(kDt);
        Motion motion;
        expect_ok(pools->motion(id, &motion));
        const float gap = motion.position_m.y / kCell - 1.0F - 8.0F;  // to the surface, cells
        if (report.particles_asleep > 0) {
            ASSERT_GT(gap, 2.0F);
        } else {
            ASSERT_LT(gap, 9.0F);
            return;
        }
    }
    FAIL() << "never woken";
}

/// Water poured over the divider wakes who sleeps behind it before it arrives.
TYPED_TEST(RegionsOf, WaterThatComesOverTheDividerWakes) {
    Pools<TypeParam> pools;
    pools.pour_left();
    pools.rest_right();
    std::int32_t added = 0;
    expect_ok(pools->fill({{0, 8 * kCell}, {20 * kCell, 24 * kCell}}, &added));
    const std::int32_t count = pools->particle_positions().size;
    expect_ok(pools->set_gravity({0.0F, -9.81F}));
    for (int step = 0; step < 300; ++step) {
        const StepReport report = pools->step(kDt);
        ASSERT_EQ(report.particles, count);
        ASSERT_EQ(pools->particle_positions().size, count);
        if (report.particles_asleep == 0) {
            EXPECT_GT(step, 3);
            ASSERT_TRUE(all_inside(*pools));
            return;
        }
        ASSERT_GT(nearest_to_sleepers(*pools, report.particles_asleep), 1.5) << step;
    }
    FAIL() << "never woken";
}

/// What was just let go is slow, too, and what turns round in the air: neither sleeps there.
TEST(Regions, NothingSleepsInTheAir) {
    for (std::int32_t phase = 0; phase < 12; ++phase) {
        Pools<float> pools;
        for (int step = 0; step < 40 + 5 * phase; ++step) {
            pools->step(kDt);
        }
        const std::int32_t first = pools->particle_positions().size;
        expect_ok(pools->add_particle({10 * kCell, 2 * kCell}, {0.0F, 2.0F}));
        expect_ok(pools->fill({{16 * kCell, 18 * kCell}, {20 * kCell, 22 * kCell}}));
        static_cast<void>(first);
        for (int step = 0; step < 120; ++step) {
            const StepReport report = pools->step(kDt);
            const auto x = pools->particle_positions();
            for (std::int32_t k = 0; k < report.particles_asleep; ++k) {
                ASSERT_TRUE(x[k].x > 32.0F || x[k].y < 2.0F) << x[k].x << " " << x[k].y;
            }
        }
    }
}

TEST(Regions, SnapshotDoesNotTellWhetherAnybodyLooked) {
    Pools<float> pools;
    pools.add_spinner();
    pools.pour_left();
    pools.rest_right();
    if (testing::Test::HasFatalFailure()) {
        return;
    }
    const std::vector<std::byte> before = saved(*pools, pools_def().capacity);
    static_cast<void>(pools->pressure());
    static_cast<void>(pools->density());
    EXPECT_EQ(saved(*pools, pools_def().capacity), before);
    expect_ok(pools->restore(before.data(), before.size()));
    EXPECT_EQ(saved(*pools, pools_def().capacity), before);
}

TEST(Regions, WhoDoesNotAskHasTheBitsOfBefore) {
    WorldDef def = pools_def();
    def.capacity.sleeping_regions = false;
    Pools<float> plain(def, false);
    Pools<float> roomy(pools_def(), false);
    for (int step = 0; step < 20; ++step) {
        plain->step(kDt);
        EXPECT_EQ(roomy->step(kDt).particles_asleep, 0);
    }
    EXPECT_EQ(roomy->state_hash(), plain->state_hash());
    EXPECT_EQ(plain->let_regions_sleep(), Status::regions_missing);
}

TEST(Regions, RefusedWhereTheyCannotBe) {
    using Change = void (*)(WorldDef&);
    const Change changes[] = {
        [](WorldDef& def) { def.capacity.two_way = true; },
        [](WorldDef& def) {
            def.capacity.bodies = 0;
            def.capacity.window_cells = 66 * 18;
        },
        [](WorldDef& def) {
            def.capacity.bodies = 0;
            def.periodic_x = true;
        },
        [](WorldDef& def) { def.capacity.bodies = 0, def.periodic_y = true; },
    };
    for (const Change change : changes) {
        WorldDef def = pools_def();
        change(def);
        const auto memory = measure::memory_for<float>(def);
        World<float> world;
        EXPECT_EQ(world.init(def, memory.data(), memory.size()), Status::regions_out_of_place);
    }
    World<float> none;
    EXPECT_EQ(none.let_regions_sleep(), Status::not_initialised);
    Pools<float> pools;
    expect_ok(pools->let_regions_sleep());  // once more changes nothing
    StepReport report;
    expect_ok(pools->begin_step(kDt, &report));
    EXPECT_EQ(pools->let_regions_sleep(), Status::step_in_progress);
    // A snapshot with sleepers is not for a world in which regions do not sleep.
    Pools<float> other(pools_def(), false);
    std::vector<std::byte> room(snapshot_bytes<float>(pools_def().capacity));
    expect_ok(other->save(room.data(), room.size()));
    EXPECT_EQ(pools->restore(room.data(), room.size()), Status::snapshot_of_other_definition);
}

/// More regions than there are numbers: the last ones share theirs.
TEST(Regions, MoreThanThereAreNumbers) {
    WorldDef def = pools_def();
    def.capacity.cells_x = 256;
    def.capacity.cells_y = 256;
    def.capacity.bodies = 0;
    def.capacity.vertices = 0;
    def.gravity_mps2 = {};
    TestWorld<float> world(def);
    expect_ok(world->let_regions_sleep());
    std::int32_t count = 0;
    for (std::int32_t j = 4; j < 256; j += 12) {
        for (std::int32_t i = 4; i < 256; i += 12, ++count) {
            expect_ok(world->add_particle({static_cast<float>(i) * kCell,
                                           static_cast<float>(j) * kCell}, {}));
        }
    }
    ASSERT_GT(count, 400);
    expect_ok(world->add_particle({2 * kCell, 255 * kCell}, {0.05F, 0.0F}));
    StepReport report;
    for (int step = 0; step < 70; ++step) {
        report = world->step(kDt);
    }
    EXPECT_EQ(report.particles_asleep, count);
    const auto last = world->particle_positions()[count - 1];
    expect_ok(world->add_particle({last.x * kCell, last.y * kCell}, {0.1F, 0.0F}));
    world->step(kDt);
    report = world->step(kDt);
    EXPECT_LT(report.particles_asleep, count);
    EXPECT_EQ(report.particles, count + 2);
    for (int step = 0; step < 120; ++step) {
        world->step(kDt);
    }
    EXPECT_TRUE(all_inside(*world));
}

}  // namespace
}  // namespace weir
