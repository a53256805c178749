// What the volume stage takes for too dense and too thin.
#include <gtest/gtest.h>

#include "pressure/excess.hpp"

namespace weir {
namespace {

/// A cell amid liquid, and those around it.
struct Cell {
    float density[9] = {};
    float level[9] = {};
    float pressure[9] = {};
    float result[9] = {};
    PressureFields<float> fields;

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
    }
    float excess_under(float weight) {
        const float hanging = weight > 0.0F ? 1.0F / weight : 0.0F;
        return excess<float>(fields, hanging, 4, 2.0F);
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

}  // namespace
}  // namespace weir
