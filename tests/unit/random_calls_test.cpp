// Calls at random, sane and absurd, on worlds at random: what is refused changes nothing, particles
// are accounted for, and three lives that must be one are: whole steps; steps in slices, amid which
// calls are tried, with the pieces of each loop in another order; and a world of other beginnings
// that is restored from the first one now and then. Half of the definitions are any that a world
// may have. Looks change nothing, and no step is so short that it flings the liquid.
#include <cstdlib>
#include <optional>

#include "random_calls.hpp"

namespace weir {
namespace {

constexpr std::int32_t kCalls = 80;

/// Odd ones first, then the even ones from the last on.
void mixed(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
    for (std::int32_t k = 1; k < count; k += 2) {
        task(context, k);
    }
    for (std::int32_t k = (count - 1) / 2 * 2; k >= 0; k -= 2) {
        task(context, k);
    }
}

std::uint64_t counted() {
    static std::uint64_t now = 0;
    return ++now;
}

/// From none to what is far too long.
float step_time(Dice& dice) {
    switch (dice.below(8)) {
        case 0: return dice.chance(0.3F) ? 0.0F : number(dice, 0.0F, 10.0F);
        case 1: return any_size(dice, 1.0e-10F, 1.0F);
        default: return number(dice, 0.0F, 0.03F);
    }
}

/// Along an axis, of any particle or body, m/s.
template <class Real>
float fastest(const World<Real>& world, std::int32_t bodies) {
    float most = 0.0F;
    for (const auto& v : world.particle_velocities()) {
        const float speed = std::fmax(std::fabs(static_cast<float>(v.x)),
                                      std::fabs(static_cast<float>(v.y)));
        most = std::fmax(most, speed * world.velocity_scale());
    }
    for (std::int32_t slot = 0; slot < bodies; ++slot) {
        BodyId id;
        Motion motion;
        static_cast<void>(world.body_in_slot(slot, &id));
        if (world.motion(id, &motion) == Status::ok) {
            const Vec2f at = motion.position_m;
            const float away = std::fabs(at.x) + std::fabs(at.y) +
                               world.cell_m() * static_cast<float>(16 + world.cells_x() +
                                                                   world.cells_y());
            const float turning = away * std::fabs(motion.spin_radps);
            most = std::fmax(most, turning + std::fabs(motion.velocity_mps.x) +
                                       std::fabs(motion.velocity_mps.y));
        }
    }
    return most;
}

/// Goes on with a step in slices of any size, at most so many of them; calls that would change
/// something are refused meanwhile, and what may be asked is answered. True: it is done.
template <class Real>
bool advance_by(World<Real>& world, std::int32_t slices, const StepReport& report,
                std::int32_t largest_item, Dice dice, const RandomDef& random) {
    const std::int32_t most = dice.chance(0.5F) ? 300 : 5000;
    std::int64_t before = work_of(report);
    for (std::int32_t k = 0; k < slices; ++k) {
        const std::int32_t budget = 1 + dice.below(most);
        const bool done = world.advance(budget);
        EXPECT_LT(work_of(report) - before, std::int64_t{budget} + largest_item);
        before = work_of(report);
        if (done) {
            return true;
        }
        if (dice.chance(0.1F)) {
            EXPECT_NE(call(world, Dice(dice.bits()), random), Status::ok);
            EXPECT_EQ(world.let_regions_sleep() == Status::ok, false);
            EXPECT_TRUE(world.contacts().size == 0);
            EXPECT_TRUE(all_inside(world));
        }
    }
    return false;
}

/// Nothing is told of what a world has no room for.
template <class Real>
void expect_of_what_is_there(const StepReport& r, const WorldDef& def) {
    const Capacity& room = def.capacity;
    EXPECT_TRUE(!r.walls_held || (r.rung >= 3 && room.bodies > 0 && room.moving_bodies));
    EXPECT_TRUE(r.particles_beyond == 0 || room.window_cells > 0);
    EXPECT_TRUE(r.contacts_missed == 0 || room.contacts > 0);
    EXPECT_TRUE(r.particles_crowded == 0 || !std::is_floating_point_v<Real>);
    EXPECT_TRUE(r.bodies_slowed == 0 || room.two_way);
    EXPECT_TRUE(r.cells_overfull == 0 || def.volume_gain > 0.0F);
    EXPECT_TRUE(r.particles_asleep == 0 || r.asleep || room.sleeping_regions);
    EXPECT_TRUE(!r.asleep || def.sleep.speed_mps > 0.0F);
    EXPECT_TRUE(!r.has(Clamped::sound_speed) || def.pressure == Pressure::equation_of_state);
    EXPECT_TRUE(!r.has(Clamped::viscosity) || def.viscosity_m2ps > 0.0F);
    EXPECT_TRUE(!r.has(Clamped::surface_tension) || def.surface_tension_m3ps2 > 0.0F);
    EXPECT_TRUE(room.bodies > 0 || (r.particles_tested == 0 && r.particles_reflected == 0 &&
                                    r.particles_stuck == 0 && r.nodes_rasterized == 0));
}

/// What a report says must fit what was asked for, and itself.
template <class Real>
void expect_consistent(const StepReport& r, float dt_s, std::int32_t rung, const WorldDef& def) {
    expect_of_what_is_there<Real>(r, def);
    EXPECT_EQ(r.rung, rung);
    EXPECT_EQ(r.has(Clamped::not_finite), r.particles_reset > 0);
    EXPECT_FALSE(r.has(Clamped::not_initialised));
    EXPECT_TRUE(r.dt_s >= 0.0F && r.dt_s <= 256.0F);
    EXPECT_TRUE(r.max_speed_mps >= 0.0F && r.max_speed_mps < 1e30F);
    constexpr float kUnit = 256.0F / 1073741824.0F;  // of the slowest packed worlds
    EXPECT_TRUE(!(dt_s >= 0.0F) || r.dt_s <= dt_s * 1.00001F + kUnit);
    EXPECT_LE(r.substeps, def.max_substeps);
    EXPECT_EQ(r.has(Clamped::speed), r.particles_slowed > 0);
    EXPECT_EQ(r.has(Clamped::body_speed), r.bodies_slowed > 0);
    EXPECT_TRUE(!r.asleep || r.particles_asleep == r.particles);
}

template <class Real>
class Lives {
public:
    explicit Lives(Dice& dice)
        : random_(random_def(dice)), def_(random_.def), whole_(def_), back_(def_) {
        begin_again_in_noise(back_, dice);
        WorldDef def = def_;
        def.parallel_for = dice.chance(0.5F) ? backwards : mixed;
        def.ticks = counted;
        sliced_.emplace(def);
        if (def_.capacity.sleeping_regions && dice.chance(0.6F)) {
            let_regions_sleep();
        }
    }

