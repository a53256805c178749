// Loops in lanes against the plain loops: the same bits, whatever the particles do.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "pressure/surface_lanes.hpp"
#include "pressure/surface_level.hpp"
#include "step/grid_to_particle.hpp"
#include "step/particle_to_grid.hpp"

namespace weir {
namespace {

constexpr std::int32_t kWide = 13;
constexpr std::int32_t kHigh = 7;
constexpr std::int32_t kCount = 2000;

/// Fields in one block, as a world lays them out; with or without room for pairs.
struct Tank {
    GridShape shape{kWide, kHigh, kWide + 2};
    std::vector<float> memory;
    std::vector<Vec2f> position, velocity;
    std::int32_t count = kCount;
    StaggeredGrid<float> grid;

    explicit Tank(bool lanes) : memory(static_cast<std::size_t>(6 * shape.size())) {
        float* field = memory.data();
        const std::int32_t size = shape.size();
        grid = {shape, field, field + 2 * size, field + size, field + 3 * size};
        grid.pairs = lanes ? field + 4 * size : nullptr;
        std::mt19937 random(7);
        std::uniform_real_distribution<float> part(0.0F, 1.0F);
        for (std::int32_t k = 0; k < kCount; ++k) {
            const Vec2f anywhere{part(random) * static_cast<float>(kWide),
                                 part(random) * static_cast<float>(kHigh)};
            position.push_back(within_tank(shape, anywhere));
            velocity.push_back({20.0F * part(random) - 10.0F, 20.0F * part(random) - 10.0F});
        }
    }
    Particles<float> particles() {
        return {position.data(), velocity.data(), count, kCount};
    }
    void fill_fields() {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> speed(-9.0F, 9.0F);
        for (std::int32_t k = 0; k < 4 * shape.size(); ++k) {
            memory[static_cast<std::size_t>(k)] = speed(random);
        }
    }
    TransferResult<float> gather(float limit, bool wrap, Vec2f* left = nullptr) {
        auto all = particles();
        const SurfaceLaw<float> wall{0.5F, 0.3F, 0.0F, false};
        const Borders<float> borders{wrap, wrap, false, wall, wall, wall, wall};
        Transfer<float> transfer{0.05F, 0.97F, limit, borders};
        transfer.near = 20.0F;
        transfer.ways = left;
        transfer.keeps_places = left != nullptr;
        prepare_gather(grid);
        return grid_to_particle(grid, transfer, all);
    }
};

bool same(const std::vector<Vec2f>& a, const std::vector<Vec2f>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

TEST(Lanes, ScatterHasThePlainLoopsBits) {
    if (!kHasLanes<float>) {
        GTEST_SKIP() << "no lanes on this processor";
    }
    Tank plain(false), lanes(true);
    for (Tank* tank : {&plain, &lanes}) {
        particle_to_grid(tank->particles(), Borders<float>{}, 1.0F, tank->grid);
    }
    const std::size_t bytes = 4 * static_cast<std::size_t>(plain.shape.size()) * sizeof(float);
    EXPECT_EQ(std::memcmp(plain.memory.data(), lanes.memory.data(), bytes), 0);
}

class GatherInLanes : public testing::TestWithParam<bool> {};

TEST_P(GatherInLanes, HasThePlainLoopsBits) {
    if (!kHasLanes<float>) {
        GTEST_SKIP() << "no lanes on this processor";
    }
    for (const float limit : {100.0F, 4.0F}) {
        Tank plain(false), lanes(true);
        TransferResult<float> result[2];
        for (Tank* tank : {&plain, &lanes}) {
            tank->fill_fields();
            tank->velocity[5].x = std::numeric_limits<float>::quiet_NaN();
            tank->velocity[6].y = -std::numeric_limits<float>::infinity();
            result[tank == &lanes] = tank->gather(limit, GetParam());
        }
        EXPECT_TRUE(same(plain.position, lanes.position));
        EXPECT_TRUE(same(plain.velocity, lanes.velocity));
        EXPECT_EQ(result[0].reset, 2);
        EXPECT_EQ(result[0].reset, result[1].reset);
        EXPECT_EQ(result[0].slowed, result[1].slowed);
        EXPECT_EQ(result[0].slowed > 0, limit < 10.0F);
        EXPECT_EQ(result[0].far, result[1].far);
        EXPECT_EQ(result[0].max_speed, result[1].max_speed);
    }
}
TEST_P(GatherInLanes, LeavesThePlacesThatParticlesComeFrom) {
    if (!kHasLanes<float>) {
        GTEST_SKIP() << "no lanes on this processor";
    }
    for (const float limit : {100.0F, 4.0F}) {
        Tank lanes(true), leaving(true);
        lanes.count = leaving.count = kCount - 1;  // the last ones are no whole group
        std::vector<Vec2f> left(kCount - 1);
        std::vector<Vec2f> before = leaving.position;
        before.pop_back();
        lanes.fill_fields();
        leaving.fill_fields();
        lanes.gather(limit, GetParam());
        leaving.gather(limit, GetParam(), left.data());
        EXPECT_TRUE(same(left, before));
        EXPECT_TRUE(same(lanes.position, leaving.position));
        EXPECT_TRUE(same(lanes.velocity, leaving.velocity));
    }
}
#if WEIR_HAS_LANES
TEST(Lanes, LevelHasThePlainFormulasBits) {
    for (std::int32_t k = -40; k < 4096; k += 4) {
        Lanes density{};
        for (std::int32_t lane = 0; lane < 4; ++lane) {
            density[lane] = static_cast<float>(k + lane) / 3900.0F;
        }
        const Lanes level = level_of_density_lanes<FourLanes>(density);
        for (std::int32_t lane = 0; lane < 4; ++lane) {
            const float plain = level_of_density<float>(density[lane]);
            EXPECT_EQ(plain, level[lane]) << "density " << density[lane];
        }
    }
}
#endif

INSTANTIATE_TEST_SUITE_P(WallsAndSeams, GatherInLanes, testing::Bool());

}  // namespace
}  // namespace weir
