// Skip: the part of a tank that holds no liquid changes nothing and costs nothing.
#include <gtest/gtest.h>

#include <cstring>

#include "step/occupied.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

/// Water in the lower left corner of a tank, closed off by a solid wall on its right, so that the
/// tank may be any larger.
template <class Real>
struct CornerPool {
    measure::WorldMemory memory;
    World<Real> world;

    CornerPool(std::int32_t cells_x, std::int32_t cells_y) {
        WorldDef def = tank_def(cells_x, cells_y, 1200, 1, 4);
        def.cell_m = 0.02F;
        memory = measure::memory_for<Real>(def);
        EXPECT_EQ(world.init(def, memory.data(), memory.size()), Status::ok);
        const Vec2f wall[] = {{0.50F, -0.02F}, {0.60F, -0.02F}, {0.60F, 2.10F}, {0.50F, 2.10F}};
        BodyDef body;
        body.polygon = {wall, 4};
        put_static(world, body);
        EXPECT_EQ(world.fill({{0.0F, 0.0F}, {0.16F, 0.40F}}), Status::ok);
    }
};

WEIR_SUITE(Occupied, EveryScalar);

TYPED_TEST(Occupied, AnEmptyRestOfTheTankChangesNoBit) {
    CornerPool<TypeParam> small(40, 100), large(90, 120);
    for (int k = 0; k < 120; ++k) {
        // A shake upwards on the way: the part grows and shrinks again.
        const Vec2f gravity{0.0F, k >= 40 && k < 52 ? 6.0F : -9.81F};
        ASSERT_EQ(small.world.set_gravity(gravity), Status::ok);
        ASSERT_EQ(large.world.set_gravity(gravity), Status::ok);
        small.world.step(1.0F / 60.0F);
        large.world.step(1.0F / 60.0F);
        const auto a = small.world.particle_positions();
        const auto b = large.world.particle_positions();
        ASSERT_EQ(a.size, b.size);
        ASSERT_EQ(std::memcmp(a.data, b.data, static_cast<std::size_t>(a.size) * sizeof a[0]), 0)
            << "step " << k;
    }
    const auto p = small.world.pressure();
    const auto q = large.world.pressure();
    for (std::int32_t j = 0; j < q.rows; ++j) {
        for (std::int32_t i = 0; i < q.columns; ++i) {
            const bool both = i < p.columns && j < p.rows;
            ASSERT_EQ(q.at(i, j), both ? p.at(i, j) : TypeParam(0)) << i << ", " << j;
        }
    }
}

/// Where liquid was that is taken away no pressure is left.
TYPED_TEST(Occupied, NothingIsLeftWhereLiquidWas) {
    TestWorld<TypeParam> world(tank_def(16, 32, 2000));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.32F, 0.6F}}));
    for (int k = 0; k < 5; ++k) {
        world->step(1.0F / 60.0F);
    }
    EXPECT_GT(world->pressure().at(2, 20), TypeParam(0));
    expect_ok(world->drain({{0.0F, 0.16F}, {0.32F, 0.64F}}));
    world->step(1.0F / 60.0F);
    const auto pressure = world->pressure();
    for (std::int32_t j = 12; j < pressure.rows; ++j) {
        for (std::int32_t i = 0; i < pressure.columns; ++i) {
            ASSERT_EQ(pressure.at(i, j), TypeParam(0)) << i << ", " << j;
        }
    }
}

