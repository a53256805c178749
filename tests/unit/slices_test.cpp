// Steps in slices: however a step is cut, its bits are those of the step in one.
#include <algorithm>
#include <cstdlib>

#include "bad_input.hpp"
#include "busy_world.hpp"

namespace weir {
namespace {

/// A budget of any size: single items, a few rows, most of a step.
std::int32_t any_budget(Dice& dice) {
    switch (dice.below(4)) {
        case 0: return 1;
        case 1: return 1 + dice.below(200);
        case 2: return 1 + dice.below(4000);
        default: return 1 + dice.below(20000);
    }
}

/// Two worlds with the same history; the steps of one are cut at random. Returns how many were.
template <class Real>
std::int64_t expect_same_steps(std::int32_t kind, std::uint64_t seed, std::int32_t steps) {
    if (!busy_kind_is_borne<Real>(kind)) {
        return 0;
    }
    SCOPED_TRACE(testing::Message() << "kind " << kind << " seed " << seed);
    const WorldDef def = busy_def(kind);
    TestWorld<Real> whole(def);
    TestWorld<Real> cut(def);
    Dice happens(seed);
    Dice budgets(seed + 77);
    std::int64_t slices = 0;
    for (std::int32_t step = 0; step < steps; ++step) {
        Dice again = happens;
        disturb(*whole, happens);
        disturb(*cut, again);
        const float dt = happens.uniform(0.0F, 0.03F);
        const StepReport expected = whole->step(dt);
        StepReport report;
        EXPECT_EQ(cut->begin_step(dt, &report), Status::ok);
        do {
            ++slices;
        } while (!cut->advance(any_budget(budgets)));
        expect_same_report(report, expected);
        EXPECT_EQ(cut->state_hash(), whole->state_hash()) << "step " << step;
        if (testing::Test::HasFailure()) {
            break;
        }
    }
    return slices;
}

/// WEIR_CUTS: steps for each kind of world; the suite makes 100,000 in all.
TEST(Slices, HoweverCutTheBitsAreTheSame) {
    const char* wanted = std::getenv("WEIR_CUTS");
    const std::int32_t steps = wanted != nullptr ? std::atoi(wanted) : 400;
    std::int64_t slices = 0;
    for (std::int32_t kind = 0; kind < kBusyKinds; ++kind) {
        for (std::int32_t at = 0; at < steps; at += 100) {
            slices += expect_same_steps<float>(kind, static_cast<std::uint64_t>(at + 1), 50);
            slices += expect_same_steps<double>(kind, static_cast<std::uint64_t>(at + 2), 25);
            const auto seed = static_cast<std::uint64_t>(at + 3);
            slices += at % 200 == 0 ? expect_same_steps<Fixed>(kind, seed, 25)
                                    : expect_same_steps<SmallFixed>(kind, seed, 25);
        }
    }
    std::printf("%d steps in %lld slices\n", steps * kBusyKinds, static_cast<long long>(slices));
}

TEST(Slices, EverySingleItemIsASlice) {
    StepReport report;
    TestWorld<float> whole(busy_def(0));
    TestWorld<float> cut(busy_def(0));
    for (TestWorld<float>* world : {&whole, &cut}) {
        ASSERT_EQ((*world)->fill({{0, 0}, {0.1F, 0.1F}}), Status::ok);
    }
    whole->step(0.01F);
    ASSERT_EQ(cut->begin_step(0.01F, &report), Status::ok);
    std::int32_t slices = 1;
    while (!cut->advance(1)) {
        ++slices;
    }
    EXPECT_GT(slices, 2 * 16 * 3) << "half sweeps by rows";
    EXPECT_EQ(whole->state_hash(), cut->state_hash());
}

/// Twice the budget, half the slices: the unit means something.
TEST(Slices, NumberFollowsFromTheBudget) {
    StepReport report;
    std::int32_t slices[2] = {};
    for (int k = 0; k < 2; ++k) {
        TestWorld<float> world(busy_def(6));
        ASSERT_EQ(world->fill({{0, 0}, {0.2F, 0.18F}}), Status::ok);
        ASSERT_EQ(world->begin_step(0.01F, &report), Status::ok);
        do {
            ++slices[k];
        } while (!world->advance(1000 * (k + 1)));
    }
    EXPECT_GT(slices[0], 10);
    EXPECT_NEAR(slices[1], 0.5 * slices[0], 0.1 * slices[0]);
}

/// Whatever would change the world in the middle of a step.
TEST(Slices, NothingElseMayChangeTheWorldMeanwhile) {
    StepReport report;
    Fixture f;
    Fixture twin;
    ASSERT_EQ((*f).begin_step(0.02F, &report), Status::ok);
    ASSERT_FALSE((*f).advance(500));
    BodyId id;
    Diagnostics diagnostics;
    std::byte room[64];
    const Status refused = Status::step_in_progress;
    EXPECT_EQ((*f).begin_step(0.02F, &report), refused);
    EXPECT_EQ((*f).add_static_body(body_of(kTriangle, {0.1F, 0.1F}), &id), refused);
    EXPECT_EQ((*f).add_moving_body(body_of(kTriangle, {0.1F, 0.1F}), &id), refused);
    EXPECT_EQ((*f).set_motion(f.moving, Motion{}), refused);
    EXPECT_EQ((*f).remove_body(f.fixed), refused);
    EXPECT_EQ((*f).fill({{0, 0}, {0.02F, 0.02F}}), refused);
    EXPECT_EQ((*f).add_particle({0.1F, 0.1F}, {}), refused);
    EXPECT_EQ((*f).remove_particle(0), refused);
    EXPECT_EQ((*f).set_gravity({1, 1}), refused);
    EXPECT_EQ((*f).set_viscosity(0), refused);
    EXPECT_EQ((*f).set_surface_tension(0), refused);
    EXPECT_EQ((*f).set_walls({}), refused);
    EXPECT_EQ((*f).diagnose(&diagnostics), refused);
    EXPECT_EQ((*f).save(room, sizeof room), refused);
    Motion motion;
    EXPECT_EQ((*f).motion(f.moving, &motion), Status::ok);
    while (!(*f).advance(500)) {
    }
    EXPECT_TRUE((*f).advance(500)) << "nothing is left to be done";
    (*twin).step(0.02F);
    EXPECT_EQ((*f).state_hash(), (*twin).state_hash());
    EXPECT_EQ((*f).set_gravity({1, 1}), Status::ok);
}

TEST(Slices, StepFinishesWhatWasBegun) {
    StepReport report;
    Fixture f;
    Fixture twin;
    ASSERT_EQ((*f).begin_step(0.02F, &report), Status::ok);
    (*f).advance(700);
    const StepReport second = (*f).step(0.01F);
    (*twin).step(0.02F);
    expect_same_report((*twin).step(0.01F), second);
    EXPECT_EQ((*f).state_hash(), (*twin).state_hash());
}

TEST(Slices, RestoreDropsAStepThatWasBegun) {
    StepReport report;
    Fixture f;
    std::vector<std::byte> snapshot(snapshot_bytes<float>(small_def().capacity));
    ASSERT_EQ((*f).save(snapshot.data(), snapshot.size()), Status::ok);
    (*f).step(0.02F);
    const std::uint64_t after = (*f).state_hash();
    for (const std::int32_t work : {1, 300, 3000, 9000}) {
        ASSERT_EQ((*f).restore(snapshot.data(), snapshot.size()), Status::ok);
        ASSERT_EQ((*f).begin_step(0.03F, &report), Status::ok);
        (*f).advance(work);
        ASSERT_EQ((*f).restore(snapshot.data(), snapshot.size()), Status::ok);
        (*f).step(0.02F);
        EXPECT_EQ((*f).state_hash(), after) << work;
    }
}

TEST(Slices, NonsenseIsNoStep) {
    StepReport report;
    World<float> none;
    EXPECT_EQ(none.begin_step(0.01F, &report), Status::not_initialised);
    EXPECT_TRUE(none.advance(1));
    TestWorld<float> world(small_def());
    EXPECT_TRUE(world->advance(1000)) << "no step was begun";
    ASSERT_EQ(world->begin_step(kNan, &report), Status::ok);
    EXPECT_TRUE(world->advance(1));
    EXPECT_TRUE(report.has(Clamped::time_step));
    EXPECT_EQ(world->begin_step(0.01F, nullptr), Status::output_missing);
    ASSERT_EQ(world->begin_step(0.01F, &report), Status::ok);
    std::int32_t slices = 1;
    while (!world->advance(-5)) {
        ++slices;
    }
    EXPECT_GT(slices, 10) << "a slice of no work does one item";
}

}  // namespace
}  // namespace weir
