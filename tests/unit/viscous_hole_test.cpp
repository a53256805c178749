// No hole opens in viscous liquid where it is pressed.
#include <gtest/gtest.h>

#include <cmath>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kHeight = 16.0F;
const float kLean = std::tan(20.0F / 57.3F);

/// From the wall's middle line, cells along x.
float beyond_wall(Vec2f x) {
    return x.x - (20.3F - kLean * (x.y - 8.0F));
}

/// A line of no thickness that leans to the left, or a slab.
template <class Real>
void put_wall(World<Real>& world, bool is_line) {
    const float half = is_line ? 0.0F : 1.5F * std::sqrt(1.0F + kLean * kLean);
    const auto at = [&](float y, float aside) {
        return kCell * Vec2f{20.3F - kLean * (y - 8.0F) + aside, y};
    };
    Ring ring = is_line ? Ring{at(-5, 0), at(40, 0)}
                        : Ring{at(-5, -half), at(-5, half), at(40, half), at(40, -half)};
    BodyDef wall = body_of(ring, {0, 0});
    wall.open = is_line;
    put_static(world, wall);
}

/// A pool that is stirred and one at rest on both sides of a wall.
template <class Real>
void fill_sides(World<Real>& world, float free) {
    for (float y = 0.25F; y < kHeight; y += 0.5F) {
        for (float x = 0.25F; x < 40.0F; x += 0.5F) {
            const float beyond = beyond_wall({x, y});
            if (std::fabs(beyond) >= free) {
                const Vec2f whirl = 0.05F * Vec2f{8.0F - y, x - 10.0F};
                expect_ok(world.add_particle(kCell * Vec2f{x, y}, beyond < 0 ? whirl : Vec2f{}));
            }
        }
    }
}

/// Of the liquid beyond the wall, m/s, rms.
template <class Real>
float speed_beyond(const World<Real>& world) {
    float sum = 0.0F;
    int count = 0;
    for (std::int32_t k = 0; k < world.particle_positions().size; ++k) {
        const Vec2f x = convert<float>(world.particle_positions()[k]);
        if (beyond_wall(x) > 0.0F) {
            const Vec2f v = convert<float>(world.particle_velocities()[k]);
            sum += dot(v, v);
            ++count;
        }
    }
    return kCell * std::sqrt(sum / static_cast<float>(count));
}

/// What the pool at rest gains in a step at most, m/s. 1/6 s is for it to settle.
template <class Real>
float largest_jolt(bool is_line, float viscosity_m2ps) {
    WorldDef def = tank_def(40, 20, 4000, 1, 4);
    def.capacity.wall_edges = is_line ? 2000 : 0;
    def.cell_m = kCell;
    def.viscosity_m2ps = viscosity_m2ps;
    TestWorld<Real> world(def);
    put_wall(*world, is_line);
    fill_sides(*world, is_line ? 0.1F : 1.7F);
    float before = 1.0F;
    float most = 0.0F;
    for (int step = 0; step < 300; ++step) {
        world->step(1.0F / 60.0F);
        const float now = speed_beyond(*world);
        most = step < 10 ? 0.0F : std::fmax(most, now - before);
        before = now;
    }
    return most;
}

WEIR_SUITE(ViscousHole, RoomyScalars);

/// The stirred pool's particles thin out beside the wall. Cells that lie side by side there were
/// air at times: both pools lost most of their pressure for a substep, and got up to 0.045 m/s.
TYPED_TEST(ViscousHole, DoesNotTakeThePressureOffAPool) {
    for (const bool is_line : {false, true}) {
        for (const float viscosity : some_of({5.0e-3F, 1.0e-3F})) {
            EXPECT_LT(largest_jolt<TypeParam>(is_line, viscosity), 0.001F)
                << is_line << ' ' << viscosity;
        }
    }
}

}  // namespace
}  // namespace weir
