// What particles between a wall of no thickness and the first faces beyond it take from those.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "step/thin_transfer.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr std::int32_t kCells = 16;
constexpr float kCell = 1.0F / 64.0F;
constexpr double kStrain = 0.5;  ///< 1/s

/// A wall through all of the tank along an axis, at rest or moving towards its normal.
struct Wall {
    bool is_floor;  ///< or stands upright
    bool above;     ///< the liquid is, or to the right
    double at;      ///< cells
    double speed;   ///< cells/s

    /// Along its normal away from the wall, of liquid that stagnates on it: exact at any distance.
    double through(double x) const { return speed + kStrain * (x - at); }
    double along(double x) const { return -kStrain * (x - 8.0); }
    Vec2<double> velocity(Vec2<double> x) const {
        return is_floor ? Vec2<double>{along(x.x), through(x.y)}
                        : Vec2<double>{through(x.x), along(x.y)};
    }
    /// What lies behind the wall must not be read.
    Vec2<double> on_grid(Vec2<double> x) const {
        const double height = (is_floor ? x.y : x.x) - at;
        return (height > 0.0) == above ? velocity(x) : Vec2<double>{30.0, 30.0};
    }
};

template <class Real>
void put_wall(TestWorld<Real>& world, const Wall& wall) {
    const auto at = static_cast<float>(wall.at);
    Ring ring = wall.is_floor ? Ring{{-2, at}, {18, at}} : Ring{{at, -2}, {at, 18}};
    for (Vec2f& vertex : ring) {
        vertex = kCell * vertex;
    }
    BodyDef line = body_of(ring, {0, 0});
    line.open = true;
    const float speed = kCell * static_cast<float>(wall.speed);
    line.motion.velocity_mps = wall.is_floor ? Vec2f{0, speed} : Vec2f{speed, 0};
    BodyId id;
    expect_ok(world->add_moving_body(line, &id));
    world->step(1.0e-6F);  // draws it
}

/// Velocity that a particle at rest takes with it and moves by, of liquid that wholly gives its own
/// (flip ratio 0), at a place so far from the wall: the worse of their errors.
template <class Real>
double error_at(const Wall& wall, double distance) {
    WorldDef def = tank_def(kCells, kCells, 16, 1, 2);
    def.capacity.wall_edges = 400;
    def.cell_m = kCell;
    TestWorld<Real> world(def);
    put_wall(world, wall);
    Simulation<Real>& simulation = state_of(world).simulation;
    StaggeredGrid<Real> grid = simulation.grid;
    grid.pairs = nullptr;
    for (std::int32_t j = 0; j < kCells; ++j) {
        for (std::int32_t i = 0; i < kCells; ++i) {
            const std::int32_t c = grid.shape.index(i, j);
            grid.u[c] = Real(wall.on_grid({double(i), j + 0.5}).x);
            grid.v[c] = Real(wall.on_grid({i + 0.5, double(j)}).y);
            grid.mass_u[c] = grid.u[c];
            grid.mass_v[c] = grid.v[c];
        }
    }
    const double across = wall.at + (wall.above ? distance : -distance);
    const Vec2<double> place = wall.is_floor ? Vec2<double>{7.3, across} : Vec2<double>{across, 7.3};
    Vec2<PositionOf<Real>> position = convert<Real>(place);
    const Vec2<PositionOf<Real>> before = position;
    Vec2<VelocityOf<Real>> velocity{};
    const Vec2<VelocityOf<Real>> still{};
    Particles<Real> one{&position, &velocity, 1, 1};
    constexpr float kStep = 1.0F / 64.0F;
    const std::vector<DensityOf<Real>> full(static_cast<std::size_t>(grid.shape.size()), Real(1));
    gather_past_walls<Real>(grid, {Seconds<Real>(kStep), Real(0), Real(200)},
                            simulation.layers.walls, full.data(), {}, &before, &still, one);
    const Vec2<double> expected = wall.velocity(place);
    const Vec2<double> taken = convert<double>(velocity);
    const Vec2<double> moved = (1.0 / double(kStep)) * (convert<double>(position) - place);
    double worst = 0.0;
    for (const Vec2<double> got : {taken, moved}) {
        worst = std::max({worst, std::fabs(got.x - expected.x), std::fabs(got.y - expected.y)});
    }
    return worst;
}

/// In the middle of a valley two walls are equally near: the same one answers after a restore, though
/// the records stand in another order.
TEST(ThinGather, OfTwoWallsAsNearAnswersTheSameOneAfterARestore) {
    WorldDef def = tank_def(kCells, kCells, 16, 2, 4);
    def.capacity.wall_edges = 400;
    def.cell_m = kCell;
    TestWorld<float> world(def);
    TestWorld<float> restored(def);
    const Ring slopes[] = {{{2 * kCell, 12 * kCell}, {8 * kCell, 4 * kCell}},
                           {{14 * kCell, 12 * kCell}, {8 * kCell, 4 * kCell}}};
    const auto add = [&](int which) {
        BodyDef line = body_of(slopes[which], {0, 0});
        line.open = true;
        return put_static(*world, line);
    };
    const BodyId first = add(0);
    add(1);
    expect_ok(world->remove_body(first));
    add(0);
    expect_ok(world->add_particle({8 * kCell, 5.5F * kCell}, {0, -0.05F}));
    for (int step = 0; step < 12; ++step) {
        world->step(1.0F / 60.0F);
        if (step == 0) {
            change_worlds(world, restored, def);
        } else {
            restored->step(1.0F / 60.0F);
            ASSERT_EQ(restored->state_hash(), world->state_hash()) << step;
        }
    }
}

WEIR_SUITE(ThinGatherOf, RoomyScalars);

/// The second order of the path is ½ dt (u·∇)u: 0.002 cells/s here.
TYPED_TEST(ThinGatherOf, GoesToAWallAsLiquidThatStagnatesThere) {
    for (const bool is_floor : {true, false}) {
        for (const bool above : {true, false}) {
            for (const double at : {6.1, 6.4, 6.7, 6.95}) {
                for (const double speed : {0.0, 2.0}) {
                    for (const double distance : {0.05, 0.3, 0.5}) {
                        EXPECT_LT(error_at<TypeParam>({is_floor, above, at, speed}, distance), 0.02)
                            << is_floor << above << " at " << at << ", " << speed << " cells/s, "
                            << distance;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace weir
