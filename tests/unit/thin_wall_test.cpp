// Walls thinner than a cell: which edges are thin, what they close, who sees whom, who keeps its
// side.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "measure/random.hpp"
#include "solid/thin_sweep.hpp"
#include "weir/weir.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;

WorldDef tank(std::int32_t wall_edges = 800) {
    WorldDef def = tank_def(32, 32, 5000, 4, 64);
    def.capacity.wall_edges = wall_edges;
    return def;
}

/// In cells.
BodyDef line_of(Ring& cells) {
    for (Vec2f& vertex : cells) {
        vertex = kCell * vertex;
    }
    BodyDef def = body_of(cells, {0, 0});
    def.open = true;
    return def;
}

BodyId add(World<float>& world, const BodyDef& def, bool moving = false) {
    BodyId id;
    const Status added = moving ? world.add_moving_body(def, &id) : world.add_static_body(def, &id);
    EXPECT_EQ(added, Status::ok) << status_text(added);
    return id;
}

/// The records behind a world's face.
const ThinWalls<float>& walls_of(TestWorld<float>& world) {
    return state_of(world).simulation.layers.thin;
}

std::int32_t thin_edges(TestWorld<float>& world, std::int32_t slot) {
    return walls_of(world).body[slot].count;
}

/// Of two walls at one place the same one answers, in whatever order they came.
TEST(ThinWalls, AtOnePlaceAnswerAlikeAfterARestore) {
    const WorldDef def = tank();
    TestWorld<float> world(def);
    TestWorld<float> restored(def);
    Ring ring = {{8, 10}, {24, 10.3F}};
    BodyDef line = line_of(ring);
    const BodyId first = add(*world, line);
    line.surface.restitution = 0.8F;
    add(*world, line);
    expect_ok(world->remove_body(first));
    line.surface = {0.0F, 1.0F, false, 0.3F};
    add(*world, line);
    expect_ok(world->fill({{10 * kCell, 14 * kCell}, {20 * kCell, 24 * kCell}}));
    for (int step = 0; step < 40; ++step) {
        world->step(kFrame);
        if (step == 5) {
            change_worlds(world, restored, def);
        } else if (step > 5) {
            restored->step(kFrame);
            ASSERT_EQ(restored->state_hash(), world->state_hash()) << step;
        }
    }
}

TEST(ThinWalls, WidePolygonsHaveNoThinEdges) {
    for (const float size : {1.6F, 3.0F, 10.0F}) {
        TestWorld<float> world(tank());
        const Ring ring = rectangle(size * kCell, 8 * kCell);
        add(*world, body_of(ring, {0.32F, 0.32F}, 0.3F));
        EXPECT_EQ(thin_edges(world, 0), 0) << size;
    }
}

TEST(ThinWalls, PlatesAreThinAllOverAndSpikesAtTheirTips) {
    TestWorld<float> world(tank());
    const Ring plate = rectangle(0.05F * kCell, 8 * kCell);
    add(*world, body_of(plate, {0.12F, 0.32F}, 0.3F));
    EXPECT_GE(thin_edges(world, 0), 2 * 8);
    // Ten long and five wide at its foot: thinner than a cell and a half for the first three.
    const Ring spike = {{0, 0}, {0.1F, 0}, {0.05F, 0.2F}};
    add(*world, body_of(spike, {0.3F, 0.2F}));
    EXPECT_GE(thin_edges(world, 1), 2 * 3);
    EXPECT_LE(thin_edges(world, 1), 2 * 9);
}

