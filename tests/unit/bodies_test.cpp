// Bodies: names, the vertex pool, the field that they draw, and when they draw it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "brute_distance.hpp"
#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kFrame = 1.0F / 60.0F;

WorldDef field_def(std::int32_t bodies, std::int32_t vertices) {
    WorldDef def = tank_def(40, 30, 4800, bodies, vertices);
    def.cell_m = kCell;
    return def;
}

const Ring kArrow = {{-0.1F, -0.08F}, {0.12F, 0.0F}, {-0.1F, 0.09F}, {-0.03F, 0.004F}};  // reflex

TEST(Names, GenerationsTellSuccessorsApart) {
    TestWorld<float> world(small_def());
    const BodyId first = put_static(*world, body_of(kTriangle, {0.1F, 0.1F}));
    ASSERT_EQ(world->remove_body(first), Status::ok);
    EXPECT_EQ(world->remove_body(first), Status::stale_body);
    const BodyId second = put_moving(*world, body_of(kTriangle, {0.1F, 0.1F}));
    EXPECT_EQ(second.slot, first.slot);
    EXPECT_NE(second.generation, first.generation);
    Motion motion;
    EXPECT_EQ(world->motion(first, &motion), Status::stale_body);
    EXPECT_EQ(world->motion(second, &motion), Status::ok);
}

TEST(Names, EachBodyHasItsOwn) {
    TestWorld<float> world(small_def());
    BodyId id[3];
    for (BodyId& each : id) {
        each = put_static(*world, body_of(kTriangle, {0.1F, 0.1F}));
    }
    EXPECT_NE(id[0].slot, id[1].slot);
    EXPECT_NE(id[1].slot, id[2].slot);
    EXPECT_NE(id[0].slot, id[2].slot);
}

TEST(Names, OldNamesStayStaleAfterInitOfTheSameMemory) {
    TestWorld<float> world(small_def());
    const BodyId old = put_moving(*world, body_of(kTriangle, {0.1F, 0.1F}));
    ASSERT_EQ(world.init_again(), Status::ok);
    Motion motion;
    EXPECT_EQ(world->motion(old, &motion), Status::stale_body) << "no body exists";
}

TEST(VertexPool, RemovalLeavesTheOthersIntact) {
    TestWorld<float> world(field_def(5, 19));
    const Ring rings[] = {kTriangle, kArrow, kSquare4cm, kTriangle, kArrow};
    const Vec2f at[] = {{0.1F, 0.1F}, {0.3F, 0.4F}, {0.5F, 0.1F}, {0.6F, 0.4F}, {0.15F, 0.35F}};
    Motion pose[5];
    BodyId id[5];
    for (int k = 0; k < 5; ++k) {
        pose[k] = body_of(rings[k], at[k], 0.3F * static_cast<float>(k)).motion;
        const BodyDef def = body_of(rings[k], at[k], pose[k].angle_rad);
        const Status added = k % 2 == 0 ? world->add_static_body(def, &id[k])
                                        : world->add_moving_body(def, &id[k]);
        if (k == 4) {
            ASSERT_EQ(added, Status::ok) << "3 + 4 + 4 + 3 + 4 vertices";
        }
    }
    const auto expect_without = [&](std::vector<int> gone) {
        std::vector<std::vector<Point>> left;
        for (int k = 0; k < 5; ++k) {
            if (std::find(gone.begin(), gone.end(), k) == gone.end()) {
                left.push_back(placed(rings[k], pose[k]));
            }
        }
        expect_field(*world, left);
    };
    expect_without({});
    ASSERT_EQ(world->remove_body(id[0]), Status::ok);
    expect_without({0});
    ASSERT_EQ(world->remove_body(id[3]), Status::ok);
    expect_without({0, 3});
    // Reuse: a body of the freed vertices, then a moved one drawn from the pool behind the gap.
    id[0] = put_static(*world, body_of(rings[0], at[0], 0));
    expect_without({3});
    pose[1].position_m = {0.35F, 0.3F};
    ASSERT_EQ(world->set_motion(id[1], pose[1]), Status::ok);
    world->step(kFrame);
    expect_without({3});
    ASSERT_EQ(world->remove_body(id[2]), Status::ok);
    expect_without({2, 3});
    for (const int k : {0, 1, 4}) {
        ASSERT_EQ(world->remove_body(id[k]), Status::ok);
    }
    expect_field(*world, {});
}

