// What free bodies meet is told as contacts: with whom, where, and the impulse to rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr float kG = 9.81F;
const Ring kSlab = rectangle(0.7F, 0.06F);
const Ring kCrate = rectangle(0.1F, 0.1F);

WorldDef dry_def(std::int32_t contacts) {
    WorldDef def = tank_def(40, 40, 1600, 4, 32);
    def.capacity.two_way = true;
    def.capacity.contacts = contacts;
    return def;
}

template <class Real>
float mass_of(const World<Real>& world, BodyId id) {
    BodyMass mass;
    expect_ok(world.mass(id, &mass));
    return mass.mass_m2;
}

WEIR_SUITE(BodyContacts, RoomyScalars);

/// A crate is thrown onto a rough slab, bounces and slides: in every step what it met is what
/// changed its momentum besides gravity, and nothing is told while it flies.
TYPED_TEST(BodyContacts, OnASlabAreWhatChangesTheMomentum) {
    TestWorld<TypeParam> world{dry_def(4)};
    BodyDef slab = body_of(kSlab, {0.4F, 0.1F});
    slab.surface.restitution = 0.4F;
    slab.surface.friction = 0.2F;
    BodyDef crate = body_of(kSquare4cm, {0.15F, 0.3F});
    crate.motion.velocity_mps = {0.5F, 0.0F};
    const BodyId floor = put_static(*world, slab);
    const BodyId id = put_free(*world, crate);
    const float mass = mass_of(*world, id);
    int met = 0;
    float largest = 0;
    Vec2f before = crate.motion.velocity_mps;
    for (int step = 0; step < 50; ++step) {
        const float dt = world->step(kDt).dt_s;
        const Motion now = motion_of(*world, id);
        Vec2f impulse{};
        ASSERT_LE(world->contacts().size, 1);
        for (const Contact& contact : world->contacts()) {
            EXPECT_EQ(contact.body, id);
            EXPECT_EQ(contact.other, floor);
            EXPECT_EQ(contact.with, ContactWith::body);
            EXPECT_GE(contact.blows, 1);
            EXPECT_NEAR(contact.place_m.y, 0.13F, 0.02F);
            EXPECT_NEAR(contact.place_m.x, now.position_m.x, 0.05F);
            impulse = contact.impulse_m3ps;
            largest = std::fmax(largest, impulse.y);
            ++met;
        }
        const float rounding = (std::is_same_v<TypeParam, Fixed> ? 2e-3F : 1e-5F) * mass;
        EXPECT_NEAR(impulse.x, mass * (now.velocity_mps.x - before.x), rounding) << step;
        EXPECT_NEAR(impulse.y, mass * (now.velocity_mps.y - before.y + kG * dt), rounding) << step;
        before = now.velocity_mps;
    }
    EXPECT_GT(met, 5);
    EXPECT_LT(met, 50);
    EXPECT_NEAR(largest, 1.4F * std::sqrt(2 * kG * 0.15F) * mass, 0.2F * largest) << "the thud";
}

/// Of two free bodies one is named, with what it got; the other one got the opposite.
TYPED_TEST(BodyContacts, OfTwoFreeBodiesAreOppositeForTheOther) {
    WorldDef def = dry_def(4);
    def.gravity_mps2 = {0, 0};
    TestWorld<TypeParam> world{def};
    BodyDef one = body_of(kSquare4cm, {0.3F, 0.4F}, 0.3F);
    one.motion.velocity_mps = {0.6F, 0.0F};
    one.surface.restitution = 0.5F;
    one.surface.friction = 0.3F;
    BodyDef two = body_of(kSquare4cm, {0.5F, 0.41F}, 1.0F);
    two.density_ratio = 2.0F;
    const BodyId id[] = {put_free(*world, one), put_free(*world, two)};
    Vec2f sum{};
    for (int step = 0; step < 30; ++step) {
        world->step(kDt);
        for (const Contact& contact : world->contacts()) {
            EXPECT_EQ(contact.body, id[0]);
            EXPECT_EQ(contact.other, id[1]);
            sum.x += contact.impulse_m3ps.x;
            sum.y += contact.impulse_m3ps.y;
        }
    }
    const float mass[2] = {mass_of(*world, id[0]), mass_of(*world, id[1])};
    const Vec2f after[2] = {motion_of(*world, id[0]).velocity_mps,
                            motion_of(*world, id[1]).velocity_mps};
    const float rounding = 2e-3F * mass[0];
    EXPECT_LT(sum.x, -0.5F * mass[0] * 0.6F) << "they did not meet";
    EXPECT_NEAR(sum.x, mass[0] * (after[0].x - 0.6F), rounding);
    EXPECT_NEAR(sum.y, mass[0] * after[0].y, rounding);
    EXPECT_NEAR(-sum.x, mass[1] * after[1].x, rounding);
    EXPECT_NEAR(-sum.y, mass[1] * after[1].y, rounding);
}

