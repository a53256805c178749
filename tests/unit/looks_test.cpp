// Whoever looks at a world, saves and restores it or cuts its steps changes nothing of its future,
// where that is least plain: liquid asleep that is gone, bodies set elsewhere, forces of blows.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "busy_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 64.0F;  // one substep
const Ring kSpinner = rectangle(0.04F, 0.04F);
constexpr Box kAll{{0, 0}, {1, 1}};

WorldDef regions_def() {
    WorldDef def = tank_def(24, 16, 600, 1, 4);
    def.capacity.sleeping_regions = true;
    def.sleep.speed_mps = 0.3F;
    def.sleep.after_s = 0.2F;
    return def;
}

template <class Real>
void go_back_to_itself(World<Real>& world, const WorldDef& def) {
    std::vector<std::byte> kept(snapshot_bytes<Real>(def.capacity));
    expect_ok(world.save(kept.data(), kept.size()));
    expect_ok(world.restore(kept.data(), kept.size()));
}

constexpr int kLooks = 3;
template <class Real>
void look(World<Real>& world, const WorldDef& def, int way) {
    Diagnostics sums;
    switch (way) {
        case 0: static_cast<void>(world.density()); break;
        case 1: expect_ok(world.diagnose(&sums)); break;
        default: go_back_to_itself(world, def); break;
    }
}

/// A pool that sleeps while a body turns above it.
template <class Real>
struct Sleepers {
    WorldDef def = regions_def();
    TestWorld<Real> world{def};
    BodyId spinner;

    Sleepers() {
        expect_ok(world->let_regions_sleep());
        BodyDef body = body_of(kSpinner, {0.4F, 0.28F});
        body.motion.spin_radps = 1.0F;
        spinner = put_moving(*world, body);
        expect_ok(world->fill({{0, 0}, {0.2F, 0.1F}}));
    }
    void fall_asleep() {
        StepReport report;
        for (int step = 0; step < 600 && report.particles_asleep == 0; ++step) {
            expect_ok(world->stir(kAll, {0, 0}, 0.2F));
            report = world->step(kDt);
        }
        ASSERT_GT(report.particles_asleep, 0);
    }
};

WEIR_SUITE(Looks, EveryScalar);

/// Who looks at all of the tank writes what sleeps, too.
TYPED_TEST(Looks, ShowOfSleepersWhatTheyFellAsleepWith) {
    Sleepers<TypeParam> sleepers;
    sleepers.fall_asleep();
    const auto shown = [&] {
        std::vector<double> fields;
        for (std::int32_t i = 1; i < 8; ++i) {
            fields.push_back(static_cast<double>(sleepers.world->density().at(i, 1)));
            fields.push_back(static_cast<double>(sleepers.world->pressure().at(i, 1)));
        }
        return fields;
    };
    const std::vector<double> before = shown();
    Diagnostics sums;
    expect_ok(sleepers.world->diagnose(&sums));
    EXPECT_EQ(shown(), before);
}

/// What falls asleep after diagnostics keeps the densities that it keeps without them.
TYPED_TEST(Looks, AtSumsLeaveWhatSleepersAreShownWith) {
    Sleepers<TypeParam> one;
    Sleepers<TypeParam> other;
    StepReport report;
    for (int step = 0; step < 600 && report.particles_asleep == 0; ++step) {
        for (Sleepers<TypeParam>* each : {&one, &other}) {
            expect_ok(each->world->stir(kAll, {0, 0}, 0.2F));
        }
        look(*other.world, other.def, 1);
        report = one.world->step(kDt);
        other.world->step(kDt);
    }
    ASSERT_GT(report.particles_asleep, 0);
    const auto density = one.world->density();
    const auto seen = other.world->density();
    for (std::int32_t j = 0; j < density.rows; ++j) {
        for (std::int32_t i = 0; i < density.columns; ++i) {
            ASSERT_EQ(static_cast<double>(seen.at(i, j)), static_cast<double>(density.at(i, j)))
                << i << ", " << j;
        }
    }
}

TYPED_TEST(Looks, AfterSleepersWereDrained) {
    for (int way = 0; way < kLooks; ++way) {
        Sleepers<TypeParam> one;
        Sleepers<TypeParam> other;
        for (Sleepers<TypeParam>* each : {&one, &other}) {
            each->fall_asleep();
            expect_ok(each->world->drain(kAll));
        }
        look(*other.world, other.def, way);
        for (int step = 0; step < 10; ++step) {
            one.world->step(kDt);
            other.world->step(kDt);
            ASSERT_EQ(one.world->state_hash(), other.world->state_hash()) << way << ", " << step;
            if (step == 0) {
                expect_ok(one.world->fill({{0, 0}, {0.2F, 0.1F}}));
                expect_ok(other.world->fill({{0, 0}, {0.2F, 0.1F}}));
            }
        }
    }
}

