// Nothing through a solid, nothing trapped in one, at any speed; what cannot be saved is counted.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "measure/random.hpp"
#include "solid/way_out.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;

/// 32 × 32 cells without gravity; particles keep their own velocity (FLIP 1).
WorldDef free_flight() {
    WorldDef def = tank_def(32, 32, 4096, 3, 32);
    def.capacity.contacts = 2;
    def.gravity_mps2 = {0, 0};
    def.flip_ratio = 1.0F;
    def.volume_gain = 0.0F;
    def.cfl = 2.0F;
    return def;
}

/// In cells and cells per step.
Status throw_one(World<float>& world, Vec2f at, Vec2f way) {
    return world.add_particle(kCell * at, (kCell / kFrame) * way);
}

BodyId add(World<float>& world, const BodyDef& def, bool moving) {
    BodyId id;
    EXPECT_EQ(moving ? world.add_moving_body(def, &id) : world.add_static_body(def, &id),
              Status::ok);
    return id;
}

TEST(Tightness, AWallOfTwoCellsStopsWhatCrossesItInASubstep) {
    for (const float speed : {0.9F, 1.9F, 3.8F}) {
        for (float start = 10.0F; start < 12.0F; start += 0.13F) {
            TestWorld<float> world(free_flight());
            const Ring wall = rectangle(1.6F * kCell, 20 * kCell);
            add(*world, body_of(wall, {15 * kCell, 16 * kCell}), false);
            ASSERT_EQ(throw_one(*world, {start, 16.2F}, {speed, 0.1F}), Status::ok);
            for (int step = 0; step < 12; ++step) {
                world->step(kFrame);
                ASSERT_LT(world->particle_positions()[0].x, 14.3F) << speed << " from " << start;
            }
        }
    }
}

/// A plate from wall to wall, without room for its edges: on which side of it is who.
template <class Real>
class Divided {
public:
    Divided(const WorldDef& def, float thickness, Vec2f at, float angle, float spin)
        : world_(def), half_(0.5F * thickness) {
        const Ring wall = rectangle(thickness * kCell, 120 * kCell);
        BodyDef plate = body_of(wall, kCell * at, angle);
        plate.motion.spin_radps = spin;
        expect_ok(spin != 0 ? world_->add_moving_body(plate, &id_)
                            : world_->add_static_body(plate, &id_));
    }

    /// Liquid on one side, thrown at the plate at two cells a frame.
    void pour() {
        const float angle = motion_of(*world_, id_).angle_rad;
        const Vec2f velocity = (2 * kCell / kFrame) * Vec2f{std::cos(angle), std::sin(angle)};
        for (float y = 0.25F; y < 32; y += 0.5F) {
            for (float x = 0.25F; x < 32; x += 0.5F) {
                const float place = beyond({x, y});
                if (place < -half_ - 0.02F && place > -10) {
                    expect_ok(world_->add_particle(kCell * Vec2f{x, y}, velocity));
                }
            }
        }
    }

    /// How many are on the other side after some steps, gravity going round.
    std::int32_t passed(std::int32_t steps) {
        for (std::int32_t step = 0; step < steps; ++step) {
            const auto turn = static_cast<float>(step / 6);
            expect_ok(world_->set_gravity({30 * std::cos(turn), 30 * std::sin(turn)}));
            EXPECT_EQ(world_->step(kFrame).particles_removed_stuck, 0);
        }
        std::int32_t count = 0;
        for (const auto x : world_->particle_positions()) {
            count += beyond(convert<float>(x)) > half_ + 0.02F ? 1 : 0;
        }
        return count;
    }

private:
    float beyond(Vec2f x) const {
        const Motion motion = motion_of(*world_, id_);
        return std::cos(motion.angle_rad) * (x.x - motion.position_m.x / kCell) +
               std::sin(motion.angle_rad) * (x.y - motion.position_m.y / kCell);
    }

    TestWorld<Real> world_;
    float half_;
    BodyId id_;
};

