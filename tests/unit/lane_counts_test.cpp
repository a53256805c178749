// Worlds stepped with as many lanes as the processor has, and with fewer: the same bits.
#include <gtest/gtest.h>

#include "busy_world.hpp"
#include "fewer_lanes.hpp"

namespace weir {
namespace {

/// Rows of all lengths, against those of lanes.
std::vector<std::uint64_t> hashes(std::int32_t kind, std::int32_t lanes) {
    const Fewer fewer(lanes);
    std::vector<std::uint64_t> hashes;
    for (const std::int32_t wide : {10, 31, 54, 75, 96}) {
        WorldDef def = busy_def(kind);
        def.capacity.cells_x = def.periodic_x ? wide & ~1 : wide;
        def.capacity.cells_y = 22;
        def.capacity.particles = 60 * wide;
        TestWorld<float> world(def);
        Dice dice(static_cast<std::uint64_t>(wide));
        EXPECT_EQ(world->fill({{0.0F, 0.0F}, {0.015F * static_cast<float>(wide), 0.2F}}),
                  Status::ok);
        for (std::int32_t step = 0; step < 6; ++step) {
            live(*world, dice, 2);
            hashes.push_back(world->state_hash());
        }
    }
    return hashes;
}

class LaneCounts : public testing::TestWithParam<std::tuple<std::int32_t, std::int32_t>> {};

TEST_P(LaneCounts, HaveTheBitsOfFourLanes) {
    const auto [kind, lanes] = GetParam();
    if (lanes_of_processor() < lanes) {
        GTEST_SKIP() << "no " << lanes << " lanes on this processor, or in this build";
    }
    EXPECT_EQ(hashes(kind, lanes), hashes(kind, 4));
}
INSTANTIATE_TEST_SUITE_P(OfBusyWorlds, LaneCounts,
                         testing::Combine(testing::Range(0, kBusyKinds), testing::Values(8, 16)));

}  // namespace
}  // namespace weir
