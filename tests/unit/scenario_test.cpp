// What every scene must hold, step by step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "contour/marching_squares.hpp"
#include "scenes/scenarios.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

using scenes::Scenario;

class Play {
public:
    explicit Play(const Scenario& scenario)
        : scenario_(scenario), memory_(measure::memory_for<float>(scenario.def)) {
        const Status ready =
            scenes::begin(scenario_, memory_.data(), memory_.size(), stage_);
        EXPECT_EQ(ready, Status::ok) << status_text(ready);
        particles_ = stage_.world.particle_positions().size;
    }

    StepReport advance() { return scenes::advance(scenario_, stage_, step_++); }
    const World<float>& world() const { return stage_.world; }
    World<float>& world() { return stage_.world; }
    std::int32_t particles() const { return particles_; }
    float energy() const { return scenes::energy(scenario_, stage_.world); }

    void expect_whole(const StepReport& report) const {
        EXPECT_EQ(report.particles, particles_) << "step " << step_;
        EXPECT_EQ(report.particles_reset, 0) << "step " << step_;
        EXPECT_TRUE(scenes::all_inside(stage_.world)) << "step " << step_;
    }
    /// Deepest particle behind the bilinear distance, cells; not negative.
    double deepest() const {
        double depth = 0.0;
        for (const Vec2<float> x : stage_.world.particle_positions()) {
            depth = std::max(depth, -distance_at(stage_.world, x));
        }
        return depth;
    }
    /// Deepest particle behind the contour line of its cell, cells; not negative.
    double deepest_behind_contour() const {
        const FieldView<float> field = stage_.world.signed_distance();
        double depth = 0.0;
        for (const Vec2<float> x : stage_.world.particle_positions()) {
            const auto i = static_cast<std::int32_t>(x.x);
            const auto j = static_cast<std::int32_t>(x.y);
            const float corner[4] = {field.at(i, j), field.at(i + 1, j), field.at(i + 1, j + 1),
                                     field.at(i, j + 1)};
            const Vec2<float> local{x.x - static_cast<float>(i), x.y - static_cast<float>(j)};
            const auto hit = contour_hit(corner, local);
            depth = std::max(depth, static_cast<double>(-hit.distance));
        }
        return depth;
    }

private:
    Scenario scenario_;
    measure::WorldMemory memory_;
    scenes::Stage stage_;
    std::int32_t particles_ = 0;
    std::int32_t step_ = 0;
};

Scenario scene(const char* name) {
    const Scenario* found = scenes::find(name);
    EXPECT_NE(found, nullptr) << name;
    return found != nullptr ? *found : scenes::scenarios<float>()[0];
}

/// Figures of a pool at rest, in cells and seconds.
struct Rest {
    double mean_height = 0.0;
    double rms_speed = 0.0;
};

Rest rest_of(const World<float>& world) {
    Rest rest;
    const auto x = world.particle_positions();
    const auto v = world.particle_velocities();
    for (std::int32_t k = 0; k < x.size; ++k) {
        rest.mean_height += static_cast<double>(x[k].y) / x.size;
        rest.rms_speed += static_cast<double>(v[k].x * v[k].x + v[k].y * v[k].y) / x.size;
    }
    rest.rms_speed = std::sqrt(rest.rms_speed);
    return rest;
}

TEST(Scenario, RestingPoolStaysAtRest) {
    const Scenario resting = scene("resting_pool");
    Play play(resting);
    const double depth = 16.0;
    const double g = 9.81 / static_cast<double>(resting.def.cell_m);
    double height_at_100 = 0.0;
    double slowest = 0.0;
    for (int step = 1; step <= 5000; ++step) {
        play.advance();
        if (step == 100) {
            height_at_100 = rest_of(play.world()).mean_height;
        }
        if (step > 4000) {
            slowest = std::max(slowest, rest_of(play.world()).rms_speed);
        }
    }
    const Rest rest = rest_of(play.world());
    EXPECT_NEAR(rest.mean_height, height_at_100, 0.01 * height_at_100);
    EXPECT_LT(slowest, 0.001 * std::sqrt(g * depth));
    // Pressure at the centres of the lowest row, half a cell above the bottom.
    const auto pressure = play.world().pressure();
    const auto scale = static_cast<double>(play.world().pressure_scale());
    double mean = 0.0;
    for (std::int32_t i = 0; i < pressure.columns; ++i) {
        mean += scale * static_cast<double>(pressure.at(i, 0)) / pressure.columns;
    }
    const double bottom = mean + 9.81 * 0.5 * static_cast<double>(resting.def.cell_m);
    const double expected = 9.81 * depth * static_cast<double>(resting.def.cell_m);
    EXPECT_NEAR(bottom, expected, 0.005 * expected);
    std::printf("resting pool: height %.4f -> %.4f, rms %.6f sqrt(gh), bottom %.4f rho g h\n",
                height_at_100, rest.mean_height, slowest / std::sqrt(g * depth), bottom / expected);
}