/// As nodes show it, it is half a cell thick in places.
template <class Real>
void throw_at_walls_of_a_cell() {
    WorldDef def = free_flight();
    def.flip_ratio = 0.97F;
    for (const float angle : some_of({0.785F, 1.99F, -0.915F, 0.04F})) {
        Divided<Real> tank(def, 1.05F, {16.2F, 15.7F}, angle, 0.0F);
        tank.pour();
        EXPECT_EQ(tank.passed(24), 0) << angle;
    }
}

TEST(Tightness, AWallOfACellHoldsAtAnyAngle) {
    throw_at_walls_of_a_cell<float>();
    throw_at_walls_of_a_cell<double>();
    throw_at_walls_of_a_cell<Fixed>();
    throw_at_walls_of_a_cell<SmallFixed>();
}

/// Particles that fly at a wall, each by itself, beside one that goes `companion` cells.
template <class Real>
std::vector<Vec2f> after_a_step(std::uint64_t seed, float companion) {
    TestWorld<Real> world(free_flight());
    constexpr float kAngle = 2.3F;
    const Ring wall = rectangle(0.8F * kCell, 120 * kCell);
    put_static(*world, body_of(wall, kCell * Vec2f{16.2F, 15.7F}, kAngle));
    expect_ok(world->add_particle(kCell * Vec2f{4, 4}, (kCell / kFrame) * Vec2f{companion, 0}));
    measure::Random dice(seed);
    for (float along = -10; along <= 10; along += 4) {
        const Vec2f at{16.2F - along * std::tan(kAngle) + dice.uniform(-1.5F, 1.5F), 15.7F + along};
        const Vec2f way{dice.uniform(-0.95F, 0.95F), dice.uniform(-0.95F, 0.95F)};
        static_cast<void>(world->add_particle(kCell * at, (kCell / kFrame) * way));
    }
    EXPECT_EQ(world->step(kFrame).substeps, 1);
    std::vector<Vec2f> places;
    for (const auto x : world->particle_positions()) {
        places.push_back(convert<float>(x));
    }
    places.erase(places.begin());
    return places;
}

/// Blocks of particles are whatever slices and memory leave of them.
WEIR_SUITE(TightnessOf, EveryScalar);

TYPED_TEST(TightnessOf, AParticleMeetsAWallWhoeverFliesBeside) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const std::vector<Vec2f> slow = after_a_step<TypeParam>(seed, 0.3F);
        const std::vector<Vec2f> fast = after_a_step<TypeParam>(seed, 1.9F);
        ASSERT_EQ(slow.size(), fast.size());
        for (std::size_t k = 0; k < slow.size(); ++k) {
            EXPECT_EQ(slow[k].x, fast[k].x) << seed;
            EXPECT_EQ(slow[k].y, fast[k].y) << seed;
        }
    }
}

/// And elsewhere each time it is drawn. (Where it presses liquid against the tank some may pass.)
TEST(Tightness, AThinPlateThatTurnsHasASideForEachParticle) {
    WorldDef def = free_flight();
    def.flip_ratio = 0.97F;
    for (const float spin : some_of({1.0F, 3.0F})) {
        Divided<float> tank(def, 1.2F, {16.2F, 15.7F}, 0.4F, spin);
        tank.pour();
        EXPECT_EQ(tank.passed(60), 0) << spin;
    }
}

TEST(Tightness, AFastWallTakesAlongWhatItMeets) {
    for (const float speed : {0.9F, 1.9F, 3.0F}) {
        TestWorld<float> world(free_flight());
        const Ring wall = rectangle(2.2F * kCell, 20 * kCell);
        BodyDef def = body_of(wall, {4 * kCell, 16 * kCell});
        def.motion.velocity_mps = {speed * kCell / kFrame, 0};
        const BodyId id = add(*world, def, true);
        for (float x = 8.0F; x < 9.0F; x += 0.1F) {
            ASSERT_EQ(throw_one(*world, {x, 14.0F + x - 8.0F}, {0, 0}), Status::ok);
        }
        for (int step = 0; step < 6; ++step) {
            world->step(kFrame);
        }
        Motion motion;
        ASSERT_EQ(world->motion(id, &motion), Status::ok);
        for (const Vec2f x : world->particle_positions()) {
            EXPECT_GT(x.x, motion.position_m.x / kCell + 1.0F) << speed;
        }
        EXPECT_EQ(world->particle_positions().size, 10);
    }
}

