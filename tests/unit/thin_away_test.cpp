// Thin walls that are away from the liquid: nobody looks at them, and nobody can tell.
#include <gtest/gtest.h>

#include "math/vec2.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kStep_s = 1.0F / 60.0F;

/// A swaying pool, 8 cells deep, into which a turning paddle dives from 30 cells up every 60 steps.
/// `watched`: forces are told, so that walls are looked at in every substep.
template <class Real>
class Pool {
public:
    explicit Pool(bool watched) : world_(definition(watched)) {
        expect_ok(world_->fill({{0, 0}, {48 * kCell, 8 * kCell}}));
        const Ring arm = {{-3 * kCell, 0}, {3 * kCell, 0}};
        BodyDef def = body_of(arm, kCell * Vec2f{24, 30});
        def.open = true;
        paddle_ = put_moving(*world_, def);
    }

    void step(int k) {
        const int phase = k % 60;
        Motion motion = motion_of(*world_, paddle_);
        motion.velocity_mps.y = phase < 12 ? -2.4F : (phase >= 20 && phase < 32 ? 2.4F : 0.0F);
        motion.spin_radps = 3.0F;
        expect_ok(world_->set_motion(paddle_, motion));
        const StepReport report = world_->step(kStep_s);
        tested_ += report.particles_tested;
    }

    World<Real>& world() { return *world_; }
    std::int64_t tested() const { return tested_; }
    BodyId paddle() const { return paddle_; }
    static Capacity capacity() { return definition(false).capacity; }

private:
    static WorldDef definition(bool watched) {
        WorldDef def = tank_def(48, 40, 1600, 2, 8);
        def.capacity.two_way = watched;
        def.cell_m = kCell;
        def.capacity.wall_edges = 200;
        def.gravity_mps2 = {0.8F, -9.8F};
        return def;
    }

    TestWorld<Real> world_;
    BodyId paddle_;
    std::int64_t tested_ = 0;
};

WEIR_SUITE(ThinAway, RoomyScalars);

TYPED_TEST(ThinAway, NobodyCanTellWhetherTheyAreLookedAt) {
    Pool<TypeParam> pool(false);
    Pool<TypeParam> watched(true);
    for (int k = 0; k < 130; ++k) {
        pool.step(k);
        watched.step(k);
        const auto x = pool.world().particle_positions();
        const auto y = watched.world().particle_positions();
        ASSERT_EQ(x.size, y.size);
        for (std::int32_t n = 0; n < x.size; ++n) {
            ASSERT_TRUE(x[n].x == y[n].x && x[n].y == y[n].y) << "step " << k << ", particle " << n;
        }
    }
    EXPECT_GT(pool.tested(), 0) << "it never dived";
}

/// The last one that goes takes its marks along: where it stood the next one is far away.
TYPED_TEST(ThinAway, NorWhetherTheyWereThere) {
    Pool<TypeParam> pool(false);
    World<TypeParam>& world = pool.world();
    pool.step(0);
    expect_ok(world.remove_body(pool.paddle()));
    const Ring line = {{-5.3F * kCell, 0}, {5.3F * kCell, 1.7F * kCell}};
    BodyDef def = body_of(line, kCell * Vec2f{20, 4});
    def.open = true;
    const BodyId id = put_static(world, def);
    world.step(kStep_s);
    expect_ok(world.remove_body(id));
    def.motion.position_m.x += 14 * kCell;
    put_static(world, def);
    Pool<TypeParam> other(false);
    const std::vector<std::byte> kept = saved(world, pool.capacity());
    expect_ok(other.world().restore(kept.data(), kept.size()));
    for (int k = 0; k < 5; ++k) {
        world.step(kStep_s);
        other.world().step(kStep_s);
        ASSERT_EQ(other.world().state_hash(), world.state_hash()) << k;
    }
}

}  // namespace
}  // namespace weir
