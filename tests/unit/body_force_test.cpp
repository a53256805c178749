// What particles and the pressure do to a body: how much, and about which point.
#include <gtest/gtest.h>

#include <cmath>

#include "solid/body_force.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

WorldDef force_def() {
    WorldDef def = tank_def(16, 16, 4, 1, 8);
    def.gravity_mps2 = {0.0F, 0.0F};
    def.capacity.two_way = true;
    return def;
}

double turn_about(Vec2<float> centre, Vec2<float> point, Vec2<double> push) {
    const Vec2<double> arm = convert<double>(point) - convert<double>(centre);
    return arm.x * push.y - arm.y * push.x;
}

/// Counter-clockwise is positive; a particle of the second liquid weighs what it weighs.
TEST(BodyForce, BlowsAddUpAboutTheCentreOfMass) {
    WorldDef def = force_def();
    def.capacity.second_liquid = true;
    def.second_density_ratio = 3.0F;
    TestWorld<float> world(def);
    const BodyId id = put_free(*world, body_of(kTriangle, {0.1F, 0.1F}));
    world->step(0.0F);
    locate_bodies(state_of(world).simulation.bodies);
    const Walls<float>& walls = state_of(world).simulation.layers.walls;
    BodyLoad<float>& load = walls.load[id.slot];
    EXPECT_NEAR(load.at.x, 5.0F + 4.0F / 3.0F, 1.0e-4F) << "a third of its legs from the corner";
    EXPECT_NEAR(load.at.y, 5.0F + 4.0F / 3.0F, 1.0e-4F);
    load.forget_blows();
    load.received = {};
    const Vec2<float> points[] = {{5.0F, 8.5F}, {8.0F, 4.75F}};
    const Vec2<float> lost[] = {{3.0F, -1.0F}, {0.5F, 2.0F}};
    const Liquid kinds[] = {Liquid::first, Liquid::second};
    const double masses[] = {0.25, 0.75};
    Vec2<double> push{};
    double turn = 0.0;
    for (int k = 0; k < 2; ++k) {
        receive_blow(walls, id.slot, kinds[k], points[k], lost[k]);
        const Vec2<double> blow = masses[k] * convert<double>(lost[k]);
        push = push + blow;
        turn += turn_about(load.at, points[k], blow);
    }
    for (const Impulse<float>& sum : {load.received, load.blows}) {
        EXPECT_NEAR(sum.linear.x, push.x, 1.0e-5);
        EXPECT_NEAR(sum.linear.y, push.y, 1.0e-5);
        EXPECT_NEAR(sum.angular, turn, 1.0e-5);
    }
    EXPECT_NEAR(load.blow_mass, 1.0, 1.0e-6);
}

/// Velocity and spin after a blow of particles that weigh so many times what the body does.
Motion after_blow(float weight) {
    TestWorld<float> world(force_def());
    const Ring box = rectangle(0.1F, 0.06F);
    const BodyId id = put_free(*world, body_of(box, {0.16F, 0.16F}));
    BodyLoad<float>& load = state_of(world).simulation.bodies.load[id.slot];
    load.blows.linear = {4.0F, -2.0F};
    load.blows.angular = 3.0F;
    load.blow_mass = weight * load.mass;
    world->step(0.001F);
    return motion_of(*world, id);
}

/// Together they bring it to no more than their own speed.
TEST(BodyForce, WhatIsLighterThanItsBlowsTakesAsMuchLess) {
    const Motion whole = after_blow(0.5F);
    const Motion part = after_blow(4.0F);
    EXPECT_GT(whole.spin_radps, 0.1F);
    EXPECT_NEAR(part.spin_radps, 0.25F * whole.spin_radps, 1.0e-5F);
    EXPECT_NEAR(part.velocity_mps.x, 0.25F * whole.velocity_mps.x, 1.0e-6F);
    EXPECT_NEAR(part.velocity_mps.y, 0.25F * whole.velocity_mps.y, 1.0e-6F);
}

