// World<SmallFixed>: what its whole-number stages promise.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <vector>

#include "grid/diffuse.hpp"
#include "measure/format_wave.hpp"
#include "measure/world_memory.hpp"
#include "pressure/level_packed.hpp"
#include "pressure/surface_level.hpp"
#include "step/transfer_packed.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

using Place = PositionOf<SmallFixed>;
using Speed = VelocityOf<SmallFixed>;

struct Grid {
    static constexpr std::int32_t kCells = 12;
    std::vector<Speed> mass_u = fields(), mass_v = fields();
    std::vector<SmallFixed> momentum_u = momenta(), momentum_v = momenta();
    StaggeredGrid<SmallFixed> grid;

    Grid() {
        grid.shape = {kCells, kCells, kCells + 2};
        grid.mass_u = mass_u.data();
        grid.mass_v = mass_v.data();
        grid.u = reinterpret_cast<Speed*>(momentum_u.data());
        grid.v = reinterpret_cast<Speed*>(momentum_v.data());
    }
    static std::vector<Speed> fields() { return std::vector<Speed>((kCells + 2) * (kCells + 2)); }
    static std::vector<SmallFixed> momenta() {
        return std::vector<SmallFixed>((kCells + 2) * (kCells + 2));
    }
    template <class Field>
    static std::int64_t sum(const std::vector<Field>& field) {
        std::int64_t all = 0;
        for (const Field& value : field) {
            all += value.raw;
        }
        return all;
    }
};

struct Pool {
    std::vector<Vec2<Place>> position;
    std::vector<Vec2<Speed>> velocity;

    void add(std::uint32_t x, std::uint32_t y, std::int32_t u, std::int32_t v) {
        position.push_back({Place::of_raw(static_cast<std::uint16_t>(x)),
                            Place::of_raw(static_cast<std::uint16_t>(y))});
        velocity.push_back({Speed::of_raw(static_cast<std::int16_t>(u)),
                            Speed::of_raw(static_cast<std::int16_t>(v))});
    }
    Particles<SmallFixed> particles() {
        const auto count = static_cast<std::int32_t>(position.size());
        return {position.data(), velocity.data(), count, count};
    }
};

// Not one unit of mass or momentum is lost between particles and faces, whatever the places.
TEST(Packed, FacesHoldWhatParticlesGave) {
    std::mt19937 random(1);
    Pool pool;
    std::int64_t u = 0;
    std::int64_t v = 0;
    for (int k = 0; k < 500; ++k) {
        const auto at = [&] {
            return 4U + static_cast<std::uint32_t>(random() % (Grid::kCells * 256 - 8));
        };
        const auto speed = [&] { return static_cast<std::int32_t>(random() % 65536) - 32768; };
        pool.add(at(), at(), speed(), speed());
        u += pool.velocity.back().x.raw;
        v += pool.velocity.back().y.raw;
    }
    Grid grid;
    ASSERT_EQ(scatter_packed(pool.particles(), grid.grid), 0);
    EXPECT_EQ(Grid::sum(grid.mass_u), 256 * 500);
    EXPECT_EQ(Grid::sum(grid.mass_v), 256 * 500);
    EXPECT_EQ(Grid::sum(grid.momentum_u), 256 * 4 * u);
    EXPECT_EQ(Grid::sum(grid.momentum_v), 256 * 4 * v);
}

// A thousand particles in one cell, all as fast as can be: faces fill up, nothing wraps around.
TEST(Packed, CrowdedFacesSaturateAndSaySo) {
    for (const std::int32_t speed : {32767, -32768}) {
        Pool pool;
        for (std::uint32_t k = 0; k < 1000; ++k) {
            pool.add(5 * 256 + k % 256, 5 * 256 + k / 4 % 256, speed, speed);
        }
        Grid grid;
        EXPECT_GT(scatter_packed(pool.particles(), grid.grid), 1000);
        for (std::size_t k = 0; k < grid.mass_u.size(); ++k) {
            const std::int32_t mass = grid.mass_u[k].raw;
            ASSERT_GE(mass, 0);
            ASSERT_LE(mass, 33 * 256);
            ASSERT_EQ(grid.momentum_u[k].raw, mass * 4 * speed);
        }
    }
}

