// S5, S9, S12: violent flow in a box without solids. Most end at rest, where volume is measured.
#include <cmath>

#include "cases.hpp"
#include "measure/random.hpp"

namespace stability {

using measure::Random;

using weir::Vec2f;

namespace {

constexpr Vec2f kDown{0.0F, -9.81F};

/// The settled surface may stand so far off, cells. What still sways holds the mean up, too.
constexpr double kLevelBound = 0.35;

template <class Real>
void settle(Tank<Real>& tank, const Scheme& scheme, float seconds) {
    tank.run(static_cast<std::int32_t>(seconds / scheme.dt_s()), scheme.dt_s());
}

template <class Real>
void finish(Report& report, const std::string& name, const Bounds& bounds,
            const Tank<Real>& tank) {
    report.run(name, tank.tally(), bounds);
    report.figure(name + ".settled_volume_error", tank.volume_error(), "1");
    report.at_most(name + ".settled_level_error", std::fabs(tank.level_error()), "cells",
                   kLevelBound);
}

/// Each step half as long or half as long again, by chance or in turn.
template <class Real>
void jitter(Report& report, const Scheme& scheme, bool in_turn) {
    Tank<Real> tank(tank_def(scheme, 24, 16, 512));
    tank.fill(0, 0, 8, 12);
    Random random(9);
    for (int k = 0; k < 600; ++k) {
        const float sign = in_turn ? (k % 2 == 0 ? 1.0F : -1.0F) : random.uniform(-1.0F, 1.0F);
        tank.step(scheme.dt_s() * (1.0F + 0.5F * sign));
    }
    settle(tank, scheme, 4.0F);
    finish(report, label<Real>("S9", scheme) + (in_turn ? ".in_turn" : ".by_chance"),
           bounds_of(scheme), tank);
}

/// A pool that gravity turns over every 100 steps.
template <class Real>
void flip(Report& report, const Effort& effort, const Scheme& scheme, std::int32_t depth) {
    Tank<Real> tank(tank_def(scheme, 16, 16, 1024));
    tank.fill(0, 0, 16, static_cast<float>(depth));
    const std::int32_t flips = effort.full ? (scheme.elastic() ? 1000 : 10000) : 100;
    for (std::int32_t k = 0; k < flips; ++k) {
        tank.set_gravity(k % 2 == 0 ? Vec2f{0.0F, 9.81F} : kDown);
        if (scheme.elastic()) {
            tank.count_compression();  // what was pressed together below may be above
        }
        tank.run(100, scheme.dt_s());
    }
    tank.set_gravity(kDown);
    settle(tank, scheme, 8.0F);
    const std::string name = label<Real>("S12", scheme) + ".depth_" + std::to_string(depth);
    report.figure(name + ".flips", flips, "1");
    finish(report, name, bounds_of(scheme), tank);
}

/// A pool at rest feels a blow of so many g for one step; then nothing but its weight again.
template <class Real>
void strike(Report& report, const Scheme& scheme, float times) {
    Tank<Real> tank(tank_def(scheme, 32, 32, 2048));
    tank.fill(0, 0, 32, 13);
    tank.run(200, scheme.dt_s());
    tank.set_gravity({0.0F, -9.81F * times});
    tank.step(scheme.dt_s());
    tank.set_gravity(kDown);
    tank.count_compression();  // what was pressed together is lifted again
    tank.run(200, scheme.dt_s());
    report.run(label<Real>("S12", scheme) + ".blow_of_" +
                   std::to_string(static_cast<int>(times)) + "_g",
               tank.tally(), bounds_of(scheme));
}

}  // namespace

void high_drop(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, true, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        for (const bool pool : {false, true}) {
            Tank<Real> tank(tank_def(scheme, 12, 216, 512));
            tank.fill(4, 208, 8, 212);
            if (pool) {
                tank.fill(0, 0, 12, 8);
            }
            settle(tank, scheme, 8.0F);
            finish(report, label<Real>("S5", scheme) + (pool ? ".on_a_pool" : ".on_the_floor"),
                   bounds_of(scheme), tank);
        }
    });
}

void jittering_step(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, true, [&](const Scheme& scheme, auto real) {
        jitter<decltype(real)>(report, scheme, false);
        jitter<decltype(real)>(report, scheme, true);
    });
}

void flipping_gravity(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, false, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        for (const std::int32_t depth : {5, 8}) {
            flip<Real>(report, effort, scheme, depth);
        }
        for (const float times : {3.0F, 10.0F, 36.0F}) {
            strike<Real>(report, scheme, times);
        }
    });
}

}  // namespace stability