TEST(ThinWalls, FacesBetweenTheSidesAreClosedWithoutGaps) {
    for (const float angle : {0.0F, 0.3F, 0.7853982F, 1.2F, 1.5707964F, 2.5F}) {
        TestWorld<float> world(tank());
        Ring ring = {{-40, 0}, {-3.5F, 0}, {0, 0}, {0.5F, 0}, {40, 0}};
        BodyDef def = line_of(ring);
        def.motion.position_m = {16.5F * kCell, 15.5F * kCell};
        def.motion.angle_rad = angle;
        add(*world, def);
        const auto& simulation = state_of(world).simulation;
        const GridShape& s = simulation.grid.shape;
        // Flood from one corner through faces that are open at all.
        std::vector<int> reached(static_cast<std::size_t>(s.size()), 0);
        std::vector<std::int32_t> todo = {s.index(0, 0)};
        const auto visit = [&](std::int32_t cell, float open) {
            if (open > 0.0F && reached[static_cast<std::size_t>(cell)] == 0) {
                reached[static_cast<std::size_t>(cell)] = 1;
                todo.push_back(cell);
            }
        };
        reached[static_cast<std::size_t>(todo[0])] = 1;
        while (!todo.empty()) {
            const std::int32_t c = todo.back();
            todo.pop_back();
            const std::int32_t i = c % s.stride - 1;
            const std::int32_t j = c / s.stride - 1;
            const Walls<float>& walls = simulation.layers.walls;
            if (i > 0) visit(c - 1, walls.open_u[c]);
            if (i + 1 < s.nx) visit(c + 1, walls.open_u[c + 1]);
            if (j > 0) visit(c - s.stride, walls.open_v[c]);
            if (j + 1 < s.ny) visit(c + s.stride, walls.open_v[c + s.stride]);
        }
        const Vec2<float> normal{-std::sin(angle), std::cos(angle)};
        const float here = dot(Vec2<float>{0.5F - 16.5F, 0.5F - 15.5F}, normal);
        for (std::int32_t j = 0; j < s.ny; ++j) {
            for (std::int32_t i = 0; i < s.nx; ++i) {
                const float side = dot(Vec2<float>{static_cast<float>(i) - 16.0F,
                                                   static_cast<float>(j) - 15.0F}, normal);
                if (std::abs(side) > 1.0e-3F) {
                    EXPECT_EQ(reached[static_cast<std::size_t>(s.index(i, j))],
                              side * here > 0.0F ? 1 : 0)
                        << angle << " at " << i << ' ' << j;
                }
            }
        }
    }
}

TEST(ThinWalls, CrossingsAtASharedCornerAreSeen) {
    const Vec2<float> a{1, 1}, corner{2, 2}, b{3, 1};
    for (float x = -0.5F; x <= 0.5F; x += 0.001F) {
        const Vec2<float> from{2 + x, 3};
        const Vec2<float> to{2 - x, 1};
        EXPECT_TRUE(cross_edge(from, to, a, corner).found || cross_edge(from, to, corner, b).found)
            << x;
    }
    EXPECT_FALSE(cross_edge(Vec2<float>{0, 3}, Vec2<float>{4, 3}, a, corner).found);
    EXPECT_TRUE(cross_edge(Vec2<float>{0, 3}, Vec2<float>{3, 0}, a, corner).from_left);
}

/// Particles thrown at a bent line from both sides, up to two cells a substep.
TEST(ThinWalls, ParticlesKeepTheirSide) {
    for (const bool open : {true, false}) {
        WorldDef def = tank();
        def.gravity_mps2 = {0, 0};
        def.flip_ratio = 1.0F;
        def.cfl = 2.0F;
        TestWorld<float> world(def);
        Ring ring = {{16, -2}, {16.3F, 10}, {15.2F, 15}, {17.1F, 21}, {16, 34}};
        if (!open) {
            for (std::size_t k = ring.size(); k-- > 0;) {
                ring.push_back({ring[k].x - 0.05F, ring[k].y});
            }
        }
        BodyDef body = line_of(ring);
        body.open = open;
        body.surface.restitution = 0.7F;
        add(*world, body);
        for (int k = 0; k < 400; ++k) {
            const bool left = k % 2 == 0;
            const float x = left ? 5.0F + 0.02F * static_cast<float>(k)
                                 : 27.0F - 0.02F * static_cast<float>(k);
            const float speed = (left ? 1.0F : -1.0F) * (0.3F + 0.008F * static_cast<float>(k));
            ASSERT_EQ(world->add_particle({x * kCell, (1.0F + 0.075F * static_cast<float>(k)) * kCell},
                                          {speed * kCell / kFrame, 0.3F}),
                      Status::ok);
        }
        for (int step = 0; step < 120; ++step) {
            const StepReport report = world->step(kFrame);
            ASSERT_EQ(report.particles_removed_stuck, 0);
        }
        const auto wall_at = [&](float y) {
            std::size_t k = 0;
            while (ring[k + 1].y / kCell < y) {
                ++k;
            }
            const Vec2f a = (1.0F / kCell) * ring[k], b = (1.0F / kCell) * ring[k + 1];
            return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        };
        for (int k = 0; k < 400; ++k) {
            const Vec2f x = world->particle_positions()[k];
            const float beyond = x.x - wall_at(x.y);
            EXPECT_TRUE(k % 2 == 0 ? beyond < 0.01F : beyond > -0.01F)
                << k << " at " << x.x << ' ' << x.y;
        }
    }
}

