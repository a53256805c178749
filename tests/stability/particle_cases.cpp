// S1, S2, S3, S4, S17: few particles, many particles in one place, fast particles.
#include <algorithm>
#include <cmath>

#include "cases.hpp"
#include "measure/random.hpp"

namespace stability {

using measure::Random;

using weir::Clamped;
using weir::StepReport;
using weir::Vec2f;

namespace {

constexpr Vec2f kNoGravity{0.0F, 0.0F};

/// Particles at random places of the cell whose lower left corner is given; all in one point if
/// the spread is 0.
template <class Real>
void crowd(Tank<Real>& tank, Vec2f corner, float spread, std::int32_t count) {
    Random random(1);
    for (std::int32_t k = 0; k < count; ++k) {
        const float middle = 0.5F * (1.0F - spread);
        tank.add({corner.x + middle + random.uniform(0.0F, spread),
                  corner.y + middle + random.uniform(0.0F, spread)},
                 {0, 0});
    }
}

/// Work stored in the compressed liquid, per mass of a particle. The pressure c²(ρ − 1) is divided
/// by the density at rest, not by ρ, so it accelerates like c²(ρ² − 1)/2 would.
double stored_by_sound(double sound_speed, double density) {
    return 0.5 * sound_speed * sound_speed * (density - 1.0) * (density - 1.0) / density;
}

/// What a crowded cell may turn into motion: what the pressure stores, and a fall through the tank.
template <class Real>
void check_release(Report& report, const std::string& name, const Tank<Real>& tank,
                   double density, double fastest_kinetic) {
    const auto& def = tank.def();
    const auto cell = static_cast<double>(def.cell_m);
    const double g = std::fabs(static_cast<double>(def.gravity_mps2.y)) / cell;
    double limit = g * def.capacity.cells_y;
    if (def.pressure == weir::Pressure::equation_of_state) {
        limit += stored_by_sound(static_cast<double>(def.sound_speed_mps) / cell, density);
    }
    // A compressible crowd stores more than its weight could; without weight nothing is put in.
    const bool lifts = g > 0.0 && def.pressure == weir::Pressure::projection;
    report.run(name, tank.tally(), lifts ? bounds_of(Scheme{}) : kOnlyKept);
    report.at_most(name + ".kinetic_energy_per_particle", fastest_kinetic, "cells2/s2",
                   limit * 1.0001 + tank.rounding_room() / tank.particles());
    report.figure(name + ".most_in_a_cell_at_end", tank.highest_density(), "of full");
}

template <class Real>
void release(Report& report, const std::string& name, const Scheme& scheme, Vec2f gravity,
             std::int32_t count, float spread, std::int32_t steps) {
    weir::WorldDef def = tank_def(scheme, 32, 32, count);
    def.gravity_mps2 = gravity;
    Tank<Real> tank(def);
    crowd(tank, {16, 16}, spread, count);
    tank.count_compression();
    double kinetic = 0.0;
    for (std::int32_t k = 0; k < steps; ++k) {
        tank.step(scheme.dt_s());
        kinetic = std::max(kinetic, tank.kinetic_energy() / count);
    }
    check_release(report, name, tank, static_cast<double>(count) / def.particles_per_cell, kinetic);
}

template <class Real>
void near_empty(Report& report, const Scheme& scheme, float weight) {
    weir::WorldDef def = tank_def(scheme, 32, 32, 64);
    def.gravity_mps2 = kNoGravity;
    Tank<Real> tank(def);
    // Alone in their cells, a hair beside faces and corners of the staggered grids; one goes as
    // fast as the step allows.
    const float lines[] = {1.0F, 1.5F};
    std::vector<Vec2f> velocity;
    for (int k = 0; k < 16; ++k) {
        const float side = k % 2 == 0 ? weight : -weight;
        const float x = lines[k % 4 / 2] + 6.0F * static_cast<float>(k % 5);
        velocity.push_back({0.9F / scheme.dt_s() * (k == 7 ? 1.0F : 0.01F), 0.25F});
        tank.add({x + side, lines[k % 3 % 2] + 1.875F * static_cast<float>(k) + 0.5F * side},
                 velocity.back());
    }
    constexpr int kSteps = 5;
    double error = 0.0;
    for (int step = 0; step < kSteps; ++step) {
        tank.step(scheme.dt_s());
        for (int k = 0; k < 16; ++k) {
            const auto start = static_cast<double>(velocity[static_cast<std::size_t>(k)].x);
            // Rounded where it is put in, and in each step.
            error = std::max(error, std::fabs(tank.velocity(k).x / start - 1.0) -
                                        0.5 * (1 + kSteps) * tank.speed_unit() / start);
        }
    }
    char text[32];
    std::snprintf(text, sizeof text, ".offset%g", static_cast<double>(weight));
    const std::string name = label<Real>("S3", scheme) + text;
    report.run(name, tank.tally(), bounds_of(scheme));
    report.at_most(name + ".free_flight_error", error, "1", 1.0e-5);
}

std::string flight(float cells_a_step, std::int32_t max_substeps) {
    char text[48];
    std::snprintf(text, sizeof text, ".%gcells.of%d", static_cast<double>(cells_a_step),
                  max_substeps);
    return text;
}

/// A block of liquid in free flight, without gravity; so many cells a step.
template <class Real>
void fly(Report& report, const Scheme& scheme, float cells_a_step, std::int32_t max_substeps) {
    weir::WorldDef def = tank_def(scheme, 64, 32, 256);
    def.gravity_mps2 = kNoGravity;
    def.max_substeps = max_substeps;
    const float speed = cells_a_step / scheme.dt_s();
    def.top_speed_mps = speed * def.cell_m;
    def.sound_speed_mps = scheme.elastic() ? 0.2F : 0.0F;
    Tank<Real> tank(def);
    tank.fill_moving(2, 12, 10, 20, {speed, 0.0F});
    const auto before = static_cast<double>(tank.position(0).x);
    const StepReport first = tank.step(scheme.dt_s());
    const double way = static_cast<double>(tank.position(0).x) - before;
    const std::string name = label<Real>("S4", scheme) + flight(cells_a_step, max_substeps);
    // Half a thousandth: the substeps are planned from rounded products.
    const double wanted = scheme.elastic()
                              ? (static_cast<double>(cells_a_step) +
                                 12.8 * static_cast<double>(scheme.dt_s())) / 0.4
                              : static_cast<double>(cells_a_step);
    const double planned = std::min(std::ceil(wanted * 0.9995), static_cast<double>(max_substeps));
    report.at_least(name + ".substeps", first.substeps, "1", std::max(1.0, planned));
    report.at_most(name + ".substeps", first.substeps, "1", std::max(1.0, planned) + 1.0);
    const double possible = 2.0 * first.substeps;
    const bool limited = static_cast<double>(cells_a_step) > possible * 1.0001;
    report.holds(name + ".slowed_is_reported", first.has(Clamped::speed) == limited);
    const double expected = std::min(static_cast<double>(cells_a_step), possible);
    report.at_most(name + ".way_error", std::fabs(way / expected - 1.0), "1",
                   1.0e-4 + tank.place_unit() / expected);
    tank.run(60, scheme.dt_s());
    report.run(name, tank.tally(), bounds_of(scheme));
}

}  // namespace

void coincident_particles(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, true, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        for (const float opposite : {1.0F, -1.0F}) {
            Tank<Real> pair(tank_def(scheme, 16, 16, 2));
            pair.add({8, 8}, {40, 3});
            pair.add({8, 8}, {opposite * 40, 3});
            pair.run(300, scheme.dt_s());
            report.run(label<Real>("S1", scheme) + (opposite > 0 ? ".pair" : ".opposite_pair"),
                       pair.tally(), bounds_of(scheme));
        }
        Tank<Real> pool(tank_def(scheme, 16, 16, 516));
        pool.fill(0, 0, 16, 8);
        for (const float x : {0.0F, 8.0F, 8.25F, 16.0F}) {
            const auto at = pool.position(static_cast<int>(x) * 8);
            pool.add({static_cast<float>(at.x), static_cast<float>(at.y)}, {0, 0});
        }
        pool.count_compression();
        pool.run(300, scheme.dt_s());
        report.run(label<Real>("S1", scheme) + ".in_a_pool", pool.tally(), bounds_of(scheme));
    });
}