/// Liquid at rest stands on the left of a split in the pool: the push on the box is that on its
/// left, on a part of its bottom and its top.
TEST(BodyForce, PressureActsWhereItTouches) {
    constexpr double kLeft = 5.3;
    constexpr double kRight = 11.7;
    constexpr double kLow = 4.4;
    constexpr double kHigh = 9.6;
    constexpr double kSplit = 8.0;
    constexpr double kLevel = 12.0;
    constexpr double kPull = 0.5;
    TestWorld<double> world(force_def());
    const Ring ring = {{0.106F, 0.088F}, {0.234F, 0.088F}, {0.234F, 0.192F}, {0.106F, 0.192F}};
    const BodyId id = put_static(*world, body_of(ring, {}));
    world->step(0.0F);
    Simulation<double>& simulation = state_of(world).simulation;
    const GridShape& s = simulation.layers.shape;
    const auto entries = static_cast<std::size_t>(s.stride * (s.ny + 2));
    std::vector<double> pressure(entries);
    std::vector<double> level(entries, -1.0);
    for (std::int32_t j = 0; j < kLevel; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const auto c = static_cast<std::size_t>(s.index(i, j));
            pressure[c] = kPull * (kLevel - (j + 0.5));
            level[c] = i < kSplit ? 1.0 : -1.0;
        }
    }
    PressedCells<double> cells;
    cells.pressure = pressure.data();
    cells.level = level.data();
    cells.gravity_dt = {0.0, -kPull};
    const BodyLoad<double>& load = simulation.bodies.load[id.slot];
    locate_bodies(simulation.bodies);
    EXPECT_NEAR(load.at.x, 0.5 * (kLeft + kRight), 1.0e-4);
    EXPECT_NEAR(load.at.y, 0.5 * (kLow + kHigh), 1.0e-4);
    press_on_bodies(s, simulation.layers.walls, simulation.bodies, cells);
    const double height = kHigh - kLow;
    const double width = kSplit - kLeft;
    const double beneath = kPull * (kLevel - kLow);
    const double above = kPull * (kLevel - kHigh);
    const double lift = (beneath - above) * width;
    const double aside = 0.5 * (beneath + above) * height;
    EXPECT_NEAR(load.received.linear.x, aside, 0.01 * aside);
    EXPECT_NEAR(load.received.linear.y, lift, 0.05 * lift) << "nodes cut the corners";
    const double turn = lift * (0.5 * (kLeft + kSplit) - load.at.x) +
                        kPull * height * height * height / 12.0;
    EXPECT_NEAR(load.received.angular, turn, 0.1 * std::fabs(turn));
}

/// For each cell alone that a box cuts. Returns how many of them push.
int push_of_each_cell(float angle) {
    TestWorld<double> world(force_def());
    const Ring box = rectangle(0.12F, 0.08F);
    const BodyId id = put_static(*world, body_of(box, {0.154F, 0.165F}, angle));
    world->step(0.0F);
    Simulation<double>& simulation = state_of(world).simulation;
    locate_bodies(simulation.bodies);
    const GridShape& s = simulation.layers.shape;
    const Walls<double>& walls = simulation.layers.walls;
    const auto entries = static_cast<std::size_t>(s.stride * (s.ny + 2));
    const std::vector<double> pressure(entries);
    BodyLoad<double>& load = simulation.bodies.load[id.slot];
    constexpr Vec2<double> kPull{0.3, -0.5};
    int pushing = 0;
    for_each_cut(s, walls, id.slot, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        std::vector<double> level(entries, -1.0);
        level[static_cast<std::size_t>(c)] = 1.0;
        PressedCells<double> cells;
        cells.pressure = pressure.data();
        cells.level = level.data();
        cells.gravity_dt = kPull;
        load.received = {};
        press_on_bodies(s, walls, simulation.bodies, cells);
        Vec2<double> closed{};
        for_each_closed_face(s, walls, i, j,
                             [&](const ClosedFace<double>& f) { closed = closed + f.outward; });
        const Vec2<double> middle = middle_of_contour(s, walls, c);
        const double more = kPull.x * (middle.x - 0.5) + kPull.y * (middle.y - 0.5);
        const Vec2<double> arm{i + middle.x - load.at.x, j + middle.y - load.at.y};
        EXPECT_NEAR(load.received.linear.x, more * closed.x, 1.0e-9);
        EXPECT_NEAR(load.received.linear.y, more * closed.y, 1.0e-9);
        EXPECT_NEAR(load.received.angular, more * (arm.x * closed.y - arm.y * closed.x), 1.0e-9);
        pushing += more * closed.x != 0.0 ? 1 : 0;
    });
    return pushing;
}

/// What the pressure gains between a cell's centre and the contour acts at the contour.
TEST(BodyForce, TheWayToTheContourActsThere) {
    EXPECT_GT(push_of_each_cell(0.3F), 15);
    EXPECT_GT(push_of_each_cell(0.0F), 5);
}

