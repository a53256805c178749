// Particles that meet a wall: mirrored, slid along or pushed, whatever its inclination.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "contour/marching_squares.hpp"
#include "math/vec2.hpp"
#include "solid/collide.hpp"
#include "solid/first_entry.hpp"
#include "solid/moving_walls.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr double kPi = 3.14159265358979324;
constexpr float kCell = 0.02F;

/// A tank of 32 × 32 cells without gravity, whose one particle keeps its own velocity (FLIP 1).
WorldDef free_flight() {
    WorldDef def = tank_def(32, 32, 4096, 2, 16);
    def.gravity_mps2 = {0, 0};
    def.flip_ratio = 1.0F;
    def.volume_gain = 0.0F;
    return def;
}

Vec2<double> unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A half plane through the middle of the tank: liquid on the side that the normal points to. If it
/// is but so wide, also behind it.
BodyDef half_plane(Ring& ring, double normal_angle, float restitution, float width = 1.0F) {
    ring = {{-width, -1.0F}, {0.0F, -1.0F}, {0.0F, 1.0F}, {-width, 1.0F}};
    BodyDef def = body_of(ring, {16 * kCell, 16 * kCell}, static_cast<float>(normal_angle));
    def.surface.restitution = restitution;
    return def;
}

/// The stage on its own: walls from a real world's field, particles by hand.
struct Stand {
    TestWorld<float> world{free_flight()};
    Ring ring;
    GridShape shape{32, 32, 34};
    std::vector<float> distance = std::vector<float>(34 * 34, kBand<float>);
    std::vector<std::uint16_t> nearest = std::vector<std::uint16_t>(34 * 34, 0);
    std::vector<std::uint8_t> cell_case = std::vector<std::uint8_t>(34 * 34, 0);
    Body<float> body;
    Walls<float> walls;

    Stand(double normal_angle, float restitution, float width = 1.0F) {
        const BodyDef def = half_plane(ring, normal_angle, restitution, width);
        put_static(*world, def);
        const FieldView<float> field = world->signed_distance();
        for (std::int32_t j = 0; j <= 32; ++j) {
            for (std::int32_t i = 0; i <= 32; ++i) {
                distance[static_cast<std::size_t>(shape.index(i, j))] = field.at(i, j);
            }
        }
        for (std::int32_t j = 0; j < 32; ++j) {
            for (std::int32_t i = 0; i < 32; ++i) {
                const float corner[4] = {field.at(i, j), field.at(i + 1, j), field.at(i + 1, j + 1),
                                         field.at(i, j + 1)};
                cell_case[static_cast<std::size_t>(shape.index(i, j))] = contour_case(corner);
            }
        }
        body.surface.restitution = restitution;
        walls.active = true;
        walls.distance = distance.data();
        walls.nearest = nearest.data();
        walls.cell_case = cell_case.data();
        walls.body = &body;
    }

    /// Collides one particle.
    CollideResult<float> hit(Vec2<float>& x, Vec2<float>& v) { return hit(x, v, x); }
    CollideResult<float> hit(Vec2<float>& x, Vec2<float>& v, Vec2<float> before) {
        Particles<float> one{&x, &v, 1, 1};
        Contacts<float> none;
        CollideResult<float> result;
        collide(shape, walls, {&before, true, 1.0F / 60.0F}, 0, 1, one, none, result);
        return result;
    }
};

/// Blocks of particles around which there is no solid are told at once: not those that came through
/// a wall, which is between where they were and where they are.
TEST(Collide, BlocksMeetWhatEachOfThemMeets) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> centre(13.0F, 19.0F);
    std::uniform_real_distribution<float> place(-2.0F, 2.0F);
    std::int32_t reflected = 0;
    for (int trial = 0; trial < 300; ++trial) {
        Stand stand(0.17 * trial, 0.0F, 1.2F * kCell);
        const Vec2f middle{centre(random), centre(random)};
        const Vec2f way{0.9F * place(random), 0.9F * place(random)};
        std::vector<Vec2f> before, x, v;
        while (x.size() < 40U + random() % 160U) {
            const Vec2f from{middle.x + place(random), middle.y + place(random)};
            if (!is_inside(stand.shape, stand.walls, from)) {
                before.push_back(from);
                x.push_back({from.x + way.x, from.y + way.y});
                v.push_back({60.0F * way.x, 60.0F * way.y});
            }
        }
        const auto count = static_cast<std::int32_t>(x.size());
        std::vector<Vec2f> x_block = x, v_block = v;
        Particles<float> block{x_block.data(), v_block.data(), count, count};
        Contacts<float> none;
        CollideResult<float> all, sum;
        collide(stand.shape, stand.walls, {before.data(), true, 1.0F / 60.0F}, 0, count, block,
                none, all);
        for (std::size_t k = 0; k < x.size(); ++k) {
            sum.reflected += stand.hit(x[k], v[k], before[k]).reflected;
            ASSERT_EQ(x_block[k].x, x[k].x) << trial;
            ASSERT_EQ(x_block[k].y, x[k].y) << trial;
            ASSERT_EQ(v_block[k].x, v[k].x) << trial;
            ASSERT_EQ(v_block[k].y, v[k].y) << trial;
        }
        ASSERT_EQ(all.reflected, sum.reflected);
        reflected += all.reflected;
    }
    EXPECT_GT(reflected, 1000);
}