TEST(Tightness, ABodyPutOverLiquidIsLeftGentlyAndInTime) {
    for (const float size : {4.0F, 12.0F, 20.0F}) {
        WorldDef def = free_flight();
        def.cfl = 1.0F;
        TestWorld<float> world(def);
        std::int32_t added = 0;
        ASSERT_EQ(world->fill({{0.2F, 0.2F}, {0.44F, 0.44F}}, &added), Status::ok);
        const Ring ring = rectangle(size * kCell, size * kCell);
        add(*world, body_of(ring, {0.32F, 0.32F}), false);
        std::int32_t substeps = 0;
        std::int32_t stuck = 1;
        while (stuck > 0 && substeps <= kLongestWayOut) {
            const StepReport report = world->step(kFrame);
            substeps += report.substeps;
            stuck = report.particles_stuck;
            EXPECT_EQ(report.particles_removed_stuck, 0);
        }
        EXPECT_LE(substeps, static_cast<std::int32_t>(0.5F * size) + 2) << size;
        EXPECT_EQ(world->particle_positions().size, added);
        for (const Vec2f x : world->particle_positions()) {
            EXPECT_GT(distance_at(*world, x), -0.02) << x.x << ' ' << x.y;
        }
    }
}

/// Two overlapping bodies: between them the distance has a ridge that no gradient leaves.
TEST(Tightness, ARidgeBetweenTwoBodiesHoldsNothing) {
    TestWorld<float> world(free_flight());
    std::int32_t added = 0;
    ASSERT_EQ(world->fill({{0.2F, 0.28F}, {0.44F, 0.36F}}, &added), Status::ok);
    const Ring left = rectangle(10 * kCell, 10 * kCell);
    add(*world, body_of(left, {13 * kCell, 16 * kCell}), false);
    add(*world, body_of(left, {19 * kCell, 16 * kCell}), false);
    for (int step = 0; step < 8; ++step) {
        world->step(kFrame);
    }
    for (const Vec2f x : world->particle_positions()) {
        EXPECT_GT(distance_at(*world, x), -0.02);
    }
    EXPECT_EQ(world->particle_positions().size, added);
}

TEST(Tightness, WithoutAWayOutItIsRemovedAndCounted) {
    WorldDef def = free_flight();
    def.capacity.cells_x = 100;
    def.capacity.cells_y = 100;
    TestWorld<float> world(def);
    ASSERT_EQ(throw_one(*world, {50, 50}, {0, 0}), Status::ok);
    ASSERT_EQ(throw_one(*world, {50, 97}, {0, 0}), Status::ok);
    const Ring ring = rectangle(90 * kCell, 90 * kCell);
    add(*world, body_of(ring, {50 * kCell, 50 * kCell}), false);
    const StepReport report = world->step(kFrame);
    EXPECT_EQ(report.particles_removed_stuck, 1);
    EXPECT_EQ(report.particles, 1);
    EXPECT_NEAR(world->particle_positions()[0].y, 97.0F, 0.01F) << "the other one stays";
}

/// A press closes on liquid between it and the tank: what does not escape is counted, the rest
/// stays outside.
TEST(Tightness, APressLosesNothingUncounted) {
    WorldDef def = free_flight();
    def.gravity_mps2 = {0, -9.81F};
    def.flip_ratio = 0.97F;
    TestWorld<float> world(def);
    std::int32_t added = 0;
    ASSERT_EQ(world->fill({{0, 0}, {0.1F, 0.64F}}, &added), Status::ok);
    const Ring ring = rectangle(4 * kCell, 34 * kCell);
    BodyDef press = body_of(ring, {7.2F * kCell, 16 * kCell});
    press.motion.velocity_mps = {-0.3F, 0};
    add(*world, press, true);
    std::int32_t removed = 0;
    for (int step = 0; step < 40; ++step) {
        const StepReport report = world->step(kFrame);
        removed += report.particles_removed_stuck;
        ASSERT_EQ(report.particles + removed, added);
        EXPECT_LT(report.max_speed_mps, 10.0F) << "no explosion";
    }
    EXPECT_GT(removed, 0);
}

