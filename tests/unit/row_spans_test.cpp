// Spans: in wide tanks rows are worked on only where their liquid is. No bit is different by that.
#include "port/port.hpp"
#include "step/row_spans.hpp"
#include "window_life.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

#if WEIR_PARALLEL && WEIR_HAS_LANES

constexpr float kSize = 0.02F;

WorldDef wide_def(bool solids, bool threads) {
    WorldDef def = tank_def(302, 90, 4500, solids ? 3 : 0, solids ? 12 : 0);
    def.cell_m = kSize;
    def.parallel_for = threads ? port::parallel_for : nullptr;
    return def;
}

StaggeredGrid<float>& grid_of(TestWorld<float>& world) {
    return state_of(world).simulation.grid;
}

/// One that always works on whole rows.
class WholeRows : public TestWorld<float> {
public:
    explicit WholeRows(const WorldDef& def) : TestWorld<float>(def) {
        grid_of(*this).row_spans = nullptr;
    }
};

/// What happens to both worlds between their steps.
class Life {
public:
    Life(bool solids, std::uint64_t seed) : solids_(solids), dice_(seed) {}

    void begin(TestWorld<float>& world) {
        const Ring bar = rectangle(0.6F, 0.1F);
        const Ring stone = rectangle(0.3F, 0.3F);
        if (solids_) {
            put_static(*world, body_of(bar, {2.0F, 0.1F}, 0.3F));
            put_moving(*world, body_of(bar, {3.0F, 0.3F}));
            put_moving(*world, body_of(stone, {5.0F, 1.4F}));
        }
        expect_ok(world->fill({{2.5F, 0.9F}, {3.0F, 1.6F}}));
        expect_ok(world->fill({{5.5F, 1.5F}, {5.6F, 1.6F}}));
    }

    void disturb(TestWorld<float>& one, TestWorld<float>& other) {
        const std::int32_t what = dice_.below(14);
        const Vec2f place{dice_.uniform(0.1F, 5.9F), dice_.uniform(0.1F, 1.7F)};
        const Vec2f way{dice_.uniform(-12.0F, 12.0F), dice_.uniform(-12.0F, 12.0F)};
        for (TestWorld<float>* world : {&one, &other}) {
            if (what == 0) {
                expect_ok((*world)->set_gravity(way));
            } else if (what == 1) {
                static_cast<void>((*world)->add_particle(place, way));
            } else if (what == 2) {
                expect_ok((*world)->remove_particle((*world)->particle_positions().size / 3));
            } else if (what == 3 && solids_) {  // a leap, onto the liquid more often than not
                expect_ok((*world)->set_motion(body(2, *world), {place, 1.0F, way, 5.0F}));
            } else if (what == 4 && solids_) {
                expect_ok((*world)->set_motion(body(1, *world), {place, 0.0F, way, way.x}));
            } else if (what == 5) {
                expect_ok((*world)->drain({place, {place.x + 0.05F, place.y + 0.05F}}));
            }
        }
        if (what == 6) {
            static_cast<void>(one->density());
        } else if (what == 7) {
            Diagnostics ignored;
            expect_ok(one->diagnose(&ignored));
        }
    }

private:
    static BodyId body(std::int32_t slot, TestWorld<float>& world) {
        BodyId id;
        expect_ok(world->body_in_slot(slot, &id));
        return id;
    }

    bool solids_;
    Dice dice_;
};

/// Returns in how many steps rows were not worked on whole.
std::int32_t expect_same_bits(bool solids, bool threads, std::uint64_t seed, std::int32_t steps) {
    SCOPED_TRACE(testing::Message() << "solids " << solids << " seed " << seed);
    const WorldDef def = wide_def(solids, threads);
    TestWorld<float> first(def), second(def);
    TestWorld<float>* narrow = &first;
    TestWorld<float>* spare = &second;
    WholeRows whole(wide_def(solids, false));
    Life life(solids, seed);
    life.begin(*narrow);
    life.begin(whole);
    Dice dice(seed + 7);
    std::int32_t spared = 0;
    for (std::int32_t step = 0; step < steps && !testing::Test::HasFailure(); ++step) {
        if (step > 20) {
            life.disturb(*narrow, whole);
        }
        const float dt = dice.uniform(0.004F, 0.02F);
        any_step(**narrow, dt, dice);
        whole->step(dt);
        spared += grid_of(*narrow).whole_rows ? 0 : 1;
        EXPECT_TRUE(grid_of(whole).whole_rows);
        EXPECT_EQ((*narrow)->state_hash(), whole->state_hash()) << "step " << step;
        if (dice.below(30) == 0) {
            change_worlds(*narrow, *spare, def);
            std::swap(narrow, spare);
        }
    }
    return spared;
}

