// Views between steps: after a restore, and after particles came or went, they show the liquid as
// it stands, and who looks changes nothing of what comes.
#include <algorithm>

#include "weir/display.hpp"
#include "wide_world.hpp"

namespace weir {
namespace {

WEIR_SUITE(Views, EveryScalar);

/// What the view tells, row by row.
template <class Real>
std::vector<double> densities(const World<Real>& world) {
    const auto field = world.density();
    std::vector<double> all;
    for (std::int32_t j = 0; j < field.rows; ++j) {
        for (std::int32_t i = 0; i < field.columns; ++i) {
            all.push_back(static_cast<double>(field.at(i, j)));
        }
    }
    return all;
}

/// A pool over which something falls, at the beginning of a step of one substep.
template <class Real>
void fill_pool(World<Real>& world) {
    expect_ok(world.fill({{0.0F, 0.0F}, {0.3F, 0.1F}}));
    expect_ok(world.fill({{0.16F, 0.14F}, {0.2F, 0.2F}}));
    expect_ok(world.add_particle({0.05F, 0.21F}, {0.1F, 0.0F}));
    expect_ok(world.remove_particle(7));
}
constexpr float kShort = 0.001F;

/// Kinds of worlds that a scalar bears.
template <class Real>
std::vector<std::int32_t> kinds_of_worlds() {
    std::vector<std::int32_t> all;
    for (const std::int32_t kind : {0, 1, 2, 3, 5, 7, 8}) {
        if (busy_kind_is_borne<Real>(kind)) {
            all.push_back(kind);
        }
    }
    return all;
}
WorldDef roomy_def(std::int32_t kind) {
    WorldDef def = busy_def(kind);
    def.capacity.particles = 600;
    return def;
}

/// Densities are those of the substep's beginning: of one that is all of the step, as they were
/// looked at before it.
TYPED_TEST(Views, ShowLiquidThatWasJustPutIn) {
    for (const std::int32_t kind : kinds_of_worlds<TypeParam>()) {
        SCOPED_TRACE(kind);
        const WorldDef def = roomy_def(kind);
        TestWorld<TypeParam> world(def);
        if (def.capacity.bodies > 0) {
            put_static(*world, body_of(kSquare4cm, {0.25F, 0.08F}, 0.3F));
        }
        fill_pool(*world);
        const std::vector<double> before = densities(*world);
        EXPECT_GT(*std::max_element(before.begin(), before.end()), 0.5);
        const StepReport report = world->step(kShort);
        EXPECT_EQ(report.substeps, 1);
        EXPECT_EQ(densities(*world), before);
        expect_ok(world->remove_particle(20));
        EXPECT_NE(densities(*world), before);
    }
}

TYPED_TEST(Views, ShowWhatWasRestored) {
    for (const std::int32_t kind : kinds_of_worlds<TypeParam>()) {
        SCOPED_TRACE(kind);
        const WorldDef def = roomy_def(kind);
        TestWorld<TypeParam> world(def);
        TestWorld<TypeParam> other(def);
        fill_pool(*world);
        for (std::int32_t step = 0; step < 20; ++step) {
            world->step(0.01F);
        }
        expect_ok(other->fill({{0.1F, 0.2F}, {0.2F, 0.26F}}));
        other->step(0.01F);
        change_worlds(world, other, def);
        const std::vector<double> shown = densities(*other);
        EXPECT_EQ(world->step(kShort).substeps, 1);
        EXPECT_EQ(densities(*world), shown);
    }
}

/// Diagnostics look at places as they are, densities stay the last substep's: of liquid that falls
/// beside a body, and of a world asleep.
TYPED_TEST(Views, AreTheSameAfterDiagnostics) {
    for (const std::int32_t kind : kinds_of_worlds<TypeParam>()) {
        SCOPED_TRACE(kind);
        WorldDef def = roomy_def(kind);
        def.sleep.speed_mps = 10.0F;
        def.sleep.after_s = 0.1F;
        TestWorld<TypeParam> world(def);
        if (def.capacity.bodies > 0) {
            put_static(*world, body_of(kSquare4cm, {0.25F, 0.08F}, 0.3F));
        }
        fill_pool(*world);
        StepReport report;
        while (!report.asleep) {
            report = world->step(0.03F);
            const std::vector<double> before = densities(*world);
            Diagnostics sums;
            expect_ok(world->diagnose(&sums));
            ASSERT_EQ(densities(*world), before) << (report.asleep ? "asleep" : "awake");
        }
    }
}

WEIR_SUITE(ViewsOfWindows, RoomyScalars);

/// Of what is stored before and afterwards, if the window goes along with the liquid.
TYPED_TEST(ViewsOfWindows, AreTheSameAfterDiagnostics) {
    TestWorld<TypeParam> world(windowed(wide_def(0), 66 * 34));
    expect_ok(world->fill({{3.0F, 2.0F}, {3.2F, 2.2F}}));
    int moves = 0;
    for (int step = 0; step < 40; ++step) {
        world->step(0.015F);
        const auto before = world->density();
        const std::vector<double> shown = densities(*world);
        Diagnostics sums;
        expect_ok(world->diagnose(&sums));
        const auto after = world->density();
        moves += after.first_row != before.first_row ? 1 : 0;
        std::size_t k = 0;
        for (std::int32_t j = 0; j < before.rows; ++j) {
            for (std::int32_t i = 0; i < before.columns; ++i, ++k) {
                const std::int32_t row = j + before.first_row - after.first_row;
                const std::int32_t column = i + before.first_column - after.first_column;
                const bool stored =
                    row >= 0 && row < after.rows && column >= 0 && column < after.columns;
                ASSERT_EQ(stored ? static_cast<double>(after.at(column, row)) : 0.0, shown[k])
                    << step << ": " << i << ", " << j;
            }
        }
    }
    EXPECT_GT(moves, 0);
}

/// In a window, too, where those beyond it are seen only as far as they stand in it.
TEST(ViewsOfAWindow, ShowWhatWasRestored) {
    for (const bool fits : {true, false}) {
        WorldDef def = windowed(wide_def(0), 66 * 34);
        TestWorld<float> world(def);
        TestWorld<float> other(def);
        expect_ok(world->fill({{3.0F, 2.0F}, {3.2F, 2.2F}}));
        if (!fits) {
            expect_ok(world->fill({{0.5F, 0.1F}, {0.56F, 0.16F}}));
        }
        EXPECT_EQ(world->step(0.001F).particles_beyond > 0, !fits);
        change_worlds(world, other, def);
        const auto shown = other->density();
        const std::vector<double> before = densities(*other);
        world->step(0.001F);
        const auto after = world->density();
        EXPECT_EQ(after.first_column, shown.first_column);
        EXPECT_EQ(densities(*world), before);
        EXPECT_GT(*std::max_element(before.begin(), before.end()), 0.9);
    }
}

/// A device that starts anew from a snapshot of a world that sleeps.
TYPED_TEST(Views, ShowWhoSleeps) {
    WorldDef def = busy_def(0);
    def.sleep.speed_mps = 10.0F;
    def.sleep.after_s = 0.1F;
    TestWorld<TypeParam> world(def);
    TestWorld<TypeParam> other(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.3F, 0.08F}}));
    while (!world->step(0.01F).asleep) {
    }
    change_worlds(world, other, def);
    const std::uint64_t hash = other->state_hash();
    std::vector<std::uint8_t> pixels(8 * 14, 0);
    Display display;
    display.width = 16;
    display.height = 14;
    display.pixels = pixels.data();
    EXPECT_TRUE(other->step(0.01F).asleep);
    draw(*other, display);
    EXPECT_EQ(pixels[13 * 8] >> 4U, display.liquid);
    EXPECT_EQ(other->state_hash(), hash);
}

