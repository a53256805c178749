// The explicit pressure: what it holds up, that it moves with the liquid, and that it gives back
// no more than it took.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

WorldDef elastic_def(std::int32_t nx, std::int32_t ny, std::int32_t particles) {
    WorldDef def = tank_def(nx, ny, particles);
    def.cell_m = kCell;
    def.pressure = Pressure::equation_of_state;
    return def;
}

template <class Real>
double energy_of(const World<Real>& world, double gravity_in_cells) {
    double sum = 0.0;
    const auto x = world.particle_positions();
    const auto v = world.particle_velocities();
    for (std::int32_t k = 0; k < x.size; ++k) {
        const auto vx = static_cast<double>(static_cast<float>(v[k].x));
        const auto vy = static_cast<double>(static_cast<float>(v[k].y));
        sum += 0.5 * (vx * vx + vy * vy) +
               gravity_in_cells * static_cast<double>(static_cast<float>(x[k].y));
    }
    return sum;
}

WEIR_SUITE(EquationOfState, RoomyScalars);

using FixedScalars = testing::Types<float, Fixed, SmallFixed>;
WEIR_SUITE(ElasticArithmetic, FixedScalars);

constexpr float kBarAngle = 0.37F;

/// Of a world that is defined without gravity the automatic sound had no speed, and liquid no
/// pressure: thrown at a wall all of it lay in one line there, and a pool that got its weight later
/// fell into its lowest row.
TYPED_TEST(EquationOfState, HoldsWhatIsDefinedWithoutWeight) {
    constexpr std::int32_t kSide = 8;
    WorldDef def = elastic_def(24, 24, 4 * kSide * kSide);
    def.gravity_mps2 = {};
    for (const bool is_thrown : {true, false}) {
        SCOPED_TRACE(is_thrown);
        TestWorld<TypeParam> world{def};
        const float left = is_thrown ? 8 * kCell : 0.0F;
        expect_ok(world->fill({{left, 0}, {left + kSide * kCell, kSide * kCell}}));
        if (is_thrown) {
            expect_ok(world->stir({{0, 0}, {24 * kCell, 24 * kCell}}, {-0.5F, 0}, 1));
        } else {
            expect_ok(world->set_gravity({0, -9.81F}));
        }
        world.run(60);
        const double room = kSide * kSide * static_cast<double>(kCell * kCell);
        EXPECT_NEAR(world.sums().volume_m2 / room, 1.0, 0.05);
    }
}

TYPED_TEST(EquationOfState, HoldsUpAPoolWithoutLossOfVolume) {
    TestWorld<TypeParam> world{elastic_def(16, 20, 16 * 12 * 4)};
    expect_ok(world->fill({{0, 0}, {16 * kCell, 12 * kCell}}));
    double height = 0.0;
    for (int k = 0; k < 1200; ++k) {
        world->step(1.0F / 120.0F);
    }
    const auto x = world->particle_positions();
    for (std::int32_t k = 0; k < x.size; ++k) {
        height += static_cast<double>(static_cast<float>(x[k].y)) / x.size;
    }
    EXPECT_NEAR(height / 6.0, 1.0, 0.01);
    const auto pressure = world->pressure();
    const double bottom = static_cast<double>(static_cast<float>(pressure.at(8, 0))) *
                          static_cast<double>(world->pressure_scale());
    EXPECT_NEAR(bottom / (9.81 * 11.5 * static_cast<double>(kCell)), 1.0, 0.01);
}

TYPED_TEST(EquationOfState, GivesBackNoMoreThanItTook) {
    WorldDef def = elastic_def(40, 24, 16 * 16 * 4);
    def.max_substeps = 64;
    TestWorld<TypeParam> world{def};
    expect_ok(world->fill({{0, 0}, {16 * kCell, 16 * kCell}}));
    const double gravity = 9.81 / static_cast<double>(kCell);
    const double start = energy_of(*world, gravity);
    for (int k = 0; k < 200; ++k) {
        world->step(1.0F / 120.0F);
        EXPECT_LT(energy_of(*world, gravity), 1.0001 * start) << k;
    }
}

