// A single particle that meets a wall flies on mirrored, however thin the sliver of a cell is that
// it flies through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr double kPi = 3.14159265358979;
const Vec2<double> kOnWall{16.13, 15.71};  // cells

/// A wall whose face goes through the tank's middle, with that normal.
template <class Real>
void add_wall(TestWorld<Real>& world, Vec2<double> n) {
    const Vec2<double> side = 64.0 * Vec2<double>{-n.y, n.x};
    const Vec2<double> depth = 64.0 * n;
    Ring ring;
    for (const Vec2<double> corner : {side, side - depth, -1.0 * side - depth, -1.0 * side}) {
        ring.push_back(convert<float>(static_cast<double>(kCell) * (kOnWall + corner)));
    }
    BodyDef body = body_of(ring, {0, 0});
    body.surface.restitution = 1.0F;
    put_static(*world, body);
}

/// Error of the velocity with which a particle leaves, of its speed: 16 cells/s, from 6 cells off.
template <class Real>
double turned(Vec2<double> n, double incidence) {
    WorldDef def = small_def();
    def.capacity.cells_x = 32;
    def.capacity.cells_y = 32;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    def.gravity_mps2 = {0, 0};
    TestWorld<Real> world(def);
    add_wall(world, n);
    const Vec2<double> along{-n.y, n.x};
    const Vec2<double> v = std::sin(incidence) * along - std::cos(incidence) * n;
    const Vec2<double> from = kOnWall - 6.0 * v;
    const auto metre = static_cast<double>(kCell);
    EXPECT_EQ(world->add_particle(convert<float>(metre * from), convert<float>(16.0 * metre * v)),
              Status::ok);
    for (int step = 0; step < 48; ++step) {
        world->step(1.0F / 60.0F);
    }
    const auto left = convert<double>(world->particle_velocities()[0]);
    return length((1.0 / 16.0) * left - (v - 2.0 * dot(v, n) * n));
}

using Scalars = testing::Types<float, Fixed, SmallFixed>;
WEIR_SUITE(Sliver, Scalars);

TYPED_TEST(Sliver, DoesNotTurnASingleParticle) {
    double worst = 0.0;
    for (int k = 0; k < 36; ++k) {
        const double a = k * kPi / 18.0;
        for (const double incidence : {0.0, 0.5, 1.0}) {
            worst = std::max(worst, turned<TypeParam>({std::cos(a), std::sin(a)}, incidence));
        }
    }
    EXPECT_LT(worst, 0.01);
}

}  // namespace
}  // namespace weir
