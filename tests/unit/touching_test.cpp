// Static bodies that touch: what they make together has no seams.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

WorldDef tank() {
    WorldDef def = small_def();
    def.capacity.cells_x = 24;
    def.capacity.bodies = 6;
    def.capacity.vertices = 32;
    return def;
}

Ring box(float left, float right, float top) {
    return {{left * kCell, -kCell}, {right * kCell, -kCell}, {right * kCell, top * kCell},
            {left * kCell, top * kCell}};
}

template <class Real>
void add_all(TestWorld<Real>& world, const std::vector<Ring>& rings) {
    for (const Ring& ring : rings) {
        put_static(*world, body_of(ring, {0, 0}));
    }
}

/// Whether a particle would stand in a solid, at a place in cells.
template <class Real>
bool is_solid(TestWorld<Real>& world, float x, float y) {
    const Status status = world->add_particle({kCell * x, kCell * y}, {0, 0});
    if (status == Status::ok) {
        EXPECT_EQ(world->remove_particle(0), Status::ok);
    }
    return status == Status::particle_inside_solid;
}

/// From one place to another: solid up to a height, and open from there on.
template <class Real>
void expect_floor(TestWorld<Real>& world, float from, float to, float height) {
    for (float x = from; x <= to; x += 0.125F) {
        EXPECT_TRUE(is_solid(world, x, height - 0.03F)) << x;
        EXPECT_FALSE(is_solid(world, x, height + 0.03F)) << x;
    }
}

using Scalars = testing::Types<float, Fixed, SmallFixed>;
WEIR_SUITE(Touching, Scalars);

TYPED_TEST(Touching, AFloorOfTilesIsFlat) {
    const std::vector<std::vector<Ring>> floors = {
        {box(-2.0F, 26.0F, 4.4F)},
        {box(-2.0F, 12.02F, 4.4F), box(12.02F, 26.0F, 4.4F)},
        {box(-2.0F, 10.0F, 4.4F), box(13.98F, 26.0F, 4.4F), box(10.0F, 13.98F, 4.4F)},
        {box(-2.0F, 12.1F, 4.4F), box(11.9F, 26.0F, 4.4F)},
        {box(-2.0F, 26.0F, 4.4F), box(-2.0F, 26.0F, 4.4F)}};
    for (const std::vector<Ring>& rings : floors) {
        TestWorld<TypeParam> world{tank()};
        add_all(world, rings);
        expect_floor(world, 4.0F, 20.0F, 4.4F);
    }
}

/// More of them around a few nodes than are listed together. (SmallFixed has no room for as many.)
template <class Real>
void expect_crumbs_are_flat(bool top_first) {
    constexpr float kSize = 0.4F;
    WorldDef def = tank();
    def.capacity.bodies = 480;
    def.capacity.vertices = 1920;
    TestWorld<Real> world{def};
    std::vector<Ring> rings;
    for (int row = 0; row < 12; ++row) {
        for (int k = 0; k < 40; ++k) {
            const auto edge = [](int n) { return kSize * static_cast<float>(n) * kCell; };
            rings.push_back({{edge(k + 8), edge(row)}, {edge(k + 9), edge(row)},
                             {edge(k + 9), edge(row + 1)}, {edge(k + 8), edge(row + 1)}});
        }
    }
    if (top_first) {
        std::reverse(rings.begin(), rings.end());
    }
    add_all(world, rings);
    expect_floor(world, 6.0F, 16.0F, 12.0F * kSize);
    EXPECT_FALSE(is_solid(world, 3.0F, 1.0F));
}

TEST(TouchingCrumbs, AreFlat) {
    for (const bool top_first : {false, true}) {
        expect_crumbs_are_flat<float>(top_first);
        expect_crumbs_are_flat<Fixed>(top_first);
    }
}

/// A step keeps its height, and its edge up to the cell that the edge is in.
TYPED_TEST(Touching, ALowerTileCoversNoHigherOne) {
    TestWorld<TypeParam> world{tank()};
    add_all(world, {box(-2.0F, 12.0F, 4.4F), box(12.0F, 26.0F, 2.4F)});
    expect_floor(world, 4.0F, 11.0F, 4.4F);
    expect_floor(world, 13.0F, 20.0F, 2.4F);
    EXPECT_TRUE(is_solid(world, 11.9F, 3.5F));
    EXPECT_FALSE(is_solid(world, 12.1F, 3.5F));
}

/// The same tiles in any order, one taken away and put back.
TYPED_TEST(Touching, TheOrderIsAllTheSame) {
    std::vector<Ring> rings = {box(-2.0F, 7.3F, 4.4F), box(7.3F, 12.02F, 4.4F),
                               box(12.02F, 26.0F, 4.4F), box(11.0F, 13.0F, 5.2F)};
    std::uint64_t first = 0;
    for (int turn = 0; turn < 4; ++turn) {
        TestWorld<TypeParam> world{tank()};
        add_all(world, rings);
        if (turn == 3) {
            const BodyId id = put_static(*world, body_of(box(6.0F, 8.0F, 4.5F), {0, 0}));
            ASSERT_EQ(world->remove_body(id), Status::ok);
        }
        ASSERT_EQ(world->fill({{0.1F, 0.12F}, {0.3F, 0.2F}}), Status::ok);
        for (int step = 0; step < 30; ++step) {
            world->step(1.0F / 60.0F);
        }
        std::uint64_t sum = 0;
        for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
            const auto at = convert<float>(world->particle_positions()[k]);
            sum = sum * 31U + static_cast<std::uint64_t>(at.x * 65536.0F) * 7U +
                  static_cast<std::uint64_t>(at.y * 65536.0F);
        }
        first = turn == 0 ? sum : first;
        EXPECT_EQ(sum, first) << turn;
        std::rotate(rings.begin(), rings.begin() + 1, rings.end());
    }
}

}  // namespace
}  // namespace weir
