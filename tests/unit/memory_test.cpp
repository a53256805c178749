// The layout: a sum whose terms are aligned, disjoint and owned.
#include "weir/memory.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <type_traits>
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

/// Of a cell of the tank or of the ring around it.
template <class Real>
constexpr double bytes_a_cell(std::int32_t bodies) {
    const std::size_t small = world_bytes<Real>(capacity(64, 30, 30, bodies, 0));
    const std::size_t large = world_bytes<Real>(capacity(64, 62, 62, bodies, 0));
    return static_cast<double>(large - small) / (64 * 64 - 32 * 32);
}
static_assert(bytes_a_cell<SmallFixed>(0) == 18, "no coarse grid of their own");
static_assert(bytes_a_cell<SmallFixed>(2) < 28.5 && bytes_a_cell<float>(0) < 38.5, "as told");

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

/// Limits as numbers: who reads a log has no header at hand.
TEST(Memory, TextsOfLimitsGiveThem) {
    const auto tells = [](Status status, auto... numbers) {
        const std::string text = status_text(status);
        for (const std::int32_t number : {static_cast<std::int32_t>(numbers)...}) {
            EXPECT_NE(text.find(std::to_string(number)), std::string::npos) << text << number;
        }
        EXPECT_EQ(text.find("kM"), std::string::npos) << text;
    };
    tells(Status::cells_out_of_range, kMinCells, kMaxCells, kMaxCellsFixed, kMaxCellsSmallFixed);
    tells(Status::particle_capacity_out_of_range, kMaxParticles);
    tells(Status::body_capacity_out_of_range, kMaxBodies, kMaxBodiesSmallFixed);
    tells(Status::vertex_capacity_out_of_range, kMaxVertices);
    tells(Status::contact_capacity_out_of_range, kMaxBodies);
    tells(Status::wall_edge_capacity_out_of_range, kMaxWallEdges);
    tells(Status::polygon_too_many_vertices, kMaxBodyVertices);
    tells(Status::gravity_out_of_range, kMaxGravity, kMaxGravityFixed);
    tells(Status::top_speed_out_of_range, kMaxTopSpeedSmallFixed);
    for (const Status status :
         {Status::conveyor_out_of_range, Status::motion_out_of_range,
          Status::velocity_out_of_range}) {
        tells(status, kMaxSpeedFixed, kMaxSpeedSmallFixed);
    }
    static_assert(kMaxSpeed == 1e6F && kMaxAngle == 1e4F, "as in the texts");
}

constexpr Vec2f kCorners[] = {{0, 0}, {0.1F, 0}, {0, 0.1F}};
constexpr View<Vec2f> kWhole = kCorners;
static_assert(kWhole.data == kCorners && kWhole.size == 3, "known at compile time");
static_assert(View<Vec2f>().data == nullptr && View<Vec2f>{kCorners, 2}.size == 2, "as ever");
static_assert(std::is_trivially_copyable<View<Vec2f>>::value, "passed in registers");
static_assert(!std::is_constructible<View<Vec2f>, std::vector<Vec2f>>::value, "gone at once");
static_assert(!std::is_constructible<View<Vec2f>, Vec2<double> (&)[3]>::value, "of others");

TEST(Memory, ViewsAreOfArraysAndOfWhatHasDataAndSize) {
    const std::vector<Vec2f> vector(5);
    std::array<Vec2f, 4> array{};
    Vec2f plain[7];
    BodyDef def;
    const auto is_now = [&def](const Vec2f* data, std::int32_t size) {
        EXPECT_EQ(def.polygon.data, data);
        EXPECT_EQ(def.polygon.size, size);
    };
    def.polygon = vector;
    is_now(vector.data(), 5);
    def.polygon = array;
    is_now(array.data(), 4);
    def.polygon = plain;
    is_now(plain, 7);
    def.polygon = {plain, 3};
    is_now(plain, 3);
    View<Vec2f> copy(def.polygon);
    def.polygon = {};
    is_now(nullptr, 0);
    def.polygon = copy;
    is_now(plain, 3);
    const View<Vec2f> rings[] = {array, kCorners};
    def.holes = rings;
    EXPECT_EQ(def.holes.size, 2);
    EXPECT_EQ(def.holes[1].size, 3);
    EXPECT_FLOAT_EQ(polygon_area(kCorners), 0.005F);
}

TEST(Memory, AnyArrayOfBytesIsAWorlds) {
    constexpr Capacity kLeast = capacity(8, kMinCells, kMinCells, 0, 0);
    constexpr std::size_t kBytes = world_bytes<SmallFixed>(kLeast);
    WorldDef def;
    def.capacity = kLeast;
    alignas(world_alignment) std::byte bytes[kBytes];
    alignas(world_alignment) unsigned char chars[kBytes];
    alignas(world_alignment) std::array<std::byte, kBytes> array;
    alignas(world_alignment) std::array<unsigned char, kBytes - 1> short_by_one;
    World<SmallFixed> world;
    EXPECT_EQ(world.init(def, bytes), Status::ok);
    EXPECT_EQ(world.init(def, chars), Status::ok);
    EXPECT_EQ(world.init(def, array), Status::ok);
    EXPECT_EQ(world.init(def, short_by_one), Status::memory_too_small);
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
    BodyDef body = body_of(kTriangle, {0.2F, 0.08F});
    put_static(world, body);
    body.motion.spin_radps = 5.0F;
    body.motion.position_m = {0.1F, 0.15F};
    put_moving(world, body);
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
