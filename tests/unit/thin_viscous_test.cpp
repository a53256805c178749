// Viscous liquid does not rub on what stands behind a wall of no thickness.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

/// A pool that whirls beside one at rest: speed of that over the whirl's after half a second, rms.
template <class Real>
float taken_along(bool is_floor, float viscosity_m2ps) {
    WorldDef def = tank_def(32, 32, 4096, 1, 2);
    def.capacity.wall_edges = 400;
    def.cell_m = kCell;
    def.gravity_mps2 = {0, is_floor ? 0.0F : -9.81F};
    def.viscosity_m2ps = viscosity_m2ps;
    TestWorld<Real> world(def);
    constexpr float kWall = 16.3F;
    Ring ring = is_floor ? Ring{{-5, kWall}, {40, kWall}} : Ring{{kWall, -5}, {kWall, 40}};
    for (Vec2f& vertex : ring) {
        vertex = kCell * vertex;
    }
    BodyDef line = body_of(ring, {0, 0});
    line.open = true;
    put_static(*world, line);
    const float top = is_floor ? 32.0F : 16.0F;
    const Vec2f middle = is_floor ? Vec2f{16, 8} : Vec2f{8, 8};
    const auto whirls = [&](Vec2f x) { return (is_floor ? x.y : x.x) < kWall; };
    for (float y = 0.25F; y < top; y += 0.5F) {
        for (float x = 0.25F; x < 32.0F; x += 0.5F) {
            const Vec2f arm = Vec2f{x, y} - middle;
            expect_ok(world->add_particle(kCell * Vec2f{x, y}, whirls({x, y})
                                                                   ? 0.05F * Vec2f{-arm.y, arm.x}
                                                                   : Vec2f{}));
        }
    }
    for (int step = 0; step < 30; ++step) {
        world->step(1.0F / 60.0F);
    }
    float sum[2] = {0, 0};
    int count[2] = {0, 0};
    for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
        const Vec2f v = convert<float>(world->particle_velocities()[k]);
        const int side = whirls(convert<float>(world->particle_positions()[k])) ? 0 : 1;
        sum[side] += dot(v, v);
        ++count[side];
    }
    return std::sqrt(sum[1] / static_cast<float>(count[1]) * static_cast<float>(count[0]) / sum[0]);
}

WEIR_SUITE(ThinViscous, RoomyScalars);

/// It took along 9 to 24 %.
TYPED_TEST(ThinViscous, LiquidsOnBothSidesDoNotRub) {
    for (const bool is_floor : {false, true}) {
        for (const float viscosity : {1.0e-3F, 5.0e-3F}) {
            EXPECT_LT(taken_along<TypeParam>(is_floor, viscosity), 0.03F)
                << is_floor << ' ' << viscosity;
        }
    }
}

}  // namespace
}  // namespace weir
