// Liquid under surface tension meets solids and thin walls at a right angle, however they lean.
// Units here: a cell of 1 m and σ/ρ = 1 m³/s², without gravity.
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kStep = 0.35F;
constexpr double kPi = 3.14159265358979;

WorldDef wetting_def(bool thin) {
    WorldDef def = tank_def(36, 36, 2000, 2, 8);
    def.capacity.wall_edges = thin ? 500 : 0;
    def.cell_m = 1.0F;
    def.gravity_mps2 = {0, 0};
    def.surface_tension_m3ps2 = 1.0F;
    return def;
}

/// A wall that leans by an angle, and places seen from its middle: along it, and off it.
struct Wall {
    double lean;
    Vec2f at;

    Vec2<double> seen(double x, double y) const {
        const double dx = x - static_cast<double>(at.x);
        const double dy = y - static_cast<double>(at.y);
        return {std::cos(lean) * dx + std::sin(lean) * dy,
                std::cos(lean) * dy - std::sin(lean) * dx};
    }
    BodyDef body(const Ring& ring) const {
        BodyDef def = body_of(ring, at, static_cast<float>(lean));
        def.open = ring.size() == 2;
        return def;
    }
};

const Ring kLine = {{-14, 0}, {14, 0}};
const Ring kSlab = {{-14, -4}, {14, -4}, {14, 0}, {-14, 0}};

/// Puts lattice particles wherever `inside(along the wall, off it)` says so. Their number.
template <class Real, class Inside>
int pour(World<Real>& world, const Wall& wall, Inside inside) {
    int count = 0;
    for (int k = 0; k < 4 * world.cells_x() * world.cells_y(); ++k) {
        const double x = 0.5 * (k % (2 * world.cells_x())) + 0.25;
        const double y = 0.5 * (k / (2 * world.cells_x())) + 0.25;
        const Vec2<double> place = wall.seen(x, y);
        if (place.y > 0.05 && inside(place)) {
            expect_ok(world.add_particle({static_cast<float>(x), static_cast<float>(y)}, {0, 0}));
            ++count;
        }
    }
    return count;
}

/// Mean p/ρ of 3 × 3 cells around a place so far off the wall's middle.
template <class Real>
double pressure_off(const World<Real>& world, const Wall& wall, double off) {
    const auto i = static_cast<int>(static_cast<double>(wall.at.x) - off * std::sin(wall.lean));
    const auto j = static_cast<int>(static_cast<double>(wall.at.y) + off * std::cos(wall.lean));
    double sum = 0;
    for (int k = 0; k < 9; ++k) {
        sum += static_cast<double>(world.pressure().at(i + k % 3 - 1, j + k / 3 - 1)) / 9;
    }
    return sum * static_cast<double>(world.pressure_scale());
}

/// Means of the last steps, and where half a drop is in the end.
struct HalfDrop {
    double pressure = 0;  ///< over σ/R
    double along = 0;     ///< from where it was poured, cells
    double off = 0;       ///< from the wall, over what half a disc's is, cells
};

template <class Real>
HalfDrop half_drop(const Ring& ring, const Wall& wall) {
    TestWorld<Real> world(wetting_def(ring.size() == 2));
    put_static(*world, wall.body(ring));
    const int count = pour(*world, wall, [](Vec2<double> place) {
        return std::hypot(place.x, place.y) < 8;
    });
    const double radius = std::sqrt(count / (2 * kPi));
    HalfDrop drop;
    constexpr int kSteps = 300;
    constexpr int kMean = 200;
    for (int step = 0; step < kSteps; ++step) {
        world->step(kStep);
        drop.pressure += step >= kSteps - kMean ? radius * pressure_off(*world, wall, 3) / kMean : 0;
    }
    for (const auto& at : world->particle_positions()) {
        const Vec2<double> place = wall.seen(static_cast<double>(at.x), static_cast<double>(at.y));
        drop.along += place.x / count;
        drop.off += place.y / count;
    }
    drop.off -= 4 * radius / (3 * kPi);
    return drop;
}

/// Half a drop on a wall has the pressure σ/R and stays there. Along solids that lean it ran, faster
/// and faster; from thin walls it jumped off. How far one creeps is chance: the mean of three.
template <class Real>
void expect_half_a_drop_stays(const Ring& ring, double lean) {
    SCOPED_TRACE(lean);
    double along = 0;
    for (const float x : {18.1F, 18.4F, 18.7F}) {
        const HalfDrop drop = half_drop<Real>(ring, {lean, {x, 14.2F}});
        EXPECT_NEAR(drop.pressure, 1, 0.25) << x;
        EXPECT_NEAR(drop.off, 0, 1.2) << x;
        along += drop.along / 3;
    }
    EXPECT_NEAR(along, 0, 1.5);
}

WEIR_SUITE(Wetting, RoomyScalars);

TYPED_TEST(Wetting, HalfADropStaysOnASolid) {
    for (const double lean : some_of({0.0, 0.3, 0.785})) {
        expect_half_a_drop_stays<TypeParam>(kSlab, lean);
    }
}

TYPED_TEST(Wetting, HalfADropStaysOnAThinWall) {
    for (const double lean : some_of({0.0, 0.3, 0.785})) {
        expect_half_a_drop_stays<TypeParam>(kLine, lean);
    }
}

/// Its ends are flat. They were round, with 1.8 σ/R, as if there were no walls.
TYPED_TEST(Wetting, LiquidBetweenThinWallsIsNotPressed) {
    const Wall wall{0, {18.1F, 13.2F}};
    TestWorld<TypeParam> world(wetting_def(true));
    Wall above = wall;
    above.at.y += 8;
    put_static(*world, wall.body(kLine));
    put_static(*world, above.body(kLine));
    pour(*world, wall,
         [](Vec2<double> place) { return std::abs(place.x) < 8 && place.y < 7.95; });
    for (int step = 0; step < 200; ++step) {
        world->step(kStep);
    }
    EXPECT_NEAR(pressure_off(*world, wall, 4), 0, 0.02);  // σ/R would be 0.25
}

/// What is on one side of a thin wall does not know of what is on the other.
TYPED_TEST(Wetting, APoolBehindAThinWallChangesNothing) {
    const Wall wall{0.3, {18.1F, 14.2F}};
    double pressure[2];
    for (const bool pool : {false, true}) {
        TestWorld<TypeParam> world(wetting_def(true));
        put_static(*world, wall.body(kLine));
        pour(*world, wall, [](Vec2<double> place) { return std::hypot(place.x, place.y) < 8; });
        const Wall other{0.3 + kPi, wall.at};
        if (pool) {
            pour(*world, other,
                 [](Vec2<double> place) { return std::abs(place.x) < 6 && place.y < 4; });
        }
        world->step(kStep);
        pressure[pool ? 1 : 0] = pressure_off(*world, wall, 3);
    }
    EXPECT_NEAR(pressure[1], pressure[0], 1e-3);
}

}  // namespace
}  // namespace weir