TYPED_TEST(Looks, AfterABodyWasSetElsewhere) {
    for (int way = 0; way < kLooks; ++way) {
        Dice dice(static_cast<std::uint64_t>(way) + 1);
        for (int place = 0; place < 30; ++place) {
            Sleepers<TypeParam> one;
            Sleepers<TypeParam> other;
            Motion motion;
            motion.position_m = {dice.uniform(0.04F, 0.44F), dice.uniform(0.04F, 0.28F)};
            motion.spin_radps = dice.uniform(-3.0F, 3.0F);
            for (Sleepers<TypeParam>* each : {&one, &other}) {
                for (int step = 0; step < 2 + place % 12; ++step) {
                    each->world->step(kDt);
                }
                expect_ok(each->world->set_motion(each->spinner, motion));
            }
            look(*other.world, other.def, way);
            for (int step = 0; step < 3; ++step) {
                one.world->step(kDt, step == 1 ? 3 : 0);  // one in which it is not drawn
                other.world->step(kDt, step == 1 ? 3 : 0);
                ASSERT_EQ(one.world->state_hash(), other.world->state_hash())
                    << way << ", " << place << ", " << step;
            }
        }
    }
}

/// Liquid that falls asleep in the first substep after a restore is seen where it lies.
TYPED_TEST(Looks, ShowWhoFellAsleepAfterARestore) {
    Sleepers<TypeParam> one;
    Sleepers<TypeParam> other;
    StepReport report;
    for (int step = 0; step < 600 && report.particles_asleep == 0; ++step) {
        expect_ok(one.world->stir(kAll, {0, 0}, 0.2F));
        std::vector<std::byte> kept(snapshot_bytes<TypeParam>(one.def.capacity));
        expect_ok(one.world->save(kept.data(), kept.size()));
        report = one.world->step(kDt);
        if (report.particles_asleep > 0) {
            expect_ok(other.world->restore(kept.data(), kept.size()));
            other.world->step(kDt);
        }
    }
    ASSERT_GT(report.particles_asleep, 0);
    double seen = 0;
    const auto density = other.world->density();
    for (std::int32_t j = 0; j < density.rows; ++j) {
        for (std::int32_t i = 0; i < density.columns; ++i) {
            seen += static_cast<double>(density.at(i, j));
        }
    }
    EXPECT_NEAR(seen, 50.0, 5.0);
}

/// However a step is cut, blows on bodies and tank sum up to the same bits.
TYPED_TEST(Looks, OfSlicesLeaveForcesAsTheyAre) {
    WorldDef def;
    def.cell_m = 0.005F;
    def.capacity.cells_x = def.capacity.cells_y = 20;
    def.capacity.particles = 1200;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    def.capacity.two_way = true;
    def.walls = every_wall({0.37F, 0.71F, false, 0.0165F});
    TestWorld<TypeParam> whole{def};
    TestWorld<TypeParam> cut{def};
    BodyId id[2];
    const Ring square = rectangle(0.02F, 0.02F);
    for (TestWorld<TypeParam>* each : {&whole, &cut}) {
        expect_ok((*each)->add_static_body(body_of(square, {0.04F, 0.02F}, 0.5F),
                                           &id[each == &whole ? 0 : 1]));
        expect_ok((*each)->fill({{0, 0}, {0.08F, 0.05F}}));
    }
    for (int step = 0; step < 300; ++step) {
        const float turned = 0.05F * static_cast<float>(step);
        const Vec2f gravity{9.0F * std::sin(turned), -9.0F * std::cos(turned)};
        expect_ok(whole->set_gravity(gravity));
        expect_ok(cut->set_gravity(gravity));
        whole->step(1.0F / 64.0F);
        StepReport report;
        expect_ok(cut->begin_step(1.0F / 64.0F, &report));
        while (!cut->advance(300)) {
        }
        BodyForce force[4];
        expect_ok(whole->force(id[0], &force[0]));
        expect_ok(cut->force(id[1], &force[1]));
        expect_ok(whole->tank_force(&force[2]));
        expect_ok(cut->tank_force(&force[3]));
        for (const int k : {0, 2}) {
            ASSERT_EQ(force[k].impulse_m3ps.x, force[k + 1].impulse_m3ps.x) << step << ", " << k;
            ASSERT_EQ(force[k].impulse_m3ps.y, force[k + 1].impulse_m3ps.y) << step << ", " << k;
        }
    }
}

}  // namespace
}  // namespace weir