TEST(Packed, ACrowdIsReportedAndComesApart) {
    WorldDef def = tank_def(16, 16, 1000);
    def.gravity_mps2 = {0.0F, -100.0F};
    const auto memory = measure::memory_for<SmallFixed>(def);
    World<SmallFixed> world;
    ASSERT_EQ(world.init(def, memory.data(), memory.size()), Status::ok);
    for (int k = 0; k < 1000; ++k) {
        const Vec2f at{0.16F + 0.0006F * static_cast<float>(k % 32),
                       0.16F + 0.0006F * static_cast<float>(k / 32)};
        const float speed = k % 2 == 0 ? 5.0F : -5.0F;
        ASSERT_EQ(world.add_particle(at, {speed, -speed}), Status::ok);
    }
    EXPECT_GT(world.step(1.0F / 64.0F).particles_crowded, 0);
    StepReport report;
    for (int step = 0; step < 600; ++step) {
        report = world.step(1.0F / 64.0F);
        ASSERT_EQ(report.particles, 1000);
    }
    EXPECT_EQ(report.particles_crowded, 0);
    for (const Vec2<Place>& at : world.particle_positions()) {
        ASSERT_LT(at.x.raw, 16 * 256);
        ASSERT_LT(at.y.raw, 16 * 256);
    }
}

// A pool that was poured, and one that was a dam before: not a bit of their state changes any more,
// and pressure is solved no more.
TEST(Packed, WhatIsAtRestStaysAsItIs) {
    struct Case {
        double wide, high;
        int steps;
    };
    for (const Case& one : {Case{0.32, 0.16, 300}, Case{0.16, 0.20, 6000}}) {
        WorldDef def = tank_def(16, 16, 600);
        def.cell_m = 0.02F;
        const auto memory = measure::memory_for<SmallFixed>(def);
        World<SmallFixed> world;
        ASSERT_EQ(world.init(def, memory.data(), memory.size()), Status::ok);
        const Box box{{0.0F, 0.0F}, {static_cast<float>(one.wide), static_cast<float>(one.high)}};
        ASSERT_EQ(world.fill(box), Status::ok);
        StepReport report = world.step(1.0F / 60.0F);
        const std::uint32_t work = report.work[static_cast<int>(Stage::pressure)];
        for (int step = 0; step < one.steps; ++step) {
            report = world.step(1.0F / 60.0F);
        }
        const std::uint64_t still = world.state_hash();
        for (int step = 0; step < 100; ++step) {
            report = world.step(1.0F / 60.0F);
            ASSERT_EQ(world.state_hash(), still) << one.steps << " steps, and " << step;
        }
        EXPECT_LT(report.work[static_cast<int>(Stage::pressure)], work / 2);
        EXPECT_LE(report.max_speed_mps, 0.005F);
        double height = 0.0;
        for (const Vec2<Place>& at : world.particle_positions()) {
            height += static_cast<double>(at.y) / report.particles;
        }
        EXPECT_NEAR(height, 0.5 * one.wide * one.high / (0.32 * 0.02), 0.01 * height);
    }
}

// What leads liquid to rest does not hold back what was at rest until now.
TEST(Packed, WhatIsLetGoFallsAtOnce) {
    WorldDef def = tank_def(16, 16, 64);
    def.cell_m = 0.02F;
    const auto memory = measure::memory_for<SmallFixed>(def);
    World<SmallFixed> world;
    ASSERT_EQ(world.init(def, memory.data(), memory.size()), Status::ok);
    ASSERT_EQ(world.fill({{0.12F, 0.20F}, {0.20F, 0.28F}}), Status::ok);
    EXPECT_NEAR(world.step(1.0F / 60.0F).max_speed_mps, 9.81 / 60.0, 0.01 * 9.81 / 60.0);
}

