// Memory in which another world lived, of whatever definition, holds nothing of it.
#include <algorithm>

#include "busy_world.hpp"

namespace weir {
namespace {

WEIR_SUITE(SecondLife, EveryScalar);

TYPED_TEST(SecondLife, HasNothingOfTheFirst) {
    for (std::int32_t kind = 0; kind < kBusyKinds; ++kind) {
        const std::int32_t next = (kind + 4) % kBusyKinds;
        if (!busy_kind_is_borne<TypeParam>(kind) || !busy_kind_is_borne<TypeParam>(next)) {
            continue;
        }
        SCOPED_TRACE(kind);
        WorldDef first = busy_def(kind);
        first.capacity.cells_x += 10;
        first.capacity.particles += 100;
        const WorldDef second = busy_def(next);
        const std::size_t bytes = std::max(world_bytes<TypeParam>(first.capacity),
                                           world_bytes<TypeParam>(second.capacity));
        const measure::WorldMemory memory(bytes);
        World<TypeParam> world;
        expect_ok(world.init(first, memory.data(), bytes));
        Dice dice(3);
        live(world, dice, 40);
        StepReport unfinished;
        expect_ok(world.begin_step(0.02F, &unfinished));
        world.advance(500);
        expect_ok(world.init(second, memory.data(), bytes));
        TestWorld<TypeParam> fresh(second);
        EXPECT_EQ(world.state_hash(), fresh->state_hash());
        Dice one(5);
        Dice same(5);
        live(world, one, 40);
        live(*fresh, same, 40);
        EXPECT_EQ(world.state_hash(), fresh->state_hash());
        EXPECT_EQ(saved(world, second.capacity), saved(*fresh, second.capacity));
    }
}

/// What `init` refuses leaves the world that was there as it was.
TYPED_TEST(SecondLife, DoesNotBeginWhereItIsRefused) {
    TestWorld<TypeParam> world(small_def());
    expect_ok(world->fill({{0.0F, 0.0F}, {0.1F, 0.1F}}));
    world->step(0.01F);
    const std::uint64_t before = world->state_hash();
    WorldDef other = small_def();
    other.cfl = 3.0F;
    World<TypeParam> none;
    EXPECT_EQ(none.init(other, world.memory(), 1 << 30), Status::cfl_out_of_range);
    EXPECT_EQ(world->init(other, world.memory(), 1 << 30), Status::cfl_out_of_range);
    EXPECT_EQ(world->state_hash(), before);
}

}  // namespace
}  // namespace weir
