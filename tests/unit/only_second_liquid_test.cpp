// A tank that holds the second liquid alone: how heavy it is beside one that is not there is no
// matter. Densities that are powers of two round nothing, so such a tank goes as one of the first
// liquid does, to the bit: whatever takes a pressure for the first liquid's would show.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

WorldDef second_def(float ratio) {
    WorldDef def = tank_def(32, 32, 2600);
    def.capacity.second_liquid = true;
    def.second_density_ratio = ratio;
    return def;
}

template <class Real>
void expect_same_places(const World<Real>& one, const World<Real>& other) {
    const auto places = one.particle_positions();
    ASSERT_EQ(places.size, other.particle_positions().size);
    for (std::int32_t k = 0; k < places.size; ++k) {
        ASSERT_EQ(places[k].x, other.particle_positions()[k].x) << k;
        ASSERT_EQ(places[k].y, other.particle_positions()[k].y) << k;
    }
}

/// A column that breaks: jets along the walls, liquid that is torn, and drift that lifts it.
template <class Real>
void expect_the_first_ones_bits(float ratio) {
    SCOPED_TRACE(ratio);
    TestWorld<Real> first(second_def(ratio));
    TestWorld<Real> second(second_def(ratio));
    const Box column{{0, 0}, {0.24F, 0.4F}};
    ASSERT_EQ(first->fill(column, nullptr, Liquid::first), Status::ok);
    ASSERT_EQ(second->fill(column, nullptr, Liquid::second), Status::ok);
    for (int step = 0; step < 45; ++step) {
        first->step(1.0F / 60.0F);
        second->step(1.0F / 60.0F);
    }
    expect_same_places(*first, *second);
    const auto pressed = static_cast<float>(first->pressure().at(3, 0));
    EXPECT_EQ(ratio * pressed, static_cast<float>(second->pressure().at(3, 0)));
}

TEST(OnlySecondLiquid, GoesAsTheFirstToTheBit) {
    expect_the_first_ones_bits<float>(4.0F);
    expect_the_first_ones_bits<float>(0.25F);
    expect_the_first_ones_bits<double>(4.0F);
}

/// What a wave, a fifth as high as the pool is deep, has of its energy after eight seconds.
template <class Real>
double kept_of_a_wave(float ratio, Liquid kind) {
    TestWorld<Real> world(second_def(ratio));
    for (int i = 0; i < 64; ++i) {
        for (int j = 0; j < 40; ++j) {
            const float x = 0.01F * (static_cast<float>(i) + 0.5F);
            const float y = 0.01F * (static_cast<float>(j) + 0.5F);
            if (y < 0.3F + 0.06F * std::cos(3.14159265F * x / 0.64F)) {
                EXPECT_EQ(world->add_particle({x, y}, {0, 0}, kind), Status::ok);
            }
        }
    }
    const auto over_rest = [&] {
        Diagnostics now;
        EXPECT_EQ(world->diagnose(&now), Status::ok);
        const double depth = 1.0e-4 * world->particle_positions().size / 0.64;
        return now.kinetic_energy_m4ps2 + now.potential_energy_m4ps2 -
               0.5 * now.mass_m2 * 9.81 * depth;
    };
    world->step(1.0F / 60.0F);
    const double start = over_rest();
    for (int step = 0; step < 480; ++step) {
        world->step(1.0F / 60.0F);
    }
    return over_rest() / start;
}

TEST(OnlySecondLiquid, KeepsItsWavesHoweverHeavy) {
    const double first = kept_of_a_wave<float>(13.6F, Liquid::first);
    EXPECT_GT(first, 0.8);
    EXPECT_NEAR(kept_of_a_wave<float>(13.6F, Liquid::second), first, 0.01);  // 0.32 was left
    EXPECT_NEAR(kept_of_a_wave<Fixed>(13.6F, Liquid::second), first, 0.03);
    EXPECT_NEAR(kept_of_a_wave<float>(0.01F, Liquid::second), first, 0.01);
}

}  // namespace
}  // namespace weir
