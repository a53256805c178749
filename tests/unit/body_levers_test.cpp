// What is kept of free bodies for a pressure solve changes nothing.
#include <gtest/gtest.h>

#include <cstring>

#include "test_world.hpp"

namespace weir {
namespace {

/// A box of 40 × 14 cells falls into a pool, with a small one on it.
template <class Real>
struct Splash {
    TestWorld<Real> world;
    BodyId box;
    BodyId crate;

    explicit Splash(std::int32_t bodies) : world(def_of(bodies)) {
        constexpr float kCell = 0.02F;
        const Vec2f outline[] = {{-20.0F * kCell, -7.0F * kCell},
                                 {20.0F * kCell, -7.0F * kCell},
                                 {20.0F * kCell, 7.0F * kCell},
                                 {-20.0F * kCell, 7.0F * kCell}};
        BodyDef def;
        def.polygon = {outline, 4};
        def.motion.position_m = {29.3F * kCell, 22.0F * kCell};
        def.motion.angle_rad = 0.2F;
        def.density_ratio = 0.4F;
        box = put_free(*world, def);
        crate = put_free(*world, body_of(kSquare4cm, {0.7F, 0.7F}));
        expect_ok(world->fill({{0.0F, 0.0F}, {60 * kCell, 14 * kCell}}));
    }
    static WorldDef def_of(std::int32_t bodies) {
        WorldDef def = tank_def(60, 40, 4000, bodies, 200);
        def.cell_m = 0.02F;
        def.capacity.two_way = true;
        return def;
    }
};

WEIR_SUITE(BodyLevers, RoomyScalars);

/// Two bodies' room is too little for that box, 20 bodies' is enough.
TYPED_TEST(BodyLevers, KeptOrNotHaveTheSameBits) {
    Splash<TypeParam> kept(20);
    Splash<TypeParam> anew(2);
    for (std::int32_t step = 0; step < 40; ++step) {
        kept.world->step(1.0F / 60.0F);
        anew.world->step(1.0F / 60.0F);
        for (const auto body : {&Splash<TypeParam>::box, &Splash<TypeParam>::crate}) {
            Motion one;
            Motion other;
            expect_ok(kept.world->motion(kept.*body, &one));
            expect_ok(anew.world->motion(anew.*body, &other));
            ASSERT_EQ(one.position_m.x, other.position_m.x) << "step " << step;
            ASSERT_EQ(one.position_m.y, other.position_m.y);
            ASSERT_EQ(one.angle_rad, other.angle_rad);
        }
        const auto pressure = kept.world->pressure();
        const auto its = anew.world->pressure();
        for (std::int32_t row = 0; row < 40; ++row) {
            ASSERT_EQ(std::memcmp(&pressure.at(0, row), &its.at(0, row), 60 * sizeof(TypeParam)),
                      0)
                << "step " << step;
        }
    }
}

}  // namespace
}  // namespace weir
