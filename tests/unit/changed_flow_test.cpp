// A living world's viscosity, surface tension and walls, set anew: the liquid flows as they now say,
// and who sleeps wakes.
#include "pools.hpp"

namespace weir {
namespace {

constexpr float kHoney = 7.0e-3F;
constexpr float kSoap = 4.0e-5F;

template <class Real>
Vec2f velocity_of(const World<Real>& world, std::int32_t particle) {
    const auto v = world.particle_velocities()[particle];
    const float scale = world.velocity_scale();
    return {scale * static_cast<float>(v.x), scale * static_cast<float>(v.y)};
}

WEIR_SUITE(ChangedFlow, EveryScalar);

/// 8 × 8 cells of 1 m, full of liquid that has come to know its walls after 8 s.
template <class Real>
struct Channel {
    static constexpr float kViscosity = 6.4F;
    WorldDef def;
    TestWorld<Real> world;

    explicit Channel(float pull_mps2, const TankWalls& walls)
        : def(define(pull_mps2, walls)), world(def) {
        expect_ok(world->fill({{0.0F, 0.0F}, {8.0F, 8.0F}}));
        settle();
    }
    static WorldDef define(float pull_mps2, const TankWalls& walls) {
        WorldDef def = tank_def(8, 8, 256);
        def.cell_m = 1.0F;
        def.viscosity_m2ps = kViscosity;
        def.gravity_mps2 = {pull_mps2, 0.0F};
        def.periodic_x = true;
        def.walls = walls;
        def.top_speed_mps = 30.0F;
        return def;
    }
    void settle() {
        for (int k = 0; k < 160; ++k) {
            world->step(0.05F);
        }
    }
    /// Along x, of particles between two heights.
    float mean_speed(float low, float high) const {
        float sum = 0.0F;
        float count = 0.0F;
        for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
            const float y = static_cast<float>(world->particle_positions()[k].y);
            if (y >= low && y < high) {
                sum += velocity_of(*world, k).x;
                count += 1.0F;
            }
        }
        return sum / count;
    }
};

/// Poiseuille's: the mean speed is g h² / 12 ν.
TYPED_TEST(ChangedFlow, ChannelFlowsAsItsViscosityNowSays) {
    const float pull = 4.0F;
    Channel<TypeParam> channel(pull, every_wall({0.0F, 0.0F, true, 0.0F}));
    const float mean = pull * 64.0F / 12.0F / Channel<TypeParam>::kViscosity;
    EXPECT_NEAR(channel.mean_speed(0.0F, 8.0F), mean, 0.06F * mean);
    expect_ok(channel.world->set_viscosity(2.0F * Channel<TypeParam>::kViscosity));
    channel.settle();
    EXPECT_NEAR(channel.mean_speed(0.0F, 8.0F), mean / 2, 0.03F * mean);
    expect_ok(channel.world->set_viscosity(0.5F * Channel<TypeParam>::kViscosity));
    channel.settle();
    EXPECT_NEAR(channel.mean_speed(0.0F, 8.0F), 2 * mean, 0.12F * mean);
    // Without it nothing holds what falls along the channel.
    const float before = channel.mean_speed(0.0F, 8.0F);
    expect_ok(channel.world->set_viscosity(0.0F));
    channel.world->step(0.5F);
    EXPECT_NEAR(channel.mean_speed(0.0F, 8.0F), before + 0.5F * pull, 0.1F * pull);
    expect_ok(channel.world->set_viscosity(Channel<TypeParam>::kViscosity));
    channel.settle();
    EXPECT_NEAR(channel.mean_speed(0.0F, 8.0F), mean, 0.06F * mean) << "it sticks again";
}

/// Couette's: straight from one wall's speed to the other's.
TYPED_TEST(ChangedFlow, ChannelIsDraggedByWallsAsTheyAreNow) {
    const float belt = 4.0F;
    TankWalls walls = every_wall({0.0F, 0.0F, true, 0.0F});
    walls.top.conveyor_mps = -belt;  // along x
    Channel<TypeParam> channel(0.0F, walls);
    const auto expect_profile = [&](float at_floor, float at_ceiling) {
        for (int j = 0; j < 8; ++j) {
            const float low = static_cast<float>(j);
            const float exact = at_floor + (at_ceiling - at_floor) * (low + 0.5F) / 8.0F;
            EXPECT_NEAR(channel.mean_speed(low, low + 1.0F), exact, 0.06F * belt) << j;
        }
    };
    expect_profile(0.0F, belt);
    walls.top.conveyor_mps = 0.0F;
    walls.bottom.conveyor_mps = belt;
    expect_ok(channel.world->set_walls(walls));
    channel.settle();
    expect_profile(belt, 0.0F);
    walls.top.no_slip = false;  // it goes along
    expect_ok(channel.world->set_walls(walls));
    channel.settle();
    channel.settle();
    channel.settle();
    expect_profile(belt, belt);
}

/// Thrown against the floor one after the other.
TYPED_TEST(ChangedFlow, FloorGivesBackWhatItNowDoes) {
    WorldDef def = tank_def(16, 16, 10);
    TestWorld<TypeParam> world(def);
    const auto thrown = [&] {
        expect_ok(world->add_particle({0.1F, 0.03F}, {1.0F, -2.0F}));
        world->step(kDt);
        const Vec2f v = velocity_of(*world, 0);
        expect_ok(world->remove_particle(0));
        return v;
    };
    const Vec2f dull = thrown();
    EXPECT_NEAR(dull.x, 1.0F, 0.05F);
    EXPECT_NEAR(dull.y, 0.0F, 0.05F);
    TankWalls walls;
    walls.bottom = {0.5F, 0.1F, false, 0.0F};
    expect_ok(world->set_walls(walls));
    const Vec2f springy = thrown();
    EXPECT_NEAR(springy.x, 1.0F - 0.1F * 1.5F * 2.1F, 0.06F) << "rubbed";
    EXPECT_NEAR(springy.y, 0.5F * 2.1F, 0.15F);
    walls.bottom = {0.5F, 0.0F, false, 0.0F};  // ice
    expect_ok(world->set_walls(walls));
    EXPECT_NEAR(thrown().x, 1.0F, 0.05F);
    walls.bottom = {0.0F, 1.0F, false, -3.0F};  // a belt against it
    expect_ok(world->set_walls(walls));
    EXPECT_LT(thrown().x, -0.5F);
}

WEIR_SUITE(ChangedDrop, RoomyScalars);

/// Without weight: only tension moves a square of liquid.
TYPED_TEST(ChangedDrop, SquareIsPulledRoundOnceThereIsSome) {
    WorldDef def = tank_def(16, 16, 400);
    def.gravity_mps2 = {};
    def.surface_tension_m3ps2 = 1.0e-3F;
    TestWorld<TypeParam> world(def);
    expect_ok(world->set_surface_tension(0.0F));
    expect_ok(world->fill({{0.08F, 0.08F}, {0.24F, 0.24F}}));
    StepReport report;
    for (int k = 0; k < 10; ++k) {
        report = world->step(kDt);
    }
    EXPECT_LT(report.max_speed_mps, 1.0e-3F);
    expect_ok(world->set_surface_tension(1.0e-3F));
    for (int k = 0; k < 5; ++k) {
        report = world->step(kDt);
    }
    EXPECT_GT(report.max_speed_mps, 0.02F);
}

/// The world as a whole: any other value wakes it, the same one does not.
TYPED_TEST(ChangedFlow, WakeWhoSleeps) {
    WorldDef def = tank_def(16, 16, 600);
    def.viscosity_m2ps = kHoney;
    def.surface_tension_m3ps2 = std::is_same_v<TypeParam, SmallFixed> ? 0.0F : kSoap;
    def.sleep = {0.02F, 0.2F, 0.0F};
    TestWorld<TypeParam> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.32F, 0.12F}}));
    const auto sleeps_after = [&](int most) {
        StepReport report;
        for (int k = 0; k < most && !report.asleep; ++k) {
            report = world->step(kDt);
        }
        return report.asleep;
    };
    const auto expect_woken = [&](const char* by) {
        EXPECT_GT(world->step(kDt).substeps, 0) << by;
        EXPECT_TRUE(sleeps_after(1000)) << by;
    };
    ASSERT_TRUE(sleeps_after(1000));
    expect_ok(world->set_viscosity(def.viscosity_m2ps));
    expect_ok(world->set_surface_tension(def.surface_tension_m3ps2));
    expect_ok(world->set_walls(def.walls));
    EXPECT_TRUE(world->step(kDt).asleep) << "nothing was changed";
    expect_ok(world->set_viscosity(0.5F * kHoney));
    expect_woken("viscosity");
    if (def.surface_tension_m3ps2 > 0.0F) {
        expect_ok(world->set_surface_tension(0.5F * kSoap));
        expect_woken("tension");
    }
    Surface TankWalls::*const walls[] = {&TankWalls::bottom, &TankWalls::right, &TankWalls::top,
                                         &TankWalls::left};
    for (Surface TankWalls::*const wall : walls) {
        (def.walls.*wall).friction = 0.5F;
        expect_ok(world->set_walls(def.walls));
        expect_woken("wall");
        expect_ok(world->set_walls(def.walls));
        EXPECT_TRUE(world->step(kDt).asleep);
    }
}