TEST(VertexPool, IsWholeAgainAfterAThousandBodies) {
    TestWorld<float> world(small_def());
    std::mt19937 random(4);
    std::vector<BodyId> alive;
    for (int k = 0; k < 1000; ++k) {
        if (!alive.empty() && (alive.size() == 3 || random() % 2 == 0)) {
            const std::size_t which = random() % alive.size();
            ASSERT_EQ(world->remove_body(alive[which]), Status::ok);
            alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(which));
        } else {
            const Ring& ring = random() % 2 == 0 ? kTriangle : kSquare4cm;
            const BodyId id = put_static(*world, body_of(ring, {0.1F, 0.1F}));
            alive.push_back(id);
        }
    }
    for (const BodyId id : alive) {
        ASSERT_EQ(world->remove_body(id), Status::ok);
    }
    for (int k = 0; k < 3; ++k) {
        put_static(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    }
}

TEST(Field, SignedDistanceIsExactNearTheWall) {
    for (const float angle : {0.0F, 0.4F, 1.9F, -2.7F}) {
        TestWorld<float> world(field_def(1, 4));
        const BodyDef def = body_of(kArrow, {0.41F, 0.29F}, angle);
        put_static(*world, def);
        expect_field(*world, {placed(kArrow, def.motion)});
    }
}

TEST(Field, OverlappingBodiesAreTheirUnion) {
    TestWorld<float> world(field_def(3, 12));
    const BodyDef a = body_of(kArrow, {0.41F, 0.29F}, 0.4F);
    const BodyDef b = body_of(kArrow, {0.45F, 0.27F}, 2.2F);
    const BodyDef c = body_of(kArrow, {0.35F, 0.33F}, -1.2F);
    put_static(*world, a);
    put_moving(*world, b);
    put_moving(*world, c);
    expect_field(*world, {placed(kArrow, a.motion), placed(kArrow, b.motion),
                          placed(kArrow, c.motion)});
}

TEST(Field, BodiesThatReachBeyondTheTank) {
    TestWorld<float> world(field_def(2, 8));
    const Ring wide = rectangle(2.0F, 0.1F);
    const BodyDef a = body_of(wide, {0.4F, 0.0F}, 0.1F);
    const BodyDef b = body_of(wide, {0.8F, 0.3F}, 1.5F);
    put_static(*world, a);
    put_moving(*world, b);
    expect_field(*world, {placed(wide, a.motion), placed(wide, b.motion)});
}

TEST(Field, MidEdgeIsPlusOrMinusHalf) {
    WorldDef def = field_def(1, 4);
    def.contour = Contour::mid_edge;
    TestWorld<float> world(def);
    const BodyDef body = body_of(kArrow, {0.41F, 0.29F}, 0.4F);
    put_static(*world, body);
    const std::vector<Point> ring = placed(kArrow, body.motion);
    const FieldView<float> field = world->signed_distance();
    const Point tank{double(world->cells_x()), double(world->cells_y())};
    for (std::int32_t j = 0; j < field.rows; ++j) {
        for (std::int32_t i = 0; i < field.columns; ++i) {
            const double exact = brute_distance(ring, {double(i), double(j)}, tank);
            if (exact < -1.0e-4) {
                ASSERT_EQ(field.at(i, j), -0.5F);
            } else if (exact > 1.0e-4 && exact < 1.4) {
                ASSERT_EQ(field.at(i, j), 0.5F);
            } else if (exact > 0) {
                ASSERT_TRUE(field.at(i, j) == 0.5F || field.at(i, j) == kFarFromSolids);
            }
        }
    }
}

/// In the binary matrix, too, a node that lies on the outline belongs to the solid: a wall one cell
/// thick whose faces lie on nodes is not lost.
TEST(Field, MidEdgeKeepsAWallOnNodes) {
    WorldDef def = field_def(1, 4);
    def.contour = Contour::mid_edge;
    def.cell_m = 0.03125F;  // exact in binary
    TestWorld<float> world(def);
    const Ring wall = {{0, 0}, {0.03125F, 0}, {0.03125F, 0.3125F}, {0, 0.3125F}};
    put_static(*world, body_of(wall, {0.3125F, 0}));
    EXPECT_EQ(world->signed_distance().at(10, 5), -0.5F);
    EXPECT_EQ(world->signed_distance().at(11, 5), -0.5F);
}

TEST(Field, EmptyWithoutBodies) {
    WorldDef def = small_def();
    def.capacity.bodies = 0;
    def.capacity.vertices = 0;
    TestWorld<float> world(def);
    EXPECT_EQ(world->signed_distance().data, nullptr);
    BodyId id;
    EXPECT_EQ(world->add_static_body(body_of(kTriangle, {0.1F, 0.1F}), &id), Status::no_free_body);
}

