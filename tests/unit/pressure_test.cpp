// What the projection reaches within its fixed work: deep liquid, any width, seams, odd lattices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test_world.hpp"
#include "weir/weir.hpp"

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

}  // namespace
}  // namespace weir
