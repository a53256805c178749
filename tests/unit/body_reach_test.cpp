// What a free body's turn pushes through a face ends on the body's own outline.
#include <gtest/gtest.h>

#include "brute_distance.hpp"
#include "measure/random.hpp"
#include "solid/body_reach.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

/// So thin that the lines on which its edges lie pass near others.
const Ring kHook = {{0.0F, 0.0F},     {0.09F, 0.0F},    {0.09F, 0.014F},
                    {0.014F, 0.014F}, {0.014F, 0.09F}, {0.0F, 0.09F}};

/// The way from one end of a piece of outline to the other, as its pushes about several centres
/// tell.
Vec2<float> piece_of(const BodyTable<float>& table, const Walls<float>& walls,
                     const ClosedFace<float>& face) {
    BodyLoad<float>& load = table.load[face.slot];
    const Vec2<float> centre = load.at;
    const auto about = [&](Vec2<float> at) {
        load.at = at;
        return reach_of_face(table, walls, face).angular;
    };
    const float here = about(face.centre);
    const Vec2<float> way{here - about(face.centre + Vec2<float>{1.0F, 0.0F}),
                          here - about(face.centre + Vec2<float>{0.0F, 1.0F})};
    load.at = centre;
    const bool turns_right = face.outward.x > 0.0F || face.outward.y < 0.0F;
    return turns_right ? Vec2<float>{} - way : way;
}

/// Where one end of a face is in the solid, that is an end of the piece; the other one is where the
/// outline is.
TEST(BodyReach, PiecesEndOnTheOutline) {
    WorldDef def = tank_def(13, 13, 4, 1, 6);
    def.capacity.two_way = true;
    std::int32_t looked_at = 0;
    measure::Random random(11);
    for (int pose = 0; pose < 100; ++pose) {
        const float angle = random.uniform(-3.0F, 3.0F);
        const Vec2f at{random.uniform(0.12F, 0.14F), random.uniform(0.12F, 0.14F)};
        TestWorld<float> world(def);
        const BodyId id = put_free(*world, body_of(kHook, at, angle));
        world->step(0.0F);
        const std::vector<Point> ring = placed(kHook, motion_of(*world, id));
        const auto& simulation = state_of(world).simulation;
        const GridShape& s = simulation.layers.shape;
        const Walls<float>& walls = simulation.layers.walls;
        const auto look = [&](const ClosedFace<float>& face) {
            const bool first_inside = walls.distance[face.node] < 0.0F;
            if (first_inside == (walls.distance[face.next] < 0.0F)) {
                return;
            }
            const bool upright = (face.bit & 3) != 0;
            const Vec2<float> half = upright ? Vec2<float>{0.0F, 0.5F} : Vec2<float>{0.5F, 0.0F};
            const Vec2<float> way = piece_of(simulation.bodies, walls, face);
            const Vec2<float> end = first_inside ? face.centre - half + way
                                                 : face.centre + half - way;
            double off = 1.0e9;
            for (std::size_t k = 0; k < ring.size(); ++k) {
                off = std::min(off, to_segment(convert<double>(end), ring[k],
                                               ring[(k + 1) % ring.size()]));
            }
            EXPECT_LT(off, 1.0e-4) << end.x << ' ' << end.y << " turned by " << angle;
            ++looked_at;
        };
        for (std::int32_t j = 0; j < s.ny; ++j) {
            for (std::int32_t i = 0; i < s.nx; ++i) {
                for_each_closed_face(s, walls, i, j, look);
            }
        }
    }
    EXPECT_GT(looked_at, 2000);
}

}  // namespace
}  // namespace weir
