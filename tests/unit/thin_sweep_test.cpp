// Where who meets walls thinner than a cell gets to: in front of them, out of them, along with them.
#include <gtest/gtest.h>

#include "brute_distance.hpp"
#include "measure/random.hpp"
#include "solid/thin_sweep.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

struct Tank {
    TestWorld<float> world;

    Tank() : world(def()) {}
    static WorldDef def() {
        WorldDef def = tank_def(32, 32, 4, 2, 16);
        def.capacity.wall_edges = 400;
        return def;
    }
    /// In cells.
    void add(Ring ring, bool open) {
        for (Vec2f& vertex : ring) {
            vertex = kCell * vertex;
        }
        BodyDef body = body_of(ring, {});
        body.open = open;
        put_moving(*world, body);
    }
    Simulation<float>& simulation() {
        return state_of(world).simulation;
    }
    bool keep(Vec2<float> before, Vec2<float> after, bool follow, ThinStop<float>& stop) {
        Layers<float>& layers = simulation().layers;
        return keep_side(layers.thin, layers.shape, layers.walls.body, before, after, follow, stop);
    }
};

/// Not at the wall, where they would all meet.
TEST(ThinSweep, WhoIsFoundBehindAWallGetsAsFarInFrontOfIt) {
    Tank tank;
    tank.add({{16.0F, 2.0F}, {16.0F, 30.0F}}, true);
    ThinStop<float> stop;
    for (const float beyond : {0.1F, 0.3F, 0.8F}) {
        ASSERT_TRUE(tank.keep({15.5F, 16.2F}, {16.0F + beyond, 16.5F}, false, stop));
        EXPECT_NEAR(stop.place.x, 16.0F - std::fmin(beyond, 0.5F), 0.01F);
        EXPECT_NEAR(stop.place.y, 16.5F, 1.0e-4F);
    }
}

/// A wall that was just put there, at whatever angle, has swept nothing.
TEST(ThinSweep, AWallThatComesLeaningTakesNobodyAlong) {
    WorldDef def = Tank::def();
    def.gravity_mps2 = {};
    TestWorld<float> world(def);
    const Ring ring = {{0.0F, 0.0F}, {0.2F, 0.0F}};
    BodyDef body = body_of(ring, {0.3F, 0.3F}, 0.1F);
    body.open = true;
    put_moving(*world, body);
    expect_ok(world->add_particle({0.48F, 0.309F}, {}));
    world->step(1.0F / 60.0F);
    EXPECT_NEAR(world->particle_positions()[0].x, 24.0F, 1.0e-4F);
    EXPECT_NEAR(world->particle_positions()[0].y, 15.45F, 1.0e-4F);
}

/// In a corner narrower than what a particle keeps from walls it goes where the walls take it.
TEST(ThinSweep, ACornerTakesAlongWhoCannotSlide) {
    Tank tank;
    tank.add({{20.0F, 16.1F}, {10.0F, 16.0F}, {20.0F, 15.9F}}, true);
    Body<float>& body = tank.simulation().bodies.body[0];
    body.met_position.x = body.position.x - 1.0F;
    follow_bodies(tank.simulation().layers.thin, tank.simulation().bodies);
    ThinStop<float> stop;
    const Vec2<float> before{9.01F, 16.0F};
    ASSERT_TRUE(tank.keep(before, before, true, stop));
    EXPECT_NEAR(stop.place.x, 10.01F, 1.0e-5F);
    EXPECT_NEAR(stop.place.y, 16.0F, 1.0e-5F);
}

/// Past a tip both edges are as near, and one of them has the place on its inner side.
TEST(ThinSweep, NobodyIsInATipThatIsBesideIt) {
    measure::Random random(3);
    for (const float tip : {0.2F, 0.5F, 1.0F}) {
        Tank tank;
        tank.add({{16.1F, 16.3F}, {10.0F, 16.3F + tip}, {10.0F, 16.3F - tip}}, false);
        const Layers<float>& layers = tank.simulation().layers;
        const std::vector<Point> ring = {{16.1, 16.3},
                                         {10.0, 16.3 + static_cast<double>(tip)},
                                         {10.0, 16.3 - static_cast<double>(tip)}};
        for (int trial = 0; trial < 20000; ++trial) {
            const Vec2<float> at{random.uniform(15.5F, 16.7F), random.uniform(15.7F, 16.9F)};
            const double distance = brute_distance(ring, convert<double>(at), {32.0, 32.0});
            ThinStop<float> stop;
            const bool inside =
                way_out_of_thin(layers.thin, layers.shape, layers.walls.body, at, stop);
            if (std::abs(distance) > 1.0e-4) {
                ASSERT_EQ(inside, distance < 0.0) << tip << " at " << at.x << ' ' << at.y;
            }
        }
    }
}

/// Between the long sides of a plate its ends are thin, too, though it is long behind them.
TEST(ThinSweep, PlatesAreClosedAtTheirEnds) {
    Tank tank;
    tank.add({{10.0F, 16.0F}, {20.0F, 16.0F}, {20.0F, 16.4F}, {10.0F, 16.4F}}, false);
    EXPECT_TRUE(is_thin_all_over(tank.simulation().layers.thin, tank.simulation().bodies, 0));
}

}  // namespace
}  // namespace weir
