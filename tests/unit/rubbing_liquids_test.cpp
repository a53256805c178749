// Two liquids that flow past each other: what one loses the other gains, as nothing else takes it.
// Units here: a cell of 1 m, gravity 1 m/s².
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr std::int32_t kWide = 16;
constexpr float kFast = 0.3F;  ///< m/s
constexpr float kDt = 0.2F;

/// A tank without ends, 16 × 16 cells, full: 8 rows of the first liquid below 8 of the second.
WorldDef layers_def(float ratio, float viscosity) {
    WorldDef def = tank_def(kWide, kWide, 4 * kWide * kWide, 0, 0);
    def.capacity.second_liquid = true;
    def.second_density_ratio = ratio;
    def.cell_m = 1.0F;
    def.gravity_mps2 = {0, -1.0F};
    def.viscosity_m2ps = viscosity;
    def.periodic_x = true;
    return def;
}

template <class Real>
class Layers : public TestWorld<Real> {
public:
    explicit Layers(const WorldDef& def)
        : TestWorld<Real>(def), ratio_(static_cast<double>(def.second_density_ratio)) {
        expect_ok((**this).fill({{0, 0}, {16, 8}}));
        expect_ok((**this).fill({{0, 8}, {16, 16}}, nullptr, Liquid::second));
    }
    void run(double time_s) {
        for (double t = 0; t < time_s;) {
            t += static_cast<double>((**this).step(kDt).dt_s);
        }
    }
    void set_off(Liquids which) {
        expect_ok((**this).stir({{0, 0}, {16, 16}}, {kFast, 0}, 1.0F, which));
    }
    /// Sum of a function of each particle's mass and velocity along the layers.
    template <class Of>
    double sum(const Of& of) const {
        const World<Real>& world = **this;
        const auto scale = static_cast<double>(world.velocity_scale());
        double all = 0;
        for (std::int32_t k = 0; k < world.particle_positions().size; ++k) {
            const bool second = world.particle_kinds()[k] == Liquid::second;
            const auto u = static_cast<double>(world.particle_velocities()[k].x);
            all += of(second ? ratio_ : 1.0, scale * u);
        }
        return all;
    }
    double mass() const {
        return sum([](double m, double) { return m; });
    }
    double momentum() const {
        return sum([](double m, double u) { return m * u; });
    }
    double energy() const {
        return sum([](double m, double u) { return 0.5 * m * u * u; });
    }
    /// Of what is within half a cell of a height.
    double speed_at(double height) const {
        const World<Real>& world = **this;
        double all = 0;
        int count = 0;
        for (std::int32_t k = 0; k < world.particle_positions().size; ++k) {
            if (std::abs(static_cast<double>(world.particle_positions()[k].y) - height) < 0.5) {
                all += static_cast<double>(world.particle_velocities()[k].x);
                ++count;
            }
        }
        return all / count * static_cast<double>(world.velocity_scale());
    }

private:
    double ratio_;
};

WEIR_SUITE(RubbingLiquidsOf, RoomyScalars);

/// A moving layer takes the other along until both go at the speed of their centre of mass: 0.56 of
/// the momentum was left where the upper one is a tenth as heavy, each having lost what the other
/// would have had to lose.
TYPED_TEST(RubbingLiquidsOf, GoAsTheirMassesTell) {
    for (const float ratio : {0.5F, 0.1F}) {
        Layers<TypeParam> layers(layers_def(ratio, 0.5F));
        layers.set_off(Liquids::first);
        const double before = layers.momentum();
        layers.run(250);
        EXPECT_NEAR(layers.momentum() / before, 1.0, 0.005) << ratio;
        const double together = before / layers.mass();
        EXPECT_NEAR(layers.speed_at(2.0), together, 0.02 * together) << ratio;
        EXPECT_NEAR(layers.speed_at(14.0), together, 0.03 * together) << ratio;
    }
}

/// Between a floor that stands still and a ceiling that moves both bear the same shear, so that the
/// lighter one is sheared the more. It was one straight line.
TEST(RubbingLiquids, BearTheSameShear) {
    for (const float ratio : {0.5F, 0.1F}) {
        WorldDef def = layers_def(ratio, 1.0F);
        def.walls = every_wall({0, 0, true, 0});
        def.walls.top.conveyor_mps = -kFast;
        Layers<float> layers(def);
        layers.run(1200);
        const auto fast = static_cast<double>(kFast);
        const double between = fast * static_cast<double>(ratio / (1.0F + ratio));
        for (int row = 0; row < kWide; ++row) {
            const double y = row + 0.5;
            const double expected =
                y < 8 ? between * y / 8 : between + (fast - between) * (y - 8) / 8;
            EXPECT_NEAR(layers.speed_at(y), expected, 0.02 * fast) << ratio << ", row " << row;
        }
    }
}

/// Without viscosity a stream keeps its momentum and loses energy: it had gained 8 and 4 % over the
/// lighter liquid, at half its density, and lost 16 % beneath the heavier one.
TYPED_TEST(RubbingLiquidsOf, PassEachOther) {
    for (const Liquids moving : {Liquids::first, Liquids::second}) {
        Layers<TypeParam> layers(layers_def(0.5F, 0.0F));
        layers.set_off(moving);
        const double momentum = layers.momentum();
        double energy = layers.energy();
        for (int k = 0; k < 8; ++k) {
            layers.run(25);
            EXPECT_NEAR(layers.momentum() / momentum, 1.0, 0.01) << 25 * (k + 1);
            EXPECT_LT(layers.energy(), energy) << 25 * (k + 1);
            energy = layers.energy();
        }
    }
}

/// A disc that turns in the second liquid is braked by its density times as much.
TYPED_TEST(RubbingLiquidsOf, BrakeABodyByTheirDensity) {
    const Ring disc = regular_polygon(24, 5.0F);
    const auto torque = [&](Liquid kind) {
        WorldDef def = layers_def(4.0F, 1.0F);
        def.periodic_x = false;
        def.capacity.bodies = 1;
        def.capacity.vertices = 24;
        def.capacity.two_way = true;
        TestWorld<TypeParam> world(def);
        BodyDef body = body_of(disc, {8, 8});
        body.motion.spin_radps = 0.05F;
        body.surface.no_slip = true;
        const BodyId id = put_moving(*world, body);
        expect_ok(world->fill({{0, 0}, {16, 16}}, nullptr, kind));
        double sum = 0;
        for (int step = 0; step < 100; ++step) {
            world->step(kDt);
            BodyForce force;
            expect_ok(world->force(id, &force));
            sum += static_cast<double>(force.angular_impulse_m4ps);
        }
        return sum;
    };
    EXPECT_NEAR(torque(Liquid::second) / torque(Liquid::first), 4.0, 0.02);
}

}  // namespace
}  // namespace weir
