// However a world is run in which regions sleep, in slices, on threads, looked at or gone back to,
// its bits are the same.
#include <gtest/gtest.h>

#include "pools.hpp"

namespace weir {
namespace {

/// Worlds to which everything happens, of a size in which some sleep while others do not.
WorldDef random_def(std::int32_t kind, ParallelFor parallel_for = nullptr) {
    WorldDef def = busy_def(kind);
    def.capacity.particles = 1200;
    def.capacity.cells_x = 48;
    def.capacity.cells_y = 20;
    def.capacity.sleeping_regions = true;
    def.sleep.speed_mps = 0.25F;
    def.sleep.after_s = 0.1F;
    def.sleep.gravity_mps2 = 0.5F;
    def.parallel_for = parallel_for;
    def.keep_sorted = kind % 2 == 1;
    return def;
}

constexpr std::int32_t kKinds[] = {0, 1, 2, 3, 4, 6, 8};

template <class Real>
void happen(World<Real>& world, Dice& dice) {
    const std::int32_t what = dice.below(60);
    const float x = dice.uniform(0.0F, dice.below(4) == 0 ? 0.8F : 0.3F);
    const float y = dice.uniform(0.0F, 0.3F);
    BodyId id;
    switch (what) {
        case 0: static_cast<void>(world.fill({{x, 0}, {x + 0.12F, 0.08F}})); break;
        case 1: static_cast<void>(world.add_particle({x, y}, {0.5F, -0.5F})); break;
        case 2: static_cast<void>(world.remove_particle(dice.below(600))); break;
        case 3: {
            const Ring ring = busy_ring(dice);
            BodyDef def = body_of(ring, {x, y});
            def.motion.velocity_mps = {dice.uniform(-0.2F, 0.2F), 0.0F};
            static_cast<void>(world.add_moving_body(def, &id));
            break;
        }
        case 4: {
            const std::int32_t slot = dice.below(5);
            if (world.body_in_slot(slot, &id) == Status::ok) {
                expect_ok(world.remove_body(id));
            }
            break;
        }
        case 5:
            expect_ok(world.set_gravity(
                {dice.uniform(-0.6F, 0.6F), -9.81F + dice.uniform(-0.6F, 0.6F)}));
            break;
        case 6: move_body(world, dice, dice.below(5)); break;
        default: break;
    }
}

constexpr std::int32_t kSteps = 300;

/// Hashes of a world, and how many steps some but not all of it slept.
struct History {
    std::vector<std::uint64_t> hashes;
    std::int32_t mixed = 0;
};

enum class Way { whole, slices, snapshots, looking };

template <class Real>
StepReport advance(TestWorld<Real>& world, Way way, float dt, Dice& budgets) {
    StepReport report;
    switch (way) {
        case Way::whole: return world->step(dt);
        case Way::slices:
            expect_ok(world->begin_step(dt, &report));
            while (!world->advance(1 + budgets.below(6000))) {
                EXPECT_EQ(world->particle_positions().size, world->particle_velocities().size);
            }
            return report;
        case Way::snapshots: {
            std::vector<std::byte> room(snapshot_bytes<Real>(random_def(0).capacity) + 40000);
            std::size_t written = 0;
            expect_ok(world->save(room.data(), room.size(), &written));
            if (budgets.below(2) == 0) {  // away from it in the middle of a step, and back
                expect_ok(world->begin_step(dt, &report));
                world->advance(1 + budgets.below(20000));
            }
            expect_ok(world->restore(room.data(), written));
            if (budgets.below(2) == 0) {
                static_cast<void>(world->density());
            }
            return world->step(dt);
        }
        default: {
            static_cast<void>(world->pressure());
            static_cast<void>(world->density());
            Diagnostics diagnostics;
            if (budgets.below(3) == 0) {
                expect_ok(world->diagnose(&diagnostics));
            }
            static_cast<void>(world->pressure());
            return world->step(dt);
        }
    }
}

template <class Real>
History history(std::int32_t kind, Way way, ParallelFor parallel_for = nullptr) {
    TestWorld<Real> world(random_def(kind, parallel_for));
    expect_ok(world->let_regions_sleep());
    Dice dice(static_cast<std::uint64_t>(kind) + 5);
    Dice budgets(99);
    History history;
    const Ring wall = rectangle(9 * kCell, 20 * kCell);
    put_static(*world, body_of(wall, {24 * kCell, 0}));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.2F, 0.06F}}));
    expect_ok(world->fill({{29 * kCell, 0.0F}, {48 * kCell, 0.08F}}));
    for (std::int32_t step = 0; step < kSteps; ++step) {
        happen(*world, dice);
        const float dt = dice.uniform(0.004F, 0.02F);
        const std::int32_t count = world->particle_positions().size;
        WorkBound bound;
        expect_ok(world->work_bound(dt, &bound));
        const StepReport report = advance(world, way, dt, budgets);
        EXPECT_LE(work_of(report), bound.step) << step;
        EXPECT_EQ(report.particles + report.particles_removed_stuck, count);
        EXPECT_TRUE(all_inside(*world));
        history.hashes.push_back(world->state_hash());
        history.mixed += report.particles_asleep > 0 && report.particles_asleep < count ? 1 : 0;
    }
    return history;
}

