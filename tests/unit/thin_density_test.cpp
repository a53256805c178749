// What a full cell shows beside a wall of no thickness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/random.hpp"
#include "solid/thin_walls.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr std::int32_t kCells = 16;
constexpr float kCell = 1.0F / 64.0F;

/// A straight wall through all of the tank: what is above is n · x > at, cells.
struct Wall {
    Vec2<double> normal;
    double at;

    double height(Vec2<double> x) const { return dot(normal, x) - at; }
    Vec2f end(double along) const {
        const Vec2<double> x = at * normal + along * Vec2<double>{normal.y, -normal.x};
        return kCell * Vec2f{static_cast<float>(x.x), static_cast<float>(x.y)};
    }
};

/// Share of a face's kernel, a hat along each axis, on the face's own side of a wall, by strips.
double seen(const Wall& wall, Vec2<double> face) {
    constexpr int kStrips = 40;
    const double side = wall.height(face) > 0.0 ? 1.0 : -1.0;
    double sum = 0.0;
    for (int k = 0; k < kStrips * kStrips; ++k) {
        const Vec2<double> way{(k % kStrips + 0.5) * 2.0 / kStrips - 1.0,
                               (k / kStrips + 0.5) * 2.0 / kStrips - 1.0};
        // Of a strip that the wall passes, about as much as is on this side.
        const double open = 0.5 + side * wall.height(face + way) * kStrips / 2.0;
        sum += std::clamp(open, 0.0, 1.0) * (1.0 - std::fabs(way.x)) * (1.0 - std::fabs(way.y));
    }
    return sum * 4.0 / (kStrips * kStrips);
}

/// Mean of those of a cell's faces that its centre sees.
double full_density(const Wall& wall, std::int32_t i, std::int32_t j) {
    const Vec2<double> centre{i + 0.5, j + 0.5};
    double sum = 0.0;
    for (const Vec2<double> way :
         {Vec2<double>{-0.5, 0}, Vec2<double>{0.5, 0}, Vec2<double>{0, -0.5}, Vec2<double>{0, 0.5}}) {
        const Vec2<double> face = centre + way;
        sum += (wall.height(face) > 0.0) == (wall.height(centre) > 0.0) ? seen(wall, face) : 0.0;
    }
    return 0.25 * sum;
}

struct Errors {
    double worst = 0.0;
    double mean = 0.0;
};

/// Calls look(i, j, density of a full cell) for the cells of a tank that has such a line in it.
template <class Real, class Look>
void look_beside(const Ring& ring, Look look) {
    WorldDef def = tank_def(kCells, kCells, 16, 1, 2);
    def.capacity.wall_edges = 400;
    def.cell_m = kCell;
    TestWorld<Real> world(def);
    BodyDef line = body_of(ring, {0, 0});
    line.open = true;
    put_static(*world, line);
    world->step(1.0F / 60.0F);
    const Layers<Real>& layers = state_of(world).simulation.layers;
    for (std::int32_t j = 2; j < kCells - 2; ++j) {
        for (std::int32_t i = 2; i < kCells - 2; ++i) {
            const Real full = layers.walls.full_density[layers.shape.index(i, j)];
            look(i, j, static_cast<double>(full));
        }
    }
}

/// Of all cells within two of the wall whose neighbours the tank's own walls leave alone.
template <class Real>
Errors errors_beside(const Wall& wall) {
    Errors errors;
    int cells = 0;
    look_beside<Real>({wall.end(-24.0), wall.end(24.0)}, [&](auto i, auto j, double full) {
        const double height = wall.height({i + 0.5, j + 0.5});
        if (std::fabs(height) > 2.0 || std::fabs(height) < 1e-3) {
            return;
        }
        const double error = full - full_density(wall, i, j);
        errors.worst = std::max(errors.worst, std::fabs(error));
        errors.mean += error;
        cells += 1;
    });
    errors.mean /= cells;
    return errors;
}

WEIR_SUITE(ThinDensity, RoomyScalars);

TYPED_TEST(ThinDensity, OfAFloorAnywhereInARow) {
    for (double at = 6.03; at < 7.0; at += 0.09) {
        EXPECT_LT(errors_beside<TypeParam>({{0.0, 1.0}, at}).worst, 0.0005) << at;
    }
}

