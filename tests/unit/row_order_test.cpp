// The pool in the order of the grid's rows.
#include "fluid/row_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "busy_world.hpp"

namespace weir {
namespace {

constexpr std::int32_t kRows = 40;
constexpr std::int32_t kCount = 3000;

/// Particles anywhere, each with a velocity that tells who it is.
struct Pool {
    std::vector<Vec2f> position, velocity;
    std::vector<Liquid> kind;
    std::vector<std::int32_t> scratch = std::vector<std::int32_t>(2 * kRows);

    Pool() {
        measure::Random random(5);
        for (std::int32_t k = 0; k < kCount; ++k) {
            position.push_back({random.uniform(0.1F, 19.9F), random.uniform(0.1F, 39.9F)});
            velocity.push_back(told(position.back()));
            kind.push_back(position.back().x < 10.0F ? Liquid::first : Liquid::second);
        }
    }
    static Vec2f told(Vec2f at) { return {3.0F * at.x, at.x - at.y}; }
    void order(std::int32_t room) {
        Particles<float> particles{position.data(), velocity.data(), kCount, kCount, kind.data()};
        keep_row_order({0, kRows}, {scratch.data(), room}, particles);
    }
    bool ordered() const {
        return std::is_sorted(position.begin(), position.end(), [](Vec2f a, Vec2f b) {
            return static_cast<std::int32_t>(a.y) < static_cast<std::int32_t>(b.y);
        });
    }
    std::vector<std::array<float, 2>> places() const {
        std::vector<std::array<float, 2>> all;
        for (const Vec2f& at : position) {
            all.push_back({at.x, at.y});
        }
        std::sort(all.begin(), all.end());
        return all;
    }
};

TEST(RowOrder, MixedParticlesAreOrderedAndKeepWhatIsTheirs) {
    Pool pool;
    const auto before = pool.places();
    pool.order(2 * kRows);
    EXPECT_TRUE(pool.ordered());
    EXPECT_EQ(pool.places(), before);
    for (std::size_t k = 0; k < kCount; ++k) {
        const Vec2f told = Pool::told(pool.position[k]);
        EXPECT_EQ(pool.velocity[k].x, told.x);
        EXPECT_EQ(pool.velocity[k].y, told.y);
        EXPECT_EQ(pool.kind[k], pool.position[k].x < 10.0F ? Liquid::first : Liquid::second);
    }
}

TEST(RowOrder, WhatIsNearlyInOrderIsLeftAlone) {
    Pool pool;
    pool.order(2 * kRows);
    std::swap(pool.position[5], pool.position[kCount - 5]);
    pool.order(2 * kRows);
    EXPECT_FALSE(pool.ordered());
}

TEST(RowOrder, WithoutRoomNothingIsDone) {
    Pool pool;
    const auto before = pool.position;
    pool.order(2 * kRows - 1);
    EXPECT_EQ(before[0].x, pool.position[0].x);
    EXPECT_FALSE(pool.ordered());
}

/// Snapshots hold the order that there is; what comes after depends on nothing else.
TEST(RowOrder, SnapshotsKeepIt) {
    WorldDef def = busy_def(0);
    def.keep_sorted = true;
    TestWorld<float> world(def);
    EXPECT_EQ(world->fill({{0.02F, 0.02F}, {0.16F, 0.2F}}), Status::ok);
    Dice dice(3);
    live(*world, dice, 20);
    std::vector<std::byte> snapshot(snapshot_bytes<float>(def.capacity));
    EXPECT_EQ(world->save(snapshot.data(), snapshot.size()), Status::ok);
    Dice again = dice;
    live(*world, dice, 20);
    const std::uint64_t after = world->state_hash();
    EXPECT_EQ(world->restore(snapshot.data(), snapshot.size()), Status::ok);
    live(*world, again, 20);
    EXPECT_EQ(world->state_hash(), after);
}

}  // namespace
}  // namespace weir
