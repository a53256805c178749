// What the volume stage takes for too dense and too thin.
#include <gtest/gtest.h>

#include "pressure/excess.hpp"
#include "pressure/patch_drift.hpp"

namespace weir {
namespace {

/// A cell amid liquid, and those around it.
struct Cell {
    float density[9] = {};
    float level[9] = {};
    float pressure[9] = {};
    float result[9] = {};
    float light[9] = {};
    PressureFields<float> fields;
    StaggeredGrid<float> grid;

    Cell(float how_dense, float how_pressed) {
        fields.density = density;
        fields.level = level;
        fields.pressure = pressure;
        fields.divergence = result;
        for (float& one : level) {
            one = 2.0F;
        }
        density[4] = how_dense;
        pressure[4] = how_pressed;
        grid.shape.stride = 3;
    }
    /// One of two liquids, so many times as heavy as the first.
    void weigh(float ratio) {
        for (float& one : light) {
            one = 1.0F / ratio;
        }
        grid.inverse_density_u = light;
        grid.inverse_density_v = light;
    }
    float excess_under(float weight) {
        return excess<float>(grid.shape, fields, held_by(weight, fields, grid), 4, 2.0F);
    }
};

TEST(Excess, IsWhatADensityIsAboveOrBelowOne) {
    EXPECT_FLOAT_EQ(Cell(1.25F, 3.0F).excess_under(1.0F), 0.25F);
    EXPECT_FLOAT_EQ(Cell(0.75F, 3.0F).excess_under(1.0F), -0.25F);
}

TEST(Excess, OfWhatHangsIsNoDeficit) {
    EXPECT_FLOAT_EQ(Cell(0.75F, -0.5F).excess_under(1.0F), -0.125F) << "half a cell's weight";
    EXPECT_FLOAT_EQ(Cell(0.75F, -2.0F).excess_under(1.0F), 0.0F);
    EXPECT_FLOAT_EQ(Cell(1.25F, -2.0F).excess_under(1.0F), 0.25F) << "it may yet be too dense";
    EXPECT_FLOAT_EQ(Cell(0.75F, -2.0F).excess_under(0.0F), -0.25F) << "without gravity";
}

TEST(Excess, OfWhatHangsCountsByItsOwnWeight) {
    const auto excess_of = [](float ratio) {
        Cell cell(0.75F, -0.5F);
        cell.weigh(ratio);
        return cell.excess_under(1.0F);
    };
    EXPECT_FLOAT_EQ(excess_of(1.0F), -0.125F);
    EXPECT_FLOAT_EQ(excess_of(4.0F), -0.21875F) << "an eighth of its weight";
    EXPECT_FLOAT_EQ(excess_of(0.25F), 0.0F) << "twice its weight";
}

TEST(Excess, OfCompressibleLiquidWantsPressureToBeADeficit) {
    const auto excess_of = [](float density, float pressure, float weight) {
        Cell cell(density, pressure);
        cell.fields.sound_speed = 10.0F;
        return cell.excess_under(weight);
    };
    EXPECT_FLOAT_EQ(excess_of(0.75F, 0.0F, 1.0F), 0.0F) << "nothing holds it";
    EXPECT_FLOAT_EQ(excess_of(0.75F, 0.5F, 1.0F), -0.125F) << "half a cell's weight";
    EXPECT_FLOAT_EQ(excess_of(0.75F, 2.0F, 1.0F), -0.25F);
    EXPECT_FLOAT_EQ(excess_of(1.25F, 0.0F, 1.0F), 0.25F) << "it may yet be too dense";
    EXPECT_FLOAT_EQ(excess_of(0.75F, 0.0F, 0.0F), -0.25F) << "without gravity";
}

TEST(Drift, PaysForWhatRisesAndGetsBackWhatFalls) {
    const auto price = [](float raised) {
        Weights<float> sums;
        sums.raised[0] = raised;
        sums.moving[0] = 1.0e4F;
        sums.disorder[0] = 1.0F;
        return price_of(sums, most_refund(PressureFields<float>{}));
    };
    EXPECT_NEAR(price(1.0F), 1.0e-4F, 1.0e-6F);
    EXPECT_NEAR(price(1.0e9F), 1.0F / 32.0F, 1.0e-6F) << "not more, however much it rises";
    EXPECT_FLOAT_EQ(price(-50.0F), -50.0e-4F);
    EXPECT_EQ(price(-80.0F), 0.0F) << "more than can be paid at once";
}

}  // namespace
}  // namespace weir
