// Free bodies in viscous liquid that sticks to them.
#include <gtest/gtest.h>

#include <cmath>

#include "weir/weir.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr float kCell = 0.02F;

/// Mean velocity upwards, m/s, and what the liquid does to the body over what the body weighs.
struct Way {
    float velocity_mps = 0.0F;
    float carried = 0.0F;
};

/// When that is measured, in steps, of a ball that begins in that row.
struct Stretch {
    float row;
    int first;
    int end;
};
constexpr Stretch kSlow{20.0F, 60, 120};

/// A ball of 3 cells' radius on a rail in honey of 40 rows.
template <class Real>
Way way_of_ball(float density_ratio, const Stretch& stretch = kSlow) {
    WorldDef def = tank_def(32, 48, 8192, 1, 24);
    def.capacity.two_way = true;
    def.viscosity_m2ps = 0.02F;
    def.max_substeps = 64;
    TestWorld<Real> world{def};
    const Ring ring = regular_polygon(24, 3.0F * kCell);
    BodyDef ball = body_of(ring, {16.0F * kCell, stretch.row * kCell});
    ball.density_ratio = density_ratio;
    ball.surface.no_slip = true;
    ball.hold = Hold::rail_y;
    const BodyId id = put_free(*world, ball);
    expect_ok(world->fill({{0, 0}, {32.0F * kCell, 40.0F * kCell}}));
    BodyMass mass;
    expect_ok(world->mass(id, &mass));
    float from = 0.0F, impulse = 0.0F, time = 0.0F;
    for (int step = 0; step < stretch.end; ++step) {
        const float dt = world->step(kDt).dt_s;
        if (step == stretch.first - 1) {
            from = motion_of(*world, id).position_m.y;
        }
        if (step >= stretch.first) {
            BodyForce force;
            expect_ok(world->force(id, &force));
            impulse += force.impulse_m3ps.y;
            time += dt;
        }
    }
    return {(motion_of(*world, id).position_m.y - from) / time,
            impulse / (time * 9.81F * mass.mass_m2)};
}

/// The liquid resists a slow body by its speed alone, so what is a tenth lighter than the liquid
/// rises as fast as what is a tenth heavier sinks.
template <class Real>
void expect_to_rise_as_others_sink() {
    const Way light = way_of_ball<Real>(0.9F), heavy = way_of_ball<Real>(1.1F);
    EXPECT_GT(light.velocity_mps, 0.03F);
    EXPECT_NEAR(light.velocity_mps / -heavy.velocity_mps, 1.0F, 0.15F);
}

TEST(StickingBody, RisesAsFastAsAnotherSinks) {
    expect_to_rise_as_others_sink<float>();
    expect_to_rise_as_others_sink<Fixed>();
}

/// Nor does it matter how much lighter it is, though what pulls at it in a substep may then be many
/// times as heavy as it is.
template <class Real>
void expect_light_ones_to_be_held_back() {
    for (const float lighter : {0.5F, 0.9F, 0.98F}) {
        const Way light = way_of_ball<Real>(1.0F - lighter, {8.0F, 30, 60});
        const Way heavy = way_of_ball<Real>(1.0F + lighter, {32.0F, 30, 60});
        EXPECT_NEAR(light.velocity_mps / -heavy.velocity_mps, 1.0F, 0.05F) << lighter;
        EXPECT_NEAR(light.carried, 1.0F, 0.02F) << lighter;
    }
}

TEST(StickingBody, IsHeldBackHoweverLightItIs) {
    expect_light_ones_to_be_held_back<float>();
    expect_light_ones_to_be_held_back<Fixed>();
}

/// What goes on at one speed is carried by what it is told, however light it is.
TEST(StickingBody, TakesAllThatItIsTold) {
    for (const float density : {0.7F, 0.9F, 1.1F}) {
        EXPECT_NEAR(way_of_ball<float>(density).carried, 1.0F, 0.005F) << density;
    }
}

}  // namespace
}  // namespace weir
