// Mass and momentum of fixed-point worlds, as whole numbers: nothing is lost, step by step.
#include <gtest/gtest.h>

#include <vector>

#include "measure/momentum_book.hpp"
#include "measure/stirred_tank.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

using measure::MomentumBook;
using measure::Stirred;
using measure::StirredTank;
using measure::Units;

constexpr Units kNone{};

/// @param most_settled of what was not counted where it was exchanged, over the liquid's weight:
/// if nothing were counted that would be all of it.
template <class Real>
void expect_balance(const Stirred& how, double most_settled) {
    StirredTank<Real> tank(how);
    MomentumBook<Real> book(tank.world(), tank.memory());
    const std::int32_t particles = tank.particles();
    for (int k = 0; k < 2000 && !testing::Test::HasFailure(); ++k) {
        SCOPED_TRACE(k);
        tank.swing(k);
        const StepReport report = book.step(StirredTank<Real>::kFrame);
        EXPECT_EQ(report.particles, particles);
        EXPECT_EQ(book.off(), kNone);
        EXPECT_EQ(book.gravity_off(), kNone);
        EXPECT_TRUE(book.tank_says_so());
        EXPECT_EQ(book.mass_off(), kNone);
        if (Stored<Real>::coarse) {
            EXPECT_EQ(book.momentum_off(), kNone);
        }
    }
    EXPECT_EQ(book.drift(), kNone);
    EXPECT_LT(book.settled_rms(), most_settled);
}

using Scalars = testing::Types<Fixed, SmallFixed>;
WEIR_SUITE(WholeLedgerOf, Scalars);
WEIR_SUITE(TankOf, EveryScalar);

TYPED_TEST(WholeLedgerOf, BalancesAPool) {
    expect_balance<TypeParam>({}, 0.01);
}

TYPED_TEST(WholeLedgerOf, BalancesADamBreakOverBodies) {
    Stirred how;
    how.bodies = how.swings = true;
    expect_balance<TypeParam>(how, 0.1);
}

// What gravity owes, too.
TYPED_TEST(WholeLedgerOf, GoesOnFromASnapshot) {
    Stirred how;
    how.bodies = how.swings = true;
    StirredTank<TypeParam> tanks[] = {StirredTank<TypeParam>(how), StirredTank<TypeParam>(how)};
    for (int k = 0; k < 50; ++k) {
        tanks[0].swing(k);
        tanks[0].world().step(tanks[0].kFrame);
    }
    std::vector<std::byte> snapshot(tanks[0].snapshot_bytes());
    std::size_t written = 0;
    ASSERT_EQ(tanks[0].world().save(snapshot.data(), snapshot.size(), &written), Status::ok);
    ASSERT_EQ(tanks[1].world().restore(snapshot.data(), written), Status::ok);
    MomentumBook<TypeParam> one(tanks[0].world(), tanks[0].memory());
    MomentumBook<TypeParam> other(tanks[1].world(), tanks[1].memory());
    for (int k = 0; k < 50; ++k) {
        one.step(tanks[0].kFrame);
        other.step(tanks[1].kFrame);
        ASSERT_EQ(one.tank(), other.tank()) << k;
        ASSERT_EQ(one.gravity(), other.gravity()) << k;
        ASSERT_EQ(other.off(), kNone) << k;
    }
}

TYPED_TEST(WholeLedgerOf, IsTheSameInSlices) {
    Stirred how;
    how.bodies = how.swings = true;
    StirredTank<TypeParam> tanks[] = {StirredTank<TypeParam>(how), StirredTank<TypeParam>(how)};
    const MomentumBook<TypeParam> whole(tanks[0].world(), tanks[0].memory());
    const MomentumBook<TypeParam> sliced(tanks[1].world(), tanks[1].memory());
    for (int k = 0; k < 50; ++k) {
        tanks[0].world().step(tanks[0].kFrame);
        StepReport report;
        ASSERT_EQ(tanks[1].world().begin_step(tanks[1].kFrame, &report), Status::ok);
        while (!tanks[1].world().advance(50 + k)) {
        }
        ASSERT_EQ(whole.tank(), sliced.tank()) << k;
        ASSERT_EQ(whole.gravity(), sliced.gravity()) << k;
    }
}

TEST(WholeLedger, BalancesTwoLiquidsWithAFreeBody) {
    Stirred how;
    how.bodies = how.floating = how.second = how.swings = true;
    expect_balance<Fixed>(how, 0.2);
}

/// What a tank receives does not depend on whether there is room for bodies.
TYPED_TEST(TankOf, ReceivesTheSameWithoutRoomForBodies) {
    WorldDef def = small_def();
    def.capacity.two_way = true;
    TestWorld<TypeParam> roomy(def);
    def.capacity.bodies = def.capacity.vertices = 0;
    TestWorld<TypeParam> bare(def);
    for (TestWorld<TypeParam>* world : {&roomy, &bare}) {
        expect_ok((*world)->fill({{0.04F, 0.06F}, {0.20F, 0.14F}}));
    }
    for (int k = 0; k < 60; ++k) {
        roomy->step(1.0F / 60.0F);
        bare->step(1.0F / 60.0F);
        BodyForce one, other;
        expect_ok(roomy->tank_force(&one));
        expect_ok(bare->tank_force(&other));
        ASSERT_EQ(one.impulse_m3ps.x, other.impulse_m3ps.x) << k;
        ASSERT_EQ(one.impulse_m3ps.y, other.impulse_m3ps.y) << k;
    }
}

}  // namespace
}  // namespace weir
