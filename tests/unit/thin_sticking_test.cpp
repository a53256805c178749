// Viscous liquid sticks to walls of no thickness, on both of their sides.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

Ring in_cells(Ring ring) {
    for (Vec2f& vertex : ring) {
        vertex = kCell * vertex;
    }
    return ring;
}

/// A wall through the tank from side to side, a line or a plate as thin as a twentieth of a cell.
Ring wall_of(bool plate) {
    return in_cells(plate ? Ring{{-90, -0.025F}, {90, -0.025F}, {90, 0.025F}, {-90, 0.025F}}
                          : Ring{{-90, 0}, {90, 0}});
}

/// Couette flow between two walls that move against each other, 12 cells apart, above and below
/// which there is liquid, too: root of the mean square error amid the channel, over the walls' speed.
template <class Real>
float couette_error(float floor, bool plate) {
    constexpr int kLength = 60;
    constexpr float kGap = 12.0F;
    WorldDef def = tank_def(kLength, 18, 4 * kLength * 18, 2, 8);
    def.capacity.wall_edges = 3000;
    def.cell_m = kCell;
    def.gravity_mps2 = {};
    const float speed = 0.5F * kGap;  // cells/s
    def.viscosity_m2ps = 0.1F * kGap * kGap * kCell * kCell;
    def.max_substeps = 64;
    TestWorld<Real> world(def);
    const Ring wall = wall_of(plate);
    for (const float side : {-1.0F, 1.0F}) {
        BodyDef body = body_of(wall, kCell * Vec2f{30.0F - 9.0F * side,
                                                   floor + 0.5F * (1.0F + side) * kGap});
        body.open = !plate;
        body.surface.no_slip = true;
        body.motion.velocity_mps = {side * speed * kCell, 0.0F};
        put_moving(*world, body);
    }
    EXPECT_EQ(world->fill({{0, 0}, {kLength * kCell, 18 * kCell}}), Status::ok);
    for (int step = 0; step < 120; ++step) {
        world->step(1.0F / 60.0F);
    }
    float sum = 0.0F;
    int count = 0;
    for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
        const Vec2f x = convert<float>(world->particle_positions()[k]);
        const float part = (x.y - floor) / kGap;
        if (std::fabs(x.x - 30.0F) < 6.0F && part > 0.0F && part < 1.0F) {
            const float v = convert<float>(world->particle_velocities()[k]).x *
                            world->velocity_scale() / kCell;
            const float error = v - speed * (2.0F * part - 1.0F);
            sum += error * error;
            ++count;
        }
    }
    EXPECT_GT(count, 400);
    return std::sqrt(sum / static_cast<float>(count)) / speed;
}

WEIR_SUITE(ThinSticking, RoomyScalars);

/// They slipped: 0.58, all at rest. What is left is that nothing flows on the whole in rows of cells
/// whose middles lie between the walls, up to half a cell beside them.
TYPED_TEST(ThinSticking, LiquidGoesAlongWithWalls) {
    EXPECT_LT(couette_error<TypeParam>(3.0F, false), 0.02F) << "on lines of the grid";
    EXPECT_LT(couette_error<TypeParam>(3.2F, false), 0.06F);
    EXPECT_LT(couette_error<TypeParam>(2.5F, false), 0.12F) << "on lines of faces";
    EXPECT_LT(couette_error<TypeParam>(2.95F, true), 0.06F) << "plates";
}

/// How fast a whirl in a ring of 64 lines, 8 cells from the middle, comes to rest: over the slowest
/// rate of viscous liquid in a circle, ν (3.8317 / R)².
template <class Real>
float decay_over_exact() {
    constexpr float kRadius = 8.0F;
    const Vec2f middle{10.21F, 9.87F};
    WorldDef def = tank_def(20, 20, 1600, 1, 65);
    def.capacity.wall_edges = 800;
    def.cell_m = kCell;
    def.gravity_mps2 = {};
    def.viscosity_m2ps = 0.1F * kRadius * kRadius * kCell * kCell;
    def.max_substeps = 64;
    TestWorld<Real> world(def);
    Ring ring = in_cells(regular_polygon(64, kRadius));
    ring.push_back(ring.front());
    BodyDef body = body_of(ring, kCell * middle);
    body.open = true;
    body.surface.no_slip = true;
    put_static(*world, body);
    for (float y = 0.25F; y < 20.0F; y += 0.5F) {
        for (float x = 0.25F; x < 20.0F; x += 0.5F) {
            const Vec2f arm = Vec2f{x, y} - middle;
            if (length(arm) < kRadius - 0.05F) {
                expect_ok(world->add_particle(kCell * Vec2f{x, y},
                                              2.0F * kCell * Vec2f{-arm.y, arm.x}));
            }
        }
    }
    const auto spin_after = [&](int steps) {
        for (int step = 0; step < steps; ++step) {
            world->step(1.0F / 60.0F);
        }
        float sum = 0.0F;
        for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
            sum += cross(convert<float>(world->particle_positions()[k]) - middle,
                         convert<float>(world->particle_velocities()[k]));
        }
        return sum;
    };
    const float before = spin_after(30);
    const float after = spin_after(60);
    return std::log(before / after) / (0.1F * 3.8317F * 3.8317F);
}

/// It went on: 0.01.
TYPED_TEST(ThinSticking, WallsThatLeanBrakeAWhirl) {
    const float rate = decay_over_exact<TypeParam>();
    EXPECT_GT(rate, 0.8F);
    EXPECT_LT(rate, 1.1F);
}

}  // namespace
}  // namespace weir