/// Sliding along the second of two walls may lead back to the first: so near to it that rounding
/// decides on which side a particle is, once that wall moves.
TEST(ThinWalls, WhoSlidesAlongTwoWallsKeepsItsDistanceToBoth) {
    TestWorld<float> world(tank());
    Ring upright = {{16.1F, -8}, {16.4F, 40}};
    Ring leaning = {{-8, 9}, {40, 23}};
    const Ring outline[] = {upright, leaning};  // cells
    add(*world, line_of(upright));
    add(*world, line_of(leaning));
    const auto& state = state_of(world);
    measure::Random random(7);
    int met_both = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const Vec2<float> before{random.uniform(15.5F, 17.0F), random.uniform(15.0F, 17.0F)};
        const Vec2<float> after = before + Vec2<float>{random.uniform(-0.5F, 0.5F),
                                                       random.uniform(-0.5F, 0.5F)};
        ThinStop<float> stop;
        ASSERT_TRUE(keep_side(state.simulation.layers.thin, state.simulation.layers.shape,
                              state.simulation.layers.walls.body, before, after, false, stop));
        bool met[2] = {false, false};
        for (int hit = 0; hit < stop.count; ++hit) {
            const std::uint16_t slot = stop.slot[hit];
            met[slot] = true;
            const bool stays = stop.place.x == before.x && stop.place.y == before.y;
            EXPECT_TRUE(stays || dot(stop.place - outline[slot][0], stop.normal[hit]) > 9.0e-4F)
                << before.x << ' ' << before.y << " to " << after.x << ' ' << after.y;
        }
        met_both += met[0] && met[1] ? 1 : 0;
    }
    EXPECT_GT(met_both, 1000);
}

/// A way that ends at a wall without crossing it is a hit, too, for the same reason.
TEST(ThinWalls, WhoStopsAtAWallKeepsItsDistance) {
    TestWorld<float> world(tank());
    Ring line = {{16.1F, -8}, {16.4F, 40}};
    const Vec2f from = line[0];  // cells
    const Vec2f to = line[1];
    add(*world, line_of(line));
    const auto& state = state_of(world);
    for (int trial = 0; trial < 100; ++trial) {
        const float height = 1.0e-5F * static_cast<float>(trial - 50);
        const Vec2<float> at{from.x + (16.0F - from.y) / (to.y - from.y) * (to.x - from.x) + height,
                             16.0F};
        ThinStop<float> stop;
        ASSERT_TRUE(keep_side(state.simulation.layers.thin, state.simulation.layers.shape,
                              state.simulation.layers.walls.body, {at.x + 0.3F, at.y}, at, false,
                              stop));
        const float side = cross(to - from, stop.place - from) / length(to - from);
        EXPECT_LT(side, -9.0e-4F) << height;
    }
}