/// Who counts forces begins at the tank's corner: the same bits, for more work.
TYPED_TEST(Occupied, NorDoesAnEmptyCorner) {
    using Real = TypeParam;
    WorldDef def = small_def();
    def.capacity.particles = 1000;
    def.capacity.cells_x = 100;
    def.capacity.cells_y = 70;
    def.keep_sorted = true;
    TestWorld<Real> part(def);
    def.capacity.two_way = true;
    TestWorld<Real> whole(def);
    const Ring shelf = rectangle(0.60F, 0.06F);
    const Ring vane = rectangle(0.20F, 0.04F);
    for (TestWorld<Real>* world : {&part, &whole}) {
        BodyId id;
        ASSERT_EQ((*world)->add_static_body(body_of(shelf, {1.60F, 0.80F}), &id), Status::ok);
        BodyDef wheel = body_of(vane, {1.70F, 1.00F});
        wheel.motion.spin_radps = 5.0F;
        ASSERT_EQ((*world)->add_moving_body(wheel, &id), Status::ok);
        ASSERT_EQ((*world)->fill({{1.62F, 1.06F}, {2.0F, 1.30F}}), Status::ok);
    }
    std::int32_t fell = 0;
    for (int k = 0; k < 80; ++k) {
        const Vec2f gravity{0.0F, k >= 40 && k < 52 ? 6.0F : -9.81F};
        ASSERT_EQ(part->set_gravity(gravity), Status::ok);
        ASSERT_EQ(whole->set_gravity(gravity), Status::ok);
        part->step(1.0F / 60.0F);
        whole->step(1.0F / 60.0F);
        const auto a = part->particle_positions();
        const auto b = whole->particle_positions();
        ASSERT_EQ(a.size, b.size);
        ASSERT_EQ(std::memcmp(a.data, b.data, static_cast<std::size_t>(a.size) * sizeof a[0]), 0)
            << "step " << k;
        for (std::int32_t n = 0; k == 79 && n < a.size; ++n) {
            fell += static_cast<float>(a[n].y) < 30.0F ? 1 : 0;
        }
    }
    EXPECT_GT(fell, 10) << "some went over the edge";
}

/// Work of a step, in slices of so little that rows count.
std::int32_t slices_of(World<float>& world) {
    StepReport report;
    EXPECT_EQ(world.begin_step(1.0F / 60.0F, &report), Status::ok);
    std::int32_t slices = 1;
    while (!world.advance(100)) {
        ++slices;
    }
    return slices;
}

/// A world that counts forces asks all solids at all times: it has the same bits.
TYPED_TEST(Occupied, SolidsOutOfReachAreNotAsked) {
    using Real = TypeParam;
    WorldDef def = small_def();
    def.capacity.particles = 400;
    def.capacity.cells_y = 40;
    TestWorld<Real> skips(def);
    def.capacity.two_way = true;
    TestWorld<Real> asks(def);
    const Ring bar = rectangle(0.16F, 0.03F);
    const Ring box = rectangle(0.06F, 0.06F);
    for (TestWorld<Real>* world : {&skips, &asks}) {
        BodyId id;
        BodyDef wheel = body_of(bar, {0.16F, 0.56F});
        wheel.motion.spin_radps = 5.0F;
        ASSERT_EQ((*world)->add_moving_body(wheel, &id), Status::ok);
        BodyDef plunger = body_of(box, {0.06F, 0.70F});
        plunger.motion.velocity_mps.y = -0.5F;
        ASSERT_EQ((*world)->add_moving_body(plunger, &id), Status::ok);
        ASSERT_EQ((*world)->fill({{0.0F, 0.0F}, {0.16F, 0.20F}}), Status::ok);
    }
    std::int32_t tested = 0;
    for (int k = 0; k < 120; ++k) {
        const Vec2f gravity{0.0F, k >= 60 && k < 80 ? 9.0F : -9.81F};
        ASSERT_EQ(skips->set_gravity(gravity), Status::ok);
        ASSERT_EQ(asks->set_gravity(gravity), Status::ok);
        const StepReport report = skips->step(1.0F / 60.0F);
        EXPECT_EQ(report.particles_tested, asks->step(1.0F / 60.0F).particles_tested);
        tested += report.particles_tested;
        if (k == 20) {
            EXPECT_EQ(tested, 0) << "nothing is near yet";
        }
        const auto a = skips->particle_positions();
        const auto b = asks->particle_positions();
        ASSERT_EQ(a.size, b.size);
        ASSERT_EQ(std::memcmp(a.data, b.data, static_cast<std::size_t>(a.size) * sizeof a[0]), 0)
            << "step " << k;
    }
    EXPECT_GT(tested, 50) << "and then they met";
}

/// Nor are those that were in reach before, which a world that was restored knows nothing of: from
/// its second step on it does the same work.
TYPED_TEST(Occupied, SolidsThatWentAreForgotten) {
    WorldDef def = small_def();
    def.capacity.cells_y = 60;
    def.gravity_mps2 = {};
    TestWorld<TypeParam> world(def);
    TestWorld<TypeParam> restored(def);
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.2F, 0.05F}));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.1F, 0.1F}}));
    const StepReport beside = world->step(1.0F / 60.0F);
    Motion motion = motion_of(*world, id);
    motion.position_m.y = 1.0F;
    expect_ok(world->set_motion(id, motion));
    world->step(1.0F / 60.0F);
    change_worlds(world, restored, def);
    world->step(1.0F / 60.0F);
    restored->step(1.0F / 60.0F);
    const StepReport without = world->step(1.0F / 60.0F);
    expect_same_report(restored->step(1.0F / 60.0F), without);
    EXPECT_LT(work_of(without), work_of(beside));
}

