// Window: of a huge tank only the cells around the liquid are stored. As long as the liquid fits no
// bit is different; if it does not, no particle is lost.
#include "weir/display.hpp"
#include "window_life.hpp"

namespace weir {
namespace {

constexpr Capacity kHuge = [] {
    Capacity c;
    c.particles = 4096, c.cells_x = 4096, c.cells_y = 4096;
    return c;
}();
constexpr Capacity kHugeWindowed = [] {
    Capacity c = kHuge;
    c.window_cells = 320 * 160;
    return c;
}();
static_assert(world_bytes<float>(kHuge) > 600'000'000, "the tank decides");
static_assert(world_bytes<float>(kHugeWindowed) < 2'100'000, "the window does");

WEIR_SUITE(Window, RoomyScalars);

TYPED_TEST(Window, HasTheBitsOfTheWholeTank) {
    for (std::int32_t kind = 0; kind < kKinds; ++kind) {
        std::int32_t moves = 0;
        for (std::uint64_t seed = 1; seed <= kLives && !testing::Test::HasFailure(); ++seed) {
            moves += expect_same_life<TypeParam>(kind, seed);
        }
        EXPECT_TRUE(kind == 4 || moves > kLeastMoves) << moves << ", kind " << kind;
    }
}

/// Two lumps too far apart: the smaller one falls as in a vacuum, and then lies.
TYPED_TEST(Window, WhatIsBeyondFallsAlone) {
    using Real = TypeParam;
    TestWorld<Real> world(windowed(wide_def(0), 66 * 42));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.20F, 0.10F}}));
    const std::int32_t near = world->particle_positions().size;
    expect_ok(world->fill({{4.0F, 1.0F}, {4.06F, 1.04F}}));
    const std::int32_t all = world->particle_positions().size;
    constexpr float kDt = 0.01F;
    for (std::int32_t step = 1; step <= 20; ++step) {
        const StepReport report = world->step(kDt);
        EXPECT_EQ(report.particles_beyond, all - near);
        EXPECT_EQ(report.particles, all);
        EXPECT_EQ(world->particle_positions().size, all);
        const auto v = static_cast<float>(world->particle_velocities()[0].y) * kCell;
        EXPECT_NEAR(v, -9.81F * kDt * static_cast<float>(step), 0.01F);
    }
    Diagnostics diagnostics;
    expect_ok(world->diagnose(&diagnostics));
    EXPECT_EQ(diagnostics.volume_m2, 0.0) << "not known";
    // The tank leans: all come together again in a corner.
    expect_ok(world->set_gravity({9.81F, -9.81F}));
    std::int32_t beyond = all;
    for (std::int32_t step = 0; step < 400; ++step) {
        beyond = world->step(kDt).particles_beyond;
    }
    EXPECT_EQ(beyond, 0);
    EXPECT_EQ(world->particle_positions().size, all);
    EXPECT_TRUE(all_inside(*world));
}

TYPED_TEST(Window, ViewsShowWhatIsBeyondWhileAStepGoesOn) {
    TestWorld<TypeParam> world(windowed(wide_def(0), 66 * 42));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.20F, 0.10F}}));
    expect_ok(world->fill({{4.0F, 1.0F}, {4.06F, 1.04F}}));
    const std::int32_t all = world->particle_positions().size;
    StepReport report;
    expect_ok(world->begin_step(0.01F, &report));
    while (!world->advance(100)) {
        EXPECT_EQ(world->particle_positions().size, all);
        EXPECT_TRUE(all_inside(*world));
    }
    EXPECT_GT(report.particles_beyond, 0);
}

TYPED_TEST(Window, LosesNobodyHoweverSmallItIs) {
    for (std::int32_t kind = 0; kind < kKinds; ++kind) {
        expect_nobody_lost<TypeParam>(kind);
    }
}

