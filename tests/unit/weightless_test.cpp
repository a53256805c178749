// Liquid that nothing pulls at: faces that know the flow at their own place, to the surface.
#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr int kCells = 48;
constexpr float kMiddle = 0.5F * kCells;

/// A square of 16 cells, turned by 0.3, that turns about its middle, a radian a second.
template <class Real>
void pour_turning_patch(World<Real>& world) {
    const float c = std::cos(0.3F);
    const float s = std::sin(0.3F);
    for (int k = 0; k < 32 * 32; ++k) {
        const Vec2f at{(static_cast<float>(k % 32) - 15.5F) * 0.5F,
                       (static_cast<float>(k / 32) - 15.5F) * 0.5F};
        const Vec2f turned{c * at.x - s * at.y, s * at.x + c * at.y};
        const Vec2f place{kMiddle + turned.x, kMiddle + turned.y};
        ASSERT_EQ(world.add_particle(place, {-turned.y, turned.x}), Status::ok);
    }
}

template <class Real>
double energy(const World<Real>& world) {
    double sum = 0.0;
    for (const auto& v : world.particle_velocities()) {
        const auto x = static_cast<double>(v.x);
        const auto y = static_cast<double>(v.y);
        sum += x * x + y * y;
    }
    return sum;
}

/// Of its energy, in two seconds.
template <class Real>
double lost(Vec2f defined_gravity_mps2) {
    WorldDef def = tank_def(kCells, kCells, 1024);
    def.cell_m = 1.0F;
    def.gravity_mps2 = defined_gravity_mps2;
    TestWorld<Real> world(def);
    EXPECT_EQ(world->set_gravity({0.0F, 0.0F}), Status::ok);
    pour_turning_patch(*world);
    const double before = energy(*world);
    for (int step = 0; step < 64; ++step) {
        world->step(1.0F / 32.0F);
    }
    return 1.0 - energy(*world) / before;
}

WEIR_SUITE(Weightless, RoomyScalars);

TYPED_TEST(Weightless, APatchTurnsOnForLongerIfItWasDefinedSo) {
    const double as_scattered = lost<TypeParam>({0.0F, -9.81F});
    const double interpolated = lost<TypeParam>({0.0F, 0.0F});
    EXPECT_GT(interpolated, 0.0);
    EXPECT_LT(interpolated, 0.7 * as_scattered) << as_scattered;
}

}  // namespace
}  // namespace weir