TEST(ThinWalls, AMovingLineTakesAlongWhatItMeets) {
    for (const bool told : {false, true}) {
        for (const float speed : {0.4F, 0.9F, 1.8F, 3.6F}) {
            WorldDef def = tank();
            def.gravity_mps2 = {0, 0};
            def.flip_ratio = 1.0F;
            TestWorld<float> world(def);
            Ring ring = {{0, -20}, {0, 20}};
            BodyDef body = line_of(ring);
            body.motion.position_m = {4 * kCell, 16 * kCell};
            body.motion.velocity_mps = {told ? 0.0F : speed * kCell / kFrame, 0};
            body.motion.spin_radps = told ? 0.0F : 0.5F;
            const BodyId id = add(*world, body, true);
            for (float y = 12.0F; y < 20.0F; y += 0.1F) {
                ASSERT_EQ(world->add_particle({(7.0F + 0.1F * y) * kCell, y * kCell}, {0, 0}),
                          Status::ok);
            }
            Motion motion = body.motion;
            for (int step = 0; step < static_cast<int>(14.0F / speed); ++step) {
                if (told) {
                    motion.position_m.x += speed * kCell;
                    ASSERT_EQ(world->set_motion(id, motion), Status::ok);
                }
                world->step(kFrame);
            }
            ASSERT_EQ(world->motion(id, &motion), Status::ok);
            EXPECT_EQ(world->particle_positions().size, 80);
            for (const Vec2f x : world->particle_positions()) {
                const Vec2f arm = x - (1.0F / kCell) * motion.position_m;
                EXPECT_GT(arm.x * std::cos(motion.angle_rad) + arm.y * std::sin(motion.angle_rad),
                          0.0F)
                    << speed << ' ' << told;
            }
        }
    }
}

/// Liquid of different depth on both sides of a line comes to rest, each side at its own pressure.
TEST(ThinWalls, SidesHaveTheirOwnPressure) {
    TestWorld<float> world(tank());
    Ring ring = {{16.37F, -2}, {16.37F, 34}};
    add(*world, line_of(ring));
    ASSERT_EQ(world->fill({{0, 0}, {16.25F * kCell, 24 * kCell}}), Status::ok);
    ASSERT_EQ(world->fill({{16.5F * kCell, 0}, {0.64F, 10 * kCell}}), Status::ok);
    StepReport report;
    for (int step = 0; step < 300; ++step) {
        report = world->step(kFrame);
    }
    const FieldView<float> p = world->pressure();
    const float unit = world->pressure_scale() / (9.81F * kCell);
    EXPECT_NEAR(unit * p.at(14, 0), 23.5F, 0.3F);
    EXPECT_NEAR(unit * p.at(15, 0), 23.5F, 0.3F);
    EXPECT_NEAR(unit * p.at(16, 0), 9.5F, 0.3F);
    EXPECT_NEAR(unit * p.at(17, 0), 9.5F, 0.3F);
    EXPECT_LT(report.max_speed_mps, 0.01F);
}

TEST(ThinWalls, APlatePutOverLiquidIsLeft) {
    TestWorld<float> world(tank());
    std::int32_t added = 0;
    ASSERT_EQ(world->fill({{0, 0}, {0.64F, 0.3F}}, &added), Status::ok);
    const Ring plate = rectangle(0.8F * kCell, 10 * kCell);
    add(*world, body_of(plate, {0.32F, 0.1F}, 0.4F));
    world->step(kFrame);
    for (const Vec2f x : world->particle_positions()) {
        const Vec2f arm = x - Vec2f{16, 5};
        const float across = arm.x * std::cos(0.4F) + arm.y * std::sin(0.4F);
        const float along = arm.y * std::cos(0.4F) - arm.x * std::sin(0.4F);
        EXPECT_FALSE(std::abs(across) < 0.39F && std::abs(along) < 4.99F);
    }
    EXPECT_EQ(world->particle_positions().size, added);
    EXPECT_EQ(world->add_particle({0.32F, 0.1F}, {0, 0}), Status::particle_inside_solid);
}