/// Poured far from where an empty world's window is: what was looked at there, too.
TYPED_TEST(Window, HoldsTheLiquidBeforeTheFirstStep) {
    TestWorld<TypeParam> part(windowed(wide_def(0), 66 * 34));
    TestWorld<TypeParam> whole(wide_def(0));
    for (TestWorld<TypeParam>* world : {&part, &whole}) {
        expect_ok((*world)->fill({{0.0F, 0.0F}, {0.2F, 0.1F}}));
        static_cast<void>((*world)->density());
        expect_ok((*world)->drain({{0.0F, 0.0F}, {1.0F, 1.0F}}));
        expect_ok((*world)->fill({{3.0F, 2.0F}, {3.2F, 2.1F}}));
    }
    for (std::int32_t step = 0; step < 3; ++step) {
        Diagnostics a;
        Diagnostics b;
        expect_ok(part->diagnose(&a));
        expect_ok(whole->diagnose(&b));
        EXPECT_NEAR(a.volume_m2, 0.02, 0.002);
        EXPECT_TRUE(same(a, b)) << "step " << step;
        part->step(0.01F);
        whole->step(0.01F);
        EXPECT_EQ(part->state_hash(), whole->state_hash()) << "step " << step;
    }
}

TEST(WindowView, SaysWhichPartOfTheTankItShows) {
    TestWorld<float> world(windowed(wide_def(0), 66 * 34));
    expect_ok(world->fill({{3.0F, 2.0F}, {3.2F, 2.2F}}));
    world->step(0.01F);
    const auto density = world->density();
    EXPECT_GT(density.first_column, 0);
    EXPECT_GT(density.first_row, 0);
    EXPECT_NEAR(density.at(155 - density.first_column, 105 - density.first_row), 1.0F, 0.1F);
    std::vector<std::uint8_t> pixels(125 * 75, 0);
    Display display;
    display.pixels = pixels.data();
    display.width = 250;
    display.height = 75;
    const ChangedRows changed = draw(*world, display);
    EXPECT_GT(changed.first, 10) << "the upper third of the display";
    EXPECT_LT(changed.last, 30);
}

TEST(WindowStatus, NamesWhatItCannotBe) {
    const auto answer = [](const WorldDef& def) {
        measure::WorldMemory memory = measure::memory_for<float>(def);
        World<float> world;
        return world.init(def, memory.data(), memory.size());
    };
    EXPECT_EQ(answer(windowed(wide_def(0), 66 * 18)), Status::ok);
    EXPECT_EQ(answer(windowed(wide_def(0), 66 * 18 - 1)), Status::window_too_small);
    EXPECT_EQ(answer(windowed(wide_def(4), 252 * 18 - 1)), Status::window_too_small);
    EXPECT_EQ(answer(windowed(wide_def(6), 66 * 152 - 1)), Status::window_too_small);
    WorldDef bodies = windowed(wide_def(0), 10000);
    bodies.capacity.bodies = 1;
    EXPECT_EQ(answer(bodies), Status::ok);
    WorldDef narrow = windowed(tank_def(40, 150, 500, 1, 4), 66 * 26);
    EXPECT_EQ(answer(narrow), Status::ok);
    --narrow.capacity.window_cells;
    EXPECT_EQ(answer(narrow), Status::window_too_small);
    bodies.capacity.wall_edges = 1;
    EXPECT_EQ(answer(bodies), Status::window_without_thin_walls);
    bodies.capacity.wall_edges = 0;
    bodies.capacity.two_way = true;
    EXPECT_EQ(answer(bodies), Status::window_without_forces);
    WorldDef small = windowed(wide_def(0), 10000);
    measure::WorldMemory memory = measure::memory_for<SmallFixed>(small);
    World<SmallFixed> world;
    EXPECT_EQ(world.init(small, memory.data(), memory.size()), Status::small_fixed_has_no_window);
    WorldDef negative = wide_def(0);
    negative.capacity.window_cells = -1;
    EXPECT_EQ(answer(negative), Status::window_out_of_range);
    const WorldDef all = windowed(wide_def(0), 252 * 152);
    EXPECT_EQ(answer(all), Status::ok) << "as much as the tank has";
    EXPECT_EQ(world_bytes<float>(all.capacity), world_bytes<float>(wide_def(0).capacity));
}

}  // namespace
}  // namespace weir
