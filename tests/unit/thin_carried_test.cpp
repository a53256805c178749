// A cup of thin walls that leans and is carried along steadily: its liquid goes with it, at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kHalfWidth = 6.13F;  ///< cells
constexpr float kLean = 0.3F;        ///< rad
constexpr float kDepth = 10.0F;      ///< of its liquid in the middle, along its walls, cells

struct Carried {
    float height = 0.0F;   ///< of the liquid's mean place, over what it is at rest
    float stirred = 0.0F;  ///< rms speed relative to the cup over the cup's
};

/// After so many seconds at that speed.
template <class Real>
Carried carried(float speed_mps, int seconds) {
    WorldDef def = tank_def(160, 24, 600, 1, 4);
    def.capacity.wall_edges = 400;
    def.cell_m = kCell;
    TestWorld<Real> world(def);
    Ring ring = {{-kHalfWidth, 14}, {-kHalfWidth, 0}, {kHalfWidth, 0}, {kHalfWidth, 14}};
    for (Vec2f& vertex : ring) {
        vertex = kCell * vertex;
    }
    const Vec2f from = kCell * Vec2f{speed_mps > 0.0F ? 14.3F : 145.3F, 5.4F};
    BodyDef cup = body_of(ring, from, kLean);
    cup.open = true;
    cup.motion.velocity_mps = {speed_mps, 0};
    const BodyId id = put_moving(*world, cup);
    const float c = std::cos(kLean);
    const float s = std::sin(kLean);
    for (float x = -5.75F; x < kHalfWidth; x += 0.5F) {
        for (float y = 0.25F; y < kDepth - std::tan(kLean) * x; y += 0.5F) {
            expect_ok(world->add_particle(from + kCell * Vec2f{c * x - s * y, s * x + c * y},
                                          cup.motion.velocity_mps));
        }
    }
    for (int step = 0; step < 60 * seconds; ++step) {
        world->step(1.0F / 60.0F);
    }
    Motion now;
    expect_ok(world->motion(id, &now));
    Carried sum;
    const auto count = static_cast<float>(world->particle_positions().size);
    const float width = 2.0F * kHalfWidth;
    const float depth = 0.25F * count / width;
    const float tangent = std::tan(kLean);
    const float across = -tangent * width * width / (12.0F * depth);
    const float at_rest = s * across + 0.5F * c * (depth - tangent * across);
    for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
        const Vec2f x = convert<float>(world->particle_positions()[k]);
        const Vec2f v = convert<float>(world->particle_velocities()[k]);
        sum.height += (x.y - now.position_m.y / kCell) / (count * at_rest);
        const Vec2f past = kCell * v - now.velocity_mps;
        sum.stirred += dot(past, past) / count;
    }
    return {sum.height, std::sqrt(sum.stirred) / std::fabs(speed_mps)};
}

WEIR_SUITE(ThinCarried, RoomyScalars);

/// It had 0.88 of its height one way, 1.12 the other way, and went at 0.42 and 0.49 of the cup's
/// speed in it.
TYPED_TEST(ThinCarried, LiquidRestsInALeaningCup) {
    for (const float speed : {0.14F, -0.14F}) {
        const Carried liquid = carried<TypeParam>(speed, 5);
        EXPECT_NEAR(liquid.height, 1.0F, 0.05F) << speed;
        EXPECT_LT(liquid.stirred, 0.1F) << speed;
    }
}

}  // namespace
}  // namespace weir
