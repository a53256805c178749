// Free bodies that meet bodies, each other and the tank.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr double kCell = 0.02;
constexpr double kG = 9.81;

WorldDef dry_def() {
    WorldDef def = tank_def(40, 40, 4 * 40 * 40, 8, 64);
    def.capacity.two_way = true;
    return def;
}

std::vector<Vec2f> posed(const Ring& ring, const Motion& at) {
    const float c = std::cos(at.angle_rad);
    const float s = std::sin(at.angle_rad);
    std::vector<Vec2f> out;
    for (const Vec2f p : ring) {
        out.push_back({at.position_m.x + (c * p.x - s * p.y), at.position_m.y + (s * p.x + c * p.y)});
    }
    return out;
}

/// How deep a point is in a convex ring, m.
double depth_in(const std::vector<Vec2f>& ring, Vec2f p) {
    double depth = 1e9;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2f a = ring[k];
        const Vec2f b = ring[(k + 1) % ring.size()];
        const double side = static_cast<double>((b.x - a.x) * (p.y - a.y) -
                                                (b.y - a.y) * (p.x - a.x));
        depth = std::min(depth, side / static_cast<double>(std::hypot(b.x - a.x, b.y - a.y)));
    }
    return depth;
}

/// How deep convex rings are in each other, cells.
double overlap_of(const Ring& a, const Motion& at_a, const Ring& b, const Motion& at_b) {
    const auto one = posed(a, at_a);
    const auto two = posed(b, at_b);
    double depth = 0;
    for (const Vec2f p : one) {
        depth = std::max(depth, depth_in(two, p));
    }
    for (const Vec2f p : two) {
        depth = std::max(depth, depth_in(one, p));
    }
    return depth / kCell;
}

double speed_of(const Motion& m) {
    return static_cast<double>(std::hypot(m.velocity_mps.x, m.velocity_mps.y));
}

/// Of a box of that edge, over its mass.
double energy_of(const Motion& m, double edge) {
    const auto spin = static_cast<double>(m.spin_radps);
    return 0.5 * speed_of(m) * speed_of(m) + 0.5 * spin * spin * edge * edge / 6 +
           kG * static_cast<double>(m.position_m.y);
}

WEIR_SUITE(FreeContact, RoomyScalars);

/// Without friction a ramp is slid down as gravity has it; on a rough one a crate stays.
TYPED_TEST(FreeContact, CrateOnARampSlidesOrStays) {
    for (const float friction : {0.0F, 0.8F}) {
        WorldDef def = dry_def();
        def.capacity.cells_x = 60;
        TestWorld<TypeParam> world{def};
        const Ring slope = {{0, 0}, {1.0F, 0}, {0, 0.5F}};
        const Ring box = rectangle(0.08F, 0.08F);
        BodyDef ramp = body_of(slope, {0.02F, 0});
        ramp.surface.friction = friction;
        const float tilt = -std::atan(0.5F);
        const Vec2f normal{-std::sin(tilt), std::cos(tilt)};
        const BodyId ramp_id = put_static(*world, ramp);
        const Vec2f foot{0.12F, 0.45F};
        const Vec2f above{foot.x + 0.04F * normal.x, foot.y + 0.04F * normal.y};
        const BodyId id = put_free(*world, body_of(box, above, tilt));
        const Motion at = motion_of(*world, ramp_id);
        const Motion start = motion_of(*world, id);
        double energy = energy_of(start, 0.08);
        double t = 0;
        for (int k = 0; k < 30; ++k) {
            t += static_cast<double>(world->step(kDt).dt_s);
            const Motion m = motion_of(*world, id);
            EXPECT_LT(overlap_of(box, m, slope, at), 0.01);
            EXPECT_LT(energy_of(m, 0.08), energy + 1e-4);
            energy = energy_of(m, 0.08);
        }
        const Motion m = motion_of(*world, id);
        const double way = static_cast<double>(
            std::hypot(m.position_m.x - start.position_m.x, m.position_m.y - start.position_m.y));
        EXPECT_NEAR(static_cast<double>(m.angle_rad), static_cast<double>(tilt), 2e-3);
        if (friction > 0) {
            EXPECT_LT(way, 0.05 * kCell);
        } else {
            EXPECT_NEAR(way / (0.5 * kG * std::sqrt(0.2) * t * t), 1.0, 0.05);
        }
    }
}

