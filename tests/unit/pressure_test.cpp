// What the projection reaches within its fixed work: deep liquid, any width, seams, odd lattices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pressure/start.hpp"
#include "weir/weir.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr double kCell = 0.02;
constexpr float kStep = 1.0F / 60.0F;

WorldDef tank(std::int32_t width, std::int32_t height, std::int32_t depth) {
    return tank_def(width, height, 4 * width * depth);
}

Box pool(std::int32_t width, std::int32_t depth) {
    return {{0.0F, 0.0F}, {static_cast<float>(kCell * width), static_cast<float>(kCell * depth)}};
}

/// Largest error of the pressure in the lowest row, relative to the weight of the liquid.
template <class Real>
double bottom_error(const World<Real>& world, double depth) {
    double worst = 0.0;
    for (std::int32_t i = 0; i < world.cells_x(); ++i) {
        const double p = static_cast<double>(world.pressure().at(i, 0)) *
                         static_cast<double>(world.pressure_scale());
        worst = std::max(worst, std::abs(p / (9.81 * kCell * (depth - 0.5)) - 1.0));
    }
    return worst;
}

TEST(Projection, CarriesTheWeightOfDeepLiquid) {
    TestWorld<float> world(tank(16, 128, 120));
    ASSERT_EQ(world->fill(pool(16, 120)), Status::ok);
    for (int step = 0; step < 60; ++step) {
        world->step(kStep);
    }
    EXPECT_LT(bottom_error(*world, 120.0), 2.0e-3);
}

/// Coarse cells at the far sides have 1, 2 or 3 cells along an axis.
TEST(Projection, EveryWidthIsAsGood) {
    for (std::int32_t width = 28; width < 36; ++width) {
        for (const bool periodic : {false, true}) {
            if (periodic && width % 2 != 0) {
                continue;
            }
            SCOPED_TRACE(width);
            SCOPED_TRACE(periodic);
            WorldDef def = tank(width, width + 8, width);
            def.periodic_x = periodic;
            TestWorld<double> world(def);
            ASSERT_EQ(world->fill(pool(width, width)), Status::ok);
            for (int step = 0; step < 4; ++step) {
                world->step(kStep);
            }
            EXPECT_LT(bottom_error(*world, width), 1.0e-5);
        }
    }
}

/// Whatever the pressure at the bottom is, what an inverse is rounded by does not flow out there: as
/// other numbers are kept, 0.06 cells/s did.
TEST(Projection, DeepFixedPointLiquidStaysWhereItIs) {
    TestWorld<Fixed> world(tank(12, 64, 60));
    ASSERT_EQ(world->fill(pool(12, 60)), Status::ok);
    double fastest = 0.0;
    for (int step = 0; step < 120; ++step) {
        world->step(kStep);
        for (const auto& v : world->particle_velocities()) {
            fastest = std::max(fastest, step < 60 ? 0.0 : std::abs(static_cast<double>(v.y)));
        }
    }
    EXPECT_LT(fastest, 4.0e-3);
}

/// A lattice that stands too low at the bottom is 1 % too dense as a whole: it has to rise by a
/// sixth of a cell.
TEST(Volume, ADenseStartExpandsSoon) {
    TestWorld<float> world(tank(32, 24, 17));
    for (int b = 0; b < 32; ++b) {
        for (int a = 0; a < 64; ++a) {
            const double x = (a + 0.5) / 2.0;
            const double y = 0.089 + b / 2.0;
            ASSERT_EQ(world->add_particle({static_cast<float>(kCell * x),
                                           static_cast<float>(kCell * y)}, {0, 0}), Status::ok);
        }
    }
    world->step(kStep);
    EXPECT_GT(bottom_error(*world, 16.0), 0.008);
    for (int step = 0; step < 600; ++step) {
        world->step(kStep);
    }
    EXPECT_LT(bottom_error(*world, 16.0), 0.004);
}

/// Of the old pressure p as much is taken as brings it nearer to the solution, in eighths; pᵀb and
/// pᵀAp tell.
TEST(PressureStart, IsNoFurtherThanNone) {
    const double wanted[] = {1.0, 0.5, 0.4, 0.26, 0.13, 0.1, 0.0, -1.0};
    const double share[] = {1.0, 1.0, 0.375, 0.25, 0.125, 0.0, 0.0, 0.0};
    for (int k = 0; k < 8; ++k) {
        EXPECT_EQ(share_of_start<double>(wanted[k], 1.0), share[k]) << wanted[k];
    }
}

