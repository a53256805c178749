// Leaning surfaces come to rest: what is slow there gets more of PIC, and nothing else does.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "step/quiet_surface.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr std::int32_t kCells = 12;

/// A tank whose surface goes through its middle with a slope, liquid that moves at (u, v), and a
/// particle a quarter of a cell off the centre of a cell.
template <class Real>
struct Surface {
    GridShape shape{kCells, kCells, kCells + 2};
    std::vector<VelocityOf<Real>> before_u, before_v, share;
    std::vector<LevelOf<Real>> level;
    StaggeredGrid<Real> grid;
    PressureFields<Real> fields;
    Vec2<Real> gravity{Real(0), Real(-100)};
    Vec2<PositionOf<Real>> position;
    Vec2<VelocityOf<Real>> velocity;
    Particles<Real> particles;

    Surface(double slope, Vec2<double> moves) {
        const auto size = static_cast<std::size_t>(shape.size());
        before_u.assign(size, VelocityOf<Real>(static_cast<Real>(moves.x)));
        before_v.assign(size, VelocityOf<Real>(static_cast<Real>(moves.y)));
        level.assign(size, LevelOf<Real>(Real(0)));
        share.assign(size, VelocityOf<Real>(Real(1)));  // whatever was there
        for (std::int32_t j = -1; j <= kCells; ++j) {
            for (std::int32_t i = -1; i <= kCells; ++i) {
                const double over = slope * (i - 5.5) + 5.5 - j;
                level[static_cast<std::size_t>(shape.index(i, j))] =
                    LevelOf<Real>(static_cast<Real>(std::fmin(std::fmax(over, -1.5), 1.45)));
            }
        }
        grid.shape = shape;
        grid.mass_u = before_u.data();
        grid.mass_v = before_v.data();
        fields.level = level.data();
        fields.divergence = share.data();
        fields.cell_weight = Real(4);
    }

    /// The velocity after four substeps.
    Vec2<double> quieted(Vec2<double> at, Vec2<double> moving) {
        const Vec2<Real> x = convert<Real>(at);
        const Vec2<Real> v = convert<Real>(moving);
        position = {PositionOf<Real>(x.x), PositionOf<Real>(x.y)};
        velocity = {VelocityOf<Real>(v.x), VelocityOf<Real>(v.y)};
        particles.position = &position;
        particles.velocity = &velocity;
        particles.count = particles.capacity = 1;
        for (int substep = 0; substep < 4; ++substep) {
            quiet_surface<Real>(grid, fields, gravity, particles);
        }
        return {static_cast<double>(Real(velocity.x)), static_cast<double>(Real(velocity.y))};
    }
};

const Vec2<double> kOnSurface{6.25, 6.25};

WEIR_SUITE(QuietSurface, EveryScalar);

TYPED_TEST(QuietSurface, TakesHalfOfWhatIsUnlikeTheGridWhereItLeans) {
    Surface<TypeParam> surface(0.3, {});
    const Vec2<double> v = surface.quieted(kOnSurface, {1.0, -2.0});
    EXPECT_NEAR(v.x, 0.5, 1e-3);
    EXPECT_NEAR(v.y, -1.0, 1e-3);
}

TYPED_TEST(QuietSurface, LeavesALevelSurfaceAlone) {
    for (const double slope : {0.0, 0.1}) {
        Surface<TypeParam> surface(slope, {});
        const Vec2<double> v = surface.quieted(kOnSurface, {1.0, -2.0});
        EXPECT_EQ(v.x, 1.0);
        EXPECT_EQ(v.y, -2.0);
    }
}

/// A sensor's noise is no lean.
TYPED_TEST(QuietSurface, QuietsWhatGravityHoldsALittleAslantFromAFlatterSlopeOn) {
    Surface<TypeParam> surface(0.1, {});
    surface.gravity.x = TypeParam(1);
    EXPECT_EQ(surface.quieted(kOnSurface, {1.0, -2.0}).x, 1.0);
    surface.gravity.x = TypeParam(-2);
    EXPECT_NEAR(surface.quieted(kOnSurface, {1.0, -2.0}).x, 0.5, 1e-3);
    surface.gravity = {TypeParam(100), TypeParam(2)};
    EXPECT_NEAR(surface.quieted(kOnSurface, {1.0, -2.0}).x, 0.5, 1e-3);
    surface.gravity = {TypeParam(30), TypeParam(-100)};
    EXPECT_EQ(surface.quieted(kOnSurface, {1.0, -2.0}).x, 1.0);
}

TYPED_TEST(QuietSurface, LeavesWhatIsFastOrDeepAlone) {
    EXPECT_EQ(Surface<TypeParam>(0.3, {4.0, 0.0}).quieted(kOnSurface, {1.0, 0.0}).x, 1.0);
    EXPECT_EQ(Surface<TypeParam>(0.3, {3.0, 3.0}).quieted(kOnSurface, {1.0, 0.0}).x, 1.0);
    EXPECT_EQ(Surface<TypeParam>(0.5, {}).quieted({6.25, 4.25}, {1.0, 0.0}).x, 1.0);
    EXPECT_EQ(Surface<TypeParam>(0.5, {}).quieted({6.25, 7.25}, {1.0, 0.0}).x, 1.0);
}

