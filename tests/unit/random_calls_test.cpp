// Calls at random, sane and absurd, on worlds at random: what is refused changes nothing, particles
// are accounted for, and three lives that must be one are: whole steps; steps in slices, amid which
// calls are tried, with the pieces of each loop in another order; and a world of other beginnings
// that is restored from the first one now and then.
#include <cstdlib>
#include <limits>
#include <optional>

#include "busy_world.hpp"

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

/// What busy worlds do not have: forces and free bodies, regions that sleep, a window.
template <class Real>
WorldDef random_def(Dice& dice) {
    constexpr bool kSmall = std::is_same_v<Real, SmallFixed>;
    WorldDef def;
    do {
        def = busy_def(dice.below(kBusyKinds));
    } while (kSmall && (def.surface_tension_m3ps2 > 0.0F || def.capacity.second_liquid ||
                        def.capacity.wall_edges > 0));
    Capacity& room = def.capacity;
    room.particle_tags = dice.chance(0.5F);
    const std::int32_t kind = room.bodies > 0 && room.wall_edges == 0 ? dice.below(4) : 0;
    room.two_way = kind == 1;
    if (kind == 2) {
        room.cells_x = 40;
        room.sleeping_regions = true;
        def.sleep = {0.1F, 0.2F, 0.5F};
    } else if (kind == 3 && !kSmall) {
        room.cells_x = 90;
        room.cells_y = 60;
        room.window_cells = 66 * 26;
    }
    def.keep_sorted = dice.chance(0.3F);
    def.max_substeps = 1 + dice.below(6);
    return def;
}

template <class Real>
BodyId any_body(const World<Real>& world, Dice& dice) {
    BodyId id;
    static_cast<void>(world.body_in_slot(dice.below(6), &id));
    id.generation = static_cast<std::uint16_t>(id.generation + (dice.chance(0.05F) ? 1 : 0));
    return id;
}

template <class Real>
Status add_some_body(World<Real>& world, Dice& dice) {
    const Ring ring = dice.chance(0.8F) ? busy_ring(dice) : Ring{vector(dice, -0.1F, 0.1F),
                                                                {0.05F, 0.0F}, {0.0F, 0.05F}};
    BodyDef def = body_of(ring, vector(dice, 0.0F, 0.36F), number(dice, -3.0F, 3.0F));
    def.motion.velocity_mps = vector(dice, -0.5F, 0.5F);
    def.motion.spin_radps = number(dice, -5.0F, 5.0F);
    def.surface = {number(dice, 0, 1), number(dice, 0, 1), dice.chance(0.5F), number(dice, -1, 1)};
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
Status change_some_body(World<Real>& world, Dice& dice) {
    const BodyId id = any_body(world, dice);
    Motion motion;
    static_cast<void>(world.motion(id, &motion));
    const Vec2f way = vector(dice, -0.03F, 0.03F);
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
Status change_liquid(World<Real>& world, Dice& dice) {
    const Vec2f low = vector(dice, 0.0F, 0.25F);
    const Vec2f size = vector(dice, 0.0F, 0.1F);
    const Box box{low, {low.x + size.x, low.y + size.y}};
    const Vec2f speed = vector(dice, -1.0F, 1.0F);
    const std::int32_t index = dice.below(400) - 2;
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
Status call(World<Real>& world, Dice dice) {
    switch (dice.below(9)) {
        case 0:
        case 1: return add_some_body(world, dice);
        case 2:
        case 3: return change_some_body(world, dice);
        case 4: return world.set_gravity(vector(dice, -15.0F, 15.0F));
        case 5: return world.restore(&dice, sizeof dice);
        default: return change_liquid(world, dice);
    }
}

/// A step in slices of any size; calls that would change something are refused meanwhile.
template <class Real>
void step_in_slices(World<Real>& world, float dt_s, std::int32_t rung, Dice dice) {
    StepReport report;
    expect_ok(world.begin_step(dt_s, &report, rung));
    const std::int32_t most = dice.chance(0.5F) ? 300 : 5000;
    while (!world.advance(1 + dice.below(most))) {
        if (dice.chance(0.1F)) {
            EXPECT_NE(call(world, Dice(dice.bits())), Status::ok);
        }
    }
}

template <class Real>
class Lives {
public:
    explicit Lives(Dice& dice) : def_(random_def<Real>(dice)), whole_(def_), back_(def_) {
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
        const Status status = call(*whole_, dice);
        if (status != Status::ok && status != Status::gravity_not_finite) {  // which is reported
            EXPECT_EQ(saved(*whole_, def_.capacity), before) << status_text(status);
        }
        EXPECT_EQ(call(**sliced_, dice), status);
        EXPECT_EQ(call(*back_, dice), status);
    }

    void step_all(Dice& dice) {
        const float dt_s = number(dice, 0.0F, 0.03F);
        const std::int32_t rung = dice.below(kRungs);
        WorkBound bound;
        expect_ok(whole_->work_bound(dt_s, &bound, rung));
        const std::int32_t before = whole_->particle_positions().size;
        const StepReport report = whole_->step(dt_s, rung);
        EXPECT_LE(work_of(report), bound.step);
        EXPECT_EQ(report.particles, before - report.particles_removed_stuck);
        EXPECT_EQ(report.particles_reset, 0);
        EXPECT_TRUE(all_inside(*whole_));
        step_in_slices(**sliced_, dt_s, rung, Dice(dice.bits()));
        back_->step(dt_s, rung);
    }

    /// After things that happened to it alone.
    void restore_one(Dice& dice) {
        for (std::int32_t k = dice.below(6); k > 0; --k) {
            static_cast<void>(call(*back_, Dice(dice.bits())));
            back_->step(dice.uniform(0.0F, 0.03F));
        }
        const Bytes bytes = saved(*whole_, def_.capacity);
        expect_ok(back_->restore(bytes.data(), bytes.size()));
        EXPECT_EQ(saved(*back_, def_.capacity), bytes);
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

    WorldDef def_;
    TestWorld<Real> whole_;
    TestWorld<Real> back_;
    std::optional<TestWorld<Real>> sliced_;
};

WEIR_SUITE(RandomCalls, EveryScalar);

/// WEIR_RANDOM_LIVES: how many.
TYPED_TEST(RandomCalls, ChangeNothingWhenRefusedAndAllLivesAlike) {
    const char* wanted = std::getenv("WEIR_RANDOM_LIVES");
    const std::uint64_t lives = wanted != nullptr ? std::strtoull(wanted, nullptr, 10)
                                                  : (kSanitized ? 6 : 24);
    for (std::uint64_t seed = 1; seed <= lives; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        Lives<TypeParam> world(dice);
        for (std::int32_t k = 0; k < kCalls && !testing::Test::HasFailure(); ++k) {
            SCOPED_TRACE(k);
            const std::int32_t what = k < 8 ? 0 : dice.below(20);
            if (what < 9) {
                world.call_all(Dice(dice.bits()));
            } else if (what < 18) {
                world.step_all(dice);
            } else {
                world.restore_one(dice);
            }
            world.expect_one();
        }
    }
}

}  // namespace
}  // namespace weir