/// Regions: what the liquid is wakes all, a wall those at it.
TYPED_TEST(ChangedFlow, WakeRegionsThatFeelThem) {
    const auto expect_after = [](const char* what, bool wakes, void (*change)(World<TypeParam>&)) {
        SCOPED_TRACE(what);
        WorldDef def = pools_def();
        def.viscosity_m2ps = 1.0e-3F;
        Pools<TypeParam> pools(def);
        pools.pour_left();
        pools.rest_right();
        pools.kick_left();
        pools->step(kDt);
        change(*pools);
        pools.kick_left();
        const StepReport report = pools->step(kDt);
        EXPECT_EQ(report.particles_asleep < pools.right, wakes);
    };
    expect_after("viscosity", true,
                 [](World<TypeParam>& world) { expect_ok(world.set_viscosity(kHoney)); });
    expect_after("the same", false, [](World<TypeParam>& world) {
        expect_ok(world.set_viscosity(1.0e-3F));
        expect_ok(world.set_walls({}));
    });
    expect_after("its side", true, [](World<TypeParam>& world) {
        TankWalls walls;
        walls.right.no_slip = true;
        expect_ok(world.set_walls(walls));
    });
    expect_after("floor", true, [](World<TypeParam>& world) {
        TankWalls walls;
        walls.bottom.conveyor_mps = 0.1F;
        expect_ok(world.set_walls(walls));
    });
    expect_after("the side beyond, and the ceiling", false, [](World<TypeParam>& world) {
        TankWalls walls;
        walls.left.no_slip = true;
        walls.top.restitution = 0.5F;
        expect_ok(world.set_walls(walls));
    });
}

}  // namespace
}  // namespace weir