    /// Also once more, or where there is no room for it.
    void let_regions_sleep() {
        const Status status = whole_->let_regions_sleep();
        EXPECT_EQ(status == Status::ok, def_.capacity.sleeping_regions);
        EXPECT_EQ((*sliced_)->let_regions_sleep(), status);
        EXPECT_EQ(back_->let_regions_sleep(), status);
    }

    void call_all(Dice dice) {
        const Bytes before = saved(*whole_, def_.capacity);
        const Status status = call(*whole_, dice, random_);
        if (status != Status::ok && status != Status::gravity_not_finite) {  // which is reported
            EXPECT_EQ(saved(*whole_, def_.capacity), before) << status_text(status);
        }
        EXPECT_EQ(call(**sliced_, dice, random_), status);
        EXPECT_EQ(call(*back_, dice, random_), status);
    }

    void step_all(Dice& dice) {
        const float dt_s = step_time(dice);
        step_all(dt_s, dice.below(kRungs), dice);
    }

    void step_all(float dt_s, std::int32_t rung, Dice& dice) {
        WorkBound bound;
        expect_ok(whole_->work_bound(dt_s, &bound, rung));
        const std::int32_t before = whole_->particle_positions().size;
        const StepReport report = whole_->step(dt_s, rung);
        EXPECT_LE(work_of(report), bound.step);
        expect_consistent<Real>(report, dt_s, rung, def_);
        EXPECT_EQ(report.particles, before - report.particles_removed_stuck);
        EXPECT_EQ(report.particles_reset, 0);
        EXPECT_TRUE(all_inside(*whole_));
        StepReport cut;
        expect_ok((*sliced_)->begin_step(dt_s, &cut, rung));
        EXPECT_TRUE(advance_by(**sliced_, 1 << 30, cut, bound.largest_item, Dice(dice.bits()),
                               random_));
        expect_same_report(cut, report, false);  // who was restored clears more
        expect_same_report(back_->step(dt_s, rung), report, false);
    }

