// Free bodies that the grid shows in part, or not at all, float and sink as their density has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr float kCell = 0.005F;
constexpr float kLevel = 20 * kCell;

WorldDef pool_def(std::int32_t wall_edges) {
    WorldDef def = tank_def(48, 40, 4096, 3, 16);
    def.capacity.two_way = true;
    def.capacity.wall_edges = wall_edges;
    def.cell_m = kCell;
    return def;
}

struct Way {
    float last = 0.0F;    ///< height at the end, mean of a second, cells over the level
    float highest = 0.0F;
    float angle = 0.0F;   ///< at the end
};

/// A body in the middle of a pool, released, for so many steps.
template <class Real>
Way release_ring(const Ring& outline, float density, float offset, std::int32_t wall_edges,
                 int steps) {
    TestWorld<Real> world{pool_def(wall_edges)};
    BodyDef body = body_of(outline, {(24 + offset) * kCell, 10 * kCell});
    body.density_ratio = density;
    const BodyId id = put_free(*world, body);
    expect_ok(world->fill({{0, 0}, {48 * kCell, kLevel}}));
    Way way;
    way.highest = -100;
    for (int step = 0; step < steps; ++step) {
        world->step(kDt);
        Motion motion;
        expect_ok(world->motion(id, &motion));
        const float over = (motion.position_m.y - kLevel) / kCell;
        way.highest = std::max(way.highest, over);
        way.last += step >= steps - 60 ? over / 60 : 0;
        way.angle = motion.angle_rad;
    }
    return way;
}

template <class Real>
Way release(Vec2f cells, float density, float offset, std::int32_t wall_edges, int steps) {
    return release_ring<Real>(rectangle(cells.x * kCell, cells.y * kCell), density, offset,
                              wall_edges, steps);
}

WEIR_SUITE(Immersion, RoomyScalars);

/// However it lies to the grid's lines: they sank, or hung in the water, below two cells.
TYPED_TEST(Immersion, SmallSquaresOfHalfTheDensityFloat) {
    for (const float size : some_of({0.5F, 1.0F, 1.6F})) {
        for (const float offset : some_of({0.0F, 0.3F})) {
            const Way way = release<TypeParam>({size, size}, 0.5F, offset, 0, 180);
            EXPECT_NEAR(way.last, 0.0F, 0.6F) << size << " cells, " << offset;
            EXPECT_LT(way.highest, 2.0F) << size << " cells, " << offset;
        }
    }
}

/// Planks, with room for thin walls and without, lie flat in the surface.
TYPED_TEST(Immersion, PlanksFloat) {
    for (const float thick : some_of({0.2F, 0.5F, 1.0F, 1.4F})) {
        for (const std::int32_t wall_edges : some_of({0, 300})) {
            const Way way = release<TypeParam>({8.0F, thick}, 0.5F, 0.3F, wall_edges, 180);
            EXPECT_NEAR(way.last, 0.0F, 0.8F) << thick << ", " << wall_edges;
            EXPECT_NEAR(way.angle, 0.0F, 0.2F) << thick << ", " << wall_edges;
        }
    }
}

/// As heavy as a stone they sink to the floor, as light as cork they stay in the surface.
TYPED_TEST(Immersion, StonesSinkAndCorksStay) {
    for (const float size : some_of({0.5F, 1.0F})) {
        const Way stone = release<TypeParam>({size, size}, 3.0F, 0.3F, 0, 180);
        EXPECT_NEAR(stone.last, 0.5F * size - 20, 0.3F) << size;
        const Way cork = release<TypeParam>({size, size}, 0.05F, 0.3F, 0, 240);
        EXPECT_NEAR(cork.last, 0.5F * size + 0.3F, 0.9F) << size;
        EXPECT_LT(cork.highest, 3.0F) << size;
    }
}

/// What is shown in full is moved by the pressure alone. Half of it has left the pool, whose level
/// fell by half a cell.
TYPED_TEST(Immersion, LeavesLargeBodiesAlone) {
    const Way way = release<TypeParam>({8.0F, 6.0F}, 0.5F, 0.3F, 0, 240);
    EXPECT_NEAR(way.last, -0.5F, 0.15F);
}

/// What lifts squares that stand on each other in a pool, besides the pressure, over their weight.
template <class Real>
std::vector<double> lifts_of(std::size_t squares, Vec2f cells, float density, float height) {
    TestWorld<Real> world{pool_def(0)};
    const Ring ring = rectangle(cells.x * kCell, cells.y * kCell);
    for (std::size_t k = 0; k < squares; ++k) {
        const float middle = height + cells.y * (0.5F + static_cast<float>(k));
        BodyDef body = body_of(ring, {24.3F * kCell, middle * kCell});
        body.density_ratio = density;
        put_free(*world, body);
    }
    expect_ok(world->fill({{0, 0}, {48 * kCell, kLevel}}));
    EXPECT_EQ(world->step(kDt / 4).substeps, 1);
    const auto& simulation = state_of(world).simulation;
    std::vector<double> lifts;
    for (std::size_t k = 0; k < squares; ++k) {
        const BodyLoad<Real>& load = simulation.bodies.load[k];
        const double fall = 9.81 / static_cast<double>(kCell) * static_cast<double>(kDt / 4);
        lifts.push_back(static_cast<double>(load.blows.linear.y) /
                        (static_cast<double>(load.mass) * fall));
    }
    return lifts;
}