/// Nodes of a ring's bounding box, grown by the band, as a count.
std::int32_t nodes_around(const std::vector<Point>& a, const std::vector<Point>& b,
                          const World<float>& world) {
    Point low{1e9, 1e9};
    Point high{-1e9, -1e9};
    for (const auto* ring : {&a, &b}) {
        for (const Point p : *ring) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    }
    constexpr auto kBand2 = static_cast<double>(kFarFromSolids);
    const auto span = [](double from, double to, std::int32_t last) {
        const auto first = std::max(0.0, std::ceil(from - kBand2 - 1e-4));
        const auto end = std::min(static_cast<double>(last), std::floor(to + kBand2 + 1e-4));
        return static_cast<std::int32_t>(std::max(0.0, end - first + 1));
    };
    return span(low.x, high.x, world.cells_x()) * span(low.y, high.y, world.cells_y());
}

TEST(Cache, NothingMovedNothingIsRasterized) {
    TestWorld<float> world(field_def(2, 8));
    put_static(*world, body_of(kArrow, {0.2F, 0.2F}));
    const BodyId moving = put_moving(*world, body_of(kSquare4cm, {0.5F, 0.3F}));
    ASSERT_EQ(world->fill({{0, 0}, {0.3F, 0.2F}}), Status::ok);
    for (int step = 0; step < 10; ++step) {
        EXPECT_EQ(world->step(kFrame).nodes_rasterized, 0);
    }
    Motion motion;
    ASSERT_EQ(world->motion(moving, &motion), Status::ok);
    ASSERT_EQ(world->set_motion(moving, motion), Status::ok);
    EXPECT_EQ(world->step(kFrame).nodes_rasterized, 0) << "told to stay where it is";
}

TEST(Cache, AMovedBodyTouchesItsRectanglesOnly) {
    TestWorld<float> world(field_def(3, 12));
    const BodyDef fixed = body_of(kArrow, {0.2F, 0.2F});
    put_static(*world, fixed);
    BodyDef def = body_of(kSquare4cm, {0.3F, 0.3F}, 0.2F);
    const BodyId moving = put_moving(*world, def);
    std::vector<Point> before = placed(kSquare4cm, def.motion);
    std::mt19937 random(5);
    for (int step = 0; step < 50; ++step) {
        def.motion.position_m = {0.25F + 0.001F * static_cast<float>(random() % 100),
                                 0.25F + 0.001F * static_cast<float>(random() % 100)};
        def.motion.angle_rad = 0.01F * static_cast<float>(random() % 600);
        ASSERT_EQ(world->set_motion(moving, def.motion), Status::ok);
        const StepReport report = world->step(0.001F);
        ASSERT_EQ(report.substeps, 1);
        const std::vector<Point> after = placed(kSquare4cm, def.motion);
        EXPECT_GT(report.nodes_rasterized, 0);
        EXPECT_LE(report.nodes_rasterized, nodes_around(before, after, *world));
        expect_field(*world, {placed(kArrow, fixed.motion), after});
        before = after;
    }
}

TEST(Cache, AMoveAppearsAlsoIfABodyIsAddedBeforeTheStep) {
    TestWorld<float> world(field_def(3, 12));
    BodyDef def = body_of(kSquare4cm, {0.3F, 0.3F});
    const BodyId moving = put_moving(*world, def);
    def.motion.position_m = {0.5F, 0.4F};
    ASSERT_EQ(world->set_motion(moving, def.motion), Status::ok);
    const BodyDef other = body_of(kArrow, {0.15F, 0.15F});
    put_moving(*world, other);
    world->step(kFrame);
    expect_field(*world, {placed(kSquare4cm, def.motion), placed(kArrow, other.motion)});
}

TEST(Cache, AMoveAppearsAlsoIfAnotherIsRemovedBeforeTheStep) {
    TestWorld<float> world(field_def(3, 12));
    BodyDef def = body_of(kSquare4cm, {0.3F, 0.3F});
    const BodyId fixed = put_static(*world, body_of(kArrow, {0.32F, 0.31F}));
    const BodyId other = put_moving(*world, body_of(kArrow, {0.15F, 0.15F}));
    const BodyId moving = put_moving(*world, def);
    def.motion.position_m = {0.5F, 0.4F};
    ASSERT_EQ(world->set_motion(moving, def.motion), Status::ok);
    ASSERT_EQ(world->remove_body(fixed), Status::ok);
    ASSERT_EQ(world->remove_body(other), Status::ok);
    world->step(kFrame);
    expect_field(*world, {placed(kSquare4cm, def.motion)});
}

