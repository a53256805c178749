// Where particles beside thin bodies that move come from, and whom they pass.
#include <gtest/gtest.h>

#include "brute_distance.hpp"
#include "measure/random.hpp"
#include "solid/blow.hpp"
#include "solid/collide.hpp"
#include "solid/contour_hit.hpp"
#include "solid/moving_walls.hpp"
#include "solid/slide.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

class Plates {
public:
    explicit Plates(const Ring& cells) : world_(tank_def(32, 32, 4, 1, 16)) {
        Ring ring = cells;
        for (Vec2f& vertex : ring) {
            vertex = kCell * vertex;
        }
        put_moving(*world_, body_of(ring, {}));
    }
    Scene<float> scene() {
        Simulation<float>& simulation = state_of(world_).simulation;
        return {simulation.layers.shape, simulation.layers.walls, simulation.particles,
                simulation.contacts,     result_,                 0.01F,
                false,                   &simulation.bodies};
    }

private:
    TestWorld<float> world_;
    CollideResult<float> result_;
};

/// Nodes show a bent plate too thin or too thick. Who would be in what they show comes from beside
/// the outline, unless they show the solid there as well.
TEST(MovingWalls, WhoWasInAThinWallComesFromBesideIt) {
    const std::vector<Ring> bends = {
        {{8.2F, 8.3F}, {16.1F, 12.2F}, {24.3F, 8.4F}, {24.3F, 9.4F}, {16.1F, 13.2F}, {8.2F, 9.3F}},
        {{8.2F, 8.3F}, {9.2F, 8.3F}, {9.2F, 19.4F}, {20.3F, 19.4F}, {20.3F, 20.4F}, {8.2F, 20.4F}}};
    measure::Random random(5);
    int moved = 0;
    for (const Ring& bend : bends) {
        Plates plates(bend);
        const Scene<float> scene = plates.scene();
        std::vector<Point> ring;
        for (const Vec2f corner : bend) {
            ring.push_back(convert<double>(corner));
        }
        for (int trial = 0; trial < 40000; ++trial) {
            const Vec2<float> at{random.uniform(7.0F, 25.5F), random.uniform(7.0F, 21.5F)};
            const Vec2<float> from =
                moving_walls<float>().origin(scene, scene.bodies->body[0], at);
            if (from.x == at.x && from.y == at.y) {
                continue;
            }
            ++moved;
            EXPECT_FALSE(is_inside(scene.shape, scene.walls, from)) << at.x << ' ' << at.y;
            double off = 1.0e9;
            for (std::size_t k = 0; k < ring.size(); ++k) {
                off = std::min(off, to_segment(convert<double>(from), ring[k],
                                               ring[(k + 1) % ring.size()]));
            }
            EXPECT_LT(off, 1.01 * static_cast<double>(kClearance<float>)) << at.x << ' ' << at.y;
        }
    }
    EXPECT_GT(moved, 100);
}

/// At either end of a way, or in its middle.
TEST(MovingWalls, ABodyIsMetWhereverItIsOnTheWay) {
    Plates plates({{12.0F, 12.0F}, {13.5F, 12.0F}, {13.5F, 13.5F}, {12.0F, 13.5F}});
    const Scene<float> scene = plates.scene();
    const auto& moving = moving_walls<float>();
    EXPECT_EQ(moving.body_on_way(scene, {9.5F, 12.7F}, {12.5F, 12.7F}), 0) << "its end";
    EXPECT_EQ(moving.body_on_way(scene, {9.5F, 12.7F}, {16.5F, 12.7F}), 0) << "its middle";
    EXPECT_EQ(moving.body_on_way(scene, {12.5F, 12.7F}, {19.5F, 12.7F}), 0) << "where it began";
    EXPECT_EQ(moving.body_on_way(scene, {9.5F, 20.7F}, {16.5F, 20.7F}), kNoBody);
}

/// Seen from a plate that slides through the tank in one step, from far above, particles come from
/// as far below: there is nothing to be looked up.
TEST(MovingWalls, NobodyIsLookedForFarOutsideTheTank) {
    constexpr float kSpeed = 1990.0F;
    WorldDef def = tank_def(16, 16, 600, 1, 4);
    def.gravity_mps2 = {0.0F, 0.0F};
    def.max_substeps = 1;
    TestWorld<float> world(def);
    const Ring ring = rectangle(0.05F, 2.0F);
    BodyDef plate = body_of(ring, {0.157F, 0.16F + kSpeed});
    plate.motion.velocity_mps = {0.0F, -kSpeed};
    const BodyId id = put_moving(*world, plate);
    measure::Random random(1);
    for (int k = 0; k < 600; ++k) {
        const Vec2f at{random.uniform(0.0F, 0.31F), random.uniform(0.0F, 0.31F)};
        expect_ok(world->add_particle(at, {0.0F, 0.8F * kCell}));
    }
    EXPECT_EQ(world->step(1.0F).substeps, 1);
    EXPECT_NEAR(motion_of(*world, id).position_m.y, 0.16F, 0.01F);
    EXPECT_TRUE(all_inside(*world));
}

}  // namespace
}  // namespace weir
