// What bodies and tank are told to have received adds up, also where solids stand before the tank's
// walls, and with bodies that the grid does not show.
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 64.0F;
constexpr double kG = 9.81;

template <class Real>
Vec2f tank_force_of(const World<Real>& world) {
    BodyForce force;
    expect_ok(world.tank_force(&force));
    return force.impulse_m3ps;
}

template <class Real>
Vec2f force_of(const World<Real>& world, BodyId id) {
    BodyForce force;
    expect_ok(world.force(id, &force));
    return force.impulse_m3ps;
}

/// Gravity's impulse less the liquid's change of momentum less what was told, over its weight.
template <class Real>
double missing(World<Real>& world, BodyId id) {
    Diagnostics before;
    Diagnostics after;
    expect_ok(world.diagnose(&before));
    const auto dt = static_cast<double>(world.step(kDt).dt_s);
    expect_ok(world.diagnose(&after));
    const Vec2f tank = tank_force_of(world);
    const Vec2f body = force_of(world, id);
    const double weight = before.mass_m2 * kG * dt;
    const double x = -(after.momentum_m3ps.x - before.momentum_m3ps.x) -
                     static_cast<double>(tank.x + body.x);
    const double y = -weight - (after.momentum_m3ps.y - before.momentum_m3ps.y) -
                     static_cast<double>(tank.y + body.y);
    return std::hypot(x, y) / weight;
}

/// A crumb of a third of a cell is lifted and takes liquid along, though no cell knows of it.
TEST(ForceBalance, HoldsWithBodiesThatTheGridDoesNotShow) {
    WorldDef def = tank_def(24, 24, 2304, 1, 4);
    def.capacity.two_way = true;
    TestWorld<double> world(def);
    const Ring crumb = rectangle(0.007F, 0.007F);
    BodyDef body = body_of(crumb, {0.243F, 0.1F});
    body.density_ratio = 0.5F;
    const BodyId id = put_free(*world, body);
    expect_ok(world->fill({{0, 0}, {0.48F, 0.24F}}));
    for (int step = 0; step < 20; ++step) {
        EXPECT_LT(missing(*world, id), 1e-5) << step;
    }
}

/// A slab of half a cell stands before the left wall: it receives what the wall would have.
TEST(ForceBalance, CoveredWallsReceiveNothing) {
    WorldDef def = tank_def(24, 24, 2304, 1, 4);
    def.capacity.two_way = true;
    TestWorld<float> world(def);
    const Ring slab = rectangle(0.02F, 1.0F);
    const BodyId id = put_static(*world, body_of(slab, {0.0F, 0.24F}));
    expect_ok(world->fill({{0, 0}, {0.48F, 0.24F}}));
    for (int step = 0; step < 200; ++step) {
        world->step(kDt);
    }
    const double push = 0.5 * kG * 0.24 * 0.24 * static_cast<double>(kDt);
    EXPECT_NEAR(static_cast<double>(force_of(*world, id).x), -push, 0.1 * push);
    EXPECT_NEAR(static_cast<double>(tank_force_of(*world).x), push, 0.1 * push);
}

/// Still water lifts a body in the middle of what it displaces, wherever the body's own origin is,
/// and whatever another one takes that shares its cells.
WEIR_SUITE(Buoyancy, EveryScalar);

TYPED_TEST(Buoyancy, LiftsInTheMiddle) {
    WorldDef def = tank_def(32, 24, 3072, 2, 8);
    def.capacity.two_way = true;
    def.pressure_sweeps = 32;
    TestWorld<TypeParam> world{def};
    Ring box = rectangle(0.16F, 0.12F);
    for (Vec2f& corner : box) {
        corner = {corner.x - 0.1F, corner.y + 0.06F};
    }
    const BodyId ids[] = {put_static(*world, body_of(box, {0.32F, 0.11F})),
                          put_static(*world, body_of(box, {0.504F, 0.117F}))};
    expect_ok(world->fill({{0, 0}, {0.64F, 0.34F}}));
    constexpr int kSteps = 180;
    constexpr int kFirst = 60;
    double lift[2] = {};
    double turn[2] = {};
    for (int step = 0; step < kSteps; ++step) {
        const auto dt = static_cast<double>(world->step(kDt).dt_s);
        for (int k = 0; k < 2 && step >= kFirst; ++k) {
            BodyForce force;
            expect_ok(world->force(ids[k], &force));
            lift[k] += static_cast<double>(force.impulse_m3ps.y) / dt / (kSteps - kFirst);
            turn[k] += static_cast<double>(force.angular_impulse_m4ps) / dt / (kSteps - kFirst);
        }
    }
    constexpr double kWeight = kG * 0.16 * 0.12;
    for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(lift[k] / kWeight, 1.0, 0.05) << k;
        EXPECT_NEAR(turn[k] / (kWeight * 0.16), 0.0, 0.03) << k;
    }
}

/// Level liquid drives nothing aside: a body that leans meets the grid's nodes on both sides in
/// other ways, some with slivers, and sailed away by itself.
TYPED_TEST(Buoyancy, DrivesNothingAside) {
    constexpr double kBound = Stored<TypeParam>::coarse ? 5.0e-4 : 2.0e-4;
    const Ring square = rectangle(0.24F, 0.24F);
    constexpr int kSteps = 360;
    for (const Vec2f at : {Vec2f{0.485F, 0.3F}, Vec2f{0.485F, 0.2F}, Vec2f{0.48F, 0.31F}}) {
        WorldDef def = tank_def(48, 28, 4096, 1, 4);
        def.capacity.two_way = true;
        def.pressure_sweeps = 32;
        TestWorld<TypeParam> world{def};
        const BodyId id = put_static(*world, body_of(square, at, 0.4637F));
        expect_ok(world->fill({{0, 0}, {0.96F, 0.32F}}));
        double aside = 0.0;
        double lift = 0.0;
        for (int step = 0; step < kSteps; ++step) {
            world->step(kDt);
            const Vec2f force = force_of(*world, id);
            aside += step < kSteps / 2 ? 0.0 : static_cast<double>(force.x);
            lift += step < kSteps / 2 ? 0.0 : static_cast<double>(force.y);
        }
        EXPECT_NEAR(aside / lift, 0.0, kBound) << at.x << ", " << at.y;
    }
}

WEIR_SUITE(FreeFloat, RoomyScalars);

/// Nor a body that floats askew, as a square of three quarters of the density does.
TYPED_TEST(FreeFloat, SailsNowhere) {
    for (const float angle : {0.4637F, -0.4637F}) {
        WorldDef def = tank_def(48, 24, 4608, 1, 4);
        def.capacity.two_way = true;
        TestWorld<TypeParam> world{def};
        const Ring square = rectangle(0.16F, 0.16F);
        BodyDef body = body_of(square, {0.486F, 0.2F}, angle);
        body.density_ratio = 0.75F;
        const BodyId id = put_free(*world, body);
        expect_ok(world->fill({{0, 0}, {0.96F, 0.24F}}));
        for (int step = 0; step < 640; ++step) {
            world->step(kDt);
        }
        Motion motion;
        expect_ok(world->motion(id, &motion));
        EXPECT_NEAR(motion.position_m.x / def.cell_m, 24.3F, 0.5F) << angle;
        EXPECT_NEAR(std::fabs(motion.angle_rad), 0.4637F, 0.1F) << angle;
    }
}

}  // namespace
}  // namespace weir