WEIR_SUITE(RegionsRun, EveryScalar);

TYPED_TEST(RegionsRun, HasTheSameBitsInAnyWay) {
    std::int32_t mixed = 0;
    for (const std::int32_t kind : kKinds) {
        if (!busy_kind_is_borne<TypeParam>(kind)) {
            continue;
        }
        SCOPED_TRACE(kind);
        const History whole = history<TypeParam>(kind, Way::whole);
        mixed += whole.mixed;
        EXPECT_EQ(history<TypeParam>(kind, Way::slices).hashes, whole.hashes) << "slices";
        EXPECT_EQ(history<TypeParam>(kind, Way::snapshots).hashes, whole.hashes) << "snapshots";
        if (kSanitized) {
            continue;
        }
        EXPECT_EQ(history<TypeParam>(kind, Way::looking).hashes, whole.hashes) << "looking";
        EXPECT_EQ(history<TypeParam>(kind, Way::whole, backwards).hashes, whole.hashes)
            << "threads";
    }
    EXPECT_GT(mixed, 20) << "steps in which some slept and others did not";
}

WEIR_SUITE(RegionsAtRest, EveryScalar);

/// Nothing that is gone keeps liquid awake: what a wheel has stirred that was taken away sleeps
/// once nobody is fast. Marks are wiped once in `after_s`, 30 steps, so within twice as long.
TYPED_TEST(RegionsAtRest, SleepsOnceItRestsWhereAWheelHasTurned) {
    WorldDef def = pools_def();
    def.viscosity_m2ps = 1.0e-3F;
    Pools<TypeParam> pools(def);
    pools.add_spinner();
    const Ring blade = rectangle(4 * kCell, 1.2F * kCell);
    BodyDef wheel = body_of(blade, {46 * kCell, 4.8F * kCell});
    wheel.motion.spin_radps = 3.0F;
    const BodyId id = put_moving(*pools.world, wheel);
    for (int step = 0; step < 60; ++step) {
        ASSERT_EQ(pools->step(kDt).particles_asleep, 0);
    }
    expect_ok(pools->remove_body(id));
    std::int32_t last_fast = -1;
    StepReport report;
    std::int32_t step = 0;
    for (; step < 900 && report.particles_asleep < pools.right; ++step) {
        report = pools->step(kDt);
        last_fast = report.max_speed_mps > def.sleep.speed_mps ? step : last_fast;
    }
    ASSERT_EQ(report.particles_asleep, pools.right);
    EXPECT_GE(last_fast, 0) << "it had stirred them";
    EXPECT_LE(step - last_fast, 62);
}

}  // namespace
}  // namespace weir