class ClosedScenario : public ::testing::TestWithParam<const char*> {};

/// Nothing does work on the liquid but gravity: its energy only falls.
TEST_P(ClosedScenario, KeepsAllParticlesAndGainsNoEnergy) {
    const Scenario closed = scene(GetParam());
    ASSERT_FALSE(closed.bodies_move);
    Play play(closed);
    const float first = play.energy();
    float highest = first;
    for (std::int32_t step = 0; step < 3 * closed.steps; ++step) {
        play.expect_whole(play.advance());
        highest = std::max(highest, play.energy());
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_LE(highest, first * 1.001F);
    std::printf("%s: energy at most %.6f of the first, %.4f at the end\n", closed.name,
                static_cast<double>(highest / first), static_cast<double>(play.energy() / first));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ClosedScenario,
                         ::testing::Values("cup", "dam_break", "splash", "eos_dam_break",
                                           "resting_pool"),
                         [](const auto& one) { return std::string(one.param); });

class SolidScenario : public ::testing::TestWithParam<const char*> {};

/// The contour is the limit. The bilinear distance bulges out of it at a convex corner, whose tip
/// the line cuts off: by 0.13 cells at the ends of a turning bar.
TEST_P(SolidScenario, NoParticleIsInsideASolidAfterAStep) {
    const Scenario solids = scene(GetParam());
    Play play(solids);
    double deepest = 0.0;
    double behind = 0.0;
    for (std::int32_t step = 0; step < solids.steps; ++step) {
        play.expect_whole(play.advance());
        ASSERT_FALSE(HasFailure());
        deepest = std::max(deepest, play.deepest());
        behind = std::max(behind, play.deepest_behind_contour());
    }
    EXPECT_LE(behind, 0.05);
    EXPECT_LE(deepest, 0.15);
    std::printf("%s: deepest particle %.5f cells behind the contour, %.4f by bilinear distance\n",
                solids.name, behind, deepest);
}

TEST_P(SolidScenario, MidEdgeKeepsThemAndStaysFinite) {
    Scenario solids = scene(GetParam());
    solids.def.contour = Contour::mid_edge;
    Play play(solids);
    for (std::int32_t step = 0; step < solids.steps; ++step) {
        play.expect_whole(play.advance());
        ASSERT_FALSE(HasFailure());
    }
}

TEST_P(SolidScenario, EquationOfStateKeepsThemAndStaysFinite) {
    Scenario solids = scene(GetParam());
    solids.def.pressure = Pressure::equation_of_state;
    Play play(solids);
    for (std::int32_t step = 0; step < solids.steps; ++step) {
        play.expect_whole(play.advance());
        ASSERT_FALSE(HasFailure());
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SolidScenario,
                         ::testing::Values("dam_break_solids", "moving_piston", "tipping_cup"),
                         [](const auto& one) { return std::string(one.param); });

TEST(Scenario, AllHaveDifferentNamesAndFitTheSmallestBoards) {
    for (const Scenario& a : scenes::scenarios<float>()) {
        EXPECT_LE(world_bytes<float>(a.def.capacity), 96U * 1024U);
        EXPECT_EQ(scenes::find(a.name), &a);
        EXPECT_EQ(a.steps, 300);
    }
    EXPECT_EQ(scenes::find("nothing"), nullptr);
    EXPECT_GT(scenes::largest_world_bytes(96 * 1024), scenes::largest_world_bytes(16 * 1024));
}

/// Two worlds in one program do not disturb each other.
TEST(Scenario, TwoAtATimeAreTheSameAsOneAfterTheOther) {
    const Scenario dam = scene("dam_break_solids");
    const Scenario drop = scene("splash");
    Play a(dam);
    Play b(drop);
    for (int step = 0; step < 30; ++step) {
        a.advance();
        b.advance();
    }
    Play alone(dam);
    for (int step = 0; step < 30; ++step) {
        alone.advance();
    }
    EXPECT_EQ(a.world().state_hash(), alone.world().state_hash());
}

}  // namespace
}  // namespace weir
