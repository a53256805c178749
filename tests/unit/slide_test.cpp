// Liquid that flows around corners: what is led into a wall slides along it, and holes are no pumps.
#include <gtest/gtest.h>

#include <algorithm>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;

WEIR_SUITE(Slide, EveryScalar);

WorldDef tank(std::int32_t columns, std::int32_t rows) {
    WorldDef def = tank_def(columns, rows, 4 * columns * rows, 2, 8);
    def.cell_m = kCell;
    return def;
}

/// A block, in cells.
template <class Real>
void add_block(TestWorld<Real>& world, float left, float low, float right, float high) {
    const Ring ring = rectangle(kCell * (right - left), kCell * (high - low));
    put_static(*world, body_of(ring, {0.5F * kCell * (left + right), 0.5F * kCell * (low + high)}));
}

template <class Real>
double energy(TestWorld<Real>& world) {
    Diagnostics diagnostics;
    expect_ok(world->diagnose(&diagnostics));
    return diagnostics.kinetic_energy_m4ps2 + diagnostics.potential_energy_m4ps2;
}

/// Hundreds stood beside the mouth of a slot, as each step led them into the wall, and what flowed
/// became a jet with several times the energy that there had been.
TYPED_TEST(Slide, SlotsBetweenBasinsAreNoPumps) {
    struct Slot {
        float low;
        float high;
    };
    for (const Slot slot : {Slot{4.0F, 6.0F}, {0.5F, 1.5F}}) {
        TestWorld<TypeParam> world(tank(40, 32));
        if (slot.low > 0.0F) {
            add_block(world, 20.0F, 0.0F, 23.0F, slot.low);
        }
        add_block(world, 20.0F, slot.high, 23.0F, 32.0F);
        expect_ok(world->fill({{0.0F, 0.0F}, {20.0F * kCell, 28.0F * kCell}}));
        const double before = energy(world);
        double most = 0.0;
        for (std::int32_t step = 0; step < (kSanitized ? 60 : 240); ++step) {
            world->step(1.0F / 60.0F);
            most = step % 10 == 9 ? std::max(most, energy(world)) : most;
        }
        EXPECT_LE(most, 1.02 * before) << slot.low << ' ' << slot.high;
    }
}

/// A ledge whose top is a line of the grid kept a third of what was poured onto it, for ever.
TYPED_TEST(Slide, LedgesRunDry) {
    TestWorld<TypeParam> world(tank(16, 16));
    add_block(world, -1.0F, -1.0F, 8.0F, 5.0F);
    expect_ok(world->fill({{0.0F, 5.0F * kCell}, {8.0F * kCell, 7.0F * kCell}}));
    ASSERT_EQ(world->particle_positions().size, 64);
    for (std::int32_t step = 0; step < 640; ++step) {
        world->step(1.0F / 64.0F);
    }
    std::int32_t kept = 0;
    for (const auto at : world->particle_positions()) {
        kept += static_cast<float>(at.x) < 8.0F ? 1 : 0;
    }
    EXPECT_LE(kept, 12);
}

}  // namespace
}  // namespace weir
