// A box of walls without thickness that turns, for more than a turn, keeps what is in it.
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

WEIR_SUITE(TurningBox, RoomyScalars);

/// Angles jump by a turn now and then: so does no wall.
TYPED_TEST(TurningBox, HoldsItsLiquid) {
    WorldDef def = tank_def(32, 32, 600, 1, 8);
    def.capacity.wall_edges = 1200;
    TestWorld<TypeParam> world(def);
    const Ring walls = {{-0.1F, -0.1F}, {0.1F, -0.1F}, {0.1F, 0.1F}, {-0.1F, 0.1F},
                        {-0.1F, -0.1F}};
    BodyDef box = body_of(walls, {0.32F, 0.32F});
    box.open = true;
    box.motion.spin_radps = 9.0F;
    const BodyId id = put_moving(*world, box);
    expect_ok(world->fill({{0.25F, 0.25F}, {0.39F, 0.33F}}));
    const std::int32_t count = world->particle_positions().size;
    for (int step = 0; step < 120; ++step) {
        EXPECT_EQ(world->step(1.0F / 60.0F).particles, count);
        const float angle = motion_of(*world, id).angle_rad;
        const float c = std::cos(angle);
        const float s = std::sin(angle);
        std::int32_t outside = 0;
        for (const auto& at : world->particle_positions()) {
            const float x = static_cast<float>(at.x) * def.cell_m - 0.32F;
            const float y = static_cast<float>(at.y) * def.cell_m - 0.32F;
            outside += std::fabs(c * x + s * y) < 0.1005F && std::fabs(c * y - s * x) < 0.1005F
                           ? 0 : 1;
        }
        ASSERT_EQ(outside, 0) << step;
    }
}

}  // namespace
}  // namespace weir
