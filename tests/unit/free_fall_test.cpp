// What a world must do exactly, or nearly so: free fall, mirror images, who is thrown in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/vec2.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

/// A block that touches nothing falls as Galileo says: in substeps of h, v = g t and
/// x = x0 − g (t² + t h) / 2 after each.
template <class Real>
void expect_free_fall(Pressure pressure, double tolerance) {
    WorldDef def = tank_def(24, 48, 400);
    def.pressure = pressure;
    def.volume_gain = 0.0F;
    def.sound_speed_mps = 4.0F;
    TestWorld<Real> world(def);
    std::int32_t added = 0;
    ASSERT_EQ(world->fill({{0.16F, 0.7F}, {0.32F, 0.86F}}, &added), Status::ok);
    std::vector<Vec2<Real>> start(world->particle_positions().begin(),
                                  world->particle_positions().end());
    double t = 0.0;
    double fallen = 0.0;
    const double g = 9.81 / static_cast<double>(def.cell_m);
    for (int step = 0; step < 12; ++step) {
        const StepReport report = world->step(1.0F / 60.0F);
        ASSERT_EQ(report.clamped, 0U);
        const double h = static_cast<double>(report.dt_s) / report.substeps;
        for (int k = 0; k < report.substeps; ++k) {
            t += h;
            fallen += h * g * t;
        }
    }
    for (std::int32_t k = 0; k < added; ++k) {
        const auto at = world->particle_positions()[k];
        const auto v = world->particle_velocities()[k];
        ASSERT_NEAR(static_cast<double>(v.y), -g * t, g * t * tolerance);
        ASSERT_NEAR(static_cast<double>(v.x), 0.0, g * t * tolerance);
        ASSERT_NEAR(static_cast<double>(at.y),
                    static_cast<double>(start[std::size_t(k)].y) - fallen, 30 * tolerance);
        ASSERT_NEAR(static_cast<double>(at.x), static_cast<double>(start[std::size_t(k)].x),
                    30 * tolerance);
    }
}

TEST(FreeFall, IsExactWithProjection) {
    expect_free_fall<double>(Pressure::projection, 1e-7);  // def's floats bound the figures
    expect_free_fall<float>(Pressure::projection, 1e-5);
}

/// Its own face masses make a falling block look compressed here and there: looser.
TEST(FreeFall, IsCloseWithEquationOfState) {
    expect_free_fall<double>(Pressure::equation_of_state, 1e-7);
    expect_free_fall<float>(Pressure::equation_of_state, 1e-4);
}

/// Two columns, mirror images, fall together. Largest difference from a mirror image after some
/// steps, cells.
template <class Real>
double asymmetry(std::int32_t width, std::int32_t steps) {
    WorldDef def = tank_def(width, 24, 2000);
    def.cell_m = 0.03125F;  // exact: both columns get mirrored lattices
    TestWorld<Real> world(def);
    const float cell = def.cell_m;
    const auto right_wall = static_cast<float>(width);
    std::int32_t left = 0;
    std::int32_t right = 0;
    EXPECT_EQ(world->fill({{0, 0}, {6 * cell, 12 * cell}}, &left), Status::ok);
    EXPECT_EQ(world->fill({{(right_wall - 6) * cell, 0}, {right_wall * cell, 12 * cell}}, &right),
              Status::ok);
    EXPECT_EQ(left, right);
    for (std::int32_t step = 0; step < steps; ++step) {
        world->step(1.0F / 60.0F);
    }
    // Row by row both lattices run from left to right: particle a of a row mirrors 11 - a.
    double worst = 0.0;
    const auto x = world->particle_positions();
    for (std::int32_t k = 0; k < left; ++k) {
        const Vec2<double> a = convert<double>(x[k]);
        const Vec2<double> b = convert<double>(x[left + k / 12 * 12 + (11 - k % 12)]);
        worst = std::max({worst, std::abs(a.x + b.x - width), std::abs(a.y - b.y)});
    }
    return worst;
}

/// A mirror swaps the colours of the red-black sweeps, or shifts the coarse cells: what the solve
/// leaves undone differs between the sides. No width keeps both.
TEST(Symmetry, IsCloseWhateverTheWidth) {
    EXPECT_LT(asymmetry<double>(33, 12), 0.02);
    EXPECT_LT(asymmetry<float>(33, 12), 0.02);
    EXPECT_LT(asymmetry<double>(32, 12), 0.02);
    EXPECT_LT(asymmetry<float>(32, 12), 0.02);
}

/// A step is cut as who was thrown in needs it, though nothing had moved before.
TEST(World, WhoIsThrownInIsNotSlowed) {
    TestWorld<float> world(tank_def(32, 32, 10));
    world->step(1.0F / 60.0F);
    expect_ok(world->add_particle({0.1F, 0.3F}, {12.0F, 0.0F}));
    const StepReport report = world->step(1.0F / 60.0F);
    EXPECT_EQ(report.particles_slowed, 0);
    EXPECT_GE(report.substeps, 10);
    EXPECT_NEAR(static_cast<double>(world->particle_positions()[0].x), 15.0, 0.1);
}

/// Told of the end of a step, not of all of its substeps.
TEST(World, CellsAreOverfullOnce) {
    TestWorld<float> world(tank_def(16, 16, 2048));
    for (int k = 0; k < 2; ++k) {
        expect_ok(world->fill({{0, 0}, {0.32F, 0.32F}}));
    }
    const StepReport report = world->step(0.1F);
    EXPECT_GE(report.substeps, 6);
    EXPECT_GT(report.cells_overfull, 200);
    EXPECT_LE(report.cells_overfull, 256);
}

}  // namespace
}  // namespace weir
