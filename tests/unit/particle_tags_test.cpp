// Tags: a number of the caller's that stays with a particle, and changes nothing else.
#include <cmath>
#include <cstdint>
#include <map>

#include "measure/random.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

using Dice = measure::Random;
constexpr float kCell_m = 0.02F;
constexpr std::int32_t kColumns = 96;
constexpr float kWidth = kColumns * kCell_m;
constexpr float kHeight = 16 * kCell_m;

WorldDef tank() {
    WorldDef def = tank_def(kColumns, 16, 600);
    def.capacity.particle_tags = true;
    def.cell_m = kCell_m;
    return def;
}

/// Liquid comes and goes and is thrown about.
template <class Real>
void disturb(World<Real>& world, Dice& dice) {
    const Vec2f low{dice.uniform(0.0F, kWidth - 0.1F), dice.uniform(0.0F, kHeight - 0.1F)};
    const Box box{low, {low.x + 0.1F, low.y + 0.1F}};
    const Liquid kind = world.particle_kinds().size > 0 && dice.below(2) == 0 ? Liquid::second
                                                                             : Liquid::first;
    const std::int32_t before = world.particle_positions().size;
    switch (dice.below(8)) {
        case 0:
        case 1: static_cast<void>(world.fill(box, nullptr, kind)); break;
        case 2: static_cast<void>(world.remove_particle(dice.below(300))); break;
        case 3: expect_ok(world.drain({low, {low.x + 0.03F, low.y + 0.05F}})); break;
        case 4: expect_ok(world.stir(box, {dice.uniform(-1, 1), dice.uniform(-1, 1)}, 0.5F)); break;
        case 5: expect_ok(world.set_gravity({dice.uniform(-2, 2), dice.uniform(-9, 2)})); break;
        default: break;
    }
    for (std::int32_t k = before; k < world.particle_positions().size; ++k) {
        EXPECT_EQ(world.particle_tags()[k], 0);
        expect_ok(world.tag_particle(k, kind == Liquid::second ? 1 : 0));
    }
}

WEIR_SUITE(ParticleTags, EveryScalar);

/// What liquid a particle is of goes with it. Its tag says the same, whatever became of both.
TYPED_TEST(ParticleTags, GoWithTheKinds) {
    if (std::is_same_v<TypeParam, SmallFixed>) {
        GTEST_SKIP() << "it has one liquid";
    }
    for (std::int32_t way = 0; way < 4; ++way) {
        SCOPED_TRACE(way);
        WorldDef def = tank();
        def.capacity.second_liquid = true;
        def.keep_sorted = way % 2 == 1;
        def.capacity.sleeping_regions = way == 2;
        def.capacity.window_cells = way == 3 ? 66 * 18 : 0;
        def.sleep.speed_mps = 0.1F;
        TestWorld<TypeParam> one(def), other(def);
        TestWorld<TypeParam>* world = &one;
        TestWorld<TypeParam>* spare = &other;
        if (way == 2) {
            expect_ok(one->let_regions_sleep());
            expect_ok(other->let_regions_sleep());
        }
        expect_ok((*world)->fill({{0.0F, 0.0F}, {0.3F, 0.1F}}));
        Dice dice(static_cast<std::uint64_t>(way) + 1);
        for (std::int32_t step = 0; step < 200 && !testing::Test::HasFailure(); ++step) {
            disturb(**world, dice);
            (*world)->step(dice.uniform(0.002F, 0.02F));
            const View<Liquid> kinds = (*world)->particle_kinds();
            const View<std::uint8_t> tags = (*world)->particle_tags();
            ASSERT_EQ(tags.size, kinds.size);
            for (std::int32_t k = 0; k < tags.size; ++k) {
                EXPECT_EQ(tags[k], kinds[k] == Liquid::second ? 1 : 0) << step;
            }
            if (dice.below(20) == 0) {
                change_worlds(*world, *spare, def);
                std::swap(world, spare);
            }
        }
    }
}