/// In a plate, and nearer to an edge of another one from outside.
TEST(ThinWalls, APlateIsLeftAlsoBesideAnother) {
    TestWorld<float> world(tank());
    ASSERT_EQ(world->add_particle({15.9F * kCell, 10.0F * kCell}, {0, 0}), Status::ok);
    const Ring plate = rectangle(1.4F * kCell, 10 * kCell);
    const Ring beside = rectangle(1.2F * kCell, 4 * kCell);
    add(*world, body_of(plate, {16.0F * kCell, 10.0F * kCell}));
    add(*world, body_of(beside, {16.6F * kCell, 10.0F * kCell}));
    EXPECT_EQ(world->add_particle({15.9F * kCell, 10.0F * kCell}, {0, 0}),
              Status::particle_inside_solid);
    world->step(kFrame);
    ASSERT_EQ(world->particle_positions().size, 1);
    EXPECT_LT(world->particle_positions()[0].x, 15.3F);
}

TEST(ThinWalls, RoomForEdgesIsKeptAndGivenBack) {
    TestWorld<float> world(tank(150));
    Ring ring = {{4, 4}, {28, 4}};
    const BodyDef def = line_of(ring);
    const BodyId first = add(*world, def, true);
    BodyId id;
    EXPECT_EQ(world->add_moving_body(def, &id), Status::no_free_wall_edge);
    const std::uint64_t hash = world->state_hash();
    EXPECT_EQ(world->add_moving_body(def, &id), Status::no_free_wall_edge);
    EXPECT_EQ(world->state_hash(), hash) << "a refusal changes nothing";
    EXPECT_EQ(world->remove_body(first), Status::ok);
    EXPECT_EQ(walls_of(world).used, 0);
    add(*world, def, false);
    ASSERT_EQ(world->fill({{0, 0}, {0.64F, 0.2F}}), Status::ok);
    world->step(kFrame);
}

/// The next step sweeps particles along from where they last met a wall to where it stands now.
TEST(ThinWalls, TheHashKnowsTheWayOfAWall) {
    TestWorld<float> world(tank());
    TestWorld<float> other(tank());
    Ring ring = {{0, 0}, {0, 8}};
    BodyDef def = line_of(ring);
    def.motion.position_m = {0.2F, 0.2F};
    const BodyId id = add(*world, def, true);
    ASSERT_EQ(world->set_motion(id, def.motion), Status::ok);
    ASSERT_EQ(other->set_motion(add(*other, def, true), def.motion), Status::ok);
    EXPECT_EQ(world->state_hash(), other->state_hash());
    def.motion.position_m = {0.22F, 0.2F};
    TestWorld<float> placed(tank());
    const BodyId there = add(*placed, def, true);
    const Motion between{{0.21F, 0.2F}, 0.0F, {0, 0}, 0.0F};
    ASSERT_EQ(world->set_motion(id, between), Status::ok);
    ASSERT_EQ(placed->set_motion(there, between), Status::ok);
    EXPECT_NE(world->state_hash(), placed->state_hash());
    ASSERT_EQ(world->add_particle({0.205F, 0.25F}, {0, 0}), Status::ok);
    ASSERT_EQ(placed->add_particle({0.205F, 0.25F}, {0, 0}), Status::ok);
    world->step(kFrame);
    placed->step(kFrame);
    EXPECT_GT(world->particle_positions()[0].x, 10.5F) << "swept along";
    EXPECT_LT(placed->particle_positions()[0].x, 10.5F);
}

TEST(ThinWalls, LinesLongerThanAnyRoomAreRefused) {
    WorldDef def = tank(100);
    def.capacity.vertices = 4000;
    TestWorld<float> world(def);
    Ring zigzag;
    for (std::int32_t k = 0; k < 4000; ++k) {
        zigzag.push_back({k % 2 == 0 ? -99000.0F : 99000.0F, 0.05F * static_cast<float>(k % 600)});
    }
    BodyId id;
    EXPECT_EQ(world->add_moving_body(line_of(zigzag), &id), Status::no_free_wall_edge);
}

TEST(ThinWalls, WithoutRoomForEdgesNothingIsCarvedOrDone) {
    const Layout with = layout<float>(tank(100).capacity);
    const Layout without = layout<float>(tank(0).capacity);
    EXPECT_EQ(without.owner_bytes[static_cast<int>(Owner::thin_walls)], 0U);
    EXPECT_GT(with.owner_bytes[static_cast<int>(Owner::thin_walls)], 100U * 16);
}

}  // namespace
}  // namespace weir