/// Who looks whenever possible goes on like who never does, across snapshots and scratch.
TYPED_TEST(Views, LookingChangesNothing) {
    for (std::int32_t kind = 0; kind < kBusyKinds; ++kind) {
        if (!busy_kind_is_borne<TypeParam>(kind)) {
            continue;
        }
        SCOPED_TRACE(kind);
        const WorldDef def = busy_def(kind);
        TestWorld<TypeParam> blind(def);
        TestWorld<TypeParam> one(def);
        TestWorld<TypeParam> two(def);
        TestWorld<TypeParam>* seen = &one;
        TestWorld<TypeParam>* spare = &two;
        Dice here(static_cast<std::uint64_t>(kind) + 3);
        Dice there = here;
        for (std::int32_t step = 0; step < 60; ++step) {
            disturb(*blind, here);
            disturb(**seen, there);
            static_cast<void>(densities(**seen));
            const float dt = here.uniform(0.002F, 0.03F);
            there.uniform(0.002F, 0.03F);
            blind->step(dt);
            (*seen)->step(dt);
            if (step % 10 == 9) {
                change_worlds(*seen, *spare, def);
                std::swap(seen, spare);
                static_cast<void>(densities(**seen));
            }
            ASSERT_EQ((*seen)->state_hash(), blind->state_hash()) << "step " << step;
        }
    }
}

}  // namespace
}  // namespace weir