const double kAngles[] = {0.0, 0.25 * kPi, 0.5 * kPi, 1.0, 2.2, kPi, 4.0, 5.5};

/// Of who goes far, paths through open cells alone are not walked: nothing would be met on them.
TEST(Collide, PathsThroughOpenCellsMeetNothing) {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> anywhere(2.5F, 29.5F);
    std::uniform_real_distribution<float> way(-2.0F, 2.0F);
    const auto at_line = [&](float x) {  // on a line of the grid, and just before it
        const float line = std::floor(x);
        return random() % 4 != 0 ? x : random() % 2 == 0 ? line : std::nextafter(line, 0.0F);
    };
    std::int32_t open = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Stand stand(0.17 * trial, 0.0F);
        for (int k = 0; k < 4000; ++k) {
            const Vec2f from{at_line(anywhere(random)), at_line(anywhere(random))};
            const Vec2f to{at_line(from.x + way(random)), at_line(from.y + way(random))};
            if (is_path_open(stand.shape, stand.walls.cell_case, from, to)) {
                ++open;
                ASSERT_FALSE(is_inside(stand.shape, stand.walls, from));
                ASSERT_FALSE(is_inside(stand.shape, stand.walls, to));
                ASSERT_FALSE(first_entry(stand.shape, stand.walls, from, to).found);
            }
        }
    }
    EXPECT_GT(open, 40000);
    EXPECT_LT(open, 120000);
}

TEST(Collide, RestitutionOneMirrors) {
    for (const double normal_angle : kAngles) {
        Stand stand(normal_angle, 1.0F);
        const Vec2<double> n = unit(normal_angle);
        for (double approach = -1.4; approach <= 1.4; approach += 0.2) {
            const Vec2<double> v = 5.0 * unit(normal_angle + kPi + approach);
            Vec2<float> x = convert<float>(Vec2<double>{16.0, 16.0} + (-0.2) * n);
            Vec2<float> w = convert<float>(v);
            const CollideResult<float> count = stand.hit(x, w);
            EXPECT_EQ(count.tested, 1);
            EXPECT_EQ(count.reflected, 1);
            const Vec2<double> expected = v - 2.0 * dot(v, n) * n;
            EXPECT_NEAR(static_cast<double>(w.x), expected.x, 2.0e-4);
            EXPECT_NEAR(static_cast<double>(w.y), expected.y, 2.0e-4);
            // Set back along the normal, half as far before the wall, and a hair, as it was behind.
            const Vec2<double> from_wall = convert<double>(x) - Vec2<double>{16.0, 16.0};
            EXPECT_GT(dot(from_wall, n), 0.1);
            EXPECT_LT(dot(from_wall, n), 0.102);
            EXPECT_NEAR(cross(from_wall, n), 0.0, 1.0e-4);
        }
    }
}

TEST(Collide, RestitutionZeroSlides) {
    for (const double normal_angle : kAngles) {
        Stand stand(normal_angle, 0.0F);
        const Vec2<double> n = unit(normal_angle);
        const Vec2<double> along{-n.y, n.x};
        const Vec2<double> v = (-3.0) * n + 2.0 * along;
        Vec2<float> x = convert<float>(Vec2<double>{16.0, 16.0} + (-0.1) * n);
        Vec2<float> w = convert<float>(v);
        EXPECT_EQ(stand.hit(x, w).reflected, 1);
        EXPECT_NEAR(dot(convert<double>(w), n), 0.0, 1.0e-4);
        EXPECT_NEAR(dot(convert<double>(w), along), 2.0, 1.0e-4);
    }
}