/// Of light bodies corners matter less.
TYPED_TEST(Immersion, CornersLiftHalfAWeightAtMost) {
    EXPECT_NEAR(lifts_of<TypeParam>(1, {3.0F, 3.0F}, 0.02F, 8.0F)[0], 0.5, 0.01);
}

/// Under what lies on the floor a film closes what cells show. That is without the corners, too.
TYPED_TEST(Immersion, CornersAreLiftedOverFilms) {
    constexpr double kCorners = 4.0 / 8.0;
    const double lift = lifts_of<TypeParam>(1, {8.0F, 2.0F}, 1.3F, 0.0F)[0];
    EXPECT_NEAR(lift, kCorners / (1.3 * 16.0), 0.001);
}

/// Which part of a cell is whose is a guess, also where what they share is a line of the grid.
TYPED_TEST(Immersion, CellsThatBodiesShareLiftNobody) {
    for (const float size : {1.5F, 2.0F, 2.4F, 3.0F}) {
        EXPECT_EQ(lifts_of<TypeParam>(3, {size, size}, 1.1F, 0.0F), std::vector<double>(3, 0.0))
            << size << " cells";
    }
}

/// Nearly as heavy as the liquid, they rise from the deep to where they float: they hovered, or sank.
TYPED_TEST(Immersion, BallsNearlyAsDenseAsTheLiquidRise) {
    for (const float radius : some_of({1.0F, 1.5F})) {
        for (const float density : some_of({0.9F, 0.95F})) {
            const Ring ball = regular_polygon(12, radius * kCell);
            const Way way = release_ring<TypeParam>(ball, density, 0.3F, 0, 600);
            EXPECT_NEAR(way.last, -0.9F * radius, 0.4F) << radius << " cells, " << density;
        }
    }
}

/// Mean spin, rad/s, of a ball that floats for ten seconds more, after ten.
template <class Real>
float spin_of_ball(int corners, float density, float place) {
    constexpr int kSteps = 600;
    WorldDef def = pool_def(0);
    def.capacity.cells_x = def.capacity.cells_y = 16;
    def.capacity.vertices = 24;
    TestWorld<Real> world{def};
    const Ring outline = regular_polygon(corners, 2.0F * kCell);
    BodyDef body = body_of(outline, {place * kCell, 8 * kCell});
    body.density_ratio = density;
    const BodyId id = put_free(*world, body);
    expect_ok(world->fill({{0, 0}, {16 * kCell, 8 * kCell}}));
    float spin = 0.0F;
    for (int step = -kSteps; step < kSteps; ++step) {
        world->step(kDt);
        Motion motion;
        expect_ok(world->motion(id, &motion));
        spin += step < 0 ? 0.0F : std::abs(motion.spin_radps) / kSteps;
    }
    return spin;
}

/// Pressure acts through the centre of what is round: nothing turns it. They spun at 50 to 100 rad/s
/// in liquid at rest, for ever. Of two places, as what little turns a single one is chance.
TYPED_TEST(Immersion, NothingTurnsBalls) {
    for (const float density : some_of({0.5F, 0.8F})) {
        for (const int corners : some_of({12, 24})) {
            const float spins = spin_of_ball<TypeParam>(corners, density, 7.7F) +
                                spin_of_ball<TypeParam>(corners, density, 8.0F);
            EXPECT_LT(spins / 2, 8.0F) << corners << " corners, " << density;
        }
    }
}

/// It goes on from a snapshot to the bit.
TYPED_TEST(Immersion, GoesOnFromASnapshot) {
    const WorldDef def = pool_def(0);
    TestWorld<TypeParam> world{def};
    const Ring box = rectangle(8 * kCell, 0.5F * kCell);
    put_free(*world, body_of(box, {24 * kCell, 18 * kCell}));
    expect_ok(world->fill({{0, 0}, {20 * kCell, kLevel}}));
    for (int step = 0; step < 20; ++step) {
        world->step(kDt);
    }
    std::vector<std::byte> kept(snapshot_bytes<TypeParam>(def.capacity));
    expect_ok(world->save(kept.data(), kept.size()));
    TestWorld<TypeParam> twin{def};
    expect_ok(twin->restore(kept.data(), kept.size()));
    for (int step = 0; step < 20; ++step) {
        world->step(kDt);
        twin->step(kDt);
        ASSERT_EQ(world->state_hash(), twin->state_hash()) << step;
    }
}

}  // namespace
}  // namespace weir
