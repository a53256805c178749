// R14: a closed box for a million steps, left alone (i) and kicked (v); and a pool at rest.
#include <algorithm>
#include <cmath>
#include <vector>

#include "cases.hpp"

namespace stability {

using weir::Vec2f;

namespace {

constexpr float kBox = 1.0F;    // m
constexpr float kDepth = 0.4F;  // m, once settled
constexpr double kGravity = 9.81;

/// A box of 1 m × 1 m in `cells` cells a side, N a power of two.
template <class Real>
weir::WorldDef box_def(const Scheme& scheme, std::int32_t cells) {
    weir::WorldDef def = tank_def(scheme, cells, cells, 4 * cells * cells);
    def.cell_m = kBox / static_cast<float>(cells);
    // Ten times the speed of the fastest liquid to be expected: c = 10 √(g h).
    def.sound_speed_mps = scheme.elastic() ? 20.0F : 0.0F;
    return def;
}

struct Goal {
    double volume;    ///< |drift| at the end
    double residual;  ///< rms speed, of √(g h)
};

/// The projection damps little: what still sways after 20,000 steps is gone after 200,000. After a
/// million fixed point keeps the volume within 1 %.
template <class Real>
Goal goal_of(const Scheme& scheme, std::int32_t steps) {
    const double sways = steps < 200000 ? 0.02 : 1.0e-4;
    const double volume = kIsFixed<Real> && steps >= 1000000 ? 0.01 : 0.02;
    return scheme.elastic() ? Goal{0.05, 1.0e-3} : Goal{volume, sways};
}

template <class Real>
struct Soak {
    Report& report;
    std::string name;
    Scheme scheme;
    Tank<Real> tank;
    std::int32_t steps;

    Soak(Report& r, const std::string& n, const Scheme& s, std::int32_t cells, std::int32_t count)
        : report(r), name(n), scheme(s), tank(box_def<Real>(s, cells)), steps(count) {
        const auto width = static_cast<float>(cells);
        tank.fill(0, 0, 0.5F * width, 0.8F * width);
    }

    /// Drift at each power of ten of steps; the last 1,000 steps' worst rms speed.
    void run(std::int32_t kick_every) {
        double residual = 0.0;
        std::int32_t next = 1000;
        for (std::int32_t k = 1; k <= steps; ++k) {
            if (kick_every > 0 && k % kick_every == 0 && k + 1000 < steps) {
                kick(k / kick_every);
            } else {
                tank.step(scheme.dt_s());
            }
            if (k > steps - 1000) {
                residual = std::max(residual, tank.rms_speed());
            }
            if (k == next) {
                report.figure(name + ".drift_at_" + std::to_string(k), tank.volume_error(), "1");
                report.figure(name + ".speed_at_" + std::to_string(k), tank.rms_speed() / unit(),
                              "sqrt(gh)");
                next *= 10;
            }
        }
        finish(residual, kick_every > 0);
    }

    /// One step of gravity as strong as may be, 0.3 sound speeds' worth or as much as a step takes.
    void kick(std::int32_t number) {
        const float strength = std::min(900.0F, 6.0F / scheme.dt_s());
        const float angle = 2.4F * static_cast<float>(number);
        tank.set_gravity({strength * std::cos(angle), strength * std::sin(angle)});
        tank.step(scheme.dt_s());
        tank.set_gravity({0.0F, -9.81F});
        tank.count_compression();  // the liquid was pressed into a corner
    }

    /// √(g h), cells/s.
    double unit() const {
        return std::sqrt(kGravity * static_cast<double>(kDepth)) /
               static_cast<double>(tank.def().cell_m);
    }

