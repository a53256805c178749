// A drop that flies against a thin wall gets the blow that any solid gives: nothing brakes it before.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

struct Blow {
    double lean;       ///< of the wall
    Surface surface;
    Vec2f wall_mps{};  ///< its velocity
};

/// Velocity after a blow as the wall sees it, along it and off it, of one particle that comes with
/// (3, −8) cells/s.
template <class Real>
Vec2<double> after(const Blow& blow, const Ring& ring) {
    WorldDef def = tank_def(32, 32, 4, 1, 8);
    def.capacity.wall_edges = 400;
    def.cell_m = 1.0F;
    def.gravity_mps2 = {0, 0};
    TestWorld<Real> world(def);
    BodyDef wall = body_of(ring, {16, 16}, static_cast<float>(blow.lean));
    wall.open = ring.size() == 2;
    wall.surface = blow.surface;
    wall.motion.velocity_mps = blow.wall_mps;
    put_moving(*world, wall);
    const Vec2<double> along{std::cos(blow.lean), std::sin(blow.lean)};
    const Vec2<double> off{-along.y, along.x};
    const auto tell = [](double x, double y) {
        return Vec2f{static_cast<float>(x), static_cast<float>(y)};
    };
    const Vec2f comes = tell(3 * along.x - 8 * off.x, 3 * along.y - 8 * off.y);
    expect_ok(world->add_particle(tell(16.1 + 3 * off.x - along.x, 16.1 + 3 * off.y - along.y),
                                  {comes.x + blow.wall_mps.x, comes.y + blow.wall_mps.y}));
    for (int step = 0; step < 50; ++step) {
        world->step(1.0F / 64.0F);
    }
    const Vec2<Real> left = world->particle_velocities()[0];
    const Vec2<double> seen{
        static_cast<double>(left.x) - static_cast<double>(blow.wall_mps.x),
        static_cast<double>(left.y) - static_cast<double>(blow.wall_mps.y)};
    return {dot(seen, along), dot(seen, off)};
}

const Ring kLine = {{-10, 0}, {10, 0}};
const Ring kPlate = {{-10, -0.3F}, {10, -0.3F}, {10, 0}, {-10, 0}};
const Ring kSlab = {{-10, -4}, {10, -4}, {10, 0}, {-10, 0}};

WEIR_SUITE(ThinBlow, RoomyScalars);

/// Of a speed of 8 towards leaning and moving lines 2.7 was left when it met them.
TYPED_TEST(ThinBlow, IsThatOfAThickWall) {
    Surface elastic;
    elastic.restitution = 0.5F;
    Surface rough = elastic;
    rough.friction = 0.1F;
    Surface belt;
    belt.friction = 0.5F;
    belt.conveyor_mps = -2.0F;
    for (const double lean : some_of({0.3, 0.785, 0.0})) {
        for (const Ring& ring : {kLine, kPlate, kSlab}) {
            SCOPED_TRACE(lean);
            SCOPED_TRACE(ring.size() == 2 ? "line" : ring[0].y > -1.0F ? "plate" : "slab");
            const Vec2<double> thrown = after<TypeParam>({lean, rough}, ring);
            EXPECT_NEAR(thrown.x, 1.8, 0.01);
            EXPECT_NEAR(thrown.y, 4, 0.01);
            const Vec2<double> pushed = after<TypeParam>({lean, elastic, {1, 2}}, ring);
            EXPECT_NEAR(pushed.x, 3, 0.01);
            EXPECT_NEAR(pushed.y, 4, 0.01);
            const Vec2<double> carried = after<TypeParam>({lean, belt}, ring);
            EXPECT_NEAR(carried.x, 2, 0.01);
            EXPECT_NEAR(carried.y, 0, 0.01);
        }
    }
}

}  // namespace
}  // namespace weir
