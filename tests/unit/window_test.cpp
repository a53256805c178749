// Window: of a huge tank only the cells around the liquid are stored. As long as the liquid fits no
// bit is different; if it does not, no particle is lost.
#include <algorithm>

#include "busy_world.hpp"
#include "port/port.hpp"
#include "weir/display.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

constexpr Capacity kHuge = [] {
    Capacity c;
    c.particles = 4096, c.cells_x = 4096, c.cells_y = 4096;
    return c;
}();
constexpr Capacity kHugeWindowed = [] {
    Capacity c = kHuge;
    c.window_cells = 320 * 160;
    return c;
}();
static_assert(world_bytes<float>(kHuge) > 600'000'000, "the tank decides");
static_assert(world_bytes<float>(kHugeWindowed) < 2'100'000, "the window does");

constexpr std::int32_t kKinds = 9;

/// Worlds without bodies in a tank that is large for their liquid.
WorldDef wide_def(std::int32_t kind) {
    WorldDef def;
    def.capacity.particles = 500;
    def.capacity.cells_x = 250;
    def.capacity.cells_y = 150;
    def.walls = every_wall({0.0F, 0.5F, false, 0.0F});
    switch (kind) {
        case 1:
            def.pressure = Pressure::equation_of_state;
            def.sound_speed_mps = 3.0F;
            break;
        case 2:
            def.capacity.second_liquid = true;
            def.second_density_ratio = 3.0F;
            break;
        case 3:
            def.viscosity_m2ps = 1.0e-3F;
            def.walls = every_wall({0.0F, 0.3F, true, 0.2F});
            break;
        case 4:
            def.periodic_x = true;
            def.surface_tension_m3ps2 = 2.0e-4F;
            break;
        case 5: def.surface_tension_m3ps2 = 2.0e-4F; break;
        case 6: def.periodic_y = true; break;
        case 7: def.keep_sorted = true; break;
        case 8: def.sleep.speed_mps = 0.05F; break;
        default: break;
    }
    return def;
}

WorldDef windowed(WorldDef def, std::int32_t window_cells) {
    def.capacity.window_cells = window_cells;
    return def;
}

/// A lump that is moved about as a whole: gravity turns, and what strays is taken away.
template <class Real>
class Nomads {
public:
    Nomads(std::int32_t kind, std::uint64_t seed) : kind_(kind), dice_(seed) {}

    /// The same happens to both.
    void disturb(World<Real>& one, World<Real>& other) {
        const Vec2f low = lowest(one);
        switch (dice_.below(10)) {
            case 0: {
                const Vec2f gravity{dice_.uniform(-12.0F, 12.0F), dice_.uniform(-12.0F, 12.0F)};
                both(one, other, [&](World<Real>& w) { return w.set_gravity(gravity); });
                break;
            }
            case 1:
            case 2: {
                const Vec2f to{dice_.uniform(0.02F, 0.25F), dice_.uniform(0.02F, 0.25F)};
                const Box box{low, {std::min(low.x + to.x, 4.9F), std::min(low.y + to.y, 2.9F)}};
                const Liquid liquid = kind_ == 2 && dice_.below(2) == 0 ? Liquid::second
                                                                       : Liquid::first;
                both(one, other, [&](World<Real>& w) { return w.fill(box, nullptr, liquid); });
                break;
            }
            case 3: {
                const Vec2f way{dice_.uniform(-2.0F, 2.0F), dice_.uniform(-2.0F, 2.0F)};
                both(one, other, [&](World<Real>& w) {
                    return w.add_particle({std::min(low.x + 0.1F, 4.9F), low.y}, way);
                });
                break;
            }
            default: break;
        }
        thin_out(one, other);
    }

private:
    template <class Do>
    void both(World<Real>& one, World<Real>& other, Do what) {
        const Status did = what(one);
        EXPECT_EQ(what(other), did);
    }

    /// Of the box around the last particle: where what is added belongs.
    Vec2f lowest(const World<Real>& world) {
        const auto position = world.particle_positions();
        if (position.size == 0) {
            return {dice_.uniform(0.0F, 4.0F), dice_.uniform(0.0F, 2.0F)};
        }
        const auto last = position[position.size / 2];
        return {std::clamp(kCell * static_cast<float>(last.x) - 0.05F, 0.0F, 4.7F),
                std::clamp(kCell * static_cast<float>(last.y) - 0.05F, 0.0F, 2.8F)};
    }