    /// A fountain, as much as there is room for and more.
    void pour_all(Dice& dice) {
        const Vec2f at = place(dice, random_);
        const float c = def_.cell_m;
        for (std::int32_t k = dice.one_of({3, 30, 30, 1600}); k > 0; --k) {
            const Vec2f off = {at.x + c * dice.uniform(0.0F, 3.0F),
                               at.y + c * dice.uniform(0.0F, 3.0F)};
            const Vec2f speed = {0.1F * random_.speed_mps * dice.uniform(-1.0F, 1.0F), 0.0F};
            const Status status = whole_->add_particle(off, speed);
            EXPECT_EQ((*sliced_)->add_particle(off, speed), status);
            EXPECT_EQ(back_->add_particle(off, speed), status);
        }
    }

    /// Long enough to come to rest, and to fall asleep.
    void wait_all(Dice& dice) {
        const float dt_s = dice.one_of({1.0F / 60.0F, 1.0F / 60.0F, 0.1F, 1.0e-4F});
        for (std::int32_t k = dice.integer(10, 60); k > 0 && !testing::Test::HasFailure(); --k) {
            step_all(dt_s, 0, dice);
        }
    }

    /// Amid a step it goes back to where the others are; or another step finishes what was begun.
    void break_off(Dice& dice) {
        StepReport report;
        WorkBound bound;
        const float dt_s = step_time(dice);
        const std::int32_t rung = dice.below(kRungs);
        const Bytes bytes = saved(*whole_, def_.capacity);
        expect_ok((*sliced_)->work_bound(dt_s, &bound, rung));
        expect_ok((*sliced_)->begin_step(dt_s, &report, rung));
        advance_by(**sliced_, dice.below(40), report, bound.largest_item, Dice(dice.bits()),
                   random_);
        if (dice.chance(0.6F)) {
            expect_ok((*sliced_)->restore(bytes.data(), bytes.size()));
            return;
        }
        const float next_s = step_time(dice);
        (*sliced_)->step(next_s);
        for (TestWorld<Real>* world : {&whole_, &back_}) {
            (*world)->step(dt_s, rung);
            (*world)->step(next_s);
        }
    }

    /// After things that happened to it alone.
    void restore_one(Dice& dice) {
        for (std::int32_t k = dice.below(6); k > 0; --k) {
            static_cast<void>(call(*back_, Dice(dice.bits()), random_));
            back_->step(dice.uniform(0.0F, 0.03F));
        }
        const Bytes bytes = saved(*whole_, def_.capacity);
        expect_ok(back_->restore(bytes.data(), bytes.size()));
        EXPECT_EQ(saved(*back_, def_.capacity), bytes);
    }

    void look_at_one(Dice& dice) {
        TestWorld<Real>& one = dice.chance(0.5F) ? whole_ : *sliced_;
        const std::uint64_t hash = one->state_hash();
        look(*one, Dice(dice.bits()), random_);
        EXPECT_EQ(one->state_hash(), hash);
    }

    /// What is thrown between crossing belts gets faster with each of them, but no more. Under the
    /// gravity that its speed is of: what is added beneath the surface makes room as fast as
    /// gravity moves anything.
    void make_a_short_step(Dice& dice) {
        const Bytes bytes = saved(*whole_, def_.capacity);
        expect_ok(back_->restore(bytes.data(), bytes.size()));
        expect_ok(back_->set_gravity({0.0F, -random_.gravity_mps2}));
        const float before = fastest(*back_, def_.capacity.bodies) + random_.speed_mps;
        EXPECT_LE(back_->step(any_size(dice, 1.0e-9F, 1.0e-6F)).max_speed_mps, 30.0F * before);
        expect_ok(back_->restore(bytes.data(), bytes.size()));
    }