TEST(Motion, ConstantVelocityAndSpinGoOn) {
    TestWorld<float> world(field_def(1, 4));
    BodyDef def = body_of(kArrow, {0.3F, 0.25F}, 0.1F);
    def.motion.velocity_mps = {0.1F, 0.05F};
    def.motion.spin_radps = 3.0F;
    const BodyId id = put_moving(*world, def);
    for (int step = 1; step <= 120; ++step) {
        EXPECT_GT(world->step(kFrame).nodes_rasterized, 0);
        Motion now;
        ASSERT_EQ(world->motion(id, &now), Status::ok);
        const float t = static_cast<float>(step) * kFrame;
        EXPECT_NEAR(now.position_m.x, 0.3F + 0.1F * t, 1.0e-5F);
        EXPECT_NEAR(now.position_m.y, 0.25F + 0.05F * t, 1.0e-5F);
        EXPECT_NEAR(std::sin(now.angle_rad), std::sin(0.1F + 3.0F * t), 1.0e-4F);
        EXPECT_NEAR(std::cos(now.angle_rad), std::cos(0.1F + 3.0F * t), 1.0e-4F);
        EXPECT_FLOAT_EQ(now.velocity_mps.x, 0.1F);
        EXPECT_FLOAT_EQ(now.spin_radps, 3.0F);
        if (step % 20 == 0) {
            expect_field(*world, {placed(kArrow, now)});
        }
    }
}

TEST(Motion, AStaticBodyIgnoresVelocity) {
    TestWorld<float> world(field_def(1, 4));
    BodyDef def = body_of(kArrow, {0.3F, 0.25F}, 0.1F);
    def.motion.velocity_mps = {0.1F, 0.05F};
    def.motion.spin_radps = 3.0F;
    const BodyId id = put_static(*world, def);
    EXPECT_EQ(world->step(kFrame).nodes_rasterized, 0);
    Motion now;
    ASSERT_EQ(world->motion(id, &now), Status::ok);
    EXPECT_FLOAT_EQ(now.position_m.x, 0.3F);
    EXPECT_EQ(now.velocity_mps.x, 0.0F);
    EXPECT_EQ(now.spin_radps, 0.0F);
}

/// With whichever corner a polygon ends: steps are cut as the furthest wants it.
TEST(Motion, AnArmIsAsFastAsItsTip) {
    for (const std::size_t first : {0U, 1U, 2U, 3U}) {
        TestWorld<float> world(field_def(1, 4));
        Ring arm = {{0.0F, -0.02F}, {0.2F, -0.02F}, {0.2F, 0.02F}, {0.0F, 0.02F}};
        std::rotate(arm.begin(), arm.begin() + static_cast<std::ptrdiff_t>(first), arm.end());
        BodyDef def = body_of(arm, {0.3F, 0.25F});
        def.motion.spin_radps = 20.0F;
        put_moving(*world, def);
        EXPECT_EQ(world->step(kFrame).substeps, 4) << "3.4 cells";
    }
}

TEST(Motion, ABodyMayLeaveTheTankAndComeBack) {
    TestWorld<float> world(field_def(2, 8));
    BodyDef def = body_of(kSquare4cm, {0.3F, 0.3F});
    const BodyId id = put_moving(*world, def);
    for (const Vec2f at : {Vec2f{-1.0F, 0.3F}, Vec2f{1500.0F, -1500.0F}, Vec2f{0.8F, 0.6F},
                           Vec2f{0.4F, 0.2F}}) {
        def.motion.position_m = at;
        ASSERT_EQ(world->set_motion(id, def.motion), Status::ok);
        world->step(kFrame);
        expect_field(*world, {placed(kSquare4cm, def.motion)});
    }
}

template <class Real>
void check_comes_in() {
    const WorldDef def = field_def(2, 8);
    TestWorld<Real> world(def), led(def);
    BodyDef paddle = body_of(kSquare4cm, {-0.1F, 0.1F});
    paddle.motion.velocity_mps = {0.5F, 0.0F};
    BodyId id;
    EXPECT_EQ(world->add_static_body(paddle, &id), Status::polygon_outside_domain);
    id = put_moving(*world, paddle);
    const Motion begins = paddle.motion;
    paddle.motion.position_m = {0.3F, 0.3F};
    const BodyId led_id = put_moving(*led, paddle);
    ASSERT_EQ(led->set_motion(led_id, begins), Status::ok);
    std::vector<std::byte> kept(snapshot_bytes<Real>(def.capacity));
    ASSERT_EQ(world->save(kept.data(), kept.size()), Status::ok);
    ASSERT_EQ(world->restore(kept.data(), kept.size()), Status::ok);
    for (int step = 0; step < 24; ++step) {
        world->step(kFrame);
        led->step(kFrame);
        ASSERT_EQ(world->state_hash(), led->state_hash()) << step;
    }
    Motion now;
    ASSERT_EQ(world->motion(id, &now), Status::ok);
    EXPECT_NEAR(now.position_m.x, 0.1F, 1.0e-4F);
    if constexpr (std::is_same_v<Real, float>) {
        expect_field(*world, {placed(kSquare4cm, now)});
    }
}

TEST(Motion, ABodyMayComeInFromOutside) {
    check_comes_in<float>();
    check_comes_in<Fixed>();
}

}  // namespace
}  // namespace weir