/// Four crates on each other stand as they were put, and do not sink into each other.
TYPED_TEST(FreeContact, StackStands) {
    for (const float density : {0.5F, 3.0F}) {
        TestWorld<TypeParam> world{dry_def()};
        const Ring box = rectangle(0.1F, 0.1F);
        constexpr int kCrates = 4;
        BodyId id[kCrates];
        for (int k = 0; k < kCrates; ++k) {
            BodyDef crate = body_of(box, {k % 2 == 0 ? 0.3F : 0.31F,
                                          0.052F + 0.103F * static_cast<float>(k)});
            crate.density_ratio = density;
            crate.surface.friction = 0.4F;
            id[k] = put_free(*world, crate);
        }
        double deepest = 0;
        for (int step = 0; step < 600; ++step) {
            world->step(kDt);
            for (int k = 0; k < kCrates; ++k) {
                const Motion m = motion_of(*world, id[k]);
                if (k > 0) {
                    deepest = std::max(deepest,
                                       overlap_of(box, m, box, motion_of(*world, id[k - 1])));
                }
                if (step > 300) {
                    EXPECT_LT(speed_of(m), 1e-3) << k;
                }
            }
        }
        EXPECT_LT(deepest, 0.05);
        for (int k = 0; k < kCrates; ++k) {
            const Motion m = motion_of(*world, id[k]);
            EXPECT_NEAR(m.position_m.x, k % 2 == 0 ? 0.3F : 0.31F, 5e-4F) << k;
            EXPECT_NEAR(m.position_m.y, 0.05F + 0.1F * static_cast<float>(k), 5e-4F) << k;
            EXPECT_NEAR(m.angle_rad, 0.0F, 2e-3F) << k;
        }
    }
}

/// Two bodies in empty space: what one loses the other gets, about any point, and none is thrown
/// off with more than there was.
TYPED_TEST(FreeContact, WhatOneLosesTheOtherGets) {
    for (const float restitution : {0.0F, 0.5F, 1.0F}) {
        for (const float offset : {0.0F, 0.045F}) {
            WorldDef def = dry_def();
            def.gravity_mps2 = {0, 0};
            TestWorld<TypeParam> world{def};
            const Ring box = rectangle(0.1F, 0.08F);
            const Ring bar = rectangle(0.2F, 0.06F);
            BodyDef one = body_of(box, {0.25F, 0.4F}, 0.3F);
            one.motion.velocity_mps = {0.6F, 0.1F};
            one.motion.spin_radps = 2.0F;
            one.surface.restitution = restitution;
            one.surface.friction = 0.3F;
            BodyDef other = body_of(bar, {0.5F, 0.42F + offset}, 1.3F);
            other.motion.velocity_mps = {-0.3F, 0.0F};
            other.density_ratio = 1.7F;
            const BodyId id[] = {put_free(*world, one), put_free(*world, other)};
            double sum[2][4];  // momentum, angular momentum about the tank's corner, energy
            for (int after = 0; after < 2; ++after) {
                std::fill(sum[after], sum[after] + 4, 0.0);
                for (const BodyId each : id) {
                    BodyMass mass;
                    expect_ok(world->mass(each, &mass));
                    const Motion m = motion_of(*world, each);
                    const auto kg = static_cast<double>(mass.mass_m2);
                    const auto x = static_cast<double>(m.position_m.x);
                    const auto y = static_cast<double>(m.position_m.y);
                    const auto u = static_cast<double>(m.velocity_mps.x);
                    const auto v = static_cast<double>(m.velocity_mps.y);
                    const double turn = static_cast<double>(mass.inertia_m4) *
                                        static_cast<double>(m.spin_radps);
                    sum[after][0] += kg * u;
                    sum[after][1] += kg * v;
                    sum[after][2] += kg * (x * v - y * u) + turn;
                    sum[after][3] += 0.5 * kg * (u * u + v * v) +
                                     0.5 * turn * static_cast<double>(m.spin_radps);
                }
                for (int k = 0; k < 24 && after == 0; ++k) {
                    world->step(kDt);
                }
            }
            const double much = 0.013 * 0.6;  // of momentum
            const double fine = std::is_same_v<TypeParam, Fixed> ? 2e-3 : 2e-5;
            EXPECT_NEAR(sum[1][0], sum[0][0], fine * much);
            EXPECT_NEAR(sum[1][1], sum[0][1], fine * much);
            EXPECT_NEAR(sum[1][2], sum[0][2], fine * much);
            EXPECT_LT(sum[1][3], sum[0][3] * (1 + 1e-3));
            EXPECT_GT(std::fabs(sum[1][3] - sum[0][3]), restitution < 1 ? 0.05 * sum[0][3] : -1.0)
                << "they did not meet";
        }
    }
}

