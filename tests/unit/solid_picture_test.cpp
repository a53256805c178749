// The solids' picture on the grid follows from where bodies are, not from how they came there, and
// is drawn anew only where they come and go.
#include <cstring>
#include <type_traits>

#include "busy_world.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;

using Bytes = std::vector<std::byte>;

WorldDef tank() {
    return tank_def(40, 24, 900, 16, 64);
}

template <class Real>
Bytes saved(const World<Real>& world, const WorldDef& def) {
    Bytes bytes(snapshot_bytes<Real>(def.capacity));
    EXPECT_EQ(world.save(bytes.data(), bytes.size()), Status::ok);
    return bytes;
}

template <class Real>
const Layers<Real>& layers_of(TestWorld<Real>& world) {
    return state_of(world).simulation.layers;
}

/// Bit by bit, as far as it is stored.
template <class Real>
void expect_same_picture(TestWorld<Real>& a, TestWorld<Real>& b, const WorldDef& def) {
    const Layout plan = layout<Real>(def.capacity);
    for (const Block block :
         {Block::static_distance, Block::static_body, Block::merged_distance, Block::merged_body,
          Block::contour_case, Block::near_wall, Block::open_u, Block::open_v,
          Block::full_density, Block::wall_mark}) {
        const auto k = static_cast<std::int32_t>(block);
        EXPECT_EQ(std::memcmp(a.memory() + plan.offset[k], b.memory() + plan.offset[k],
                              plan.bytes[k]), 0)
            << "block " << k;
    }
}

/// A few bodies come and go, some of them on grid lines, and overlap.
template <class Real>
void change_bodies(World<Real>& world, Dice& dice) {
    BodyId id;
    const std::int32_t slot = dice.below(16);
    const bool exists = world.body_in_slot(slot, &id) == Status::ok;
    if (exists && dice.below(3) == 0) {
        EXPECT_EQ(world.set_surface(id, {0.0F, 0.0F, dice.below(2) == 0, 0.0F}), Status::ok);
    } else if (exists) {
        EXPECT_EQ(world.remove_body(id), Status::ok);
        return;
    }
    const bool straight = dice.below(3) == 0;
    const auto cells = [&](float low, float high) {
        const float at = dice.uniform(low, high);
        return kCell * (straight ? static_cast<float>(static_cast<int>(at)) : at);
    };
    const Ring ring = rectangle(cells(2.0F, 9.0F), cells(2.0F, 5.0F));
    BodyDef def = body_of(ring, {cells(3.0F, 37.0F), cells(1.0F, 14.0F)});
    def.motion.angle_rad = straight ? 0.0F : dice.uniform(-1.0F, 1.0F);
    def.surface.no_slip = dice.below(6) == 0;
    const bool moves = dice.below(5) == 0;
    def.motion.velocity_mps = {dice.uniform(-0.1F, 0.1F), dice.uniform(-0.1F, 0.1F)};
    const Status added = moves ? world.add_moving_body(def, &id) : world.add_static_body(def, &id);
    EXPECT_TRUE(added == Status::ok || added == Status::no_free_body) << status_text(added);
}

template <class Real>
void expect_picture_of_poses(const WorldDef& def, std::uint64_t seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    TestWorld<Real> world(def);
    TestWorld<Real> third(def);
    Dice dice(seed);
    ASSERT_EQ(world->fill({{0, 0}, {40 * kCell, 5 * kCell}}), Status::ok);
    for (int turn = 0; turn < 40; ++turn) {
        change_bodies(*world, dice);
        change_bodies(*world, dice);
        const Bytes snapshot = saved(*world, def);
        TestWorld<Real> fresh(def);
        ASSERT_EQ(fresh->restore(snapshot.data(), snapshot.size()), Status::ok);
        expect_same_picture(world, fresh, def);
        // One that lags behind: of what it shows only some is other.
        ASSERT_EQ(third->restore(snapshot.data(), snapshot.size()), Status::ok);
        expect_same_picture(world, third, def);
        world->step(kFrame);
        fresh->step(kFrame);
        third->step(kFrame);
        ASSERT_EQ(world->state_hash(), fresh->state_hash()) << turn;
        ASSERT_EQ(world->state_hash(), third->state_hash()) << turn;
        change_bodies(*third, dice);
        third->step(kFrame);
        ASSERT_FALSE(testing::Test::HasFailure()) << turn;
    }
}

WEIR_SUITE(BodiesPicture, EveryScalar);

TYPED_TEST(BodiesPicture, FollowsFromPosesAlone) {
    for (std::uint64_t seed = kSanitized ? 20 : 1; seed <= 20; ++seed) {
        expect_picture_of_poses<TypeParam>(tank(), seed);
    }
    WorldDef binary = tank();
    binary.contour = Contour::mid_edge;
    expect_picture_of_poses<TypeParam>(binary, 21);
    if constexpr (!std::is_same_v<TypeParam, SmallFixed>) {
        WorldDef thin = tank();
        thin.capacity.wall_edges = 2000;
        expect_picture_of_poses<TypeParam>(thin, 22);
    }
}

/// What bodies do on the left, no node on the right knows: a mark that is set there stays.
TYPED_TEST(BodiesPicture, IsDrawnAnewOnlyWhereBodiesComeAndGo) {
    using Real = TypeParam;
    const WorldDef def = tank();
    TestWorld<Real> world(def);
    const Ring block = rectangle(4 * kCell, 4 * kCell);
    const BodyId kept = put_static(*world, body_of(block, {30 * kCell, 4 * kCell}));
    BodyId id = put_static(*world, body_of(block, {6 * kCell, 4 * kCell}));
    const Layers<Real>& layers = layers_of(world);
    DistanceOf<Real>& mark = layers.static_distance[layers.shape.index(30, 4)];
    const Real other = Real(-1.75);
    mark = other;
    const auto expect_kept = [&](const char* what) { EXPECT_EQ(Real(mark), other) << what; };
    const Bytes snapshot = saved(*world, def);
    ASSERT_EQ(world->remove_body(id), Status::ok);
    expect_kept("removed");
    ASSERT_EQ(world->restore(snapshot.data(), snapshot.size()), Status::ok);
    expect_kept("rolled back");
    EXPECT_EQ(world->set_surface(kept, {0.0F, 0.0F, true, 0.0F}), Status::ok);
    expect_kept("made sticky");
    id = put_static(*world, body_of(block, {9 * kCell, 4 * kCell}));
    expect_kept("added");
    ASSERT_EQ(world->remove_body(kept), Status::ok);
    EXPECT_EQ(Real(mark), kBand<Real>) << "and goes with its body";
}

}  // namespace
}  // namespace weir
