// Windows of tanks with bodies: the picture of the solids is drawn again wherever the window goes,
// and around single particles beyond it.
#include "solid/contour_hit.hpp"
#include "step/fly_beyond.hpp"
#include "window_life.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr Capacity kLevel = [] {
    Capacity c;
    c.particles = 4096, c.cells_x = 4096, c.cells_y = 4096, c.bodies = 1000, c.vertices = 8000;
    c.window_cells = 320 * 160;
    return c;
}();
static_assert(world_bytes<float>(kLevel) < 4'200'000, "window and polygons decide, not the tank");

WEIR_SUITE(WindowBodies, RoomyScalars);

TYPED_TEST(WindowBodies, HaveTheBitsOfTheWholeTank) {
    const char* more = std::getenv("WEIR_WINDOWS");
    const auto seeds = static_cast<std::uint64_t>(more != nullptr ? std::atoi(more) : kLives);
    for (std::int32_t kind = kKinds; kind < kAllKinds; ++kind) {
        std::int32_t moves = 0;
        for (std::uint64_t seed = 1; seed <= seeds && !testing::Test::HasFailure(); ++seed) {
            moves += expect_same_life<TypeParam>(kind, seed);
        }
        EXPECT_GT(moves, kLeastMoves) << "kind " << kind;
    }
}

TYPED_TEST(WindowBodies, LoseNobodyHoweverSmallItIs) {
    for (std::int32_t kind = kKinds; kind < kAllKinds; ++kind) {
        expect_nobody_lost<TypeParam>(kind);
    }
}

/// Whoever is beyond and goes where no body is drawn is not collided: in all cells that it can
/// touch, and in those beside them, the picture of the whole tank is open.
TYPED_TEST(WindowBodies, OpenWaysNeedNoPicture) {
    using Real = TypeParam;
    TestWorld<Real> world(wide_def(9));
    TestWorld<Real> twin(wide_def(9));
    Nomads<Real> nomads(9, 5);
    Dice dice(17);
    std::int32_t open = 0;
    std::int32_t near_bodies = 0;
    for (std::int32_t step = 0; step < 30; ++step) {
        nomads.disturb_bodies(*world, *twin);
        world->step(0.01F);
        twin->step(0.01F);
        const auto& simulation = state_of(world).simulation;
        PictureBeyond<Real> picture(simulation.layers.shape, simulation.layers.walls,
                                    simulation.bodies);
        const NodeBox drawn = all_drawn(simulation.bodies);
        for (std::int32_t k = 0; k < 2000; ++k) {
            const auto place = [&](float middle_x, float middle_y, float off) {
                return Vec2<Real>{static_cast<Real>(middle_x + dice.uniform(-off, off)),
                                  static_cast<Real>(middle_y + dice.uniform(-off, off))};
            };
            const float x = dice.uniform(6.0F, 244.0F);
            const float y = dice.uniform(6.0F, 144.0F);
            const Vec2<Real> from = place(x, y, 2.0F);
            const Vec2<Real> to = place(x, y, 2.0F);
            const NodeBox near = nodes_around(from, to);
            const bool any = DrawnBodies<Real>(simulation.bodies).any_at(near);
            ASSERT_EQ(picture.any_at(near), any);
            if (any) {
                ++near_bodies;
                EXPECT_TRUE(overlap(near, drawn));
                continue;
            }
            ++open;
            for (const Real at : {Real(0), Real(0.25), Real(0.5), Real(0.75), Real(1)}) {
                const Vec2<Real> on = from + at * (to - from);
                ASSERT_FALSE(is_inside(simulation.layers.shape, simulation.layers.walls, on));
                ASSERT_EQ(case_at(simulation.layers.shape, simulation.layers.walls, on),
                          kCellOutside);
            }
        }
    }
    EXPECT_GT(open, 1000);
    EXPECT_GT(near_bodies, 1000);
}