TEST(Collide, LeavesAloneWhatLeavesOrStandsInFront) {
    Stand stand(1.0, 1.0F);
    const Vec2<double> n = unit(1.0);
    Vec2<float> x = convert<float>(Vec2<double>{16.0, 16.0} + (-0.1) * n);
    Vec2<float> w = convert<float>(3.0 * n);
    EXPECT_EQ(stand.hit(x, w).reflected, 1) << "set back";
    EXPECT_NEAR(dot(convert<double>(w), n), 3.0, 1.0e-5) << "but its velocity is its own";
    x = convert<float>(Vec2<double>{16.0, 16.0} + 0.1 * n);
    const Vec2<float> before = x;
    w = convert<float>((-3.0) * n);
    const CollideResult<float> count = stand.hit(x, w);
    EXPECT_EQ(count.reflected, 0);
    EXPECT_EQ(x.x, before.x);
    EXPECT_EQ(x.y, before.y);
    x = convert<float>(Vec2<double>{16.0, 16.0} + 4.0 * n);
    EXPECT_EQ(stand.hit(x, w).tested, 0) << "no boundary nearby";
}

/// All along the wall, the normal that a particle is turned about is the wall's.
TEST(Collide, InclinedWallsAreStraight) {
    double worst = 0.0;
    for (double normal_angle = 0.0; normal_angle < 2.0 * kPi; normal_angle += 0.11) {
        Stand stand(normal_angle, 1.0F);
        const Vec2<double> n = unit(normal_angle);
        const Vec2<double> along{-n.y, n.x};
        for (double s = -10.0; s <= 10.0; s += 0.173) {
            Vec2<float> x = convert<float>(Vec2<double>{16.0, 16.0} + s * along + (-0.02) * n);
            Vec2<float> w = convert<float>((-1.0) * n);
            const CollideResult<float> count = stand.hit(x, w);
            ASSERT_EQ(count.reflected, 1) << normal_angle << " at " << s;
            const Vec2<double> out = convert<double>(w);
            worst = std::max(worst, std::abs(std::asin(std::clamp(cross(out, n), -1.0, 1.0))));
        }
    }
    // Twice the angle of the line, which floats in cells give to about 1e-5 of a cell's edge; the
    // shortest lines that cut a corner take theirs from slopes, and are as good.
    EXPECT_LT(worst, 1.0e-3);
}

TEST(Collide, AMovingWallLendsItsVelocity) {
    Stand stand(0.0, 0.0F);
    stand.body.velocity = {3.0F, 1.0F};
    stand.walls.moving = &moving_walls<float>();
    Vec2<float> x{15.9F, 16.0F};
    Vec2<float> w{0.0F, 0.0F};
    EXPECT_EQ(stand.hit(x, w).reflected, 1);
    EXPECT_NEAR(w.x, 3.0F, 1.0e-5F) << "pushed";
    EXPECT_NEAR(w.y, 0.0F, 1.0e-5F) << "the wall is slippery";
    stand.body.surface.restitution = 1.0F;
    x = {15.9F, 16.0F};
    w = {-1.0F, 2.0F};
    stand.hit(x, w);
    EXPECT_NEAR(w.x, 7.0F, 1.0e-5F);
    stand.body.velocity = {0, 0};
    stand.body.surface.restitution = 0.0F;
    stand.body.position = {16.0F, 10.0F};
    stand.body.spin = -2.0F;  // at (15.9, 16): velocity (12, 0.2)
    x = {15.9F, 16.0F};
    w = {0, 0};
    stand.hit(x, w);
    EXPECT_NEAR(w.x, 12.0F, 1.0e-4F);
}

/// Throws one particle at a half plane; its velocity after 40 steps, cells/s.
Vec2<double> thrown(double normal_angle, Vec2<double> v_mps, double& nearest) {
    TestWorld<float> world(free_flight());
    Ring ring;
    put_static(*world, half_plane(ring, normal_angle, 1.0F));
    const Vec2<double> n = unit(normal_angle);
    const Vec2<double> middle{16.0, 16.0};
    const Vec2<float> start = convert<float>(middle + 3.0 * n);
    EXPECT_EQ(world->add_particle(kCell * start, convert<float>(v_mps)), Status::ok);
    nearest = 1.0e9;
    for (int step = 0; step < 40; ++step) {
        world->step(1.0F / 60.0F);
        const Vec2<double> x = convert<double>(world->particle_positions()[0]);
        nearest = std::min(nearest, dot(x - middle, n));
    }
    return convert<double>(world->particle_velocities()[0]);
}