/// Without names at nodes: a sticky bar turns among viscous liquid, and is taken away.
TEST(Packed, OneBodyAloneHasTheBitsOfOneWithRoomForMore) {
    std::vector<float> places[2];
    for (std::int32_t room = 1; room <= 2; ++room) {
        WorldDef def = small_def();
        def.capacity.bodies = room;
        def.viscosity_m2ps = 1.0e-3F;
        TestWorld<SmallFixed> world(def);
        const Ring ring = rectangle(0.16F, 0.03F);
        BodyDef bar = body_of(ring, {0.17F, 0.07F}, 0.4F);
        bar.surface.no_slip = true;
        bar.motion.spin_radps = 6.0F;
        const BodyId id = put_moving(*world, bar);
        ASSERT_EQ(world->fill({{0.0F, 0.0F}, {0.09F, 0.18F}}), Status::ok);
        for (int step = 0; step < 200; ++step) {
            if (step == 150) {
                ASSERT_EQ(world->remove_body(id), Status::ok);
            }
            world->step(1.0F / 60.0F);
            for (const auto& at : world->particle_positions()) {
                places[room - 1].push_back(static_cast<float>(at.x));
                places[room - 1].push_back(static_cast<float>(at.y));
            }
        }
    }
    EXPECT_EQ(places[0], places[1]);
}

void expect_as_in_double(measure::WaveCase wave) {
    const measure::Wave exact = measure::run_wave<double>(wave);
    const measure::Wave packed = measure::run_wave<SmallFixed>(wave);
    EXPECT_NEAR(packed.period / exact.period, 1.0, 0.005);
    EXPECT_NEAR(packed.height, exact.height, 0.01 * wave.periods);
}

// A fifth of a cell a step, and a top speed that is told: five times slower without.
TEST(Packed, SlowWavesAreThoseOfDouble) {
    measure::WaveCase wave;
    wave.cells_per_step = 0.2;
    wave.periods = 3.0;
    expect_as_in_double(wave);
}

// 32 rows, six sweeps: with the factor that is best for many the pressure swings, and waves die.
TEST(Packed, DeepWavesAreThoseOfDoubleWithFewSweeps) {
    measure::WaveCase wave;
    wave.cells = 64;
    wave.sweeps = 6;
    wave.periods = 3.0;
    expect_as_in_double(wave);
}

TEST(Packed, LevelsAreThoseOfTheFormula) {
    for (std::int32_t density = 0; density <= 300; ++density) {
        const double level = level_of_density(density / 256.0);
        EXPECT_NEAR(packed_level(density) + kHeadRaw, 64.0 * level, 0.5001) << density;
    }
}

// Of four substeps as many change a velocity as there are quarters of a unit to change it by.
TEST(Packed, SmallChangesAddUp) {
    const Speed here = Speed::of_raw(-70);
    for (std::int32_t eighths = -20; eighths <= 20; ++eighths) {
        std::int32_t units = 0;
        for (std::uint32_t turn = 0; turn < 4; ++turn) {
            const SmallFixed now =
                changed(here, here + SmallFixed::of_raw(64 * eighths), rounded_from(turn));
            EXPECT_EQ(now.raw % 512, 0);
            units += now.raw / 512 - here.raw;
        }
        EXPECT_LE(std::abs(2 * units - eighths), 1) << eighths;
    }
    EXPECT_EQ(Speed(changed(Speed::of_raw(32767), SmallFixed(1.0e4F), kNearest)).raw, 32767);
    EXPECT_EQ(Speed(changed(Speed::of_raw(-32768), SmallFixed(-3.0e4F), 64)).raw, -32768);
}