    void expect_one() const {
        EXPECT_EQ((*sliced_)->state_hash(), whole_->state_hash());
        EXPECT_EQ(back_->state_hash(), whole_->state_hash());
        // Densities of sleepers are kept as they were seen last, a window stands where it stood.
        if (!def_.capacity.sleeping_regions && def_.capacity.window_cells == 0) {
            const Bytes bytes = saved(*whole_, def_.capacity);
            EXPECT_EQ(saved(**sliced_, def_.capacity), bytes);
            EXPECT_EQ(saved(*back_, def_.capacity), bytes);
        }
    }

private:
    using Bytes = std::vector<std::byte>;

    /// Where any is refused, which changes nothing in the memory, it is one of the busy ones.
    static RandomDef random_def(Dice& dice) {
        if (dice.chance(0.5F)) {
            const RandomDef random = any_def<Real>(dice);
            std::vector<std::byte> memory(world_bytes<Real>(random.def.capacity) + 16);
            const auto off = reinterpret_cast<std::uintptr_t>(memory.data()) % world_alignment;
            World<Real> world;
            if (world.init(random.def, memory.data() + (16 - off), memory.size() - 16) ==
                Status::ok) {
                return random;
            }
            EXPECT_EQ(std::count(memory.begin(), memory.end(), std::byte{}),
                      static_cast<std::ptrdiff_t>(memory.size()));
        }
        return busy_random_def<Real>(dice);
    }

    /// Whatever memory held, the world in it is the same.
    void begin_again_in_noise(TestWorld<Real>& world, Dice& dice) {
        const std::size_t bytes = world_bytes<Real>(def_.capacity);
        std::uint64_t noise = dice.bits();
        for (std::size_t at = 0; at < bytes; ++at, noise = noise << 9U | noise >> 55U) {
            world.memory()[at] = static_cast<std::byte>(noise + at / 7);
        }
        expect_ok(world.init_again());
    }

    RandomDef random_;
    WorldDef def_;
    TestWorld<Real> whole_;
    TestWorld<Real> back_;
    std::optional<TestWorld<Real>> sliced_;
};

WEIR_SUITE(RandomCalls, EveryScalar);

/// WEIR_RANDOM_LIVES: how many. WEIR_RANDOM_FIRST: from which seed on.
TYPED_TEST(RandomCalls, ChangeNothingWhenRefusedAndAllLivesAlike) {
    const char* wanted = std::getenv("WEIR_RANDOM_LIVES");
    const std::uint64_t lives = wanted != nullptr ? std::strtoull(wanted, nullptr, 10)
                                                  : (kSanitized ? 6 : 24);
    const char* from = std::getenv("WEIR_RANDOM_FIRST");
    const std::uint64_t first = from != nullptr ? std::strtoull(from, nullptr, 10) : 1;
    for (std::uint64_t seed = first; seed < first + lives; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        Lives<TypeParam> world(dice);
        for (std::int32_t k = 0; k < kCalls && !testing::Test::HasFailure(); ++k) {
            SCOPED_TRACE(k);
            const std::int32_t what = k < 8 ? 0 : dice.below(250);
            if (what < 95) {
                world.call_all(Dice(dice.bits()));
            } else if (what < 190) {
                world.step_all(dice);
            } else if (what < 210) {
                world.restore_one(dice);
            } else if (what < 220) {
                world.look_at_one(dice);
            } else if (what < 230) {
                world.make_a_short_step(dice);
            } else if (what < 238) {
                world.break_off(dice);
            } else if (what < 246) {
                world.pour_all(dice);
            } else if (what < 248) {
                world.wait_all(dice);
            } else {
                world.let_regions_sleep();
            }
            world.expect_one();
        }
    }
}

}  // namespace
}  // namespace weir