/// From a height, onto a static body: it comes back to the square of the restitution of it.
TYPED_TEST(FreeContact, BouncesAsHighAsItsRestitution) {
    TestWorld<TypeParam> world{dry_def()};
    const Ring slab = rectangle(0.4F, 0.06F);
    BodyDef floor = body_of(slab, {0.4F, 0.1F});
    floor.surface.restitution = 0.7F;
    BodyId id = put_static(*world, floor);
    id = put_free(*world, body_of(kSquare4cm, {0.4F, 0.45F}));
    float lowest = 1;
    float highest = 0;
    for (int k = 0; k < 40; ++k) {
        world->step(kDt);
        const Motion m = motion_of(*world, id);
        lowest = std::min(lowest, m.position_m.y);
        highest = m.velocity_mps.y > 0 || highest > 0 ? std::max(highest, m.position_m.y) : 0;
    }
    EXPECT_GT(lowest, 0.15F - 1e-4F);
    EXPECT_NEAR((highest - 0.15F) / 0.3F, 0.49F, 0.03F);
}

/// Pressed into a notch that is too narrow for it, a crate comes to rest.
TYPED_TEST(FreeContact, WedgedCrateComesToRest) {
    TestWorld<TypeParam> world{dry_def()};
    const Ring left = {{0, 0}, {0.15F, 0}, {0, 0.5F}};
    const Ring right = {{0, 0}, {0, 0.5F}, {-0.15F, 0}};
    const Ring box = rectangle(0.16F, 0.16F);
    const BodyId walls[] = {put_static(*world, body_of(left, {0.2F, 0})),
                            put_static(*world, body_of(right, {0.5F, 0}))};
    BodyDef crate = body_of(box, {0.35F, 0.55F}, 0.1F);
    crate.motion.velocity_mps = {0, -2.0F};
    const BodyId id = put_free(*world, crate);
    const Motion at[2] = {motion_of(*world, walls[0]), motion_of(*world, walls[1])};
    double energy = 1e9;
    for (int k = 0; k < 300; ++k) {
        world->step(kDt);
        const Motion m = motion_of(*world, id);
        EXPECT_LT(energy_of(m, 0.16), energy + 2e-3);
        energy = std::min(energy, energy_of(m, 0.16));
        EXPECT_LT(overlap_of(box, m, left, at[0]), k < 200 ? 0.3 : 0.05);
        EXPECT_LT(overlap_of(box, m, right, at[1]), k < 200 ? 0.3 : 0.05);
    }
    EXPECT_LT(speed_of(motion_of(*world, id)), 1e-3);
    EXPECT_GT(motion_of(*world, id).position_m.y, 0.1F) << "it fell through";
}

/// Put into each other, bodies are moved apart, and none of them is faster for it.
TYPED_TEST(FreeContact, BodiesInEachOtherAreMovedApart) {
    WorldDef def = dry_def();
    def.gravity_mps2 = {0, 0};
    TestWorld<TypeParam> world{def};
    const Ring box = rectangle(0.1F, 0.1F);
    const BodyId id[] = {put_static(*world, body_of(box, {0.3F, 0.4F})),
                         put_free(*world, body_of(box, {0.385F, 0.41F}, 0.1F)),
                         put_free(*world, body_of(box, {0.46F, 0.38F}))};
    for (int k = 0; k < 120; ++k) {
        world->step(kDt);
        EXPECT_LT(speed_of(motion_of(*world, id[1])), 1e-3);
        EXPECT_LT(speed_of(motion_of(*world, id[2])), 1e-3);
    }
    const Motion at[3] = {motion_of(*world, id[0]), motion_of(*world, id[1]),
                          motion_of(*world, id[2])};
    EXPECT_LT(overlap_of(box, at[0], box, at[1]), 0.03);
    EXPECT_LT(overlap_of(box, at[1], box, at[2]), 0.03);
    EXPECT_LT(at[2].position_m.x, 0.55F) << "it was thrown off";
}

/// Moving bodies push, lift and carry; a belt takes along what lies on it.
TYPED_TEST(FreeContact, MovingBodiesPushLiftAndCarry) {
    TestWorld<TypeParam> world{dry_def()};
    const Ring slab = rectangle(0.3F, 0.04F);
    const Ring post = rectangle(0.04F, 0.2F);
    BodyDef lift = body_of(slab, {0.2F, 0.2F});
    lift.motion.velocity_mps = {0, 0.2F};
    BodyDef pusher = body_of(post, {0.45F, 0.1F});
    pusher.motion.velocity_mps = {0.1F, 0};
    BodyDef belt = body_of(slab, {0.2F, 0.02F});
    belt.surface.friction = 0.6F;
    belt.surface.conveyor_mps = -0.15F;
    const BodyId id[] = {put_moving(*world, lift),
                         put_moving(*world, pusher),
                         put_static(*world, belt),
                         put_free(*world, body_of(kSquare4cm, {0.2F, 0.24F})),
                         put_free(*world, body_of(kSquare4cm, {0.5F, 0.02F})),
                         put_free(*world, body_of(kSquare4cm, {0.12F, 0.06F}))};
    for (int k = 0; k < 60; ++k) {
        world->step(kDt);
    }
    const Motion lifted = motion_of(*world, id[3]);
    EXPECT_NEAR(lifted.position_m.y - motion_of(*world, id[0]).position_m.y, 0.04F, 2e-4F);
    EXPECT_NEAR(lifted.velocity_mps.y, 0.2F, 2e-3F);
    const Motion pushed = motion_of(*world, id[4]);
    EXPECT_NEAR(pushed.position_m.x - motion_of(*world, id[1]).position_m.x, 0.04F, 2e-4F);
    EXPECT_NEAR(pushed.velocity_mps.x, 0.1F, 2e-3F);
    const Motion carried = motion_of(*world, id[5]);
    EXPECT_NEAR(carried.velocity_mps.x, 0.15F, 2e-3F);
    EXPECT_NEAR(carried.position_m.y, 0.06F, 2e-4F);
}