/// Liquid that is carried along makes a body heavier by a half here. What stops it is counted too.
TEST(BodyForce, IsAnsweredByWhatHoldsTheBody) {
    BodyLoad<double> load;
    load.inverse_mass = 0.5;
    load.inverse_inertia = 0.25;
    load.ease = 2.0 / 3.0;
    load.arm = {3.0, -2.0};
    load.stopped = {{1.0, 10.0}, 100.0};
    const Impulse<double> impulse{{6.0, 12.0}, 24.0};
    const auto expect = [&](Vec2<double> slides, Twist<double> twist) {
        load.slides = slides;
        const Twist<double> got = answer(load, impulse);
        EXPECT_NEAR(got.velocity.x, twist.velocity.x, 1.0e-12);
        EXPECT_NEAR(got.velocity.y, twist.velocity.y, 1.0e-12);
        EXPECT_NEAR(got.spin, twist.spin, 1.0e-12);
        const Twist<double> stopped = answer_stopped(load, impulse);
        EXPECT_NEAR(stopped.velocity.x, 1.0 + twist.velocity.x, 1.0e-12);
        EXPECT_NEAR(stopped.velocity.y, 10.0 + twist.velocity.y, 1.0e-12);
        EXPECT_NEAR(stopped.spin, 100.0 + twist.spin, 1.0e-12);
    };
    expect({1.0, 1.0}, {{2.0, 4.0}, 4.0});
    expect({1.0, 0.0}, {{2.0, 0.0}, 4.0});
    expect({0.0, 1.0}, {{0.0, 4.0}, 4.0});
    // On a hinge: torque 24 + (3 · 12 + 2 · 6), and the centre goes about it.
    expect({0.0, 0.0}, {{24.0, 36.0}, 12.0});
}

/// What a body receives without the grid's knowing the tank does not.
TEST(BodyForce, WhatTheTankGivesItHasNoLonger) {
    BodyLoad<double> loads[2];
    BodyTable<double> table;
    table.capacity = 1;
    table.load = loads;
    receive_from_tank(table, {1.0, -2.0}, loads[0]);
    EXPECT_EQ(loads[0].received.linear.x, 1.0);
    EXPECT_EQ(loads[0].received.linear.y, -2.0);
    EXPECT_EQ(loads[1].received.linear.x, -1.0);
    EXPECT_EQ(loads[1].received.linear.y, 2.0);
}

/// Of two lines the longer one counts more; a cell without any has its own middle.
TEST(BodyForce, MiddleOfTheContourIsThatOfItsLength) {
    const GridShape tank{1, 1, 3};
    const std::int32_t node = tank.index(0, 0);
    const auto middle = [&](float a, float b, float c, float d) {
        std::vector<float> distance(9);
        const auto at = [&](std::int32_t k) -> float& {
            return distance[static_cast<std::size_t>(node + k)];
        };
        at(0) = a, at(1) = b, at(tank.stride + 1) = c, at(tank.stride) = d;
        Walls<float> walls;
        walls.distance = distance.data();
        return middle_of_contour(tank, walls, node);
    };
    const Vec2<float> corner = middle(-1.0F, 3.0F, 5.0F, 1.0F);
    EXPECT_NEAR(corner.x, 0.125F, 1.0e-6F);
    EXPECT_NEAR(corner.y, 0.25F, 1.0e-6F);
    const Vec2<float> open = middle(1.0F, 1.0F, 1.0F, 1.0F);
    EXPECT_EQ(open.x, 0.5F);
    EXPECT_EQ(open.y, 0.5F);
    const Vec2<float> both = middle(-1.0F, 7.0F, -3.0F, 7.0F);  // √2/8 and 0.3 √2 long
    const float share = 0.3F / (0.3F + 0.125F);
    EXPECT_NEAR(both.x, (1.0F - share) * 0.0625F + share * 0.85F, 1.0e-5F);
    EXPECT_NEAR(both.y, both.x, 1.0e-6F);
}

/// Force on a square in a layer of a tenth of the density, over what it is in the heavy one below.
template <class Real>
double lift_in_lighter_layer() {
    const Ring square = rectangle(5, 5);
    const auto lift = [&](float height) {
        WorldDef def = tank_def(24, 24, 2400, 1, 4);
        def.capacity.two_way = true;
        def.capacity.second_liquid = true;
        def.second_density_ratio = 0.1F;
        def.cell_m = 1;
        def.gravity_mps2 = {0, -1};
        TestWorld<Real> world(def);
        const BodyId id = put_static(*world, body_of(square, {12.2F, height}));
        expect_ok(world->fill({{0, 0}, {24, 10}}));
        expect_ok(world->fill({{0, 10}, {24, 20}}, nullptr, Liquid::second));
        double sum = 0;
        for (int step = 0; step < 600; ++step) {
            world->step(0.3F);
            BodyForce force;
            expect_ok(world->force(id, &force));
            sum += step < 300 ? 0 : static_cast<double>(force.impulse_m3ps.y);
        }
        return sum;
    };
    return lift(15) / lift(5);
}

/// The pressure's way from a cell to the wall goes by the density there: it was 0.077.
TEST(BodyForce, OfALighterLayerIsAsMuchLess) {
    EXPECT_NEAR(lift_in_lighter_layer<float>(), 0.1, 0.002);
    EXPECT_NEAR(lift_in_lighter_layer<Fixed>(), 0.1, 0.002);
}

}  // namespace
}  // namespace weir
