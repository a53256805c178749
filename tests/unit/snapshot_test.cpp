// Snapshots: what comes back goes on with the same bits; what is no snapshot of this world is
// refused, and the world goes on as if nobody had asked.
#include <cstring>

#include "bad_input.hpp"
#include "busy_world.hpp"

namespace weir {
namespace {

constexpr Capacity kSmall = [] {
    Capacity c;
    c.particles = 200, c.cells_x = 16, c.cells_y = 16, c.bodies = 3, c.vertices = 12;
    return c;
}();
static_assert(snapshot_bytes<float>(kSmall) < world_bytes<float>(kSmall) / 2, "scratch is not kept");
static_assert(snapshot_bytes<float>(kSmall) > 200 * 16 + 18 * 18 * 4, "at compile time");

using Bytes = std::vector<std::byte>;

/// Whatever a snapshot does not bring gets random bits, not-a-numbers among them: but for the
/// solids' picture, which stays where it is the same, and half of the time what it brings as well.
template <class Real>
void scramble(TestWorld<Real>& world, const Capacity& capacity, Dice& dice) {
    const Layout plan = layout<Real>(capacity);
    const bool all = dice.below(2) == 0;
    for (std::int32_t block = 0; block < kBlockCount; ++block) {
        const Kept kept = plan.kept[block];
        if (kept == Kept::members || kept == Kept::redrawn || (kept == Kept::vertices && !all)) {
            continue;
        }
        for (std::size_t at = 0; at < plan.bytes[block]; at += 4) {
            const std::uint64_t random = dice.bits();
            const auto bits = static_cast<std::uint32_t>(random % 3 == 0 ? ~0ULL : random >> 8U);
            std::memcpy(world.memory() + plan.offset[block] + at, &bits, sizeof bits);
        }
    }
}

/// The solids' picture on the grid, bit by bit.
template <class Real>
void expect_same_picture(TestWorld<Real>& a, TestWorld<Real>& b, const Capacity& capacity) {
    const Layout plan = layout<Real>(capacity);
    for (const Block block :
         {Block::static_distance, Block::static_body, Block::merged_distance, Block::merged_body,
          Block::contour_case, Block::near_wall, Block::open_u, Block::open_v,
          Block::full_density}) {
        const auto k = static_cast<std::int32_t>(block);
        EXPECT_EQ(std::memcmp(a.memory() + plan.offset[k], b.memory() + plan.offset[k],
                              plan.bytes[k]), 0)
            << "block " << k;
    }
}

/// A world lives, is saved and goes on; the snapshot is restored over another life's memory, its
/// scratch overwritten, and has to go on alike.
template <class Real>
void expect_goes_on_alike(std::int32_t kind, std::uint64_t seed) {
    if (!busy_kind_is_borne<Real>(kind)) {
        return;
    }
    SCOPED_TRACE(testing::Message() << "kind " << kind << " seed " << seed);
    const WorldDef def = busy_def(kind);
    TestWorld<Real> one(def);
    TestWorld<Real> other(def);
    Dice dice(seed);
    live(*one, dice, 30);
    const bool placed = dice.below(3) == 0;
    if (placed) {
        move_body(*one, dice, 0);
        move_body(*one, dice, 1);
    }
    Dice elsewhere(seed + 1000);
    live(*other, elsewhere, 20);

    const std::uint64_t hash = one->state_hash();
    const Bytes snapshot = saved(*one, def.capacity);
    EXPECT_EQ(one->state_hash(), hash) << "saving changed the world";
    scramble(other, def.capacity, elsewhere);
    ASSERT_EQ(other->restore(snapshot.data(), snapshot.size()), Status::ok);
    ASSERT_EQ(other->state_hash(), hash);
    EXPECT_EQ(saved(*other, def.capacity), snapshot);
    if (!placed && def.capacity.bodies > 0) {
        expect_same_picture(one, other, def.capacity);
    }
    one->step(0.01F);
    other->step(0.01F);
    Dice here = dice;
    Dice there = dice;
    for (std::int32_t step = 0; step < 50; ++step) {
        live(*one, here, 1);
        live(*other, there, 1);
        ASSERT_EQ(one->state_hash(), other->state_hash()) << "step " << step;
    }
    if (def.capacity.bodies > 0) {
        expect_same_picture(one, other, def.capacity);
    }
}

TEST(Snapshot, RestoredWorldGoesOnWithTheSameBits) {
    for (std::int32_t kind = 0; kind < kBusyKinds; ++kind) {
        for (std::uint64_t seed = kSanitized ? 12 : 1; seed <= 12; ++seed) {
            expect_goes_on_alike<float>(kind, seed);
        }
        expect_goes_on_alike<double>(kind, 13);
        expect_goes_on_alike<Fixed>(kind, 14);
        expect_goes_on_alike<SmallFixed>(kind, 15);
    }
}

/// Two bodies on a common edge, and a third one later in the slot of the first: nodes on the edge
/// are as near to one as to the other, and the last one drawn must not matter.
TEST(Snapshot, PictureDoesNotTellWhenBodiesCame) {
    for (const bool moving : {false, true}) {
        const WorldDef def = busy_def(0);
        TestWorld<float> one(def);
        const Ring block = {{0, 0}, {0.06F, 0}, {0.06F, 0.04F}, {0, 0.04F}};
        BodyDef left = body_of(block, {0.06F, 0.04F});
        const BodyDef right = body_of(block, {0.12F, 0.04F});
        const BodyId first = put_static(*one, left);
        BodyId id = put_static(*one, right);
        ASSERT_EQ(one->remove_body(first), Status::ok);
        left.surface.restitution = 1.0F;
        ASSERT_EQ(moving ? one->add_moving_body(left, &id) : one->add_static_body(left, &id),
                  Status::ok);
        EXPECT_EQ(id.slot, first.slot);
        const Bytes snapshot = saved(*one, def.capacity);
        TestWorld<float> other(def);
        ASSERT_EQ(other->restore(snapshot.data(), snapshot.size()), Status::ok);
        expect_same_picture(one, other, def.capacity);
    }
}

/// What is drawn stays where the snapshot has the same: not of a body that was moved since.
TEST(Snapshot, DrawsABodyThatWasMovedSince) {
    WorldDef def = small_def();
    def.capacity.wall_edges = 0;  // or all is drawn anew
    TestWorld<float> world(def);
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    world->step(0.01F);
    Motion motion = motion_of(*world, id);
    motion.position_m = {0.2F, 0.2F};
    expect_ok(world->set_motion(id, motion));
    const Bytes snapshot = saved(*world, def.capacity);
    expect_ok(world->restore(snapshot.data(), snapshot.size()));
    EXPECT_EQ(world->add_particle({0.2F, 0.2F}, {}), Status::particle_inside_solid);
    EXPECT_EQ(world->add_particle({0.1F, 0.1F}, {}), Status::ok);
}

/// Nor of another body in its slot that differs from it in any one thing.
TEST(Snapshot, DrawsABodyInWhoseSlotIsAnother) {
    WorldDef def = small_def();
    def.capacity.wall_edges = 0;
    const Ring corner = {{0, 0}, {0.04F, 0}, {0.04F, 0.04F}};
    const Ring more = {{0, 0}, {0.04F, 0}, {0.04F, 0.04F}, {0, 0.04F}};
    const Ring other_end = {{0, 0}, {0.04F, 0}, {0.04F, 0.05F}};
    const Vec2f at{0.1F, 0.1F};
    const BodyDef rows[] = {body_of(corner, at),           body_of(corner, {0.13F, 0.1F}),
                            body_of(corner, {0.1F, 0.13F}), body_of(corner, at, 0.5F),
                            body_of(more, at),             body_of(other_end, at)};
    for (const bool moves : {false, true}) {
        for (std::size_t row = moves ? 0 : 1; row < std::size(rows); ++row) {
            TestWorld<float> one(def);
            TestWorld<float> other(def);
            const BodyId id = put_static(*one, rows[0]);
            one->step(0.0F);
            const Bytes snapshot = saved(*one, def.capacity);
            expect_ok(one->remove_body(id));
            static_cast<void>(moves ? put_moving(*one, rows[row]) : put_static(*one, rows[row]));
            one->step(0.0F);
            expect_ok(one->restore(snapshot.data(), snapshot.size()));
            expect_ok(other->restore(snapshot.data(), snapshot.size()));
            SCOPED_TRACE(testing::Message() << moves << " " << row);
            expect_same_picture(one, other, def.capacity);
        }
    }
}

TEST(Snapshot, RollsBackTheSameWorld) {
    const WorldDef def = busy_def(0);
    TestWorld<float> world(def);
    Dice dice(7);
    live(*world, dice, 40);
    const Bytes snapshot = saved(*world, def.capacity);
    std::uint64_t first = 0;
    for (int time = 0; time < 3; ++time) {
        Dice again = dice;
        live(*world, again, 30);
        first = time == 0 ? world->state_hash() : first;
        EXPECT_EQ(world->state_hash(), first) << time;
        ASSERT_EQ(world->restore(snapshot.data(), snapshot.size()), Status::ok);
    }
}

TEST(Snapshot, NamesOfBodiesHoldAcrossARollback) {
    TestWorld<float> world(small_def());
    const BodyId kept = put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    const Bytes snapshot = saved(*world, small_def().capacity);
    const BodyId later = put_static(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
    ASSERT_EQ(world->restore(snapshot.data(), snapshot.size()), Status::ok);
    Motion motion;
    EXPECT_EQ(world->motion(kept, &motion), Status::ok);
    EXPECT_EQ(world->motion(later, &motion), Status::stale_body);
    BodyId again;
    EXPECT_EQ(world->body_in_slot(kept.slot, &again), Status::ok);
    EXPECT_EQ(again.generation, kept.generation);
    EXPECT_EQ(again.world, kept.world);
    EXPECT_EQ(world->body_in_slot(later.slot, &again), Status::stale_body);
    EXPECT_EQ(world->body_in_slot(-1, &again), Status::stale_body);
    EXPECT_EQ(world->body_in_slot(3, &again), Status::stale_body);
    EXPECT_EQ(world->body_in_slot(0, nullptr), Status::output_missing);
}

/// Equal worlds have equal snapshots, whatever stood where their bodies stand now.
TEST(Snapshot, HoldsNothingOfABodyThatIsGone) {
    WorldDef def = small_def();
    def.capacity.vertices = 40;
    def.capacity.wall_edges = 100;
    const Ring hole = {{0.01F, 0.01F}, {0.03F, 0.01F}, {0.01F, 0.03F}};
    const View<Vec2f> holes[] = {{hole.data(), 3}};
    BodyDef before = body_of(kTriangle, {0.1F, 0.1F});
    before.holes = {holes, 1};
    for (const bool open : {false, true}) {
        TestWorld<float> world(def);
        const Bytes empty = saved(*world, def.capacity);
        BodyDef after = body_of(kSquare4cm, {0.1F, 0.1F});
        after.open = open;
        put_static(*world, after);
        const Bytes expected = saved(*world, def.capacity);
        expect_ok(world->restore(empty.data(), empty.size()));
        put_static(*world, before);
        expect_ok(world->restore(empty.data(), empty.size()));
        put_static(*world, after);
        EXPECT_EQ(saved(*world, def.capacity), expected);
    }
}

/// A call that asks where solids are has the picture drawn, and may be refused.
TEST(Snapshot, DoesNotTellWhetherBodiesWereDrawn) {
    TestWorld<float> world(small_def());
    const BodyId id = put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    Motion motion = motion_of(*world, id);
    motion.position_m = {0.2F, 0.2F};
    expect_ok(world->set_motion(id, motion));
    const Bytes before = saved(*world, small_def().capacity);
    EXPECT_EQ(world->add_particle({0.2F, 0.2F}, {}), Status::particle_inside_solid);
    EXPECT_EQ(saved(*world, small_def().capacity), before);
}

TEST(Snapshot, FullestWorldFitsItsRoom) {
    WorldDef def = small_def();
    def.capacity.second_liquid = true;
    TestWorld<double> world(def);
    for (int k = 0; k < 3; ++k) {
        put_moving(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    }
    for (int k = 0; k < 200; ++k) {
        ASSERT_EQ(world->add_particle({0.3F, 0.3F}, {}), Status::ok);
    }
    const std::size_t room = snapshot_bytes<double>(def.capacity);
    const Bytes snapshot = saved(*world, def.capacity);
    EXPECT_GT(snapshot.size() + 64 * 3 + 192, room) << "the room is much larger than needed";
}

/// Restores what another world saved, into one of `small_def`.
template <class Real>
Status restore_of(Fixture& f, const WorldDef& def, std::size_t flipped = ~std::size_t{0}) {
    TestWorld<Real> other(def);
    EXPECT_EQ(other->fill({{0, 0}, {0.1F, 0.1F}}), Status::ok);
    Bytes snapshot = saved(*other, def.capacity);
    if (flipped < snapshot.size()) {
        snapshot[flipped] ^= std::byte{1};
    }
    return (*f).restore(snapshot.data(), snapshot.size());
}

WorldDef changed(void (*change)(WorldDef&)) {
    WorldDef def = small_def();
    change(def);
    return def;
}

}  // namespace

const std::vector<Row>& snapshot_rows() {
    static const std::vector<Row> rows = {
        {"save to null", [](Fixture& f) { return (*f).save(nullptr, 1 << 20); },
         Status::snapshot_missing},
        {"restore null", [](Fixture& f) { return (*f).restore(nullptr, 1 << 20); },
         Status::snapshot_missing},
        {"save to less room than is needed",
         [](Fixture& f) {
             const std::size_t size = saved(*f, small_def().capacity).size();
             Bytes room(size, std::byte{0x5A});
             const Status refused = (*f).save(room.data(), size - 1);
             EXPECT_EQ(room, Bytes(size, std::byte{0x5A})) << "a refused call wrote";
             return refused;
         },
         Status::snapshot_room_too_small},
        {"first half of a snapshot",
         [](Fixture& f) {
             const Bytes snapshot = saved(*f, small_def().capacity);
             return (*f).restore(snapshot.data(), snapshot.size() / 2);
         },
         Status::snapshot_truncated},
        {"one byte", [](Fixture& f) { return (*f).restore("W", 1); }, Status::snapshot_truncated},
        {"wrong magic", [](Fixture& f) { return restore_of<float>(f, small_def(), 0); },
         Status::snapshot_not_recognised},
        {"wrong version", [](Fixture& f) { return restore_of<float>(f, small_def(), 4); },
         Status::snapshot_of_other_version},
        {"flipped bit", [](Fixture& f) { return restore_of<float>(f, small_def(), 500); },
         Status::snapshot_damaged},
        {"of doubles", [](Fixture& f) { return restore_of<double>(f, small_def()); },
         Status::snapshot_of_other_scalar},
        {"one particle more",
         [](Fixture& f) {
             return restore_of<float>(f, changed([](WorldDef& d) { ++d.capacity.particles; }));
         },
         Status::snapshot_of_other_capacity},
        {"another share of PIC",
         [](Fixture& f) {
             return restore_of<float>(f, changed([](WorldDef& d) { d.flip_ratio = 0.98F; }));
         },
         Status::snapshot_of_other_definition},
        {"other walls",
         [](Fixture& f) {
             return restore_of<float>(f, changed([](WorldDef& d) { d.walls.left.no_slip = true; }));
         },
         Status::snapshot_of_other_definition},
    };
    return rows;
}

namespace {

TEST(Snapshot, RefusalsChangeNothing) { check_all(snapshot_rows()); }

TEST(Snapshot, NoWorldNoSnapshot) {
    World<float> none;
    std::byte byte{};
    BodyId id;
    EXPECT_EQ(none.save(&byte, 1), Status::not_initialised);
    EXPECT_EQ(none.restore(&byte, 1), Status::not_initialised);
    EXPECT_EQ(none.body_in_slot(0, &id), Status::not_initialised);
}

TEST(Snapshot, EveryTruncationIsNoticed) {
    const WorldDef def = busy_def(0);
    TestWorld<float> world(def);
    Dice dice(3);
    live(*world, dice, 10);
    const std::uint64_t hash = world->state_hash();
    const Bytes snapshot = saved(*world, def.capacity);
    for (std::size_t size = 0; size < snapshot.size(); ++size) {
        ASSERT_EQ(world->restore(snapshot.data(), size), Status::snapshot_truncated) << size;
    }
    EXPECT_EQ(world->state_hash(), hash);
}

TEST(Snapshot, NeedsNoAlignment) {
    const WorldDef def = busy_def(3);
    TestWorld<float> world(def);
    Dice dice(5);
    live(*world, dice, 20);
    const Bytes snapshot = saved(*world, def.capacity);
    Bytes shifted(snapshot.size() + 1);
    ASSERT_EQ(world->save(shifted.data() + 1, snapshot.size()), Status::ok);
    EXPECT_EQ(std::memcmp(shifted.data() + 1, snapshot.data(), snapshot.size()), 0);
    EXPECT_EQ(world->restore(shifted.data() + 1, snapshot.size()), Status::ok);
}

TEST(Snapshot, EveryFlippedBitIsNoticed) {
    WorldDef def = small_def();
    def.capacity.particles = 12;
    def.capacity.cells_x = def.capacity.cells_y = 6;
    TestWorld<float> world(def);
    ASSERT_EQ(world->fill({{0, 0}, {0.03F, 0.03F}}), Status::ok);
    put_moving(*world, body_of(kSquare4cm, {0.08F, 0.08F}));
    world->step(0.01F);
    const std::uint64_t hash = world->state_hash();
    Bytes snapshot = saved(*world, def.capacity);
    for (std::size_t bit = 0; bit < 8 * snapshot.size(); ++bit) {
        snapshot[bit / 8] ^= std::byte{1} << (bit % 8);
        ASSERT_NE(world->restore(snapshot.data(), snapshot.size()), Status::ok) << bit;
        snapshot[bit / 8] ^= std::byte{1} << (bit % 8);
    }
    EXPECT_EQ(world->state_hash(), hash);
    EXPECT_EQ(world->restore(snapshot.data(), snapshot.size()), Status::ok);
}

}  // namespace
}  // namespace weir
