// The layout: a sum whose terms are aligned, disjoint and owned.
#include "weir/memory.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr Capacity capacity(std::int32_t particles, std::int32_t cells_x, std::int32_t cells_y,
                            std::int32_t bodies, std::int32_t vertices) {
    Capacity c;
    c.particles = particles;
    c.cells_x = cells_x;
    c.cells_y = cells_y;
    c.bodies = bodies;
    c.vertices = vertices;
    return c;
}

constexpr Capacity kReadme = capacity(2000, 64, 32, 2, 8);
static_assert(world_bytes<float>(kReadme) <= 256 * 1024, "known at compile time");
static_assert(world_bytes<float>(kReadme) == layout<float>(kReadme).total_bytes, "one sum");
static_assert(world_bytes<float>(kReadme) < world_bytes<double>(kReadme), "a double is larger");
static_assert(world_bytes<float>(kReadme) % world_alignment == 0, "worlds can stand in an array");

const Capacity kCapacities[] = {
    Capacity{},
    kReadme,
    capacity(1, kMinCells, kMinCells, 0, 0),
    capacity(1, kMinCells, kMaxCells, 0, 0),
    capacity(7, 5, 9, 3, 11),
    capacity(1, 5, 9, 0, 13),
    capacity(kMaxParticles, kMaxCells, kMaxCells, kMaxBodies, kMaxVertices),
};

template <class Real>
void expect_sound(const Capacity& c) {
    const Layout plan = layout<Real>(c);
    std::size_t end = 0;
    std::size_t sum = 0;
    for (std::int32_t block = 0; block < kBlockCount; ++block) {
        EXPECT_EQ(plan.offset[block] % world_alignment, 0U) << block;
        EXPECT_GE(plan.offset[block], end) << "blocks overlap: " << block;
        end = plan.offset[block] + plan.bytes[block];
        sum += plan.bytes[block];
    }
    EXPECT_EQ(end, plan.total_bytes);
    EXPECT_EQ(sum, plan.total_bytes);
    std::size_t owned = 0;
    for (const std::size_t bytes : plan.owner_bytes) {
        owned += bytes;
    }
    EXPECT_EQ(owned, plan.total_bytes);
}

TEST(Memory, BlocksAreAlignedDisjointAndSumUp) {
    for (const Capacity& c : kCapacities) {
        expect_sound<float>(c);
        expect_sound<double>(c);
    }
}

TEST(Memory, EachBlockHasRoomForWhatItNames) {
    const Layout plan = layout<float>(kReadme);
    const auto bytes = [&](Block block) { return plan.bytes[static_cast<std::int32_t>(block)]; };
    const std::size_t cells = 66 * 34;
    EXPECT_GE(bytes(Block::particle_position), 2000U * 8);
    EXPECT_GE(bytes(Block::particle_velocity), 2000U * 8);
    EXPECT_GE(bytes(Block::velocity_u), cells * 4);
    EXPECT_GE(bytes(Block::pressure), cells * 4);
    EXPECT_GE(bytes(Block::merged_distance), cells * 4);
    EXPECT_GE(bytes(Block::merged_body), cells * 2);
    EXPECT_GE(bytes(Block::contour_case), cells);
    EXPECT_GE(bytes(Block::vertex_local), 8U * 8);
}

TEST(Memory, WithoutBodiesThereIsNoContour) {
    const Layout plan = layout<float>(capacity(1000, 32, 32, 0, 0));
    const auto owned = [&](Owner owner) {
        return plan.owner_bytes[static_cast<std::int32_t>(owner)];
    };
    EXPECT_EQ(owned(Owner::contour), 0U);
    EXPECT_EQ(owned(Owner::cut_cells), 0U);
    EXPECT_EQ(owned(Owner::bodies), 0U);
    EXPECT_EQ(owned(Owner::vertices), 0U);
    EXPECT_GT(owned(Owner::grid), 0U);
    EXPECT_GT(owned(Owner::pressure), 0U);
}

