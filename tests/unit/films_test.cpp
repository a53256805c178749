// Free bodies that lie flat on something, where no cell under them holds liquid: light ones rise all
// the same, wherever their corners are in the cells, and heavy ones do not.
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kDt = 1.0F / 60.0F;

WEIR_SUITE(Films, RoomyScalars);

/// A tank of 24 × 20 cells, twelve deep.
template <class Real>
class Tank {
public:
    Tank() : world_(tank()) {}

    /// A static ledge, 15 cells wide.
    void put_ledge(float top_m) {
        const Ring ledge = rectangle(15 * kCell, 2 * kCell);
        put_static(*world_, body_of(ledge, {12 * kCell, top_m - kCell}));
    }
    /// How far a body goes up in five seconds, cells.
    double rise(const Ring& ring, Vec2f at, float density) {
        BodyDef body = body_of(ring, at);
        body.density_ratio = density;
        const BodyId id = put_free(*world_, body);
        expect_ok(world_->fill({{0, 0}, {24 * kCell, 12 * kCell}}));
        for (int step = 0; step < 300; ++step) {
            world_->step(kDt);
        }
        EXPECT_GT(volume_left(*world_), 0.98);
        const auto up = static_cast<double>(motion_of(*world_, id).position_m.y - at.y);
        return up / static_cast<double>(kCell);
    }

private:
    static WorldDef tank() {
        WorldDef def = tank_def(24, 20, 6400, 2, 64);
        def.capacity.two_way = true;
        return def;
    }
    TestWorld<Real> world_;
};

TYPED_TEST(Films, LiftCratesFromTheFloor) {
    for (const float x : {0.24F, 0.2337F, 0.245F}) {
        for (const float width : {0.1F, 0.07F}) {
            const Ring box = rectangle(width, 0.06F);
            for (const float light : {0.4F, 0.7F}) {
                const double least = light < 0.5F ? 8.5 : 8.0;
                EXPECT_GT(Tank<TypeParam>().rise(box, {x, 0.03F}, light), least)
                    << width << " at " << x;
            }
            EXPECT_NEAR(Tank<TypeParam>().rise(box, {x, 0.03F}, 2.0F), 0.0, 0.01)
                << width << " at " << x;
        }
    }
}

/// However small, flat or round they are. As long as liquid under a face's middle ended its film,
/// crate and plate stayed where they were.
TYPED_TEST(Films, LiftWhateverLiesOnTheFloor) {
    struct Shape {
        const char* name;
        Ring ring;
        float height;  ///< of its middle
    };
    constexpr float kHalf = 0.3926991F;  // of a side of the wheel, on which it stands
    const Shape shapes[] = {
        {"crate", rectangle(0.03F, 0.03F), 0.015F},
        {"plate", rectangle(0.16F, 0.012F), 0.006F},
        {"wheel", regular_polygon(8, 0.06F, kHalf), 0.06F * std::cos(kHalf)}};
    for (const Shape& shape : shapes) {
        const Vec2f at{0.24F, shape.height};
        EXPECT_GT(Tank<TypeParam>().rise(shape.ring, at, 0.5F), 5.0) << shape.name;
        EXPECT_NEAR(Tank<TypeParam>().rise(shape.ring, at, 2.0F), 0.0, 0.01) << shape.name;
    }
}

/// Also where cells show no gap before it is as wide as they are.
TYPED_TEST(Films, LiftCratesFromALedge) {
    const Ring box = rectangle(0.07F, 0.06F);
    for (const float top : {0.1F, 0.106F}) {
        for (const float density : {0.4F, 2.0F}) {
            Tank<TypeParam> tank;
            tank.put_ledge(top);
            const double rise = tank.rise(box, {0.24F, top + 0.03F}, density);
            if (density < 1.0F) {
                EXPECT_GT(rise, 3.0) << top;
            } else {
                EXPECT_NEAR(rise, 0.0, 0.01) << top;
            }
        }
    }
}

}  // namespace
}  // namespace weir