    /// So that the rest fits: 49 × 33 cells about the middle one.
    void thin_out(World<Real>& one, World<Real>& other) {
        const auto position = one.particle_positions();
        if (position.size == 0) {
            return;
        }
        const auto middle = position[position.size / 2];
        for (std::int32_t k = one.particle_positions().size - 1; k >= 0; --k) {
            const auto at = one.particle_positions()[k];
            const float x = static_cast<float>(at.x) - static_cast<float>(middle.x);
            const float y = static_cast<float>(at.y) - static_cast<float>(middle.y);
            if ((kind_ != 4 && std::abs(x) > 24.0F) || (kind_ != 6 && std::abs(y) > 16.0F)) {
                both(one, other, [&](World<Real>& w) { return w.remove_particle(k); });
            }
        }
    }

    std::int32_t kind_;
    Dice dice_;
};

std::int32_t window_of(std::int32_t kind) {
    switch (kind) {
        case 4: return 252 * 66;
        case 6: return 130 * 152;
        default: return 130 * 66;
    }
}

bool same(const Diagnostics& a, const Diagnostics& b) {
    return a.volume_m2 == b.volume_m2 && a.largest_density == b.largest_density &&
           a.divergence_per_s == b.divergence_per_s &&
           a.kinetic_energy_m4ps2 == b.kinetic_energy_m4ps2;
}

/// Saves one world and goes on in another.
template <class Real>
void change_worlds(TestWorld<Real>& from, TestWorld<Real>& to, const WorldDef& def) {
    std::vector<std::byte> bytes(snapshot_bytes<Real>(def.capacity));
    std::size_t written = 0;
    ASSERT_EQ(from->save(bytes.data(), bytes.size(), &written), Status::ok);
    ASSERT_EQ(to->restore(bytes.data(), written), Status::ok);
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

/// Returns how often the window was another one after a step.
template <class Real>
std::int32_t expect_same_life(std::int32_t kind, std::uint64_t seed, std::int32_t steps) {
    SCOPED_TRACE(testing::Message() << "kind " << kind << " seed " << seed);
    const WorldDef def = wide_def(kind);
    WorldDef part = windowed(def, window_of(kind));
    part.parallel_for = kind == 7 ? port::parallel_for : nullptr;
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
    for (std::int32_t step = 0; step < steps; ++step) {
        nomads.disturb(**stored, *whole);
        const float dt = dice.uniform(0.005F, 0.03F);
        const StepReport report = any_step(**stored, dt, dice);
        whole->step(dt);
        beyond += report.particles_beyond;
        const auto view = (*stored)->density();
        const std::int32_t now = view.first_column + 1000 * view.first_row + 100 * view.rows;
        moves += now != place ? 1 : 0;
        place = now;
        EXPECT_EQ((*stored)->state_hash(), whole->state_hash()) << "step " << step;
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

template <class Real>
class Window : public testing::Test {};
using Scalars = testing::Types<float, double, Fixed>;
TYPED_TEST_SUITE(Window, Scalars, );

TYPED_TEST(Window, HasTheBitsOfTheWholeTank) {
    for (std::int32_t kind = 0; kind < kKinds; ++kind) {
        std::int32_t moves = 0;
        for (std::uint64_t seed = 1; seed <= 2 && !testing::Test::HasFailure(); ++seed) {
            moves += expect_same_life<TypeParam>(kind, seed, 100);
        }
        EXPECT_TRUE(kind == 4 || moves > 5) << moves << ", kind " << kind;
    }
}

/// Two lumps too far apart: the smaller one falls as in a vacuum, and then lies.
TYPED_TEST(Window, WhatIsBeyondFallsAlone) {
    using Real = TypeParam;
    TestWorld<Real> world(windowed(wide_def(0), 66 * 42));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.20F, 0.10F}}));
    const std::int32_t near = world->particle_positions().size;
    expect_ok(world->fill({{4.0F, 1.0F}, {4.06F, 1.04F}}));
    const std::int32_t all = world->particle_positions().size;
    constexpr float kDt = 0.01F;
    for (std::int32_t step = 1; step <= 20; ++step) {
        const StepReport report = world->step(kDt);
        EXPECT_EQ(report.particles_beyond, all - near);
        EXPECT_EQ(report.particles, all);
        EXPECT_EQ(world->particle_positions().size, all);
        const auto v = static_cast<float>(world->particle_velocities()[0].y) * kCell;
        EXPECT_NEAR(v, -9.81F * kDt * static_cast<float>(step), 0.01F);
    }
    Diagnostics diagnostics;
    expect_ok(world->diagnose(&diagnostics));
    EXPECT_EQ(diagnostics.volume_m2, 0.0) << "not known";
    // The tank leans: all come together again in a corner.
    expect_ok(world->set_gravity({9.81F, -9.81F}));
    std::int32_t beyond = all;
    for (std::int32_t step = 0; step < 400; ++step) {
        beyond = world->step(kDt).particles_beyond;
    }
    EXPECT_EQ(beyond, 0);
    EXPECT_EQ(world->particle_positions().size, all);
    EXPECT_TRUE(all_inside(*world));
}