// Couette flow of Re 10 in a channel of 32 cells: near its end a step changes velocities by less
// than half a unit, and always rounded to the nearest it would stay 3 % off.
TEST(Packed, GentleBendsOfViscousFlowAreFelt) {
    constexpr float kSpeed = 0.64F;
    constexpr std::int32_t kCells = 32;
    WorldDef def = tank_def(8, kCells, 4 * 8 * kCells);
    def.gravity_mps2 = {};
    def.periodic_x = true;
    def.walls.bottom.no_slip = true;
    def.walls.top.no_slip = true;
    def.walls.top.conveyor_mps = -kSpeed;
    const float height = def.cell_m * static_cast<float>(kCells);
    def.viscosity_m2ps = kSpeed * height / 10.0F;
    def.top_speed_mps = 1.25F * kSpeed;
    TestWorld<SmallFixed> world(def);
    ASSERT_EQ(world->fill({{0.0F, 0.0F}, {0.16F, height}}), Status::ok);
    for (int step = 0; step < 640; ++step) {  // h² / viscosity is 10 s
        world->step(1.0F / 64.0F);
    }
    double off = 0.0;
    double norm = 0.0;
    const auto places = world->particle_positions();
    const auto speeds = world->particle_velocities();
    for (std::int32_t k = 0; k < places.size; ++k) {
        const double exact = static_cast<double>(kSpeed / kCells * static_cast<float>(places[k].y));
        const double speed =
            static_cast<double>(world->velocity_scale() * static_cast<float>(speeds[k].x));
        off += (speed - exact) * (speed - exact);
        norm += exact * exact;
    }
    EXPECT_LT(std::sqrt(off / norm), 0.015);
}

// A pull of 3.4 units a step is not one of 3; what is owed goes along with a snapshot.
TEST(Packed, WeakGravityPullsAsItShould) {
    WorldDef def = small_def();
    def.gravity_mps2 = {0.0F, -0.034F};
    TestWorld<SmallFixed> world(def);
    ASSERT_EQ(world->fill({{0.0F, 0.06F}, {0.08F, 0.14F}}), Status::ok);
    std::vector<std::byte> saved(
        static_cast<std::size_t>(snapshot_bytes<SmallFixed>(def.capacity)));
    std::uint64_t after = 0;
    for (int step = 1; step <= 50; ++step) {
        if (step == 48) {
            ASSERT_EQ(world->save(saved.data(), saved.size()), Status::ok);
        }
        const float speed = world->step(1.0F / 64.0F).max_speed_mps / def.cell_m;
        const float exact = 1.7F / 64.0F * static_cast<float>(step);
        EXPECT_NEAR(speed, exact, 0.03F * exact + 1.5F / 128.0F) << step;
        after = world->state_hash();
    }
    ASSERT_EQ(world->restore(saved.data(), saved.size()), Status::ok);
    for (int step = 48; step <= 50; ++step) {
        world->step(1.0F / 64.0F);
    }
    EXPECT_EQ(world->state_hash(), after);
}

/// Gravity that trembles wakes nobody, but stirs the liquid: who has met is looked for.
TEST(Packed, WhoMetPartsWhenGravityTrembles) {
    WorldDef def = tank_def(8, 8, 4);
    def.sleep.gravity_mps2 = 0.5F;
    TestWorld<SmallFixed> world(def);
    expect_ok(world->add_particle({0.05F, 0.01F}, {}));
    expect_ok(world->add_particle({0.08F, 0.01F}, {}));
    const auto live = [&](bool trembles) {
        for (int step = 0; step < 200; ++step) {
            if (trembles && step == 0) {
                expect_ok(world->set_gravity({0.0F, -9.7F}));
            }
            world->step(1.0F / 60.0F);
        }
    };
    live(false);
    auto* const place = const_cast<Vec2<Place>*>(&world->particle_positions()[0]);
    auto* const speed = const_cast<Vec2<Speed>*>(&world->particle_velocities()[0]);
    place[1] = place[0];
    speed[1] = speed[0];
    const auto are_together = [&] {
        return place[0].x.raw == place[1].x.raw && place[0].y.raw == place[1].y.raw;
    };
    live(false);
    EXPECT_TRUE(are_together());
    live(true);
    EXPECT_FALSE(are_together());
}

}  // namespace
}  // namespace weir
