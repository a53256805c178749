// Calls at random, sane and absurd, on worlds at random: what is refused changes nothing, particles
// are accounted for, and three lives that must be one are: whole steps; steps in slices, amid which
// calls are tried, with the pieces of each loop in another order; and a world of other beginnings
// that is restored from the first one now and then. Half of the definitions are any that a world
// may have. Looks change nothing, and no step is so short that it flings the liquid.
#include <cstdlib>
#include <limits>
#include <optional>

#include "random_def.hpp"
#include "weir/display.hpp"

namespace weir {
namespace {

constexpr std::int32_t kCalls = 80;

void backwards(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
    for (std::int32_t k = count; k-- > 0;) {
        task(context, k);
    }
}

/// Now and then what no caller should say.
float number(Dice& dice, float low, float high) {
    using Limits = std::numeric_limits<float>;
    constexpr float kAbsurd[] = {Limits::quiet_NaN(), Limits::infinity(), -1e30F, 3e38F, -0.0F};
    const float sane = dice.uniform(low, high);
    const float absurd = dice.one_of(kAbsurd);
    return dice.chance(0.02F) ? absurd : sane;
}

Vec2f vector(Dice& dice, float low, float high) {
    const float x = number(dice, low, high);
    return {x, number(dice, low, high)};
}

template <class Real>
BodyId any_body(const World<Real>& world, Dice& dice, const RandomDef& random) {
    BodyId id;
    static_cast<void>(world.body_in_slot(dice.below(random.def.capacity.bodies + 1), &id));
    id.generation = static_cast<std::uint16_t>(id.generation + (dice.chance(0.05F) ? 1 : 0));
    return id;
}

/// Of the tank.
Vec2f place(Dice& dice, const RandomDef& random, float share = 1.0F) {
    const Vec2f tank = random.tank_m();
    const float x = number(dice, 0.0F, share * tank.x);
    return {x, number(dice, 0.0F, share * tank.y)};
}

template <class Real>
Status add_some_body(World<Real>& world, Dice& dice, const RandomDef& random) {
    const float c = random.def.cell_m;
    Ring ring = dice.chance(0.8F) ? busy_ring(dice) : Ring{vector(dice, -0.1F, 0.1F),
                                                          {0.05F, 0.0F}, {0.0F, 0.05F}};
    for (Vec2f& vertex : ring) {  // busy ones are made for cells of 2 cm
        vertex = {vertex.x * (c / 0.02F), vertex.y * (c / 0.02F)};
    }
    BodyDef def = body_of(ring, place(dice, random), number(dice, -3.0F, 3.0F));
    const float fastest = 0.5F * random.speed_mps;
    def.motion.velocity_mps = vector(dice, -fastest, fastest);
    def.open = dice.chance(0.1F);
    def.motion.spin_radps = number(dice, -5.0F, 5.0F);
    def.surface = {number(dice, 0, 1), number(dice, 0, 1), dice.chance(0.5F),
                   number(dice, -fastest, fastest)};
    def.density_ratio = number(dice, 0.1F, 3.0F);
    def.hold = static_cast<Hold>(dice.below(5));
    if (dice.chance(0.02F)) {
        def.polygon = {nullptr, 4};
    }
    BodyId id;
    switch (dice.below(3)) {
        case 0: return world.add_static_body(def, &id);
        case 1: return world.add_moving_body(def, &id);
        default: return world.add_free_body(def, &id);
    }
}

template <class Real>
Status change_some_body(World<Real>& world, Dice& dice, const RandomDef& random) {
    const BodyId id = any_body(world, dice, random);
    Motion motion;
    static_cast<void>(world.motion(id, &motion));
    const float furthest = 1.5F * random.def.cell_m;
    const Vec2f way = vector(dice, -furthest, furthest);
    motion.position_m = {motion.position_m.x + way.x, motion.position_m.y + way.y};
    motion.spin_radps = number(dice, -5.0F, 5.0F);
    switch (dice.below(4)) {
        case 0: return world.set_motion(id, motion);
        case 1: return world.move_body(id, motion.position_m, motion.angle_rad,
                                       number(dice, 0.0F, 0.03F));
        case 2: return world.set_surface(id, {number(dice, 0, 1), number(dice, 0, 1), false, 0});
        default: return world.remove_body(id);
    }
}

template <class Real>
Status change_liquid(World<Real>& world, Dice& dice, const RandomDef& random) {
    const Vec2f low = place(dice, random, 0.8F);
    const Vec2f size = place(dice, random, dice.chance(0.5F) ? 0.3F : 0.6F);
    const Box box{low, {low.x + size.x, low.y + size.y}};
    const Vec2f speed = vector(dice, -random.speed_mps, random.speed_mps);
    const std::int32_t index = dice.below(world.particle_positions().size + 4) - 2;
    const auto tag = static_cast<std::uint8_t>(dice.below(256));
    const bool second = world.particle_kinds().data != nullptr && dice.chance(0.5F);
    const Liquid kind = second ? Liquid::second : Liquid::first;
    switch (dice.below(9)) {
        case 0: return world.add_particle(low, speed, kind);
        case 1: return world.remove_particle(index);
        case 2: return world.drain(box);
        case 3: return world.stir(box, speed, number(dice, 0.0F, 1.0F));
        case 4: return world.tag(box, tag);
        case 5: return world.tag_particle(index, tag);
        default: return world.fill(box, nullptr, kind);
    }
}

template <class Real>
Status call(World<Real>& world, Dice dice, const RandomDef& random) {
    const float pull = random.gravity_mps2;
    switch (dice.below(9)) {
        case 0:
        case 1: return add_some_body(world, dice, random);
        case 2:
        case 3: return change_some_body(world, dice, random);
        case 4: return world.set_gravity(vector(dice, -pull, pull));
        case 5: return world.restore(&dice, sizeof dice);
        default: return change_liquid(world, dice, random);
    }
}

/// All that may be asked and drawn; numbers are numbers.
template <class Real>
void look(World<Real>& world, Dice dice, const RandomDef& random) {
    Diagnostics sums;
    expect_ok(world.diagnose(&sums));
    double sum = sums.mass_m2 + sums.kinetic_energy_m4ps2 + sums.volume_m2;
    const auto density = world.density();
    for (std::int32_t k = 0; k < density.columns * density.rows; ++k) {
        sum += static_cast<double>(density.at(k % density.columns, k / density.columns));
    }
    EXPECT_EQ(sum - sum, 0.0);
    LiquidIn found;
    const Vec2f low = place(dice, random);
    static_cast<void>(world.liquid_in({{-low.x, -low.y}, low}, &found));
    BodyForce force;
    static_cast<void>(world.tank_force(&force));
    static_cast<void>(world.force(any_body(world, dice, random), &force));
    static_cast<void>(world.rung_within(number(dice, 0.0F, 0.1F), dice.below(100000)));
    Display display;
    display.width = dice.integer(1, 60);
    display.height = dice.integer(1, 40);
    std::vector<std::uint8_t> pixels(
        static_cast<std::size_t>((display.width + 1) / 2 * display.height));
    display.pixels = pixels.data();
    const Vec2f size = place(dice, random, dice.one_of({0.1F, 1.0F, 1000.0F}));
    display.shown_m = {{low.x - size.x, low.y - size.y}, {low.x + size.x, low.y + size.y}};
    EXPECT_LT(draw(world, display).last, display.height);
}

/// From none to what is far too long.
float step_time(Dice& dice) {
    switch (dice.below(8)) {
        case 0: return number(dice, 0.0F, 10.0F);
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
            const float turning = 16.0F * world.cell_m() * std::fabs(motion.spin_radps);
            most = std::fmax(most, turning + std::fabs(motion.velocity_mps.x) +
                                       std::fabs(motion.velocity_mps.y));
        }
    }
    return most;
}

/// A step in slices of any size; calls that would change something are refused meanwhile.
template <class Real>
void step_in_slices(World<Real>& world, float dt_s, std::int32_t rung, Dice dice,
                    const RandomDef& random) {
    StepReport report;
    expect_ok(world.begin_step(dt_s, &report, rung));
    const std::int32_t most = dice.chance(0.5F) ? 300 : 5000;
    while (!world.advance(1 + dice.below(most))) {
        if (dice.chance(0.1F)) {
            EXPECT_NE(call(world, Dice(dice.bits()), random), Status::ok);
        }
    }
}

template <class Real>
class Lives {
public:
    explicit Lives(Dice& dice)
        : random_(random_def(dice)), def_(random_.def), whole_(def_), back_(def_) {
        WorldDef def = def_;
        def.parallel_for = backwards;
        sliced_.emplace(def);
        if (def_.capacity.sleeping_regions && dice.chance(0.8F)) {
            for (World<Real>* world : {&*whole_, &**sliced_, &*back_}) {
                expect_ok(world->let_regions_sleep());
            }
        }
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
        const std::int32_t rung = dice.below(kRungs);
        WorkBound bound;
        expect_ok(whole_->work_bound(dt_s, &bound, rung));
        const std::int32_t before = whole_->particle_positions().size;
        const StepReport report = whole_->step(dt_s, rung);
        EXPECT_LE(work_of(report), bound.step);
        EXPECT_EQ(report.particles, before - report.particles_removed_stuck);
        EXPECT_EQ(report.particles_reset, 0);
        EXPECT_TRUE(all_inside(*whole_));
        step_in_slices(**sliced_, dt_s, rung, Dice(dice.bits()), random_);
        back_->step(dt_s, rung);
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

    /// What is thrown between crossing belts gets faster with each of them, but no more.
    void make_a_short_step(Dice& dice) {
        const Bytes bytes = saved(*whole_, def_.capacity);
        expect_ok(back_->restore(bytes.data(), bytes.size()));
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
            const std::int32_t what = k < 8 ? 0 : dice.below(22);
            if (what < 9) {
                world.call_all(Dice(dice.bits()));
            } else if (what < 18) {
                world.step_all(dice);
            } else if (what < 20) {
                world.restore_one(dice);
            } else if (what < 21) {
                world.look_at_one(dice);
            } else {
                world.make_a_short_step(dice);
            }
            world.expect_one();
        }
    }
}

}  // namespace
}  // namespace weir
