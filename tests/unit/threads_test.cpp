// Steps shared out to threads: the bits of one that is not, for any number of threads and any order
// in which the pieces are done.
#include <gtest/gtest.h>

#include "busy_world.hpp"
#include "port/port.hpp"

namespace weir {
namespace {

std::int32_t g_rounds = 0;
std::int32_t g_most_pieces = 0;

/// What relies on the order of pieces shows without threads.
void counted_backwards(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
    ++g_rounds;
    g_most_pieces = g_most_pieces < count ? count : g_most_pieces;
    backwards(task, context, count);
}

/// A tank large enough to be cut into pieces.
WorldDef wide_def(std::int32_t kind, ParallelFor parallel_for) {
    WorldDef def = busy_def(kind);
    def.capacity.particles = 40000;
    def.capacity.cells_x = 160;
    def.capacity.cells_y = 96;
    def.capacity.contacts = kind == 0 ? 2 : 0;
    def.capacity.wall_edges *= 4;
    def.capacity.two_way = kind == 0;
    def.max_substeps = 4;
    def.keep_sorted = kind % 2 == 1;
    def.parallel_for = parallel_for;
    return def;
}

template <class Real>
std::vector<std::uint64_t> hashes(std::int32_t kind, ParallelFor parallel_for) {
    TestWorld<Real> world(wide_def(kind, parallel_for));
    Dice dice(static_cast<std::uint64_t>(kind));
    // Some hangs in the air, so that the part of the tank it is in begins elsewhere.
    const Vec2f from = kind % 3 == 2 ? Vec2f{1.5F, 0.7F} : Vec2f{};
    EXPECT_EQ(world->fill({from, {from.x + 1.6F, from.y + 1.1F}}), Status::ok);
    EXPECT_EQ(world->add_particle({1.7F, 1.6F}, {30.0F, -20.0F}), Status::ok);
    std::vector<std::uint64_t> hashes;
    for (std::int32_t step = 0; step < 8; ++step) {
        disturb(*world, dice);
        disturb(*world, dice);
        world->step(dice.uniform(0.002F, 0.03F));
        hashes.push_back(world->state_hash());
    }
    return hashes;
}

class Threads : public testing::TestWithParam<std::int32_t> {};

TEST_P(Threads, AnyOrderOfPiecesHasTheSameBits) {
    g_rounds = g_most_pieces = 0;
    EXPECT_EQ(hashes<float>(GetParam(), counted_backwards), hashes<float>(GetParam(), nullptr));
    EXPECT_GT(g_rounds, 50);
    EXPECT_GT(g_most_pieces, 3);
}

TEST_P(Threads, AnyNumberOfThreadsHasTheSameBits) {
    const std::vector<std::uint64_t> alone = hashes<float>(GetParam(), nullptr);
    for (const int threads : {1, 2, 3, 8}) {
        port::set_threads(threads);
        EXPECT_EQ(hashes<float>(GetParam(), port::parallel_for), alone) << threads << " threads";
    }
    port::set_threads(1);
}
INSTANTIATE_TEST_SUITE_P(OfBusyWorlds, Threads, testing::Range(0, kBusyKinds));

TEST(Threads, OtherScalarsHaveTheSameBits) {
    EXPECT_EQ(hashes<double>(0, counted_backwards), hashes<double>(0, nullptr));
    EXPECT_EQ(hashes<Fixed>(0, counted_backwards), hashes<Fixed>(0, nullptr));
}

/// Rows cannot be cut then, since particles that follow each other give to all of them; or all are
/// put in order.
TEST(Threads, ParticlesInNoOrderHaveTheSameBits) {
    const auto run = [](bool sorted, ParallelFor parallel_for) {
        WorldDef def = wide_def(8, parallel_for);
        def.keep_sorted = sorted;
        TestWorld<float> world(def);
        Dice dice(1);
        for (std::int32_t k = 0; k < 12345; ++k) {
            EXPECT_EQ(world->add_particle({dice.uniform(0.1F, 1.6F), dice.uniform(0.1F, 1.1F)},
                                          {dice.uniform(-1.0F, 1.0F), 0.0F}),
                      Status::ok);
        }
        for (std::int32_t step = 0; step < 3; ++step) {
            world->step(1.0F / 60.0F);
        }
        return world->state_hash();
    };
    port::set_threads(3);
    for (const bool sorted : {false, true}) {
        const std::uint64_t alone = run(sorted, nullptr);
        EXPECT_EQ(run(sorted, counted_backwards), alone) << sorted;
        EXPECT_EQ(run(sorted, port::parallel_for), alone) << sorted;
    }
    port::set_threads(1);
}

/// A window's rows begin with a column of the tank that is not its first.
TEST(Threads, WindowsHaveTheSameBitsWhereverTheyStand) {
    const auto run = [](ParallelFor parallel_for) {
        WorldDef def = tank_def(512, 200, 12000);
        def.capacity.window_cells = 160 * 120;
        def.keep_sorted = true;
        def.parallel_for = parallel_for;
        TestWorld<float> world(def);
        EXPECT_EQ(world->fill({{8.0F, 0.3F}, {9.2F, 1.2F}}), Status::ok);
        for (std::int32_t step = 0; step < 3; ++step) {
            EXPECT_EQ(world->step(1.0F / 60.0F).particles_beyond, 0);
        }
        return world->state_hash();
    };
    g_most_pieces = 0;
    EXPECT_EQ(run(counted_backwards), run(nullptr));
    EXPECT_GT(g_most_pieces, 3);
}

/// What is deeper in a solid than 32 cells has no way out.
std::uint64_t bury(ParallelFor parallel_for, std::int32_t* removed) {
    TestWorld<float> world(wide_def(8, parallel_for));
    EXPECT_EQ(world->fill({{0.0F, 0.0F}, {1.6F, 1.0F}}), Status::ok);
    const Ring ring = rectangle(1.5F, 1.5F);
    const BodyDef block = body_of(ring, {0.8F, 1.0F});
    put_static(*world, block);
    for (std::int32_t step = 0; step < 3; ++step) {
        *removed += world->step(1.0F / 60.0F).particles_removed_stuck;
    }
    return world->state_hash();
}

TEST(Threads, RemoveParticlesInTheSameOrder) {
    std::int32_t alone = 0, shared = 0;
    EXPECT_EQ(bury(counted_backwards, &shared), bury(nullptr, &alone));
    EXPECT_EQ(shared, alone);
    EXPECT_GT(alone, 10);
}

TEST(Threads, StepsCanBeCutIntoSlices) {
    const auto run = [](ParallelFor parallel_for, std::int32_t slice) {
        TestWorld<float> world(wide_def(1, parallel_for));
        EXPECT_EQ(world->fill({{0.0F, 0.0F}, {1.6F, 1.1F}}), Status::ok);
        StepReport report;
        EXPECT_EQ(world->begin_step(1.0F / 60.0F, &report), Status::ok);
        while (!world->advance(slice)) {
        }
        return world->state_hash();
    };
    const std::uint64_t alone = run(nullptr, 1000000000);
    for (const std::int32_t slice : {9000, 50000, 1000000000}) {
        EXPECT_EQ(run(counted_backwards, slice), alone) << slice;
    }
}

}  // namespace
}  // namespace weir