/// Liquid that never fits: nobody is lost or leaves the tank, slices change nothing, a snapshot
/// knows all of it, and no stage does more than was said.
TYPED_TEST(Window, LosesNobodyHoweverSmallItIs) {
    using Real = TypeParam;
    for (std::int32_t kind = 0; kind < kKinds; ++kind) {
        SCOPED_TRACE(kind);
        const WorldDef def = windowed(wide_def(kind), kind == 4   ? 252 * 18
                                                      : kind == 6 ? 66 * 152
                                                                  : 66 * 18);
        TestWorld<Real> one(def);
        TestWorld<Real> other(def);
        TestWorld<Real> third(def);
        Dice dice(static_cast<std::uint64_t>(kind) + 1);
        std::int32_t beyond = 0;
        for (std::int32_t step = 0; step < 80; ++step) {
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
            const std::int32_t before = one->particle_positions().size;
            WorkBound bound;
            expect_ok(one->work_bound(0.02F, &bound));
            const StepReport report = one->step(0.02F);
            any_step(*other, 0.02F, dice);
            beyond = std::max(beyond, report.particles_beyond);
            EXPECT_EQ(report.particles, before);
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
}

TEST(WindowView, SaysWhichPartOfTheTankItShows) {
    TestWorld<float> world(windowed(wide_def(0), 66 * 34));
    expect_ok(world->fill({{3.0F, 2.0F}, {3.2F, 2.2F}}));
    world->step(0.01F);
    const auto density = world->density();
    EXPECT_GT(density.first_column, 0);
    EXPECT_GT(density.first_row, 0);
    EXPECT_NEAR(density.at(155 - density.first_column, 105 - density.first_row), 1.0F, 0.1F);
    std::vector<std::uint8_t> pixels(125 * 75, 0);
    Display display;
    display.pixels = pixels.data();
    display.width = 250;
    display.height = 75;
    const ChangedRows changed = draw(*world, display);
    EXPECT_GT(changed.first, 10) << "the upper third of the display";
    EXPECT_LT(changed.last, 30);
}

TEST(WindowStatus, NamesWhatItCannotBe) {
    const auto answer = [](const WorldDef& def) {
        measure::WorldMemory memory = measure::memory_for<float>(def);
        World<float> world;
        return world.init(def, memory.data(), memory.size());
    };
    EXPECT_EQ(answer(windowed(wide_def(0), 66 * 18)), Status::ok);
    EXPECT_EQ(answer(windowed(wide_def(0), 66 * 18 - 1)), Status::window_too_small);
    EXPECT_EQ(answer(windowed(wide_def(4), 252 * 18 - 1)), Status::window_too_small);
    EXPECT_EQ(answer(windowed(wide_def(6), 66 * 152 - 1)), Status::window_too_small);
    WorldDef bodies = windowed(wide_def(0), 10000);
    bodies.capacity.bodies = 1;
    EXPECT_EQ(answer(bodies), Status::window_without_bodies);
    WorldDef small = windowed(wide_def(0), 10000);
    measure::WorldMemory memory = measure::memory_for<SmallFixed>(small);
    World<SmallFixed> world;
    EXPECT_EQ(world.init(small, memory.data(), memory.size()), Status::small_fixed_has_no_window);
    WorldDef negative = wide_def(0);
    negative.capacity.window_cells = -1;
    EXPECT_EQ(answer(negative), Status::window_out_of_range);
    const WorldDef all = windowed(wide_def(0), 252 * 152);
    EXPECT_EQ(answer(all), Status::ok) << "as much as the tank has";
    EXPECT_EQ(world_bytes<float>(all.capacity), world_bytes<float>(wide_def(0).capacity));
}

}  // namespace
}  // namespace weir
