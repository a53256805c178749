// A free body between two liquids of unlike density displaces its own mass of both.
#include <gtest/gtest.h>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr double kWide = 20;  // the tank, cells
constexpr double kInterface = 9;

/// How deep a body comes to rest in the lower liquid, cells, that begins with `share` of its height
/// in it, where it displaces what it weighs. The upper one is `upper` times as dense.
template <class Real>
double depth_in_lower(Vec2f cells, double share, float upper, float higher) {
    WorldDef def = tank_def(static_cast<std::int32_t>(kWide), 20, 1600, 1, 4);
    def.capacity.two_way = true;
    def.capacity.second_liquid = true;
    def.second_density_ratio = upper;
    def.viscosity_m2ps = 0.001F;
    def.pressure_sweeps = 16;
    TestWorld<Real> world(def);
    const Ring ring = rectangle(cells.x * kCell, cells.y * kCell);
    const auto width = static_cast<double>(cells.x);
    const auto height = static_cast<double>(cells.y);
    const auto middle = static_cast<float>(kInterface + (0.5 - share) * height) + higher;
    BodyDef body = body_of(ring, {10.3F * kCell, middle * kCell});
    body.density_ratio = static_cast<float>(share + (1 - share) * static_cast<double>(upper));
    body.hold = Hold::rail_y;
    const BodyId id = put_free(*world, body);
    const float level = static_cast<float>(kInterface) * kCell;
    std::int32_t below = 0;
    expect_ok(world->fill({{0, 0}, {static_cast<float>(kWide) * kCell, level}}, &below));
    expect_ok(world->fill({{0, level}, {static_cast<float>(kWide) * kCell, 17 * kCell}}, nullptr,
                          Liquid::second));
    double bottom = 0;
    constexpr int kSteps = 240;
    constexpr int kMean = 60;
    for (int step = 0; step < kSteps; ++step) {
        world->step(1.0F / 64.0F);
        const auto at = static_cast<double>(motion_of(*world, id).position_m.y / kCell);
        bottom += step >= kSteps - kMean ? (at - 0.5 * height) / kMean : 0;
    }
    return (below / 4.0 - width * bottom) / (kWide - width) - bottom;
}

WEIR_SUITE(BetweenLiquids, RoomyScalars);

/// What cells show of it is pressed by the density that they hold.
TYPED_TEST(BetweenLiquids, ABoxDisplacesItsMass) {
    for (const float higher : some_of({0.0F, 0.37F})) {
        EXPECT_NEAR(depth_in_lower<TypeParam>({6, 5}, 0.2, 0.1F, higher), 1.0, 0.1) << higher;
    }
    EXPECT_NEAR(depth_in_lower<TypeParam>({6, 4}, 0.5, 0.5F, 0.2F), 2.0, 0.1);
}

/// What no cell shows is lifted by as much as is around it.
TYPED_TEST(BetweenLiquids, SmallSquaresDisplaceTheirMass) {
    for (const float size : some_of({1.0F, 0.6F})) {
        EXPECT_NEAR(depth_in_lower<TypeParam>({size, size}, 0.5, 0.1F, 0),
                    0.5 * static_cast<double>(size), 0.2)
            << size;
    }
}

/// How high a body of half the liquid's density has come that lay on the floor, cells, in liquid
/// so many times as dense as the first: it bobs, so the mean of 100 steps.
template <class Real>
double height_in_alone(float size, float liquid) {
    WorldDef def = tank_def(24, 24, 1600, 1, 4);
    def.capacity.two_way = true;
    def.capacity.second_liquid = true;
    def.second_density_ratio = liquid;
    TestWorld<Real> world(def);
    const Ring ring = rectangle(size * kCell, size * kCell);
    BodyDef body = body_of(ring, {12.2F * kCell, (0.5F * size + 0.01F) * kCell});
    body.density_ratio = 0.5F * liquid;
    const BodyId id = put_free(*world, body);
    expect_ok(world->fill({{0, 0}, {24 * kCell, 16 * kCell}}, nullptr,
                          liquid == 1.0F ? Liquid::first : Liquid::second));
    double height = 0;
    for (int step = 0; step < 160; ++step) {
        world->step(1.0F / 64.0F);
        const float now = motion_of(*world, id).position_m.y / kCell;
        height += step < 60 ? 0 : static_cast<double>(now) / 100;
    }
    return height;
}

/// Alone a second liquid is to a body of so many times the mass what the first is: a small square
/// in one ten times as dense stayed on the floor.
TYPED_TEST(BetweenLiquids, SecondLiquidAloneLiftsAsTheFirstDoes) {
    const double small = height_in_alone<TypeParam>(1, 1);
    const double large = height_in_alone<TypeParam>(4, 1);
    for (const float liquid : some_of({10.0F, 0.1F})) {
        EXPECT_NEAR(height_in_alone<TypeParam>(1, liquid), small, 0.2) << liquid;
        EXPECT_NEAR(height_in_alone<TypeParam>(4, liquid), large, 0.6) << liquid;
    }
}

}  // namespace
}  // namespace weir