TEST(Collide, ThrownInAWorldIsStoppedAtTheWall) {
    for (const double normal_angle : kAngles) {
        const Vec2<double> n = unit(normal_angle);
        double nearest = 0.0;
        const Vec2<double> v = 0.2 * unit(normal_angle + kPi + 0.6);
        const Vec2<double> out = thrown(normal_angle, v, nearest);
        EXPECT_GT(nearest, -1.0e-3) << normal_angle;
        EXPECT_GT(dot(out, n), -0.5) << normal_angle << ": still goes into the wall";
        EXPECT_LT(std::hypot(out.x, out.y), 10.1) << normal_angle << ": gained speed";
    }
}

TEST(Collide, ThrownInAWorldComesBackMirrored) {
    for (const double normal_angle : kAngles) {
        const Vec2<double> n = unit(normal_angle);
        const Vec2<double> v = 0.2 * unit(normal_angle + kPi + 0.6);
        double nearest = 0.0;
        const Vec2<double> out = thrown(normal_angle, v, nearest);
        const Vec2<double> turned = v - 2.0 * dot(v, n) * n;
        const Vec2<double> mirrored = (1.0 / static_cast<double>(kCell)) * turned;
        EXPECT_NEAR(out.x, mirrored.x, 0.5) << normal_angle;
        EXPECT_NEAR(out.y, mirrored.y, 0.5) << normal_angle;
    }
}

/// A ramp whose ends lie exactly on the tank's walls has no pocket behind it.
TEST(Collide, ARampFlushWithTheTankIsTight) {
    WorldDef def = free_flight();
    def.gravity_mps2 = {0, -9.81F};
    def.flip_ratio = 0.97F;
    TestWorld<float> world(def);
    const Ring ramp = {{0, 0}, {9 * kCell, 0}, {9 * kCell, 4.5F * kCell}};
    put_static(*world, body_of(ramp, {23 * kCell, 0}));
    ASSERT_EQ(world->fill({{0, 0}, {0.24F, 0.4F}}), Status::ok);
    double deepest = 0.0;
    for (int step = 0; step < 180; ++step) {
        world->step(1.0F / 60.0F);
        for (const Vec2<float> x : world->particle_positions()) {
            const Vec2<double> from = convert<double>(x) - Vec2<double>{23.0, 0.0};
            deepest = std::max(deepest, (0.5 * from.x - from.y) / std::sqrt(1.25));
        }
    }
    EXPECT_LT(deepest, 0.1) << "cells below the ramp's face";
}

TEST(Collide, AMovingWallPushesALayerOfLiquid) {
    WorldDef def = free_flight();
    def.flip_ratio = 0.97F;
    TestWorld<float> world(def);
    Ring ring = rectangle(4 * kCell, 64 * kCell);
    BodyDef wall = body_of(ring, {4 * kCell, 16 * kCell});
    wall.motion.velocity_mps = {0.2F, 0};
    const BodyId id = put_moving(*world, wall);
    std::int32_t added = 0;
    ASSERT_EQ(world->fill({{6 * kCell, 0}, {8 * kCell, 0.64F}}, &added), Status::ok);
    ASSERT_EQ(added, 2 * 32 * 4);
    for (int step = 0; step < 60; ++step) {
        world->step(1.0F / 60.0F);
    }
    Motion motion;
    ASSERT_EQ(world->motion(id, &motion), Status::ok);
    const float face = motion.position_m.x / kCell + 2.0F;
    double mean = 0.0;
    for (std::int32_t k = 0; k < added; ++k) {
        EXPECT_GT(world->particle_positions()[k].x, face - 0.05F);
        mean += static_cast<double>(world->particle_velocities()[k].x) / added;
    }
    EXPECT_NEAR(mean, 10.0, 0.5) << "it goes with the wall, cells/s";
}

/// A body put over liquid, however thick: everything found inside comes out.
TEST(Collide, NothingStaysInsideABodyPutOverLiquid) {
    for (const float width : {3.0F, 6.0F, 10.0F, 16.0F}) {
        WorldDef def = free_flight();
        def.gravity_mps2 = {0, -9.81F};
        TestWorld<float> world(def);
        std::int32_t added = 0;
        ASSERT_EQ(world->fill({{0, 0}, {0.64F, 0.24F}}, &added), Status::ok);
        const Ring ring = rectangle(width * kCell, 8 * kCell);
        put_static(*world, body_of(ring, {0.31F, 0.13F}));
        for (int step = 0; step < 240; ++step) {
            world->step(1.0F / 60.0F);
        }
        std::int32_t inside = 0;
        for (const Vec2<float> x : world->particle_positions()) {
            inside += distance_at(*world, x) < -0.15 ? 1 : 0;
        }
        EXPECT_EQ(inside, 0) << "of a body " << width << " cells wide";
        EXPECT_EQ(world->particle_positions().size, added);
    }
}

}  // namespace
}  // namespace weir