/// A line without thickness is a shelf; a cup with a hollow holds what falls into it.
TYPED_TEST(FreeContact, ShelvesAndCupsHold) {
    WorldDef def = dry_def();
    def.capacity.wall_edges = 400;
    TestWorld<TypeParam> world{def};
    const Ring shelf = {{0, 0}, {0.15F, 0}, {0.3F, 0.02F}};
    const Ring cup = {{0, 0},           {0.3F, 0},        {0.3F, 0.2F}, {0.26F, 0.2F},
                      {0.26F, 0.04F}, {0.04F, 0.04F}, {0.04F, 0.2F}, {0, 0.2F}};
    BodyDef line = body_of(shelf, {0.04F, 0.3F});
    line.open = true;
    line.surface.friction = 0.5F;
    const BodyId id[] = {put_static(*world, line),
                         put_moving(*world, body_of(cup, {0.44F, 0.1F})),
                         put_free(*world, body_of(kSquare4cm, {0.1F, 0.4F})),
                         put_free(*world, body_of(kSquare4cm, {0.6F, 0.5F}, 0.4F))};
    for (int k = 0; k < 180; ++k) {
        world->step(kDt);
    }
    EXPECT_NEAR(motion_of(*world, id[2]).position_m.y, 0.32F, 5e-4F);
    EXPECT_NEAR(motion_of(*world, id[3]).position_m.y, 0.16F, 5e-4F);
}

/// What comes down no faster than it falls in two substeps stays, however hard it is: else it would
/// tremble for ever.
TEST(FreeContact, WhoComesDownSlowlyStays) {
    WorldDef def = dry_def();
    def.walls.bottom.restitution = 1.0F;
    TestWorld<float> world(def);
    BodyDef ball = body_of(kSquare4cm, {0.4F, 0.0205F});
    ball.surface.restitution = 1.0F;
    const BodyId id = put_free(*world, ball);
    for (int step = 0; step < 60; ++step) {
        world->step(kDt);
        EXPECT_LT(motion_of(*world, id).velocity_mps.y, 1.0e-3F) << step;
    }
    EXPECT_NEAR(motion_of(*world, id).position_m.y, 0.02F, 1.0e-4F);
}

/// A comb of eight teeth meets a slab in more points than there is room for. Two teeth are longer,
/// and bear it.
TEST(FreeContact, OfTooManyPointsTheNearestCount) {
    WorldDef def = tank_def(40, 40, 4, 2, 64);
    def.capacity.two_way = true;
    constexpr float kWide = 0.015F;
    for (int longer = 0; longer < 4; ++longer) {
        TestWorld<float> world(def);
        put_static(*world, body_of(rectangle(0.6F, 0.1F), {0.4F, 0.15F}));
        Ring comb = {{0.5F * 15 * kWide, 0.06F}, {-0.5F * 15 * kWide, 0.06F}};
        for (int tooth = 0; tooth < 8; ++tooth) {
            const float left = (2.0F * static_cast<float>(tooth) - 7.5F) * kWide;
            const float end = tooth == longer || tooth == 7 - longer ? 0.0F : 0.002F;
            for (const Vec2f corner : {Vec2f{left, 0.03F}, Vec2f{left, end},
                                       Vec2f{left + kWide, end}, Vec2f{left + kWide, 0.03F}}) {
                comb.push_back(corner);
            }
        }
        comb.erase(comb.begin() + 2);
        comb.pop_back();
        const BodyId id = put_free(*world, body_of(comb, {0.4F, 0.201F}));
        for (int step = 0; step < 60; ++step) {
            world->step(kDt);
        }
        EXPECT_NEAR(motion_of(*world, id).position_m.y, 0.2F, 5.0e-4F) << longer;
    }
}

}  // namespace
}  // namespace weir