/// Each has another number: none is there twice, none is lost, and all go on from where they were.
TYPED_TEST(ParticleTags, TellParticlesApart) {
    for (const bool sorted : {false, true}) {
        WorldDef def = tank();
        def.keep_sorted = sorted;
        TestWorld<TypeParam> world(def);
        expect_ok(world->fill({{0.0F, 0.0F}, {8 * kCell_m, 7 * kCell_m}}));
        const std::int32_t count = world->particle_positions().size;
        ASSERT_LE(count, 255);
        std::map<int, Vec2f> seen;
        for (std::int32_t k = 0; k < count; ++k) {
            expect_ok(world->tag_particle(k, static_cast<std::uint8_t>(k + 1)));
        }
        constexpr float kDt = 0.004F;
        for (std::int32_t step = 0; step < 200; ++step) {
            const std::int32_t left = world->particle_positions().size;
            if (step % 20 == 19) {
                const std::int32_t gone = (step * 7) % left;
                seen.erase(world->particle_tags()[gone]);
                expect_ok(world->remove_particle(gone));
            }
            std::map<int, Vec2f> now;
            for (std::int32_t k = 0; k < world->particle_tags().size; ++k) {
                const auto at = world->particle_positions()[k];
                now[world->particle_tags()[k]] = {static_cast<float>(at.x),
                                                  static_cast<float>(at.y)};
            }
            EXPECT_EQ(static_cast<std::int32_t>(now.size()), world->particle_positions().size);
            for (const auto& [tag, place] : seen) {
                ASSERT_EQ(now.count(tag), 1U);
                const Vec2f moved{now[tag].x - place.x, now[tag].y - place.y};
                EXPECT_LT(std::hypot(moved.x, moved.y), 3.0F * kDt / kCell_m) << "over 3 m/s";
            }
            seen = now;
            world->step(kDt);
        }
    }
}

TYPED_TEST(ParticleTags, ChangeNothingElse) {
    WorldDef def = tank();
    TestWorld<TypeParam> tagged(def);
    def.capacity.particle_tags = false;
    TestWorld<TypeParam> plain(def);
    Dice dice(3);
    EXPECT_EQ(plain->particle_tags().size, 0);
    for (TestWorld<TypeParam>* world : {&tagged, &plain}) {
        expect_ok((*world)->fill({{0.0F, 0.0F}, {0.3F, 0.1F}}));
    }
    for (std::int32_t step = 0; step < 50; ++step) {
        const float at = dice.uniform(0.0F, kWidth);
        expect_ok(tagged->tag({{at, -1.0F}, {at + 0.1F, 1.0F}},
                              static_cast<std::uint8_t>(dice.below(256))));
        tagged->step(0.01F);
        plain->step(0.01F);
        ASSERT_EQ(tagged->state_hash(), plain->state_hash());
    }
    const Capacity& with = tank().capacity;
    EXPECT_LE(world_bytes<TypeParam>(with), world_bytes<TypeParam>(def.capacity) + 608);
}

TYPED_TEST(ParticleTags, AreRefusedWhereThereAreNone) {
    WorldDef def = tank();
    TestWorld<TypeParam> world(def);
    const Box box{{0.0F, 0.0F}, {0.1F, 0.1F}};
    expect_ok(world->fill(box));
    const std::int32_t count = world->particle_positions().size;
    EXPECT_EQ(world->tag_particle(count, 1), Status::no_such_particle);
    EXPECT_EQ(world->tag_particle(-1, 1), Status::no_such_particle);
    EXPECT_EQ(world->tag({{0.1F, 0.0F}, {0.1F, 0.1F}}, 1), Status::box_is_empty);
    StepReport report;
    expect_ok(world->begin_step(0.01F, &report));
    EXPECT_EQ(world->tag(box, 1), Status::step_in_progress);
    EXPECT_EQ(world->tag_particle(0, 1), Status::step_in_progress);
    for (std::int32_t k = 0; k < count; ++k) {
        EXPECT_EQ(world->particle_tags()[k], 0);
    }
    def.capacity.particle_tags = false;
    TestWorld<TypeParam> plain(def);
    expect_ok(plain->fill(box));
    EXPECT_EQ(plain->tag(box, 1), Status::no_particle_tags);
    EXPECT_EQ(plain->tag_particle(0, 1), Status::no_particle_tags);
}

}  // namespace
}  // namespace weir
