// Nothing rubs on a surface: the stress there is none, whatever turns.
#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kRadius = 12.0F;
constexpr float kViscosity = 8.0F;

template <class Real>
double angular_momentum(const World<Real>& world, double middle) {
    double sum = 0.0;
    for (std::int32_t k = 0; k < world.particle_positions().size; ++k) {
        const auto& x = world.particle_positions()[k];
        const auto& v = world.particle_velocities()[k];
        sum += (static_cast<double>(x.x) - middle) * static_cast<double>(v.y) -
               (static_cast<double>(x.y) - middle) * static_cast<double>(v.x);
    }
    return sum;
}

/// Share of its angular momentum that a drop keeps which turns without weight, by so little that it
/// stays round, for half of R²/4ν. If each component by itself were diffused within it, it were
/// e^−½.
template <class Real>
double spin_kept() {
    constexpr int kCells = 40;
    constexpr float kMiddle = 0.5F * kCells;
    WorldDef def = tank_def(kCells, kCells, 2000);
    def.cell_m = 1.0F;
    def.gravity_mps2 = {0.0F, 0.0F};
    def.viscosity_m2ps = kViscosity;
    def.top_speed_mps = 4.0F;
    TestWorld<Real> world(def);
    for (float y = -kRadius + 0.25F; y < kRadius; y += 0.5F) {
        for (float x = -kRadius + 0.25F; x < kRadius; x += 0.5F) {
            if (x * x + y * y < kRadius * kRadius) {
                expect_ok(world->add_particle({kMiddle + x, kMiddle + y}, {-0.05F * y, 0.05F * x}));
            }
        }
    }
    const double before = angular_momentum(*world, 0.5 * kCells);
    const auto steps = static_cast<int>(0.5F * kRadius * kRadius / (4.0F * kViscosity) * 32.0F);
    for (int step = 0; step < steps; ++step) {
        world->step(1.0F / 32.0F);
    }
    return angular_momentum(*world, 0.5 * kCells) / before;
}

/// Mean speed of a film of 8 cells that runs down a floor without slip, over Nusselt's.
template <class Real>
double film_speed() {
    constexpr int kColumns = 16;
    constexpr float kDepth = 8.0F;
    WorldDef def = tank_def(kColumns, 16, kColumns * 8 * 4);
    def.cell_m = 1.0F;
    def.periodic_x = true;
    def.gravity_mps2 = {0.02F, -1.0F};
    def.viscosity_m2ps = 1.0F;
    def.walls.bottom.no_slip = true;
    TestWorld<Real> world(def);
    const float mean = def.gravity_mps2.x * kDepth * kDepth / (3.0F * def.viscosity_m2ps);
    for (float y = 0.25F; y < kDepth; y += 0.5F) {
        const float rise = y / kDepth;
        for (float x = 0.25F; x < kColumns; x += 0.5F) {
            expect_ok(world->add_particle({x, y}, {1.5F * mean * rise * (2.0F - rise), 0.0F}));
        }
    }
    double sum = 0.0;
    for (int step = 0; step < 2000; ++step) {
        world->step(0.1F);
        for (const auto& v : world->particle_velocities()) {
            sum += step >= 1500 ? static_cast<double>(v.x) : 0.0;
        }
    }
    return sum / (500.0 * world->particle_velocities().size) / static_cast<double>(mean);
}

WEIR_SUITE(ViscousDrop, EveryScalar);

TYPED_TEST(ViscousDrop, KeepsItsSpin) {
    EXPECT_NEAR(spin_kept<TypeParam>(), 0.95, 0.05);
}

WEIR_SUITE(ViscousFilm, RoomyScalars);

TYPED_TEST(ViscousFilm, RunsAsFastAsNusselts) {
    EXPECT_NEAR(film_speed<TypeParam>(), 1.0, 0.035);
}

}  // namespace
}  // namespace weir
