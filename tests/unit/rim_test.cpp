// Which cells are asked for what the liquid does to a body: those around the nodes that it wrote,
// without the ones that are all within it.
#include <gtest/gtest.h>

#include "measure/random.hpp"
#include "solid/body_force.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

/// Of the tank's cells, those with a node in the box.
TEST(Rim, CellsOfABoxAreThoseWithANodeInIt) {
    const GridShape tank{7, 5, 9};
    const auto has = [](std::int32_t cell, std::int32_t first, std::int32_t last) {
        return cell + 1 >= first && cell <= last;
    };
    for (std::int32_t first = 0; first < 8; ++first) {
        for (std::int32_t last = first; last < 8; ++last) {
            const NodeBox across = cells_of(tank, {first, 2, last, 3});
            const NodeBox upright = cells_of(tank, {2, minimum(first, 5), 3, minimum(last, 5)});
            for (std::int32_t cell = 0; cell < 7; ++cell) {
                EXPECT_EQ(cell >= across.i0 && cell <= across.i1, has(cell, first, last));
            }
            for (std::int32_t cell = 0; cell < 5; ++cell) {
                EXPECT_EQ(cell >= upright.j0 && cell <= upright.j1,
                          has(cell, minimum(first, 5), minimum(last, 5)));
            }
        }
    }
}

/// A cell with any open face has a pressure.
TEST(Rim, ShutIsWhatHasNoOpenFace) {
    const GridShape tank{1, 1, 3};
    const std::int32_t cell = tank.index(0, 0);
    for (std::uint32_t open = 0; open < 16; ++open) {
        std::vector<float> u(9);
        std::vector<float> v(9);
        const auto share = [&](std::uint32_t bit) { return (open & bit) != 0 ? 0.01F : 0.0F; };
        u[static_cast<std::size_t>(cell)] = share(1);
        u[static_cast<std::size_t>(cell + 1)] = share(2);
        v[static_cast<std::size_t>(cell)] = share(4);
        v[static_cast<std::size_t>(cell + tank.stride)] = share(8);
        Walls<float> walls;
        walls.open_u = u.data();
        walls.open_v = v.data();
        EXPECT_EQ(is_shut(tank, walls, cell), open == 0) << open;
    }
}

struct Closed {
    Vec2<double> outward{};
    double turn = 0.0;

    void add(const ClosedFace<float>& face) {
        const Vec2<double> way = convert<double>(face.outward);
        outward = outward + way;
        const Vec2<double> at = convert<double>(face.centre);
        turn += at.x * way.y - at.y * way.x;
    }
};

/// What two bodies that overlap close of all cells they close of those at their rims.
TEST(Rim, HoldsAllThatABodyCloses) {
    WorldDef def = tank_def(24, 24, 4, 2, 12);
    def.capacity.two_way = true;
    measure::Random random(5);
    std::int32_t within = 0;
    for (int pose = 0; pose < 60; ++pose) {
        TestWorld<float> world(def);
        const float middle = random.uniform(0.22F, 0.26F);
        put_free(*world, body_of(rectangle(0.16F, 0.12F), {0.16F, middle},
                                 random.uniform(-3.0F, 3.0F)));
        put_free(*world, body_of(rectangle(0.14F, 0.16F), {random.uniform(0.26F, 0.32F), middle},
                                 random.uniform(-3.0F, 3.0F)));
        world->step(0.0F);
        const auto& simulation = state_of(world).simulation;
        const GridShape& s = simulation.layers.shape;
        const Walls<float>& walls = simulation.layers.walls;
        Closed of_all[2];
        Closed at_rim[2];
        for (std::int32_t j = 0; j < s.ny; ++j) {
            for (std::int32_t i = 0; i < s.nx; ++i) {
                for_each_closed_face(s, walls, i, j, [&](const ClosedFace<float>& face) {
                    if (face.slot != kNoBody) {
                        of_all[face.slot].add(face);
                    }
                });
            }
        }
        for (std::uint16_t slot = 0; slot < 2; ++slot) {
            std::int32_t cells = 0;
            for_each_rim(s, walls, slot, [&](std::int32_t i, std::int32_t j, std::int32_t) {
                for_each_closed_face(s, walls, i, j, [&](const ClosedFace<float>& face) {
                    if (face.slot == slot) {
                        at_rim[slot].add(face);
                    }
                });
                --cells;
            });
            for_each_cut(s, walls, slot,
                         [&](std::int32_t, std::int32_t, std::int32_t) { ++cells; });
            within += cells;
            EXPECT_NEAR(at_rim[slot].outward.x, of_all[slot].outward.x, 1.0e-4) << pose;
            EXPECT_NEAR(at_rim[slot].outward.y, of_all[slot].outward.y, 1.0e-4) << pose;
            EXPECT_NEAR(at_rim[slot].turn, of_all[slot].turn, 1.0e-3) << pose;
        }
    }
    EXPECT_GT(within, 1000) << "what is passed over is worth it";
}

}  // namespace
}  // namespace weir