    void finish(double residual, bool kicked) {
        Goal goal = goal_of<Real>(scheme, steps);
        goal.residual += 2.0 * tank.speed_unit() / unit();  // what stands still in fixed point
        report.run(name, tank.tally(), bounds_of(scheme));
        report.at_most(name + ".volume_drift", std::fabs(tank.volume_error()), "1", goal.volume);
        if (kicked) {
            report.figure(name + ".residual_speed", residual / unit(), "sqrt(gh)");
        } else {
            report.at_most(name + ".residual_speed", residual / unit(), "sqrt(gh)", goal.residual);
        }
    }
};

std::int32_t step_count(const Effort& effort, const Scheme& scheme) {
    if (effort.steps > 0) {
        return effort.steps;
    }
    if (!effort.full) {
        return 20000;
    }
    return scheme.elastic() ? 200000 : 1000000;
}

template <class Real>
void rest(Report& report, const Scheme& scheme, std::int32_t steps) {
    Tank<Real> tank(box_def<Real>(scheme, 16));
    tank.fill(0, 0, 16, 8);
    tank.run(steps - 1000, scheme.dt_s());
    std::vector<weir::Vec2<Look<Real>>> before;
    for (std::int32_t k = 0; k < tank.particles(); ++k) {
        before.push_back(tank.position(k));
    }
    const std::uint64_t hash = tank.world().state_hash();
    tank.run(999, scheme.dt_s());
    const std::uint64_t last_but_one = tank.world().state_hash();
    tank.run(1, scheme.dt_s());
    double most = 0.0;
    for (std::size_t k = 0; k < before.size(); ++k) {
        const auto now = tank.position(static_cast<std::int32_t>(k));
        most = std::max(most, std::hypot(static_cast<double>(now.x - before[k].x),
                                         static_cast<double>(now.y - before[k].y)));
    }
    const std::string name = label<Real>("R14.rest", scheme);
    const std::uint64_t end = tank.world().state_hash();
    report.run(name, tank.tally(), bounds_of(scheme));
    report.at_most(name + ".largest_way_in_last_1000", most, "cells",
                   scheme.elastic() ? 2.0 : 0.05);
    if (kIsFixed<Real>) {
        report.holds(name + ".same_bits_as_1000_steps_ago", end == hash);
        report.holds(name + ".same_bits_as_the_step_before", end == last_but_one);
    } else {
        report.figure(name + ".same_bits_as_1000_steps_ago", end == hash ? 1 : 0, "1");
        report.figure(name + ".same_bits_as_the_step_before", end == last_but_one ? 1 : 0, "1");
    }
    report.figure(name + ".volume_drift", tank.volume_error(), "1");
}

/// A column that is poured into a box of 32 cells comes to rest wherever its surface ends up: what
/// keeps its volume must not keep it swaying.
template <class Real>
void pour(Report& report, const Scheme& scheme, const std::vector<float>& heights) {
    double worst = 0.0;
    for (const float height : heights) {
        Tank<Real> tank(box_def<Real>(scheme, 32));
        tank.fill(0, 0, 16, height);
        tank.run(40000, scheme.dt_s());
        const double depth = 0.5 * static_cast<double>(height * tank.def().cell_m);
        const double unit = std::sqrt(kGravity * depth) / static_cast<double>(tank.def().cell_m);
        worst = std::max(worst, tank.rms_speed() / unit);
    }
    report.at_most(label<Real>("R14.poured", scheme) + ".residual_speed", worst, "sqrt(gh)",
                   1.0e-3);
}

}  // namespace

void soak(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, false, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        for (const std::int32_t cells : {16, 32}) {
            if (cells > 16 && !effort.full) {
                continue;
            }
            const std::int32_t steps = step_count(effort, scheme);
            const std::string name = label<Real>("R14.N", scheme) + "." + std::to_string(cells);
            Soak<Real>(report, name + ".i", scheme, cells, steps).run(0);
            Soak<Real>(report, name + ".v", scheme, cells, steps).run(steps / 10);
        }
    });
}

void resting_pool(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, false, [&](const Scheme& scheme, auto real) {
        const std::int32_t quick = scheme.elastic() ? 20000 : 100000;
        const std::int32_t wanted = effort.full ? 10 * quick : quick;
        rest<decltype(real)>(report, scheme, effort.steps > 0 ? effort.steps : wanted);
        if (!scheme.elastic()) {
            std::vector<float> heights = {23.0F, 24.0F, 25.5F};
            if (effort.full) {
                heights.insert(heights.end(), {22.5F, 23.5F, 24.5F, 26.0F, 26.5F});
            }
            pour<decltype(real)>(report, scheme, heights);
        }
    });
}

}  // namespace stability
