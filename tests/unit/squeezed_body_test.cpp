// Light bodies on hinges and rails, squeezed by bodies that drive over them, while the liquid that
// they are in comes and goes. Nothing of it may send them off for good.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "measure/random.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

using Dice = measure::Random;

constexpr float kDt = 1.0F / 60.0F;
constexpr int kLight = 3;
constexpr int kDriven = 3;
constexpr std::uint64_t kLives = 16;

WorldDef squeezed_def() {
    WorldDef def = tank_def(18, 16, 4 * 18 * 16);
    def.capacity.bodies = kLight + kDriven + 1;
    def.capacity.vertices = 4 * def.capacity.bodies;
    def.capacity.two_way = true;
    def.cell_m = 0.25F;
    return def;
}

/// A plank anywhere in the tank, in a slant.
BodyDef any_plank(Dice& dice, Ring& ring, float thin, float thick) {
    ring = rectangle(dice.uniform(0.4F, 1.2F), dice.uniform(thin, thick));
    BodyDef body = body_of(ring, {dice.uniform(1.0F, 3.5F), dice.uniform(0.5F, 2.5F)},
                           dice.uniform(-3.0F, 3.0F));
    body.surface.friction = dice.uniform(0.0F, 1.5F);
    body.surface.restitution = dice.uniform(0.0F, 1.0F);
    return body;
}

/// Light bodies, a block that stands, and bodies that are driven about.
template <class Real>
void put_bodies(Dice& dice, World<Real>& world, std::vector<BodyId>& light,
                std::vector<BodyId>& driven) {
    Ring ring;
    BodyId id;
    for (int k = 0; k < kLight; ++k) {
        BodyDef body = any_plank(dice, ring, 0.1F, 0.3F);
        body.density_ratio = dice.uniform(0.002F, 0.1F);
        body.hold = k == 0 ? Hold::hinge : static_cast<Hold>(dice.below(5));
        id = put_free(world, body);
        light.push_back(id);
    }
    id = put_static(world, any_plank(dice, ring, 0.4F, 0.8F));
    for (int k = 0; k < kDriven; ++k) {
        id = put_moving(world, any_plank(dice, ring, 0.4F, 0.8F));
        driven.push_back(id);
    }
}

/// Drives a body to a light one, or on as it likes.
template <class Real>
void drive(Dice& dice, World<Real>& world, BodyId id, BodyId to) {
    Motion now = motion_of(world, id);
    const Motion goal = motion_of(world, to);
    if (dice.below(2) == 0) {
        now.velocity_mps = {4 * (goal.position_m.x - now.position_m.x),
                            4 * (goal.position_m.y - now.position_m.y)};
        now.spin_radps = dice.uniform(-5.0F, 5.0F);
        expect_ok(world.set_motion(id, now));
    } else {
        const Vec2f at{now.position_m.x + 0.1F * (goal.position_m.x - now.position_m.x),
                       now.position_m.y + 0.1F * (goal.position_m.y - now.position_m.y)};
        expect_ok(world.move_body(id, at, now.angle_rad + dice.uniform(-0.1F, 0.1F), kDt));
    }
}

template <class Real>
void expect_sound(World<Real>& world, BodyId id) {
    const Motion now = motion_of(world, id);
    EXPECT_LE(std::fabs(now.angle_rad), 6.2832F);
    EXPECT_LE(std::fabs(now.spin_radps), kMaxAngle);
    EXPECT_TRUE(now.position_m.x > -1.0F && now.position_m.x < 6.0F) << now.position_m.x;
    EXPECT_TRUE(now.position_m.y > -1.0F && now.position_m.y < 6.0F) << now.position_m.y;
    EXPECT_LE(std::hypot(now.velocity_mps.x, now.velocity_mps.y), 1000.0F);
}

WEIR_SUITE(SqueezedBody, RoomyScalars);

/// Pushes that bodies are parted with were found for what they took along in the water: where that
/// was gone at the step's end they doubled from round to round, to an angle of 1e13.
TYPED_TEST(SqueezedBody, StaysInItsRange) {
    TestWorld<TypeParam> other{squeezed_def()};
    for (std::uint64_t seed = 0; seed < kLives; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        TestWorld<TypeParam> world{squeezed_def()};
        std::vector<BodyId> light;
        std::vector<BodyId> driven;
        put_bodies(dice, *world, light, driven);
        for (int step = 0; step < 40; ++step) {
            if (step % 8 == 0) {
                expect_ok(world->fill({{0, 0}, {4.5F, 2.5F}}));
            } else if (step % 8 == 6) {
                expect_ok(world->drain({{0, 0}, {4.5F, 4.0F}}));
            }
            const auto from = static_cast<std::size_t>(dice.below(kDriven));
            drive(dice, *world, driven[from], light[static_cast<std::size_t>(dice.below(kLight))]);
            const StepReport report = world->step(kDt);
            EXPECT_FALSE(report.has(Clamped::not_finite));
            EXPECT_TRUE(all_inside(*world));
            for (const BodyId id : light) {
                expect_sound(*world, id);
            }
            change_worlds(world, other, squeezed_def());
            ASSERT_EQ(other->state_hash(), world->state_hash());
            if (this->HasFailure()) {
                return;
            }
        }
    }
}

/// Of what hits a body that is lighter it takes as much as brings it to that speed.
TEST(LightBody, TakesNoMoreThanTheSpeedOfWhatHitsIt) {
    WorldDef def = tank_def(32, 16, 4, 1, 4);
    def.capacity.two_way = true;
    def.gravity_mps2 = {};
    TestWorld<float> world(def);
    BodyDef body = body_of(kSquare4cm, {0.30F, 0.16F});
    body.density_ratio = 0.01F;
    const BodyId id = put_free(*world, body);
    expect_ok(world->add_particle({0.25F, 0.16F}, {1.0F, 0.0F}));
    Motion motion;
    for (int k = 0; k < 12; ++k) {
        world->step(1.0F / 240.0F);
    }
    expect_ok(world->motion(id, &motion));
    EXPECT_GT(motion.velocity_mps.x, 0.5F);
    EXPECT_LT(motion.velocity_mps.x, 1.5F);
}

/// A free body meets drops where it has come to in a substep, not where it was.
TEST(FastFreeBody, HasNoDropInsideAfterAStep) {
    WorldDef def = tank_def(48, 16, 100, 1, 4);
    def.capacity.two_way = true;
    def.gravity_mps2 = {};
    def.max_substeps = 1;
    TestWorld<float> world(def);
    const Ring box = rectangle(0.12F, 0.12F);
    BodyDef body = body_of(box, {0.10F, 0.16F});
    body.density_ratio = 1000.0F;
    body.motion.velocity_mps.x = 0.9F * 0.02F * 60.0F;
    const BodyId id = put_free(*world, body);
    for (int k = 0; k < 30; ++k) {
        const float row = static_cast<float>(k % 3 - 1);
        expect_ok(world->add_particle({0.24F + 0.02F * static_cast<float>(k), 0.16F + 0.04F * row},
                                      {}));
    }
    for (int k = 0; k < 10; ++k) {
        world->step(kDt);
        Motion motion;
        expect_ok(world->motion(id, &motion));
        for (const auto& x : world->particle_positions()) {
            const float dx = std::fabs(x.x * def.cell_m - motion.position_m.x);
            const float dy = std::fabs(x.y * def.cell_m - motion.position_m.y);
            EXPECT_FALSE(dx < 0.055F && dy < 0.055F) << k;
        }
    }
}

}  // namespace
}  // namespace weir