TEST(RowSpans, HaveTheBitsOfWholeRows) {
    std::int32_t spared = 0;
    constexpr std::int32_t kSeeds = kSanitized ? 1 : 3;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        spared += expect_same_bits(false, seed == 2, seed, 80);
        spared += expect_same_bits(true, seed == 2, seed, 80);
    }
    EXPECT_GT(spared, 80 * kSeeds) << "of " << 160 * kSeeds << " steps";
}

/// In how many steps of such a world rows were not worked on whole.
std::int32_t narrow_steps(WorldDef def) {
    if (def.periodic_x || def.periodic_y) {
        def.capacity.bodies = def.capacity.vertices = 0;
    }
    TestWorld<float> world(def);
    if (def.capacity.sleeping_regions) {
        expect_ok(world->let_regions_sleep());
    }
    const Ring ring = rectangle(0.6F, 0.1F);
    if (def.capacity.bodies > 0) {
        BodyDef bar = body_of(ring, {2.0F, 0.1F});
        bar.open = def.capacity.wall_edges > 0;
        put_static(*world, bar);
    }
    expect_ok(world->fill({{2.5F, 0.9F}, {3.0F, 1.6F}}));
    const Liquid kind = def.capacity.second_liquid ? Liquid::second : Liquid::first;
    expect_ok(world->fill({{5.5F, 1.5F}, {5.6F, 1.6F}}, nullptr, kind));
    std::int32_t steps = 0;
    for (std::int32_t step = 0; step < 10; ++step) {
        world->step(0.01F);
        steps += grid_of(world).whole_rows ? 0 : 1;
    }
    return steps;
}

/// Of some kinds of liquid, tanks and solids there are stages that know no spans.
TEST(RowSpans, AreNotForEveryKindOfWorld) {
    using Change = void (*)(WorldDef&);
    struct Row {
        const char* name;
        Change change;
    };
    const Row rows[] = {
        {"forces", [](WorldDef& def) { def.capacity.two_way = true; }},
        {"thin walls", [](WorldDef& def) { def.capacity.wall_edges = 400; }},
        {"elastic", [](WorldDef& def) { def.pressure = Pressure::equation_of_state; }},
        {"two liquids", [](WorldDef& def) { def.capacity.second_liquid = true; }},
        {"periodic in x", [](WorldDef& def) { def.periodic_x = true; }},
        {"periodic in y", [](WorldDef& def) { def.periodic_y = true; }},
        {"viscous", [](WorldDef& def) { def.viscosity_m2ps = 1.0e-3F; }},
        {"surface tension", [](WorldDef& def) { def.surface_tension_m3ps2 = 7.3e-5F; }},
        {"regions",
         [](WorldDef& def) {
             def.capacity.sleeping_regions = true;
             def.sleep.speed_mps = 0.02F;
         }},
    };
    EXPECT_GT(narrow_steps(wide_def(true, false)), 5);
    for (const Row& row : rows) {
        WorldDef def = wide_def(true, false);
        row.change(def);
        EXPECT_EQ(narrow_steps(def), 0) << row.name;
    }
}

/// What is not worked on shows as empty to whoever looks.
TEST(RowSpans, LeaveEmptyWhatLiquidLeft) {
    TestWorld<float> narrow(wide_def(false, false));
    WholeRows whole(wide_def(false, false));
    Life life(false, 1);
    life.begin(narrow);
    life.begin(whole);
    for (std::int32_t step = 0; step < 60; ++step) {
        narrow->step(0.01F);
        whole->step(0.01F);
    }
    ASSERT_FALSE(grid_of(narrow).whole_rows);
    const auto density = narrow->density();
    const auto pressure = narrow->pressure();
    for (std::int32_t j = 0; j < density.rows; ++j) {
        for (std::int32_t i = 0; i < density.columns; ++i) {
            ASSERT_EQ(density.at(i, j), whole->density().at(i, j)) << i << " " << j;
            ASSERT_EQ(pressure.at(i, j), whole->pressure().at(i, j)) << i << " " << j;
        }
    }
}

TEST(RowSpans, TakeNoMemoryInNarrowTanks) {
    WorldDef def = wide_def(false, false);
    const Layout wide = layout<float>(def.capacity);
    def.capacity.cells_x = kLeastSpanned - 1;
    const Layout narrow = layout<float>(def.capacity);
    const auto block = static_cast<std::size_t>(Block::row_span);
    EXPECT_GE(wide.bytes[block], kRowSpanBytes * 90 / 4);
    EXPECT_EQ(narrow.bytes[block], 0U);
}

#endif

}  // namespace
}  // namespace weir
