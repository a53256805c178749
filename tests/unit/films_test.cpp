// Free bodies that lie on something, where no cell under them holds liquid: light ones rise all
// the same, wherever their corners are in the cells, and heavy ones do not.
#include <gtest/gtest.h>

#include <algorithm>
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
    /// Or a rough one that leans. Returns where the middle is of what lies on it, so high.
    Vec2f put_leaning_ledge(float angle, float height) {
        const Ring ledge = rectangle(15 * kCell, 4 * kCell);
        const Vec2f middle{12 * kCell, 3.3F * kCell};
        BodyDef body = body_of(ledge, middle, angle);
        body.surface.friction = 2.0F;
        put_static(*world_, body);
        const float up = 2 * kCell + 0.5F * height;
        return {middle.x - up * std::sin(angle), middle.y + up * std::cos(angle)};
    }
    /// Or two, down to 5 cells. Returns where the middle is of a block that lies between them.
    Vec2f put_notch(float angle, float width, float height) {
        const Ring ledge = rectangle(15 * kCell, 4 * kCell);
        const Vec2f way{std::cos(angle), std::sin(angle)};
        for (const float side : {-1.0F, 1.0F}) {
            const Vec2f middle{12 * kCell + side * (7.5F * way.x + 2 * way.y) * kCell,
                               (5 + 7.5F * way.y - 2 * way.x) * kCell};
            put_static(*world_, body_of(ledge, middle, side * angle));
        }
        const float up = 0.5F * (width * way.y / way.x + height) + 0.005F * kCell;
        return {12 * kCell, 5 * kCell + up};
    }
    /// How far a body goes up in five seconds, cells.
    double rise(const Ring& ring, Vec2f at, float density, float angle = 0.0F,
                int steps = 300) {
        BodyDef body = body_of(ring, at, angle);
        body.density_ratio = density;
        body.surface.friction = angle != 0.0F ? 2.0F : body.surface.friction;
        const BodyId id = put_free(*world_, body);
        expect_ok(world_->fill({{0, 0}, {24 * kCell, 12 * kCell}}));
        for (int step = 0; step < steps; ++step) {
            world_->step(kDt);
            const float up = motion_of(*world_, id).position_m.y - at.y;
            highest_ = std::max(highest_, static_cast<double>(up / kCell));
        }
        EXPECT_GT(volume_left(*world_), 0.98);
        const auto up = static_cast<double>(motion_of(*world_, id).position_m.y - at.y);
        return up / static_cast<double>(kCell);
    }

    /// How far either of two like stones that touch each other goes up at most in five seconds,
    /// cells.
    double rise_of_pair(float width, float height, Vec2f at, float density, float angle) {
        const Ring stone = rectangle(width, height);
        const Vec2f way{std::cos(angle), std::sin(angle)};
        BodyId id[2];
        Vec2f from[2];
        for (const int side : {0, 1}) {
            const float along = (0.5F * width + 0.001F * kCell) * (side == 0 ? -1.0F : 1.0F);
            from[side] = {at.x + along * way.x, at.y + along * way.y};
            BodyDef body = body_of(stone, from[side], angle);
            body.density_ratio = density;
            body.surface.friction = angle != 0.0F ? 2.0F : body.surface.friction;
            id[side] = put_free(*world_, body);
        }
        expect_ok(world_->fill({{0, 0}, {24 * kCell, 12 * kCell}}));
        double highest = 0.0;
        for (int step = 0; step < 300; ++step) {
            world_->step(kDt);
            for (const int side : {0, 1}) {
                const float up = motion_of(*world_, id[side]).position_m.y - from[side].y;
                highest = std::max(highest, static_cast<double>(up / kCell));
            }
        }
        return highest;
    }

    /// And at most.
    double highest() const { return highest_; }

private:
    static WorldDef tank() {
        WorldDef def = tank_def(24, 20, 6400, 3, 64);
        def.capacity.two_way = true;
        return def;
    }
    TestWorld<Real> world_;
    double highest_ = 0.0;
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

/// In a corner of the tank liquid comes from one side alone, and presses for both.
TYPED_TEST(Films, LiftCratesFromACorner) {
    for (const float width : {0.03F, 0.07F}) {
        const Ring box = rectangle(width, 0.06F);
        const float beside = 0.5F * width + 0.0005F;
        for (const float x : {beside, 24 * kCell - beside}) {
            EXPECT_GT(Tank<TypeParam>().rise(box, {x, 0.03F}, 0.7F), 8.0) << width << " at " << x;
            EXPECT_NEAR(Tank<TypeParam>().rise(box, {x, 0.03F}, 2.0F), 0.0, 0.01)
                << width << " at " << x;
        }
    }
}

