// Liquid that stands apart from a wall of no thickness closes the gap, as it does before others.
#include <gtest/gtest.h>

#include <algorithm>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr std::int32_t kColumns = 24;
constexpr float kFloor = 5.88F;  ///< cells

/// Height of the lowest particle over a floor of that kind after 4 s, cells; 0.87 at first.
template <class Real>
float height_over(bool open) {
    WorldDef def = tank_def(kColumns, 24, 1200, 1, 4);
    def.capacity.wall_edges = open ? 600 : 0;
    def.cell_m = kCell;
    TestWorld<Real> world{def};
    const float right = static_cast<float>(kColumns);
    Ring ring = open ? Ring{{0, kFloor}, {right, kFloor}}
                     : Ring{{-1, 0}, {right + 1, 0}, {right + 1, kFloor}, {-1, kFloor}};
    for (Vec2f& vertex : ring) {
        vertex = kCell * vertex;
    }
    BodyDef floor = body_of(ring, {0, 0});
    floor.open = open;
    put_static(*world, floor);
    expect_ok(world->fill({{0, 6.6F * kCell}, {right * kCell, 16.6F * kCell}}));
    for (int step = 0; step < 240; ++step) {
        world->step(1.0F / 60.0F);
    }
    float lowest = 100.0F;
    const auto places = world->particle_positions();
    for (std::int32_t k = 0; k < places.size; ++k) {
        lowest = std::min(lowest, static_cast<float>(places[k].y) - kFloor);
    }
    return lowest;
}

WEIR_SUITE(ThinFloor, RoomyScalars);

TYPED_TEST(ThinFloor, IsReached) {
    const float over_slab = height_over<TypeParam>(false);
    const float over_line = height_over<TypeParam>(true);
    EXPECT_LT(over_line, 0.65F);
    EXPECT_GT(over_line, 0.0F);
    EXPECT_LT(over_line - over_slab, 0.3F);
}

}  // namespace
}  // namespace weir