/// Nor by what creeps by a last digit of fixed point, in which beside solids another number stands
/// for a face that no particle reaches.
TYPED_TEST(Occupied, SolidsOutOfReachSlowNothingThatCreeps) {
    using Real = TypeParam;
    WorldDef def = small_def();
    def.capacity.cells_y = 40;
    def.gravity_mps2 = {};
    TestWorld<Real> skips(def);
    def.capacity.two_way = true;
    TestWorld<Real> asks(def);
    const float digit_mps = def.cell_m / 65536.0F;
    for (TestWorld<Real>* world : {&skips, &asks}) {
        put_static(**world, body_of(kSquare4cm, {0.16F, 0.64F}));
        expect_ok((*world)->fill({{0.04F, 0.04F}, {0.16F, 0.16F}}));
        expect_ok((*world)->stir({{}, {0.32F, 0.32F}}, {digit_mps, -digit_mps}, 1.0F));
        for (int k = 0; k < 5; ++k) {
            (*world)->step(1.0F / 60.0F);
        }
    }
    const auto a = skips->particle_velocities();
    const auto b = asks->particle_velocities();
    ASSERT_EQ(a.size, b.size);
    EXPECT_EQ(std::memcmp(a.data, b.data, static_cast<std::size_t>(a.size) * sizeof a[0]), 0);
}

TEST(OccupiedPart, IsAllThatCostsWork) {
    CornerPool<float> small(40, 60), large(800, 600);
    small.world.step(1.0F / 60.0F);  // the first one empties the tank
    large.world.step(1.0F / 60.0F);
    for (int k = 0; k < 5; ++k) {
        EXPECT_EQ(slices_of(small.world), slices_of(large.world));
    }
}

/// The same water in the far corner: the rows that both find empty are counted alike.
TEST(OccupiedPart, CostsTheSameInAnyCorner) {
    const auto slices = [](Vec2f from) {
        WorldDef def = small_def();
        def.capacity.particles = 1000;
        def.capacity.cells_x = 512;
        def.capacity.cells_y = 512;
        TestWorld<float> world(def);
        EXPECT_EQ(world->fill({from, {from.x + 0.2F, from.y + 0.4F}}), Status::ok);
        world->step(1.0F / 60.0F);
        return slices_of(*world);
    };
    const std::int32_t near = slices({0.0F, 0.0F});
    EXPECT_LT(slices({10.04F, 9.84F}), 3 * near) << "a part begins at a multiple of 32 columns";
    EXPECT_GT(near, 20);
}

TEST(OccupiedPart, BeginsAndEndsBeyondTheParticlesAndNeverCutsASeam) {
    Vec2f position[] = {{1.5F, 2.5F}, {7.5F, 0.5F}, {3.5F, 4.5F}, {0.5F, 0.5F}, {0.5F, 9.25F}};
    Vec2f velocity[5] = {};
    const GridShape tank{40, 30, 42};
    const Particles<float> all{position, velocity, 5, 5};
    Borders<float> borders;
    GridShape part = occupied_part<float>(tank, borders, extent_of(all), false);
    EXPECT_GE(part.nx, 7 + 3);
    EXPECT_LT(part.nx, 7 + 8);
    EXPECT_GE(part.ny, 9 + 3);
    EXPECT_LT(part.ny, 9 + 8);
    EXPECT_EQ(part.stride, tank.stride);
    EXPECT_EQ(part.i0, 0);
    for (Vec2f& place : position) {
        place = {place.x + 70.0F, place.y + 20.0F};
    }
    const GridShape large{90, 60, 92};
    part = occupied_part<float>(large, borders, extent_of(all), false);
    EXPECT_EQ(part.i0, 64);
    EXPECT_EQ(part.j0, 16);
    EXPECT_GE(part.i0 + part.nx, 77 + 3);
    EXPECT_GE(part.j0 + part.ny, 29 + 3);
    EXPECT_EQ(occupied_part<float>(large, borders, extent_of(all), true).i0, 0);
    borders.wrap_x = borders.wrap_y = true;
    part = occupied_part<float>(tank, borders, extent_of(all), false);
    EXPECT_EQ(part.nx, 40);
    EXPECT_EQ(part.ny, 30);
}

}  // namespace
}  // namespace weir
