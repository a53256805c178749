// Particles stay apart between walls that move: those at one place are carried alike from then on,
// and the liquid loses their volume.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>
#include <vector>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

using FloatAndFixed = testing::Types<float, Fixed>;  // in double nearly nobody meets
WEIR_SUITE(ApartOf, RoomyScalars);
WEIR_SUITE(ApartInCrowdOf, FloatAndFixed);

template <class Real>
std::int32_t met(const World<Real>& world) {
    std::set<std::pair<double, double>> places;
    for (const auto& x : world.particle_positions()) {
        places.insert({static_cast<double>(x.x), static_cast<double>(x.y)});
    }
    return world.particle_positions().size - static_cast<std::int32_t>(places.size());
}

const Ring kBall = {{0.04F, 0.0F},  {0.028F, 0.028F},   {0.0F, 0.04F},  {-0.028F, 0.028F},
                    {-0.04F, 0.0F}, {-0.028F, -0.028F}, {0.0F, -0.04F}, {0.028F, -0.028F}};

/// A wheel of two thin plates pushes particles into the corners at its hub: 370 of 1,152 had met,
/// as long as they were set back to the plates themselves.
TYPED_TEST(ApartOf, ParticlesInTheCornersOfAThinWheel) {
    using Real = TypeParam;
    WorldDef def = tank_def(32, 24, 1400, 2, 8);
    def.capacity.wall_edges = 400;
    TestWorld<Real> world(def);
    const Ring plate = rectangle(0.24F, 0.01F);
    for (const float angle : {0.0F, 1.5707963F}) {
        BodyDef blade = body_of(plate, {0.32F, 0.18F}, angle);
        blade.motion.spin_radps = 3.0F;
        put_moving(*world, blade);
    }
    expect_ok(world->fill({{0.0F, 0.0F}, {0.64F, 0.18F}}));
    world.run(900);
    EXPECT_LE(met(*world), 12);
    EXPECT_GT(volume_left(*world), 0.94);
}

/// A belt under viscous packed liquid stirs it as bodies do. As long as that started no look for
/// those that had met they were 9 after two minutes, 21 after six.
TEST(ApartPacked, ParticlesOverABelt) {
    WorldDef def = tank_def(16, 16, 600);
    def.cell_m = 0.01F;
    def.viscosity_m2ps = 5.0e-3F;
    def.walls.bottom = {0.0F, 0.0F, true, 0.1F};
    TestWorld<SmallFixed> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.16F, 0.08F}}));
    world.run(120 * 60);
    EXPECT_LE(met(*world), 2);
}

/// How many have met once crates and balls were thrown in and taken out again three times.
template <class Real>
int met_among_crates(unsigned seed) {
    WorldDef def = tank_def(32, 40, 1800, 12, 120);
    def.capacity.two_way = true;
    TestWorld<Real> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.64F, 0.24F}}));
    std::mt19937 random(seed);
    const auto between = [&](float least, float most) {
        return least + (most - least) * 1e-3F * static_cast<float>(random() % 1001U);
    };
    for (int round = 0; round < 3; ++round) {
        std::vector<BodyId> bodies;
        for (int k = 0; k < 12; ++k) {
            const Ring shape = k % 3 == 0 ? kBall
                                          : rectangle(between(0.04F, 0.08F), between(0.04F, 0.08F));
            const Vec2f at{between(0.08F, 0.56F), between(0.4F, 0.7F)};
            BodyDef body = body_of(shape, at, between(0.0F, 3.0F));
            body.density_ratio = 0.6F;
            bodies.push_back(put_free(*world, body));
            world.run(20);
        }
        world.run(600);
        for (const BodyId& id : bodies) {
            expect_ok(world->remove_body(id));
        }
    }
    return met(*world);
}

/// What is between two of them is pressed by one and the other: 16 and 25 had met. Of three crowds,
/// as single ones differ by chance.
TYPED_TEST(ApartInCrowdOf, ParticlesBetweenFreeBodies) {
    int all = 0;
    for (const unsigned seed : {5U, 6U, 7U}) {
        all += met_among_crates<TypeParam>(seed);
    }
    EXPECT_LE(all, 3 * 7);
}

}  // namespace
}  // namespace weir