TYPED_TEST(QuietSurface, MakesNothingFasterByMoreThanAQuarter) {
    Surface<TypeParam> surface(0.3, {2.0, 0.0});
    const double share = 0.5 * (1.0 - 0.25);
    EXPECT_NEAR(surface.quieted(kOnSurface, {1.0, 0.0}).x, 1.0 + 0.25 * share, 1e-3);
    EXPECT_NEAR(surface.quieted(kOnSurface, {-1.0, 0.0}).x, -1.0 + 2.25 * share, 1e-3);
    EXPECT_EQ(surface.quieted(kOnSurface, {0.0, 0.0}).x, 0.0);
}

TYPED_TEST(QuietSurface, NeedsWeightAndLiquidThatIsNotCompressible) {
    Surface<TypeParam> light(0.3, {});
    light.fields.cell_weight = TypeParam(0);
    EXPECT_EQ(light.quieted(kOnSurface, {1.0, 0.0}).x, 1.0);
    Surface<TypeParam> compressible(0.3, {});
    compressible.fields.sound_speed = TypeParam(10);
    EXPECT_EQ(compressible.quieted(kOnSurface, {1.0, 0.0}).x, 1.0);
    Surface<TypeParam> tense(0.3, {});
    tense.fields.on_surface = true;
    EXPECT_EQ(tense.quieted(kOnSurface, {1.0, 0.0}).x, 1.0);
}

/// Kinetic energy of mgh/2 in a tank half full whose gravity leans, after 1,500 steps.
double leaning_energy(double tilt) {
    constexpr std::int32_t kDepth = 12;
    constexpr double kMiddle = kDepth;
    WorldDef def = small_def();
    def.capacity.cells_x = def.capacity.cells_y = 2 * kDepth;
    def.capacity.particles = 16 * kDepth * kDepth;
    const Vec2<double> up{-std::sin(tilt), std::cos(tilt)};
    def.gravity_mps2 = convert<float>(-9.81 * up);
    TestWorld<float> world(def);
    const auto cell = static_cast<double>(def.cell_m);
    for (int b = 0; b < 4 * kDepth; ++b) {
        for (int a = 0; a < 4 * kDepth; ++a) {
            const Vec2<double> p{0.25 + 0.5 * a, 0.25 + 0.5 * b};
            if (dot(p - Vec2<double>{kMiddle, kMiddle}, up) < 0.0) {
                expect_ok(world->add_particle(convert<float>(cell * p), {}));
            }
        }
    }
    double energy = 0.0;
    for (int step = 0; step < 1500; ++step) {
        world->step(1.0F / 60.0F);
        if (step >= 1000) {
            for (const Vec2<float> v : world->particle_velocities()) {
                energy += static_cast<double>(dot(v, v)) / world->particle_velocities().size / 500;
            }
        }
    }
    return energy * cell / (9.81 * kDepth);
}

/// What is left of the speed in a shallow packed pool that leans by less than an eighth, rms, of
/// √(gh).
double restless_pool(double tilt) {
    constexpr float kDepth = 5.25F;
    constexpr std::int32_t kSteps = 7200, kLast = 1200;
    WorldDef def = tank_def(28, 12, 600, 0, 0);
    def.cell_m = 0.0066F;
    def.top_speed_mps = 3.4F;
    def.volume_gain = 0.4F;
    def.gravity_mps2 = {static_cast<float>(9.81 * std::sin(tilt)),
                        static_cast<float>(-9.81 * std::cos(tilt))};
    TestWorld<SmallFixed> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {28.0F * def.cell_m, kDepth * def.cell_m}}));
    double sum = 0.0;
    for (std::int32_t step = 0; step < kSteps; ++step) {
        world->step(1.0F / 60.0F);
        for (const auto& v : world->particle_velocities()) {
            const Vec2<double> its{static_cast<double>(v.x), static_cast<double>(v.y)};
            sum += step < kSteps - kLast ? 0.0 : dot(its, its);
        }
    }
    const auto unit = static_cast<double>(world->velocity_scale());
    const double squares = sum / kLast / world->particle_velocities().size * unit * unit;
    return std::sqrt(squares / (9.81 * static_cast<double>(kDepth * def.cell_m)));
}

/// As long as only what leans by an eighth was quieted, it swayed for good at 0.015.
TEST(QuietSurfaceOf, AShallowPoolThatLeansALittleComesToRest) {
    EXPECT_LT(restless_pool(0.08), 0.001);
}

/// Without it the mean is 6.7e-5.
TEST(QuietSurfaceOf, AWholeTankComesToRest) {
    double mean = 0.0;
    for (const double tilt : {0.1, 0.3, 0.5, 0.7}) {
        mean += 0.25 * leaning_energy(tilt);
    }
    EXPECT_LT(mean, 2e-5);
}

}  // namespace
}  // namespace weir