/// 24 bytes a cell with a static solid and 26 with one that moves; 25 and 28 with more of them.
TEST(Memory, OnePackedBodyAloneNeedsNoNamesAtNodes) {
    const auto a_cell = [](std::int32_t bodies, bool moving) {
        Capacity none = capacity(100, 62, 30, 0, 0);
        Capacity some = capacity(100, 62, 30, bodies, 0);
        some.moving_bodies = moving;
        const Layout a = layout<SmallFixed>(none);
        const Layout b = layout<SmallFixed>(some);
        const auto of = [&](Owner owner) { return b.owner_bytes[static_cast<std::int32_t>(owner)]; };
        const std::size_t near = b.bytes[static_cast<std::int32_t>(Block::near_wall)];
        EXPECT_EQ(b.total_bytes - a.total_bytes,
                  of(Owner::bodies) + of(Owner::contour) + of(Owner::cut_cells));
        return (of(Owner::contour) + of(Owner::cut_cells) - near) / (64 * 32);
    };
    EXPECT_EQ(a_cell(1, false), 6U);
    EXPECT_EQ(a_cell(1, true), 8U);
    EXPECT_EQ(a_cell(2, false), 7U);
    EXPECT_EQ(a_cell(2, true), 10U);
}

TEST(Memory, OwnersAndStagesAndStatusesHaveNames) {
    for (std::int32_t owner = 0; owner < kOwnerCount; ++owner) {
        ASSERT_NE(owner_name(static_cast<Owner>(owner)), nullptr);
        EXPECT_GT(std::strlen(owner_name(static_cast<Owner>(owner))), 0U);
    }
    for (std::int32_t stage = 0; stage < kStageCount; ++stage) {
        ASSERT_NE(stage_name(static_cast<weir::Stage>(stage)), nullptr);
        EXPECT_GT(std::strlen(stage_name(static_cast<weir::Stage>(stage))), 0U);
    }
    std::vector<std::string> texts;
    for (int status = 0; status < static_cast<int>(Status::count); ++status) {
        const char* text = status_text(static_cast<Status>(status));
        ASSERT_NE(text, nullptr);
        ASSERT_GT(std::strlen(text), 0U);
        for (const std::string& other : texts) {
            EXPECT_NE(other, text) << status;
        }
        texts.emplace_back(text);
    }
    EXPECT_NE(status_text(Status::count), nullptr);  // total, also for what is no status
    EXPECT_NE(status_text(static_cast<Status>(255)), nullptr);
    EXPECT_NE(owner_name(Owner::count), nullptr);
    EXPECT_NE(stage_name(weir::Stage::count), nullptr);
}

/// Steps a busy world whose memory is followed and preceded by a pattern, which must survive.
TEST(Memory, NothingIsWrittenBeyondTheBlock) {
    WorldDef def;
    def.capacity = capacity(300, 12, 9, 2, 9);
    const std::size_t bytes = world_bytes<float>(def.capacity);
    std::vector<std::uint64_t> buffer((bytes + 4096) / 8, 0xA5A5A5A5A5A5A5A5ULL);
    auto* base = reinterpret_cast<unsigned char*>(buffer.data());
    const std::size_t skip = 1024 + (world_alignment -
        reinterpret_cast<std::uintptr_t>(base + 1024) % world_alignment) % world_alignment;
    World<float> world;
    ASSERT_EQ(world.init(def, base + skip, bytes), Status::ok);
    ASSERT_EQ(world.fill({{0, 0}, {0.1F, 0.16F}}), Status::ok);
    BodyId id;
    BodyDef body = body_of(kTriangle, {0.2F, 0.08F});
    ASSERT_EQ(world.add_static_body(body, &id), Status::ok);
    body.motion.spin_radps = 5.0F;
    body.motion.position_m = {0.1F, 0.15F};
    ASSERT_EQ(world.add_moving_body(body, &id), Status::ok);
    for (int step = 0; step < 60; ++step) {
        world.step(1.0F / 60.0F);
        ASSERT_EQ(world.set_gravity({step % 2 == 0 ? 900.0F : -900.0F, 500.0F}), Status::ok);
    }
    for (std::size_t k = 0; k < skip; ++k) {
        ASSERT_EQ(base[k], 0xA5) << k;
    }
    for (std::size_t k = skip + bytes; k < buffer.size() * 8; ++k) {
        ASSERT_EQ(base[k], 0xA5) << k;
    }
}

TEST(Memory, ReinitialisedWorldIsANewOne) {
    TestWorld<float> a(small_def());
    ASSERT_EQ(a->fill({{0, 0}, {0.1F, 0.1F}}), Status::ok);
    a->step(0.01F);
    const std::uint64_t used = a->state_hash();
    ASSERT_EQ(a.init_again(), Status::ok);
    EXPECT_EQ(a->particle_positions().size, 0);
    TestWorld<float> b(small_def());
    EXPECT_EQ(a->state_hash(), b->state_hash());
    EXPECT_NE(a->state_hash(), used);
}

}  // namespace
}  // namespace weir
