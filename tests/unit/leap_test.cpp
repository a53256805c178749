// Second order in time: what is asked of the pressure, and which paths bend.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "pressure/leap_packed.hpp"
#include "step/bend_paths.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr std::int32_t kCells = 12;
constexpr double kDt = 0.1;

/// A tank of 12 × 12 cells in which everything moves at (a y, b x) about its centre. The liquid's
/// surface is at row 9.
template <class Real>
struct Flow {
    GridShape shape{kCells, kCells, kCells + 2};
    std::vector<Real> u, v, before_u, before_v, level;
    StaggeredGrid<Real> grid;
    PressureFields<Real> fields;
    Walls<Real> walls;
    Borders<Real> borders;

    Flow(double a, double b) {
        for (auto* field : {&u, &v, &before_u, &before_v, &level}) {
            field->assign(static_cast<std::size_t>(shape.size()), Real(0));
        }
        for (std::int32_t j = -1; j <= kCells; ++j) {
            for (std::int32_t i = -1; i <= kCells; ++i) {
                const auto c = static_cast<std::size_t>(shape.index(i, j));
                before_u[c] = u[c] = static_cast<Real>(a * (j + 0.5 - 0.5 * kCells));
                before_v[c] = v[c] = static_cast<Real>(b * (i + 0.5 - 0.5 * kCells));
                level[c] = Real(8.5) - static_cast<Real>(j);
                level[c] = level[c] < kEmptyLevel<Real> ? kEmptyLevel<Real> : level[c];
            }
        }
        grid = {shape, u.data(), v.data(), before_u.data(), before_v.data()};
        fields.level = level.data();
        fields.divergence = before_u.data();
        fields.inverse_diagonal = before_v.data();
    }
    void bend() {
        bend_paths(Domain<Real>{grid, fields, borders, walls}, static_cast<Seconds<Real>>(kDt));
    }
    double bent_u(std::int32_t i, std::int32_t j) const {
        const auto c = static_cast<std::size_t>(shape.index(i, j));
        return static_cast<double>(u[c] - before_u[c]);
    }
};

/// A rotation's determinant is ω², a shear's 0, a strain's −s².
TEST(Leap, AsksForWhatStraightPathsTake) {
    const auto wanted = [](double a, double b) {
        const Flow<double> flow(a, b);
        return wanted_convergence(flow.grid, flow.shape.index(5, 5), Leap<double>(kDt));
    };
    EXPECT_NEAR(wanted(-0.5, 0.5), kDt * 0.25, 1e-12);
    EXPECT_NEAR(wanted(0.5, 0.5), -kDt * 0.25, 1e-12);
    EXPECT_NEAR(wanted(0.5, 0.0), 0.0, 1e-12);
    EXPECT_NEAR(wanted(-40.0, 40.0), 0.0625 / kDt, 1e-12) << "within its limit";
}

/// In whole numbers, too: to the unit that velocities have.
TEST(Leap, PackedWorldsAskForTheSame) {
    constexpr double kUnit = 1.0 / 128.0;
    std::mt19937 random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        const double largest = trial % 2 == 0 ? 2.0 : 25.0;
        Flow<double> exact(0.0, 0.0);
        const std::int32_t c = exact.shape.index(5, 5);
        std::vector<VelocityOf<SmallFixed>> u(exact.u.size()), v(exact.v.size());
        for (std::size_t k = 0; k < u.size(); ++k) {
            const auto any = [&] { return (static_cast<double>(random()) / 2147483648.0 - 1.0) * largest; };
            u[k] = SmallFixed(any());
            v[k] = SmallFixed(any());
            exact.before_u[k] = static_cast<double>(u[k]);
            exact.before_v[k] = static_cast<double>(v[k]);
        }
        StaggeredGrid<SmallFixed> grid;
        grid.shape = exact.shape;
        grid.mass_u = u.data();
        grid.mass_v = v.data();
        const PackedLeap leap(true, Seconds<SmallFixed>(1.0 / 64.0));
        const double wanted = wanted_convergence(exact.grid, c, Leap<double>(1.0 / 64.0));
        EXPECT_NEAR(wanted_convergence(grid, c, leap) * kUnit, wanted,
                    kUnit * (1.0 + 0.02 * largest));
        EXPECT_EQ(wanted_convergence(grid, c, PackedLeap(false, Seconds<SmallFixed>(1.0))), 0);
    }
}

/// Rotating, (u·∇)u = −ω² (x, y): towards the centre.
template <class Real>
void expect_paths_bend_where_nothing_else_helps() {
    constexpr double kTurn = 0.5;
    Flow<Real> flow(-kTurn, kTurn);
    const auto half = [](std::int32_t i) {
        return -0.25 * kDt * kTurn * kTurn * (i - 0.5 * kCells);
    };
    flow.bend();
    for (std::int32_t j = 1; j < 7; ++j) {
        EXPECT_EQ(flow.bent_u(4, j), 0.0) << "deep: straight, row " << j;
    }
    EXPECT_NEAR(flow.bent_u(4, 0), half(4), 2e-5) << "at the floor";
    EXPECT_NEAR(flow.bent_u(4, 8), half(4), 2e-5) << "below the surface";
    EXPECT_NEAR(flow.bent_u(4, 9), half(4), 2e-5) << "and above it";
    EXPECT_EQ(flow.bent_u(4, 11), 0.0) << "where there is nothing";
    EXPECT_NEAR(flow.bent_u(1, 4), 0.5 * half(1), 2e-5) << "between the two kinds of cells";
    EXPECT_EQ(flow.bent_u(0, 4), 0.0) << "on the wall";

    Flow<Real> bent(-kTurn, kTurn);
    bent.fields.leaps = false;
    bent.bend();
    EXPECT_NEAR(bent.bent_u(4, 4), 2.0 * half(4), 2e-5) << "without leap everywhere";
}

TEST(Leap, PathsBendWhereThePressureDoesNotSeeToIt) {
    expect_paths_bend_where_nothing_else_helps<float>();
    expect_paths_bend_where_nothing_else_helps<double>();
    expect_paths_bend_where_nothing_else_helps<Fixed>();
}

/// What falls freely keeps its energy to rounding, as long steps as they may be: velocities are
/// half a step behind positions, and so is the potential energy that is told.
TEST(Leap, EnergyIsToldForTheTimeOfTheVelocities) {
    WorldDef def = tank_def(16, 40, 64);
    def.cell_m = 1.0F;
    def.gravity_mps2 = {0.0F, -10.0F};
    TestWorld<float> world(def);
    ASSERT_EQ(world->fill({{6, 30}, {10, 34}}), Status::ok);
    Diagnostics first;
    ASSERT_EQ(world->diagnose(&first), Status::ok);
    for (int step = 0; step < 10; ++step) {
        ASSERT_EQ(world->step(0.1F).substeps, 1);
        Diagnostics d;
        ASSERT_EQ(world->diagnose(&d), Status::ok);
        ASSERT_NEAR(d.kinetic_energy_m4ps2 + d.potential_energy_m4ps2, first.potential_energy_m4ps2,
                    1e-5 * first.potential_energy_m4ps2)
            << step;
    }
}

}  // namespace
}  // namespace weir
