// A tank that lies on its side, with a gravity that does, too: all is as in the one that stands,
// with x and y exchanged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "step/stage_clock.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 1.0F / 64;  // exact, as all places are, so that both begin alike
constexpr float kStep_s = 1.0F / 128;

Vec2f turned(Vec2f at, bool lies) { return lies ? Vec2f{at.y, at.x} : at; }

WorldDef turned_def(WorldDef def, bool lies) {
    def.cell_m = kCell;
    def.gravity_mps2 = turned({0.0F, -8.0F}, lies);
    if (lies) {
        std::swap(def.capacity.cells_x, def.capacity.cells_y);
    }
    return def;
}

/// Particles of a box as `fill` would put them, in the same order whichever way the tank lies.
template <class Real>
void pour(World<Real>& world, int columns, int rows, bool lies) {
    for (int j = 0; j < 2 * rows; ++j) {
        for (int i = 0; i < 2 * columns; ++i) {
            const Vec2f at{kCell * (0.25F + 0.5F * static_cast<float>(i)),
                           kCell * (0.25F + 0.5F * static_cast<float>(j))};
            expect_ok(world.add_particle(turned(at, lies), {}));
        }
    }
}

/// Of a particle, cells: across and along gravity.
template <class Real>
Vec2<double> place_of(const World<Real>& world, std::int32_t k, bool lies) {
    const auto at = world.particle_positions()[k];
    const Vec2<double> place{static_cast<double>(at.x), static_cast<double>(at.y)};
    return lies ? Vec2<double>{place.y, place.x} : place;
}

/// A deep narrow column, at rest from its first step on.
template <class Real>
class Column {
public:
    Column(int depth, bool lies)
        : lies_(lies), world_(turned_def(tank_def(8, 2 * depth, 32 * depth), lies)) {
        pour(*world_, 8, depth, lies);
    }
    /// Mean height of the liquid, in terms of what it was, after so many steps.
    double height_after(int steps) {
        const double before = height();
        for (int k = 0; k < steps; ++k) {
            WorkBound bound;
            expect_ok(world_->work_bound(kStep_s, &bound));
            EXPECT_LE(work_of(world_->step(kStep_s)), bound.step) << k;
        }
        return height() / before;
    }

private:
    double height() const {
        double sum = 0.0;
        const std::int32_t count = world_->particle_positions().size;
        for (std::int32_t k = 0; k < count; ++k) {
            sum += place_of(*world_, k, lies_).y;
        }
        return sum / count;
    }

    bool lies_;
    TestWorld<Real> world_;
};

WEIR_SUITE(TurnedTank, EveryScalar);

/// Sweeps went by how many rows hold liquid: of a column that lay a tenth was gone in a second.
TYPED_TEST(TurnedTank, HoldsUpADeepColumn) {
    const int depth = std::is_same<TypeParam, SmallFixed>::value ? 40 : 100;
    const double stands = Column<TypeParam>(depth, false).height_after(120);
    const double lies = Column<TypeParam>(depth, true).height_after(120);
    EXPECT_NEAR(stands, 1.0, 0.002);
    EXPECT_NEAR(lies, stands, 0.0005);
}

/// Water around the ends of a plate that leans and of one that is pushed.
template <class Real>
class Plates {
public:
    explicit Plates(bool lies) : lies_(lies), world_(turned_def(definition(), lies)) {
        const Ring leans = {turned({0, 0}, lies), turned({3 * kCell, 5.5F * kCell}, lies)};
        const Ring stands = {turned({0, 0}, lies), turned({0, 8 * kCell}, lies)};
        BodyDef def = body_of(leans, turned({9.3125F * kCell, 2.4375F * kCell}, lies));
        def.open = true;
        put_static(*world_, def);
        def = body_of(stands, turned({20.125F * kCell, 3.5F * kCell}, lies));
        def.open = true;
        def.motion.velocity_mps = turned({0.5F, 0.0F}, lies);
        put_moving(*world_, def);
        pour(*world_, 32, 10, lies);
    }
    void run(int steps) { world_.run(steps, kStep_s); }

    /// Furthest that a particle is from where it is in another one, cells.
    double off(const Plates& other) const {
        double most = 0.0;
        for (std::int32_t k = 0; k < world_->particle_positions().size; ++k) {
            const Vec2<double> here = place_of(*world_, k, lies_);
            const Vec2<double> there = place_of(*other.world_, k, other.lies_);
            most = std::max({most, std::abs(here.x - there.x), std::abs(here.y - there.y)});
        }
        return most;
    }

private:
    static WorldDef definition() {
        WorldDef def = tank_def(32, 20, 1280, 2, 4);
        def.capacity.wall_edges = 80;
        def.pressure_sweeps = 100;  // what sweeps leave depends on their order
        return def;
    }

    bool lies_;
    TestWorld<Real> world_;
};

WEIR_SUITE(TurnedPlates, RoomyScalars);

/// A particle that a wall hides a face from takes another one's velocity: where both of its
/// neighbours could stand in it was the row's, so that one at a plate's end came up to a cell
/// further in five steps if the plate lay.
TYPED_TEST(TurnedPlates, AreFlowedAroundAlike) {
    Plates<TypeParam> stand(false);
    Plates<TypeParam> lie(true);
    stand.run(5);
    lie.run(5);
    EXPECT_LT(stand.off(lie), 0.002);
}

}  // namespace
}  // namespace weir
