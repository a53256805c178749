// The yardstick must itself be sound: what the paper's method promises, it does here.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "paper_fluid.hpp"
#include "paper_scaling.hpp"
#include "paper_solids.hpp"

namespace paper {
namespace {

void fill(Fluid& fluid, Point low, Point high) {
    for (float y = low.y + 0.25F; y < high.y; y += 0.5F) {
        for (float x = low.x + 0.25F; x < high.x; x += 0.5F) {
            fluid.add_particle({x, y});
        }
    }
}

// Everything finite and within the tank and its margin; the clamp stands 2 cells behind a wall.
void expect_all_inside(const Fluid& fluid) {
    const float slack = static_cast<float>(kMargin) - 1.0F;
    int outside = 0;
    for (int k = 0; k < fluid.size(); ++k) {
        const Point x = fluid.position(k);
        const bool inside = x.x >= -slack && x.y >= -slack &&
                            x.x <= static_cast<float>(fluid.config().cells_x) + slack &&
                            x.y <= static_cast<float>(fluid.config().cells_y) + slack;
        outside += inside ? 0 : 1;  // not-a-number compares false
    }
    EXPECT_EQ(outside, 0);
}

Point mean_position(const Fluid& fluid) {
    double x = 0.0;
    double y = 0.0;
    for (int k = 0; k < fluid.size(); ++k) {
        x += static_cast<double>(fluid.position(k).x);
        y += static_cast<double>(fluid.position(k).y);
    }
    return {static_cast<float>(x / fluid.size()), static_cast<float>(y / fluid.size())};
}

double mean_speed(const Fluid& fluid) {
    double sum = 0.0;
    for (int k = 0; k < fluid.size(); ++k) {
        sum += static_cast<double>(std::hypot(fluid.velocity(k).x, fluid.velocity(k).y));
    }
    return sum / fluid.size();
}

TEST(PaperFluid, MassIsConservedOnTheGrid) {
    Fluid fluid(FluidConfig{});
    fill(fluid, {0.0F, 0.0F}, {20.0F, 30.0F});
    for (int k = 0; k < 200; ++k) {
        fluid.step();
        ASSERT_NEAR(fluid.grid_mass(), fluid.size(), 1e-5 * fluid.size());
    }
}

TEST(PaperFluid, BlockInFreeFlightFollowsGravity) {
    for (const Velocity kind : {Velocity::from_grid, Velocity::scattered_again}) {
        FluidConfig config;
        config.cells_y = 128;
        config.velocity = kind;
        Fluid fluid(config);
        fill(fluid, {20.0F, 80.0F}, {40.0F, 100.0F});
        const Point start = mean_position(fluid);
        const int steps = 300;
        for (int k = 0; k < steps; ++k) {
            fluid.step();
        }
        // Gravity first, then the move: sum of k g for k = 1 ... n.
        const float fall = 0.5F * config.gravity.y * static_cast<float>(steps * (steps + 1));
        const Point end = mean_position(fluid);
        EXPECT_NEAR(end.x, start.x, 0.01F);
        EXPECT_NEAR(end.y - start.y, fall, 0.001F * std::abs(fall));
    }
}

struct DamBreak {
    float depth;   // twice the height of the centre of mass over the tank's floor
    double speed;  // over sqrt(g H)
};

DamBreak settle(Velocity kind, float sound_ratio, float cfl) {
    const int height = 32;
    FluidConfig config;
    config.cells_x = 64;
    config.cells_y = 64;
    config.velocity = kind;
    Scaling scaling;
    scaling.depth_m = scaling.cell_m * static_cast<float>(height);
    scaling.sound_ratio = sound_ratio;
    scaling.cfl = cfl;
    scaling.apply(config);
    Fluid fluid(config);
    fill(fluid, {0.0F, 0.0F}, {16.0F, static_cast<float>(height)});
    const float unit_s = std::sqrt(scaling.depth_m / scaling.gravity_mps2);
    const int steps = static_cast<int>(60.0F * unit_s / scaling.seconds_per_step());
    for (int k = 0; k < steps; ++k) {
        fluid.step();
    }
    expect_all_inside(fluid);
    const double wave_speed =
        std::sqrt(static_cast<double>(-config.gravity.y) * static_cast<double>(height));
    return {2.0F * mean_position(fluid).y, mean_speed(fluid) / wave_speed};
}

// The method counts no mass beyond walls and surface, so its density is too low within half a
// kernel of them and the liquid packs there. In a tank 64 cells wide it stands short of its depth
// by 1.2, 1.1 and 1.3 cells at depths 8, 16 and 32 (measured at rest, sound 10 sqrt(gH)); at
// 3 sqrt(gH) it also gives under its own weight: 1.9, 2.5 and 3.7. The bound here is what this
// implementation does, to notice a change; it is not what a liquid should do.
TEST(PaperFluid, DamBreakSettlesAtItsDepth) {
    const float expected = 8.0F;  // 16 × 32 cells of liquid in a tank of 64
    struct Run {
        Velocity kind;
        float sound_ratio;
    };
    for (const Run run : {Run{Velocity::from_grid, 3.0F}, Run{Velocity::from_grid, 6.0F},
                          Run{Velocity::scattered_again, 3.0F}}) {
        const DamBreak end = settle(run.kind, run.sound_ratio, 0.5F);
        std::printf("dam break, %s, sound %.0f sqrt(gH): depth %.2f of %.0f cells, "
                    "mean speed %.4f sqrt(gH)\n",
                    run.kind == Velocity::from_grid ? "2 scatters" : "3 scatters",
                    static_cast<double>(run.sound_ratio), static_cast<double>(end.depth),
                    static_cast<double>(expected), end.speed);
        EXPECT_LT(end.depth, expected);
        EXPECT_GT(end.depth, expected - 1.5F);
        EXPECT_LT(end.speed, 0.05);
    }
}

TEST(PaperScaling, PhysicalTimeMapsToSteps) {
    Scaling scaling;
    scaling.cell_m = 0.02F;
    scaling.depth_m = 0.4F;
    scaling.sound_ratio = 5.0F;
    scaling.cfl = 0.4F;
    FluidConfig config;
    scaling.apply(config);
    const float dt = scaling.seconds_per_step();
    EXPECT_FLOAT_EQ(scaling.sound_speed_mps(), 5.0F * std::sqrt(9.81F * 0.4F));
    EXPECT_FLOAT_EQ(dt * scaling.sound_speed_mps(), 0.4F * 0.02F);
    EXPECT_FLOAT_EQ(config.gravity.y, -9.81F * dt * dt / 0.02F);
    EXPECT_FLOAT_EQ(std::sqrt(config.stiffness), 0.4F);
}

TEST(PaperSolids, LeftTurnTest) {
    const Polygon hexagon = regular_polygon({10.0F, 10.0F}, 4.0F, 6, 0.3F);
    EXPECT_TRUE(is_inside(hexagon, {10.0F, 10.0F}));
    EXPECT_TRUE(is_inside(hexagon, {13.0F, 10.5F}));
    EXPECT_FALSE(is_inside(hexagon, {14.5F, 10.0F}));
    Polygon clockwise = hexagon;
    std::reverse(clockwise.begin(), clockwise.end());
    EXPECT_FALSE(is_inside(clockwise, {10.0F, 10.0F}));
}

// The 16 cases against a rule of their own: walk round the cell's rim. At a corner the answer is
// that corner's bit, and a line crosses an edge in its middle, exactly where the bits differ.
TEST(PaperSolids, SixteenCasesAgreeWithTheirCorners) {
    const Point corners[4] = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    for (int contour = 0; contour < 16; ++contour) {
        for (int k = 0; k < 4; ++k) {
            const Point a = corners[k];
            const Point b = corners[(k + 1) % 4];
            for (const float t : {0.01F, 0.25F, 0.49F, 0.51F, 0.75F, 0.99F}) {
                const int owner = t < 0.5F ? k : (k + 1) % 4;
                const bool solid = ((contour >> owner) & 1) != 0;
                const Contact contact =
                    test_cell(contour, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
                EXPECT_EQ(contact.side != Side::outside, solid) << "case " << contour;
            }
        }
    }
}

TEST(PaperSolids, NormalsAreUnitAndPointOutOfTheSolid) {
    for (int contour = 1; contour < 15; ++contour) {
        for (int s = 0; s < 100; ++s) {
            const float u = 0.05F + 0.1F * static_cast<float>(s % 10);
            const float v = 0.05F + 0.1F * static_cast<float>(s / 10);
            const Contact contact = test_cell(contour, u, v);
            if (contact.side != Side::behind_line) {
                continue;
            }
            const Point n = contact.normal;
            EXPECT_NEAR(n.x * n.x + n.y * n.y, 1.0F, 1e-6F);
            // A line is at most 3/4 of the diagonal away; beyond it is liquid, or the cell ends.
            bool reaches_liquid = false;
            for (float way = 0.0F; way < 1.2F; way += 0.01F) {
                const float x = u + way * n.x;
                const float y = v + way * n.y;
                const bool in_cell = x >= 0.0F && x <= 1.0F && y >= 0.0F && y <= 1.0F;
                reaches_liquid |= !in_cell || test_cell(contour, x, y).side == Side::outside;
            }
            EXPECT_TRUE(reaches_liquid) << "case " << contour;
        }
    }
    EXPECT_EQ(test_cell(0, 0.5F, 0.5F).side, Side::outside);
    EXPECT_EQ(test_cell(15, 0.5F, 0.5F).side, Side::buried);
}

TEST(PaperSolids, ReflectionTurnsOnlyWhatComesIn) {
    const Point in = reflected({1.0F, -2.0F}, {0.0F, 1.0F});
    EXPECT_FLOAT_EQ(in.x, 1.0F);
    EXPECT_FLOAT_EQ(in.y, 2.0F);
    const Point out = reflected({1.0F, 2.0F}, {0.0F, 1.0F});
    EXPECT_FLOAT_EQ(out.y, 2.0F);
}

TEST(PaperSolids, DynamicPolygonsAreMergedAndLeaveNoTrace) {
    Solids solids(64, 64);
    solids.add_static(box_polygon({4.5F, 4.5F}, {8.5F, 8.5F}));
    solids.add_dynamic(box_polygon({-8.0F, -0.7F}, {8.0F, 0.7F}), {32.0F, 32.0F}, 0.0F,
                       1.57079633F);
    solids.rebuild();  // a quarter turn per step: now upright
    EXPECT_TRUE(solids.solid_at(32, 38));
    EXPECT_FALSE(solids.solid_at(38, 32));
    EXPECT_TRUE(solids.solid_at(6, 6));
    solids.rebuild();  // and now lying
    EXPECT_FALSE(solids.solid_at(32, 38));
    EXPECT_TRUE(solids.solid_at(38, 32));
    EXPECT_TRUE(solids.solid_at(6, 6));
    EXPECT_EQ(solids.contour_case(6, 6), kCaseFull);
    EXPECT_EQ(solids.contour_case(20, 20), 0);
}

// A pool on a raised floor: with interaction the floor holds nearly all of it, without none.
TEST(PaperFluid, SolidsHoldTheLiquidOnlyWithInteraction) {
    for (const bool interaction : {true, false}) {
        FluidConfig config;
        config.interaction = interaction;
        Fluid fluid(config);
        fluid.add_static(box_polygon({-2.5F, 9.5F}, {66.5F, 20.5F}));
        fill(fluid, {4.0F, 25.0F}, {60.0F, 40.0F});
        for (int k = 0; k < 600; ++k) {
            fluid.step();
        }
        expect_all_inside(fluid);
        int below = 0;
        for (int k = 0; k < fluid.size(); ++k) {
            below += fluid.position(k).y < 19.0F ? 1 : 0;
        }
        if (interaction) {
            EXPECT_LT(below, fluid.size() / 50);
        } else {
            EXPECT_GT(below, fluid.size() / 2);
        }
    }
}

}  // namespace
}  // namespace paper