TEST(Tightness, ContactsNameTheBodyItsImpulseAndThePlace) {
    TestWorld<float> world(free_flight());
    const Ring wall = rectangle(4 * kCell, 8 * kCell);
    const BodyId id = add(*world, body_of(wall, {16 * kCell, 16 * kCell}), false);
    ASSERT_EQ(throw_one(*world, {13.4F, 16.0F}, {0.9F, 0.0F}), Status::ok);
    const float before = world->particle_velocities()[0].x;
    StepReport report = world->step(kFrame);
    ASSERT_EQ(world->contacts().size, 1);
    const Contact contact = world->contacts()[0];
    EXPECT_EQ(contact.body.slot, id.slot);
    EXPECT_EQ(contact.body.generation, id.generation);
    EXPECT_EQ(contact.body.world, id.world);
    EXPECT_EQ(contact.with, ContactWith::liquid);
    EXPECT_EQ(contact.other, BodyId{});
    EXPECT_EQ(contact.blows, 1);
    // A quarter of a cell of liquid, stopped.
    EXPECT_NEAR(contact.impulse_m3ps.x / (0.25F * kCell * kCell * kCell * before), 1.0F, 1.0e-3F);
    EXPECT_NEAR(contact.place_m.x, 14 * kCell, 0.3F * kCell);
    EXPECT_NEAR(contact.place_m.y, 16 * kCell, 0.1F * kCell);
    EXPECT_EQ(report.contacts_missed, 0);
    report = world->step(kFrame);
    EXPECT_EQ(world->contacts().size, 0) << "events are of one step";
}

TEST(Tightness, ContactsWithoutRoomAreCounted) {
    TestWorld<float> world(free_flight());
    const Ring square = rectangle(4 * kCell, 4 * kCell);
    for (const float y : {6.0F, 16.0F, 26.0F}) {
        add(*world, body_of(square, {16 * kCell, y * kCell}), false);
        ASSERT_EQ(throw_one(*world, {13.4F, y}, {0.9F, 0.0F}), Status::ok);
    }
    const StepReport report = world->step(kFrame);
    EXPECT_EQ(world->contacts().size, 2);
    EXPECT_EQ(report.contacts_missed, 1);
    WorldDef none = free_flight();
    none.capacity.contacts = 0;
    EXPECT_LT(world_bytes<float>(none.capacity), world_bytes<float>(free_flight().capacity));
    World<float> nothing;
    EXPECT_EQ(nothing.contacts().size, 0);
}

/// A piston in a full tank, with which nothing can yield: told, and no explosion. Fixed point once
/// ran out of numbers for the pressure, which has no surface to start from.
template <class Real>
void press_a_full_tank() {
    WorldDef def;
    def.capacity.particles = 4 * 32 * 32;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    TestWorld<Real> world(def);
    const Ring piston = rectangle(32 * kCell, 64 * kCell);
    BodyDef body = body_of(piston, {-16 * kCell, 16 * kCell});
    body.motion.velocity_mps = {0.2F, 0};
    put_moving(*world, body);
    ASSERT_EQ(world->fill({{0, 0}, {32 * kCell, 32 * kCell}}), Status::ok);
    StepReport report = world->step(kFrame);
    EXPECT_EQ(report.cells_overfull, 0);
    for (int step = 0; step < 60; ++step) {
        report = world->step(kFrame);
        EXPECT_LT(report.max_speed_mps, 0.4F) << step;
    }
    EXPECT_GT(report.cells_overfull, 500) << "a third of the tank is gone";
    EXPECT_TRUE(all_inside(*world));
}

TEST(Tightness, WhatHasNoRoomIsReported) {
    press_a_full_tank<float>();
    press_a_full_tank<Fixed>();
}

}  // namespace
}  // namespace weir
