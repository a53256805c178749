// Two pools beside each other, of which one may sleep while the other splashes.
#pragma once

#include "busy_world.hpp"

namespace weir {

inline constexpr float kDt = 1.0F / 60.0F;
inline constexpr float kCell = 0.02F;
inline constexpr std::int32_t kMiddle = 32;  ///< of the divider between two pools, in cells

/// A tank of 64 × 24 cells with room for a divider and two more bodies.
inline WorldDef pools_def() {
    WorldDef def = tank_def(64, 24, 3000, 3, 12);
    def.capacity.sleeping_regions = true;
    def.sleep.speed_mps = 0.02F;
    def.sleep.after_s = 0.5F;
    return def;
}

inline const Ring kDivider = rectangle(8 * kCell, 24 * kCell);
inline BodyDef divider() { return body_of(kDivider, {kMiddle * kCell, 0}); }

template <class Real>
struct Pools {
    TestWorld<Real> world;
    std::int32_t right = 0;  ///< particles poured in there

    explicit Pools(const WorldDef& def = pools_def(), bool regions = true) : world(def) {
        if (regions) {
            expect_ok(world->let_regions_sleep());
        }
        put_static(*world, divider());
        expect_ok(world->fill({{36 * kCell, 0}, {64 * kCell, 8 * kCell}}, &right));
    }
    World<Real>& operator*() { return *world; }
    World<Real>* operator->() { return &*world; }

    /// In the air on the left: as long as it turns the world as a whole does not sleep.
    void add_spinner() {
        BodyDef def = body_of(kSquare4cm, {2 * kCell, 20 * kCell});
        def.motion.spin_radps = 1.0F;
        put_moving(*world, def);
    }
    void pour_left() { expect_ok(world->fill({{0, 0}, {28 * kCell, 6 * kCell}})); }
    /// A splash that is small enough to stay on its side.
    void kick_left() {
        expect_ok(world->add_particle({10 * kCell, 12 * kCell}, {0.5F, -1.0F}));
    }
    /// Kicks the left pool until all of the right one sleeps.
    void rest_right() {
        StepReport report;
        for (int step = 0; step < 900 && report.particles_asleep < right; ++step) {
            if (step % 10 == 0) {
                kick_left();
            }
            report = world->step(kDt);
            ASSERT_FALSE(report.asleep);
        }
        ASSERT_EQ(report.particles_asleep, right);
    }
};

}  // namespace weir
