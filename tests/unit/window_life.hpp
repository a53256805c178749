// What is expected of a world of which only a window is stored, beside one that stores all of it.
#pragma once

#include "port/port.hpp"
#include "wide_world.hpp"

namespace weir {

inline std::int32_t window_of(std::int32_t kind) {
    switch (kind) {
        case 4: return 252 * 66;
        case 6: return 130 * 152;
        default: return 130 * 66;
    }
}

inline bool same(const Diagnostics& a, const Diagnostics& b) {
    return a.volume_m2 == b.volume_m2 && a.largest_density == b.largest_density &&
           a.divergence_per_s == b.divergence_per_s &&
           a.kinetic_energy_m4ps2 == b.kinetic_energy_m4ps2;
}

/// Distances wherever they are stored, and what bodies met.
template <class Real>
void expect_same_solids(const World<Real>& part, const World<Real>& whole) {
    const auto stored = part.signed_distance();
    const auto all = whole.signed_distance();
    std::int32_t others = 0;
    for (std::int32_t j = 0; j < stored.rows; ++j) {
        for (std::int32_t i = 0; i < stored.columns; ++i) {
            const auto other = all.at(stored.first_column + i, stored.first_row + j);
            others += static_cast<double>(stored.at(i, j)) != static_cast<double>(other) ? 1 : 0;
        }
    }
    EXPECT_EQ(others, 0);
    const View<Contact> a = part.contacts();
    const View<Contact> b = whole.contacts();
    ASSERT_EQ(a.size, b.size);
    for (std::int32_t k = 0; k < a.size; ++k) {
        EXPECT_EQ(a[k].body.slot, b[k].body.slot);
        EXPECT_EQ(a[k].blows, b[k].blows);
        EXPECT_EQ(a[k].impulse_m3ps.x, b[k].impulse_m3ps.x);
        EXPECT_EQ(a[k].place_m.y, b[k].place_m.y);
    }
}

/// A step in slices, or in one.
template <class Real>
StepReport any_step(World<Real>& world, float dt, Dice& budgets) {
    if (budgets.below(2) == 0) {
        return world.step(dt);
    }
    StepReport report;
    EXPECT_EQ(world.begin_step(dt, &report), Status::ok);
    const std::int32_t budget = 1 + budgets.below(budgets.below(2) == 0 ? 200 : 20000);
    while (!world.advance(budget)) {
    }
    return report;
}

constexpr std::int32_t kLives = kSanitized ? 1 : 2;
constexpr std::int32_t kLifeSteps = kSanitized ? 50 : 100;
constexpr std::int32_t kLeastMoves = kSanitized ? 0 : 5;

/// Returns how often the window was another one after a step.
template <class Real>
std::int32_t expect_same_life(std::int32_t kind, std::uint64_t seed) {
    SCOPED_TRACE(testing::Message() << "kind " << kind << " seed " << seed);
    const WorldDef def = wide_def(kind);
    WorldDef part = windowed(def, window_of(kind));
    part.parallel_for = kind == 7 || kind == 9 ? port::parallel_for : nullptr;
    TestWorld<Real> whole(def);
    TestWorld<Real> first(part);
    TestWorld<Real> second(part);
    TestWorld<Real>* stored = &first;
    TestWorld<Real>* spare = &second;
    Nomads<Real> nomads(kind, seed);
    Dice dice(seed + 99);
    std::int32_t beyond = 0;
    std::int32_t moves = 0;
    std::int32_t place = 0;
    for (std::int32_t step = 0; step < kLifeSteps; ++step) {
        nomads.disturb(**stored, *whole);
        if (step % 3 == 0) {
            static_cast<void>((*stored)->density());
        }
        const float dt = dice.uniform(0.005F, 0.03F);
        const StepReport report = any_step(**stored, dt, dice);
        const StepReport expected = whole->step(dt);
        beyond += report.particles_beyond;
        EXPECT_EQ(report.particles_reflected, expected.particles_reflected);
        EXPECT_EQ(report.particles_removed_stuck, expected.particles_removed_stuck);
        const auto view = (*stored)->density();
        const std::int32_t now = view.first_column + 1000 * view.first_row + 100 * view.rows;
        moves += now != place ? 1 : 0;
        place = now;
        EXPECT_EQ((*stored)->state_hash(), whole->state_hash()) << "step " << step;
        expect_same_solids(**stored, *whole);
        if (dice.below(20) == 0) {
            Diagnostics a;
            Diagnostics b;
            expect_ok((*stored)->diagnose(&a));
            expect_ok(whole->diagnose(&b));
            EXPECT_TRUE(same(a, b)) << "step " << step;
            EXPECT_EQ((*stored)->state_hash(), whole->state_hash()) << "looking, step " << step;
        }
        if (dice.below(20) == 0) {
            change_worlds(*stored, *spare, part);
            std::swap(stored, spare);
        }
        if (testing::Test::HasFailure()) {
            break;
        }
    }
    EXPECT_EQ(beyond, 0) << "this test is about what fits";
    return moves;
}

/// Liquid that never fits: nobody is lost or leaves the tank, slices change nothing, a snapshot
/// knows all of it, and no stage does more than was said.
template <class Real>
void expect_nobody_lost(std::int32_t kind) {
    SCOPED_TRACE(kind);
    const WorldDef def = windowed(wide_def(kind), kind == 4   ? 252 * 18
                                                  : kind == 6 ? 66 * 152
                                                  : kind < kKinds ? 66 * 18
                                                                  : 66 * 26);
    TestWorld<Real> one(def);
    TestWorld<Real> other(def);
    TestWorld<Real> third(def);
    Dice dice(static_cast<std::uint64_t>(kind) + 1);
    Nomads<Real> nomads(kind, static_cast<std::uint64_t>(kind));
    std::int32_t beyond = 0;
    constexpr std::int32_t kFew = kSanitized ? 20 : 40;
    for (std::int32_t step = 0; step < (kind < kKinds ? 2 * kFew : kFew); ++step) {
        const Vec2f low{dice.uniform(0.0F, 4.8F), dice.uniform(0.0F, 2.9F)};
        const Vec2f gravity{dice.uniform(-20.0F, 20.0F), dice.uniform(-20.0F, 20.0F)};
        for (TestWorld<Real>* world : {&one, &other}) {
            if (step % 10 == 0) {
                expect_ok((*world)->set_gravity(gravity));
                static_cast<void>((*world)->fill({low, {low.x + 0.1F, low.y + 0.1F}}));
            } else if (step % 7 == 0 && (*world)->particle_positions().size > 5) {
                expect_ok((*world)->remove_particle(5));
            }
        }
        if (kind >= kKinds && step % 3 == 0) {
            nomads.disturb_bodies(*one, *other);
        }
        const std::int32_t before = one->particle_positions().size;
        if (step % 3 == 0) {
            static_cast<void>(other->density());
        }
        WorkBound bound;
        expect_ok(one->work_bound(0.02F, &bound));
        const StepReport report = one->step(0.02F);
        any_step(*other, 0.02F, dice);
        beyond = std::max(beyond, report.particles_beyond);
        EXPECT_EQ(report.particles, before - report.particles_removed_stuck);
        EXPECT_LE(work_of(report), bound.step);
        for (std::int32_t k = 0; step > 0 && k < kStageCount; ++k) {
            EXPECT_LE(report.work[k], bound.substep[k] * report.substeps) << k;
        }
        ASSERT_EQ(one->state_hash(), other->state_hash()) << "step " << step;
        ASSERT_TRUE(all_inside(*one));
        if (step % 20 == 13) {
            StepReport dropped;
            expect_ok(third->begin_step(0.02F, &dropped));
            third->advance(3000);
            change_worlds(other, third, def);
            ASSERT_EQ(third->state_hash(), one->state_hash());
            change_worlds(third, other, def);
        }
    }
    EXPECT_GT(beyond, 0);
}

}  // namespace weir