/// Packed worlds keep of what adds energy half as much again as takes most away, in sixteenths.
TEST(PressureStart, OfPackedLiquidAddsNoEnergy) {
    const double wanted[] = {1.0, 0.5, 0.499, 0.25, 0.05, 0.04, 0.0, -1.0};
    const double share[] = {1.0, 1.0, 0.6875, 0.375, 0.0625, 0.0, 0.0, 0.0};
    for (int k = 0; k < 8; ++k) {
        Product<SmallFixed> sum;
        Product<SmallFixed> all;
        sum.raw = static_cast<std::int64_t>(wanted[k] * 1000);
        all.raw = 1000;
        EXPECT_EQ(static_cast<double>(share_of_start<SmallFixed>(sum, all)), share[k]);
    }
}

TEST(PressureStart, OfAMuchLongerStepIsLess) {
    const auto rescaled = [](float dt_s, float change) {
        PressureFields<float> fields;
        fields.last_dt = 1.0e-3F;
        fields.change = change;
        const float rescale = begin_solve(8, dt_s, fields).rescale;
        EXPECT_EQ(fields.change, 1.0F);
        return rescale;
    };
    EXPECT_FLOAT_EQ(rescaled(5.0e-3F, 1.0F), 5.0F);
    EXPECT_EQ(rescaled(0.1F, 1.0F), kMostRescale<float>);
    EXPECT_FLOAT_EQ(rescaled(2.0e-4F, 1.0F), 0.2F);
    EXPECT_FLOAT_EQ(rescaled(2.0e-3F, 0.5F), 1.0F) << "gravity has halved";
}

/// Pressure pushes through a narrow gap with four times its share; compressible liquid through its
/// surface with no more than that.
TEST(NarrowGap, IsNoLever) {
    PressureFields<float> fields;
    EXPECT_FLOAT_EQ(push_through(fields, true, 0.1F), 0.4F);
    EXPECT_EQ(push_through(fields, true, 0.5F), 1.0F);
    fields.sound_speed = 10.0F;
    EXPECT_EQ(push_through(fields, true, 0.1F), 0.1F);
    EXPECT_FLOAT_EQ(push_through(fields, false, 0.1F), 0.4F);
}

/// A jet's cells hold more than the liquid fraction: all of that is moved by what is more than a
/// cell's weight. Not by less, nor where liquid has no weight, unless it is compressible.
TEST(JetShare, OfMoreThanAWeightMovesAllThatIsThere) {
    float level[] = {0.25F, -0.25F};
    float density[] = {1.0F, 0.5F};
    float pressure[] = {4.0F, 0.0F};
    PressureFields<float> fields;
    fields.level = level;
    fields.density = density;
    fields.pressure = pressure;
    const auto share = [&] { return jet_share(fields, 0, 1, 1.0F, 1.0F); };
    EXPECT_EQ(share(), 1.0F) << "no weight";
    fields.cell_weight = 8.0F;
    const float fraction = liquid_fraction(fields, level[0], level[1], 1.0F);
    EXPECT_FLOAT_EQ(share(), fraction) << "of a mass of 1";
    pressure[0] = 3.0F;  // half of a weight more than a weight
    EXPECT_FLOAT_EQ(share(), 0.5F + 0.5F * fraction);
    pressure[0] = 2.0F;
    EXPECT_EQ(share(), 1.0F);
    pressure[0] = 4.0F;
    fields.on_surface = true;
    EXPECT_EQ(share(), 1.0F) << "bent surfaces make pressure, too";
    fields.on_surface = false;
    fields.sound_speed = 10.0F;
    fields.cell_weight = 0.0F;
    EXPECT_FLOAT_EQ(share(), liquid_fraction(fields, level[0], level[1], 1.0F) / 0.75F);
}

/// Gravity that grows takes the pressure along up to twice as much; compressible liquid's not.
TEST(PressureStart, FollowsGravityToTwiceItAtMost) {
    for (const Pressure pressure : {Pressure::projection, Pressure::equation_of_state}) {
        WorldDef def = small_def();
        def.pressure = pressure;
        def.gravity_mps2 = {0.0F, -1.0F};
        TestWorld<float> world(def);
        const auto change = [&] {
            return state_of(world).simulation.pressure.change;
        };
        const bool elastic = pressure == Pressure::equation_of_state;
        expect_ok(world->set_gravity({0.0F, -1.5F}));
        EXPECT_FLOAT_EQ(change(), elastic ? 1.0F : 1.5F);
        expect_ok(world->set_gravity({0.0F, -9.0F}));
        EXPECT_FLOAT_EQ(change(), elastic ? 1.0F : 3.0F);
        expect_ok(world->set_gravity({0.0F, -4.5F}));
        EXPECT_FLOAT_EQ(change(), elastic ? 0.5F : 1.5F);
    }
}

}  // namespace
}  // namespace weir