TYPED_TEST(ThinDensity, OfAWallThatLeans) {
    measure::Random random(3);
    for (int k = 0; k < 12; ++k) {
        const double angle = static_cast<double>(random.uniform(0.0F, 6.28F));
        const Vec2<double> normal{std::cos(angle), std::sin(angle)};
        const auto off = static_cast<double>(random.uniform(-1.0F, 1.0F));
        const Wall wall{normal, dot(normal, Vec2<double>{8, 8}) + off};
        const Errors errors = errors_beside<TypeParam>(wall);
        EXPECT_LT(errors.worst, 0.0005) << angle;
        EXPECT_LT(std::fabs(errors.mean), 0.0002) << angle;
    }
}

/// A line that ends amid the cells, cells.
struct Line {
    Vec2<double> a;
    Vec2<double> b;

    bool hides(Vec2<double> p, Vec2<double> q) const {
        const auto side = [](Vec2<double> from, Vec2<double> to, Vec2<double> of) {
            return cross(to - from, of - from) >= 0.0;
        };
        return side(a, b, p) != side(a, b, q) && side(p, q, a) != side(p, q, b);
    }
    /// Share of a face's kernel that it sees, place by place.
    double seen(Vec2<double> face) const {
        constexpr int kPlaces = 64;
        double sum = 0.0;
        for (int k = 0; k < kPlaces * kPlaces; ++k) {
            const Vec2<double> way{(k % kPlaces + 0.5) * 2.0 / kPlaces - 1.0,
                                   (k / kPlaces + 0.5) * 2.0 / kPlaces - 1.0};
            sum += hides(face, face + way)
                       ? 0.0
                       : (1.0 - std::fabs(way.x)) * (1.0 - std::fabs(way.y));
        }
        return sum * 4.0 / (kPlaces * kPlaces);
    }
    double full_density(Vec2<double> centre) const {
        double sum = 0.0;
        for (const Vec2<double> way : {Vec2<double>{-0.5, 0}, Vec2<double>{0.5, 0},
                                       Vec2<double>{0, -0.5}, Vec2<double>{0, 0.5}}) {
            sum += hides(centre, centre + way) ? 0.0 : seen(centre + way);
        }
        return 0.25 * sum;
    }
};

/// Behind an end of a line its shadow counts.
TYPED_TEST(ThinDensity, AroundTheEndOfALine) {
    measure::Random random(7);
    for (int k = 0; k < 6; ++k) {
        const auto at = [&] { return static_cast<double>(random.uniform(7.0F, 9.0F)); };
        const double angle = static_cast<double>(random.uniform(0.0F, 6.28F));
        Line line{{at(), at()}, {}};
        line.b = line.a + 5.0 * Vec2<double>{std::cos(angle), std::sin(angle)};
        double worst = 0.0;
        look_beside<TypeParam>({kCell * convert<float>(line.a), kCell * convert<float>(line.b)},
                               [&](auto i, auto j, double full) {
            const Vec2<double> centre{i + 0.5, j + 0.5};
            if (length(centre - line.a) < 1.8) {
                worst = std::max(worst, std::fabs(full - line.full_density(centre)));
            }
        });
        EXPECT_LT(worst, 0.001) << angle;
    }
}

/// Around a face there is room for twelve edges: of more the same ones count after a restore, though
/// the records stand in another order.
TEST(ThinDensity, OfMoreEdgesThanThereIsRoomForTheSameCountAfterARestore) {
    constexpr int kLines = 20;
    WorldDef def = tank_def(kCells, kCells, 4 * kCells * kCells, kLines, 2 * kLines);
    def.capacity.wall_edges = 400;
    def.cell_m = kCell;
    TestWorld<float> world(def);
    TestWorld<float> restored(def);
    BodyId id[kLines];
    const auto add = [&](int k) {
        const auto at = static_cast<float>(k);
        const Vec2f way{kCell * std::cos(at), kCell * std::sin(at)};
        const Ring spoke = {0.2F * way, (0.4F + 0.04F * at) * way};
        BodyDef line = body_of(spoke, {8.2F * kCell, 7.9F * kCell});
        line.open = true;
        id[k] = put_static(*world, line);
    };
    for (int k = 0; k < kLines; ++k) {
        add(k);
    }
    for (const int k : {3, 7, 1}) {
        expect_ok(world->remove_body(id[k]));
    }
    for (const int k : {1, 3, 7}) {
        add(k);
    }
    expect_ok(world->fill({{0, 0}, {16 * kCell, 12 * kCell}}));
    world->step(1.0F / 60.0F);
    change_worlds(world, restored, def);
    for (int step = 0; step < 5; ++step) {
        world->step(1.0F / 60.0F);
        restored->step(1.0F / 60.0F);
        ASSERT_EQ(restored->state_hash(), world->state_hash()) << step;
    }
}

}  // namespace
}  // namespace weir