void crowded_cell(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, true, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        const std::string name = label<Real>("S2", scheme);
        release<Real>(report, name + ".weightless", scheme, kNoGravity, 1000, 1.0F, 400);
        release<Real>(report, name + ".falling", scheme, {0.0F, -9.81F}, 1000, 1.0F, 400);
    });
}

void near_empty_faces(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, true, [&](const Scheme& scheme, auto real) {
        for (const float weight : {0.0F, 1.0e-7F, 1.0e-6F, 1.0e-3F}) {
            near_empty<decltype(real)>(report, scheme, weight);
        }
    });
}

void fast_liquid(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, false, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        const auto one = [&](float cells, std::int32_t substeps) {
            attempt<Real>(report, label<Real>("S4", scheme) + flight(cells, substeps), [&] {
                fly<Real>(report, scheme, cells, substeps);
            });
        };
        for (const float cells : {0.5F, 0.9F, 1.5F, 10.0F}) {
            one(cells, 32);
        }
        one(10.0F, 4);
    });
}

void highest_density(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, effort.full, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        const std::int32_t count = effort.full ? 200000 : 50000;
        const std::string name = label<Real>("S17", scheme);
        release<Real>(report, name + ".one_cell", scheme, {0.0F, -9.81F}, count, 1.0F, 40);
        release<Real>(report, name + ".one_point", scheme, {0.0F, -9.81F}, count, 0.0F, 40);
    });
}

}  // namespace stability