/// Liquid that fills a tank without walls moves at three quarters of the speed of sound.
TYPED_TEST(EquationOfState, MovesWithTheLiquid) {
    WorldDef def = elastic_def(24, 24, 24 * 24 * 4);
    def.gravity_mps2 = {0, 0};
    def.periodic_x = def.periodic_y = true;
    def.sound_speed_mps = 100 * kCell;
    TestWorld<TypeParam> world{def};
    const auto noise = [](int k, int n) {
        return 0.1F * static_cast<float>((k * n) % 11 - 5) * kCell;
    };
    for (int k = 0; k < 48 * 48; ++k) {
        const Vec2f at{0.25F + 0.5F * static_cast<float>(k % 48),
                       0.25F + 0.5F * static_cast<float>(k / 48)};
        expect_ok(world->add_particle(
            kCell * at, {45 * kCell + noise(k, 3), 60 * kCell + noise(k, 7)}));
    }
    for (int k = 0; k < 300; ++k) {
        world->step(0.02F);
    }
    double shaking = 0.0;
    const auto v = world->particle_velocities();
    for (std::int32_t k = 0; k < v.size; ++k) {
        const double x = static_cast<double>(static_cast<float>(v[k].x)) - 45.0;
        const double y = static_cast<double>(static_cast<float>(v[k].y)) - 60.0;
        shaking += (x * x + y * y) / v.size;
    }
    EXPECT_LT(std::sqrt(shaking), 0.1);
}

/// What a narrow gap lets through, jets along a bar and spray must not get more than the pressure
/// has taken: packed worlds gained 3 %.
TYPED_TEST(ElasticArithmetic, LosesEnergyThatFallsOntoABar) {
    constexpr float kBarCell = 1.0F / 64.0F;
    WorldDef def = elastic_def(24, 24, 320);
    def.cell_m = kBarCell;
    def.sound_speed_mps = 10.0F;
    def.max_substeps = 32;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    TestWorld<TypeParam> world{def};
    const Vec2f bar[] = {{-6 * kBarCell, -0.2F * kBarCell},
                         {6 * kBarCell, -0.2F * kBarCell},
                         {6 * kBarCell, 0.2F * kBarCell},
                         {-6 * kBarCell, 0.2F * kBarCell}};
    BodyDef body;
    body.polygon = {bar, 4};
    body.motion.position_m = {12.03F * kBarCell, 7.4F * kBarCell};
    body.motion.angle_rad = kBarAngle;
    put_static(*world, body);
    expect_ok(world->fill({{8 * kBarCell, 13 * kBarCell}, {16 * kBarCell, 23 * kBarCell}}));
    const double gravity = 9.81 / static_cast<double>(kBarCell);
    const double start = energy_of(*world, gravity);
    double most = 0.0;
    for (int k = 0; k < 600; ++k) {
        world->step(1.0F / 240.0F);
        most = std::fmax(most, energy_of(*world, gravity));
    }
    EXPECT_LE(most, 1.001 * start);  // packed places are known to 1/256
}

/// Pressure is what liquid has stored: a step that is a thousandth of the others takes none of it.
TYPED_TEST(ElasticArithmetic, AShortStepLeavesItsPressure) {
    TestWorld<TypeParam> world{elastic_def(16, 20, 16 * 12 * 4)};
    expect_ok(world->fill({{0, 0}, {16 * kCell, 12 * kCell}}));
    for (int k = 0; k < 240; ++k) {
        world->step(1.0F / 60.0F);
    }
    world->step(1.0e-5F);
    float fastest = 0.0F;
    for (int k = 0; k < 30; ++k) {
        fastest = std::fmax(fastest, world->step(1.0F / 60.0F).max_speed_mps);
    }
    EXPECT_LT(fastest, 0.03F * std::sqrt(9.81F * 12.0F * kCell));
}

/// Half a box, in steps of four substeps, each of which gives less than a quarter of a cell/s.
TEST(ElasticPacked, APoolStopsToTheBit) {
    WorldDef def = elastic_def(16, 16, 512);
    def.cell_m = 1.0F / 16.0F;
    def.sound_speed_mps = 20.0F;
    def.max_substeps = 32;
    TestWorld<SmallFixed> world{def};
    expect_ok(world->fill({{0, 0}, {16 * def.cell_m, 8 * def.cell_m}}));
    for (int k = 0; k < 2000; ++k) {
        world->step(1.0F / 240.0F);
    }
    const std::uint64_t before = world->state_hash();
    for (int k = 0; k < 200; ++k) {
        world->step(1.0F / 240.0F);
    }
    EXPECT_EQ(world->state_hash(), before);
}

/// Steps too long for sound make it slower. It stiffens again by a sixteenth a substep, not at
/// once.
TEST(EquationOfState, SoundRecoversSlowly) {
    WorldDef def = elastic_def(16, 20, 16 * 8 * 4);
    def.max_substeps = 1;
    TestWorld<float> world(def);
    expect_ok(world->fill({{0, 0}, {16 * kCell, 8 * kCell}}));
    EXPECT_TRUE(world->step(1.0F / 60.0F).has(Clamped::sound_speed));
    std::int32_t steps = 0;
    while (world->step(1.0e-4F).has(Clamped::sound_speed) && steps < 200) {
        ++steps;
    }
    EXPECT_GT(steps, 8);
    EXPECT_LT(steps, 100);
}

}  // namespace
}  // namespace weir