/// What lies on the tank's floor is carried by it in each step, and is told apart from liquid that
/// hits it.
TYPED_TEST(BodyContacts, OfTheTankCarryAndAreToldFromSplashes) {
    TestWorld<TypeParam> world{dry_def(4)};
    BodyDef crate = body_of(kCrate, {0.4F, 0.05F});
    crate.density_ratio = 3.0F;
    const BodyId id = put_free(*world, crate);
    const float mass = mass_of(*world, id);
    for (int step = 0; step < 30; ++step) {
        const float dt = world->step(kDt).dt_s;
        ASSERT_EQ(world->contacts().size, 1);
        const Contact& contact = world->contacts()[0];
        EXPECT_EQ(contact.body, id);
        EXPECT_EQ(contact.other, BodyId{});
        EXPECT_EQ(contact.with, ContactWith::tank);
        if (step > 10) {
            EXPECT_NEAR(contact.impulse_m3ps.y / (mass * kG * dt), 1.0F, 0.02F);
        }
    }
    expect_ok(world->add_particle({0.4F, 0.13F}, {0.0F, -1.0F}));
    bool splashed = false;
    for (int step = 0; step < 5; ++step) {
        EXPECT_EQ(world->step(kDt).contacts_missed, 0);
        for (const Contact& contact : world->contacts()) {
            splashed = splashed || contact.with == ContactWith::liquid;
        }
    }
    EXPECT_TRUE(splashed);
}

/// While a step goes on they are sums that mean nothing yet: none is shown.
TYPED_TEST(BodyContacts, AreShownOnceTheStepIsDone) {
    TestWorld<TypeParam> world{dry_def(4)};
    put_free(*world, body_of(kCrate, {0.4F, 0.05F}));
    for (int step = 0; step < 5; ++step) {
        StepReport report;
        expect_ok(world->begin_step(kDt, &report));
        std::int32_t slices = 1;
        for (; !world->advance(20); ++slices) {
            ASSERT_EQ(world->contacts().size, 0);
        }
        EXPECT_GT(slices, 10);
        EXPECT_EQ(world->contacts().size, 1);
    }
}

/// They name a body that was removed since, and are none of a state that is gone back to.
TYPED_TEST(BodyContacts, OutliveTheirBodyAndNoRestore) {
    const WorldDef def = dry_def(4);
    TestWorld<TypeParam> world{def};
    const BodyId id = put_free(*world, body_of(kCrate, {0.4F, 0.05F}));
    world->step(kDt);
    ASSERT_EQ(world->contacts().size, 1);
    const std::vector<std::byte> bytes = saved(*world, def.capacity);
    expect_ok(world->remove_body(id));
    ASSERT_EQ(world->contacts().size, 1);
    EXPECT_EQ(world->contacts()[0].body, id);
    expect_ok(world->restore(bytes.data(), bytes.size()));
    EXPECT_EQ(world->contacts().size, 0);
    world->step(kDt);
    EXPECT_EQ(world->contacts().size, 1);
}

/// Without room they are counted, and nothing is different for it.
TYPED_TEST(BodyContacts, WithoutRoomChangeNothing) {
    std::uint64_t hash[2];
    for (const std::int32_t room : {0, 1}) {
        TestWorld<TypeParam> world{dry_def(room)};
        for (int k = 0; k < 3; ++k) {
            put_free(*world, body_of(kCrate, {0.4F, 0.05F + 0.1F * static_cast<float>(k)}));
        }
        std::int32_t missed = 0;
        for (int step = 0; step < 20; ++step) {
            missed += world->step(kDt).contacts_missed;
            EXPECT_LE(world->contacts().size, room);
        }
        EXPECT_EQ(missed > 0, room > 0);
        hash[room] = world->state_hash();
    }
    EXPECT_EQ(hash[0], hash[1]);
}

/// A particle of the second liquid strikes as hard as it is heavy: so the contact says, and the
/// body.
TYPED_TEST(BodyContacts, OfTheSecondLiquidHaveItsWeight) {
    WorldDef def = dry_def(4);
    def.gravity_mps2 = {};
    def.capacity.second_liquid = true;
    def.second_density_ratio = 5.0F;
    float impulse[2] = {};
    for (const Liquid kind : {Liquid::first, Liquid::second}) {
        TestWorld<TypeParam> world(def);
        BodyDef crate = body_of(kCrate, {0.4F, 0.4F});
        crate.density_ratio = 20.0F;
        const BodyId id = put_free(*world, crate);
        expect_ok(world->add_particle({0.32F, 0.4F}, {2.0F, 0.0F}, kind));
        float told = 0.0F;
        for (int k = 0; k < 10; ++k) {
            world->step(kDt);
            for (const Contact& contact : world->contacts()) {
                told += contact.impulse_m3ps.x;
            }
        }
        const float gained = mass_of(*world, id) * motion_of(*world, id).velocity_mps.x;
        EXPECT_NEAR(gained, told, 0.05F * told);
        impulse[kind == Liquid::second ? 1 : 0] = told;
    }
    EXPECT_NEAR(impulse[0], 2.0F * 1.0e-4F, 2.0e-5F) << "a quarter of a cell";
    EXPECT_NEAR(impulse[1], 5.0F * impulse[0], 0.05F * impulse[1]);
}

}  // namespace
}  // namespace weir