/// However small, flat or round they are. As long as liquid under a face's middle ended its film,
/// crate and plate stayed where they were; as long as films lay under single edges, the others did.
TYPED_TEST(Films, LiftWhateverLiesOnTheFloor) {
    struct Shape {
        const char* name;
        Ring ring;
        float height;  ///< of its middle
        float x;
        float light;
    };
    constexpr float kPi = 3.1415927F;
    const auto standing = [](const char* name, int corners, float radius, float x, float light) {
        const float half = kPi / static_cast<float>(corners);  // of a side, on which it stands
        return Shape{name, regular_polygon(corners, radius, half - 0.5F * kPi),
                     radius * std::cos(half), x, light};
    };
    const Shape shapes[] = {{"crate", rectangle(0.03F, 0.03F), 0.015F, 0.24F, 0.5F},
                            {"plate", rectangle(0.16F, 0.012F), 0.006F, 0.24F, 0.5F},
                            {"cell", rectangle(0.02F, 0.02F), 0.01F, 0.2337F, 0.5F},
                            standing("small wheel", 7, 0.025F, 0.24F, 0.5F),
                            standing("nut", 6, 0.04F, 0.2433F, 0.8F),
                            standing("wheel", 8, 0.06F, 0.24F, 0.5F),
                            standing("ball", 24, 0.06F, 0.2433F, 0.8F)};
    for (const Shape& shape : shapes) {
        const Vec2f at{shape.x, shape.height};
        EXPECT_GT(Tank<TypeParam>().rise(shape.ring, at, shape.light), 5.0) << shape.name;
        EXPECT_NEAR(Tank<TypeParam>().rise(shape.ring, at, 2.0F), 0.0, 0.01) << shape.name;
    }
}

/// Nor may cells and film lift the same: heavy stones leapt by 5 cells.
TYPED_TEST(Films, LiftNothingHeavyFromALedge) {
    for (const float width : {0.01F, 0.03F, 0.07F}) {
        for (const float height : {0.012F, 0.02F}) {
            Tank<TypeParam> tank;
            tank.put_ledge(0.1F);
            const Ring stone = rectangle(width, height);
            tank.rise(stone, {0.24F, 0.1F + 0.5F * height}, 2.0F);
            EXPECT_LT(tank.highest(), 0.05) << width << " by " << height;
        }
    }
}

/// Where it leans, one half shows too much of what the other lacks, and cells show faces that do
/// not lie along it: with films along its normal only stones tumbled, slid in spite of friction
/// and leapt by up to 5 cells.
TYPED_TEST(Films, LiftNothingHeavyFromALeaningLedge) {
    constexpr float kAngle = 0.3F;
    for (const float density : {1.1F, 2.0F}) {
        for (const float width : {0.02F, 0.03F, 0.07F}) {
            for (const float height : {0.012F, 0.02F}) {
                const Ring stone = rectangle(width, height);
                Tank<TypeParam> tank;
                const Vec2f at = tank.put_leaning_ledge(kAngle, height);
                tank.rise(stone, at, density, kAngle);
                EXPECT_LT(tank.highest(), density < 2.0F ? 0.3 : 0.05)
                    << density << ", " << width << " by " << height;
            }
        }
    }
}

/// Nor between two that lean against each other: what no film is laid for is not lifted, either.
TYPED_TEST(Films, LiftNothingHeavyFromANotch) {
    for (const float angle : {0.3F, 0.6F}) {
        for (const float width : {0.02F, 0.03F, 0.05F}) {
            Tank<TypeParam> tank;
            const Ring stone = rectangle(width, 0.04F);
            tank.rise(stone, tank.put_notch(angle, width, 0.04F), 2.0F);
            EXPECT_LT(tank.highest(), 0.05) << width << " at " << angle;
        }
    }
}

/// Nor from beside each other: what each hid of the other was closed by nothing, or by films along
/// the ledge, and stones of 1.1 leapt by up to 1.9 cells from a leaning ledge and by 0.7 from a
/// level one.
TYPED_TEST(Films, LiftNothingHeavyThatTouchesAnother) {
    struct Size {
        float width;
        float height;
    };
    for (const Size size : {Size{0.02F, 0.04F}, Size{0.04F, 0.04F}, Size{0.03F, 0.02F}}) {
        for (const float density : {1.1F, 2.0F}) {
            for (const float angle : {0.0F, 0.3F}) {
                Tank<TypeParam> tank;
                Vec2f at = tank.put_leaning_ledge(angle, size.height);
                at.x += 0.37F * kCell * std::cos(angle);
                at.y += 0.37F * kCell * std::sin(angle);
                EXPECT_LT(tank.rise_of_pair(size.width, size.height, at, density, angle), 0.05)
                    << size.width << " by " << size.height << " of " << density << " at "
                    << angle;
            }
        }
    }
}

/// Also what hardly is lighter, which corners that the contour cuts decide over. When it leaves is
/// chance: some only after five seconds.
TYPED_TEST(Films, LiftCratesAlmostAsHeavyAsTheLiquid) {
    const Ring box = rectangle(0.1F, 0.06F);
    for (const float x : {0.24F, 0.2337F, 0.245F}) {
        EXPECT_GT(Tank<TypeParam>().rise(box, {x, 0.03F}, 0.95F, 0.0F, 600), 8.0) << x;
        EXPECT_NEAR(Tank<TypeParam>().rise(box, {x, 0.03F}, 1.05F), 0.0, 0.05) << x;
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