/// Where no picture is stored drops fall into a bowl and on a plate that rises: they come through
/// neither. Nor is liquid put into them.
TYPED_TEST(WindowBodies, HoldWhatIsBeyond) {
    using Real = TypeParam;
    TestWorld<Real> world(windowed(wide_def(9), 66 * 42));
    const Ring wall = rectangle(0.1F, 1.0F);
    const Ring table = rectangle(0.6F, 0.1F);
    const Ring ring = {{-0.5F, 0.0F}, {0.5F, 0.0F}, {0.5F, 0.4F}, {0.4F, 0.1F}, {-0.4F, 0.1F},
                       {-0.5F, 0.4F}};
    put_static(*world, body_of(ring, {4.0F, 0.6F}));
    put_static(*world, body_of(wall, {0.35F, 0.5F}));
    BodyDef lift = body_of(table, {4.0F, 1.5F});
    lift.motion.velocity_mps = {0.0F, 0.4F};
    put_moving(*world, lift);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.20F, 0.20F}}));
    const std::int32_t near = world->particle_positions().size;
    expect_ok(world->fill({{3.98F, 1.0F}, {4.04F, 1.06F}}));
    const std::int32_t below = world->particle_positions().size;
    expect_ok(world->fill({{3.98F, 1.8F}, {4.04F, 1.86F}}));
    EXPECT_EQ(world->add_particle({4.0F, 0.65F}, {}), Status::particle_inside_solid);
    std::int32_t seeds = -1;
    expect_ok(world->fill({{3.7F, 0.61F}, {4.3F, 0.69F}}, &seeds));
    EXPECT_EQ(seeds, 0) << "all of it is bowl";
    const std::int32_t all = world->particle_positions().size;
    for (std::int32_t step = 0; step < 100; ++step) {
        const StepReport report = world->step(0.01F);
        EXPECT_EQ(report.particles, all);
        EXPECT_GE(report.particles_beyond, all - near);
        EXPECT_EQ(report.particles_stuck, 0);
        for (std::int32_t k = 0; k < all; ++k) {
            const auto x = world->particle_positions()[k];
            const float height = kCell * static_cast<float>(x.y);
            if (static_cast<float>(x.x) > 100.0F) {
                EXPECT_GT(height, 0.69F) << "through the bowl, step " << step;
            }
        }
    }
    std::int32_t lifted = 0;
    for (std::int32_t k = 0; k < all; ++k) {
        const auto x = world->particle_positions()[k];
        lifted += static_cast<float>(x.y) * kCell > 1.94F ? 1 : 0;
    }
    EXPECT_EQ(lifted, all - below) << "on the plate";
}

template <class Real>
void expect_same_diagnosis(TestWorld<Real>& world, TestWorld<Real>& other, double least_m2) {
    Diagnostics a;
    Diagnostics b;
    expect_ok(world->diagnose(&a));
    expect_ok(other->diagnose(&b));
    EXPECT_GT(a.volume_m2, least_m2);
    EXPECT_TRUE(same(a, b)) << a.volume_m2 << " " << b.volume_m2;
}

/// The window that was restored is wide enough, though no wider one would fit.
TYPED_TEST(WindowBodies, KnowTheLiquidThatWasRestored) {
    const WorldDef def = windowed(wide_def(kKinds), 67 * 27);
    TestWorld<TypeParam> world(def);
    TestWorld<TypeParam> other(def);
    expect_ok(world->fill({{1.0F, 0.6F}, {1.4F, 0.7F}}));
    world->step(1.0F / 60.0F);
    change_worlds(world, other, def);
    expect_same_diagnosis(world, other, 0.03);
    EXPECT_EQ(other->state_hash(), world->state_hash());
    world->step(1.0F / 60.0F);
    other->step(1.0F / 60.0F);
    EXPECT_EQ(other->state_hash(), world->state_hash());
}

/// It goes along with the liquid, though what was restored stands in all of it.
TYPED_TEST(WindowBodies, GoesOnFromWhereItWasRestored) {
    const WorldDef def = windowed(wide_def(kKinds), 67 * 43);
    TestWorld<TypeParam> world(def);
    expect_ok(world->fill({{1.0F, 2.6F}, {1.2F, 2.76F}}));
    for (std::int32_t step = 0; step < 15; ++step) {
        EXPECT_EQ(world->step(1.0F / 60.0F).particles_beyond, 0);
        TestWorld<TypeParam> other(def);
        change_worlds(world, other, def);
        SCOPED_TRACE(step);
        expect_same_diagnosis(world, other, 0.02);
        other->step(1.0F / 60.0F);
        world->step(1.0F / 60.0F);
        ASSERT_EQ(other->state_hash(), world->state_hash()) << step;
    }
}

}  // namespace
}  // namespace weir
