// S13, S14, S15: what has to be the same, and how much the same.
#include <algorithm>
#include <cmath>

#include "cases.hpp"
#include "math/vec2.hpp"
#include "measure/random.hpp"

namespace stability {

using measure::Random;

using weir::Vec2f;

namespace {

/// Liquid between two solids, and a drop; the whole scene shifted, or mirrored about the middle.
/// No corner is on a node and no edge runs through one: rounding would decide there. Vessel
/// and tank are high, so that no splash gets out or meets the tank's walls.
struct Placement {
    float shift_x = 0.0F;
    float shift_y = 0.0F;
    bool mirrored = false;
    std::int32_t width = 41;

    Vec2f at(Vec2f p) const {
        const auto w = static_cast<float>(width);
        return mirrored ? Vec2f{w - p.x, p.y} : Vec2f{p.x + shift_x, p.y + shift_y};
    }
};

Ring placed(const Placement& placement, Ring ring) {
    for (Vec2f& p : ring) {
        p = placement.at(p);
    }
    if (placement.mirrored) {
        std::reverse(ring.begin(), ring.end());
    }
    return ring;
}

/// A vessel away from the tank's walls, so that it may be shifted; particles one by one, in the
/// same order wherever they are.
template <class Real>
void build(Tank<Real>& tank, const Placement& placement) {
    tank.add_static(placed(placement, {{6.125F, 3.625F}, {30.375F, 3.875F}, {33.125F, 90.375F},
                                       {29.625F, 90.125F}, {25.375F, 7.375F},
                                       {11.875F, 7.125F}, {8.375F, 90.125F}, {4.625F, 90.375F}}),
                    {0, 0});
    tank.add_static(placed(placement, {{17.875F, 8.125F}, {21.375F, 9.125F}, {19.125F, 11.375F}}),
                    {0, 0});
    // Off the lattice: on it, some cells would be liquid or air by rounding alone. In 1,024ths of a
    // cell, so that a place is exact wherever it goes.
    Random random(13);
    const auto off = [&] { return static_cast<float>(random.integer(-100, 100)) / 1024.0F; };
    const auto block = [&](float x0, float y0, int columns, int rows) {
        for (int b = 0; b < rows; ++b) {
            for (int a = 0; a < columns; ++a) {
                const float x = x0 + 0.5F * static_cast<float>(a) + 0.25F + off();
                const float y = y0 + 0.5F * static_cast<float>(b) + 0.25F + off();
                tank.add(placement.at({x, y}), {0, 0});
            }
        }
    };
    block(12.5F, 8.0F, 8, 12);
    block(20.0F, 16.0F, 6, 6);
}

/// Largest distance of a particle from where the other scene has it, cells.
template <class Real>
double difference(Tank<Real>& plain, Tank<Real>& other, const Placement& placement) {
    double most = 0.0;
    for (std::int32_t k = 0; k < plain.particles(); ++k) {
        const auto a = weir::convert<double>(plain.position(k));
        const auto b = weir::convert<double>(other.position(k));
        const double ax = a.x;
        const double expected_x =
            placement.mirrored ? placement.width - ax : ax + static_cast<double>(placement.shift_x);
        const double expected_y =
            a.y + static_cast<double>(placement.shift_y);
        most = std::max({most, std::fabs(b.x - expected_x), std::fabs(b.y - expected_y)});
    }
    return most;
}

/// What the arithmetic promises after 10 and after 60 steps; 0: nothing.
struct Agreement {
    double after_ten = 0.0;
    double after_sixty = 0.0;
};

template <class Real>
void compare(Report& report, const Scheme& scheme, const char* what, const Placement& placement,
             const Agreement& promised) {
    const weir::WorldDef def = tank_def(scheme, placement.width, 120, 132, 2, 11);
    Tank<Real> plain(def);
    Tank<Real> other(def);
    build(plain, Placement{});
    build(other, placement);
    const std::string name = label<Real>("S13", scheme) + "." + what;
    const auto look = [&](const char* when, double bound) {
        const double differs = difference(plain, other, placement);
        if (bound > 0.0) {
            report.at_most(name + when, differs, "cells", bound);
        } else {
            report.figure(name + when, differs, "cells");
        }
    };
    for (int k = 1; k <= 60; ++k) {
        plain.step(scheme.dt_s());
        other.step(scheme.dt_s());
        if (k == 10) {
            look(".difference_after_10", promised.after_ten);
        }
    }
    look(".difference_after_60", promised.after_sixty);
}

struct Run {
    Scheme scheme;
    bool backwards = false;  ///< particles in reverse order

    template <class Real>
    void begin(Tank<Real>& tank) const {
        tank.add_static({{10, -1}, {15, -1}, {13, 4}}, {0, 0});
        tank.add_moving({{-3, -0.6F}, {3, -0.6F}, {3, 0.6F}, {-3, 0.6F}}, {17, 6}, {0, 0}, 3.0F);
        for (int k = 0; k < 20 * 12; ++k) {
            const int n = backwards ? 20 * 12 - 1 - k : k;
            tank.add({0.25F + 0.5F * static_cast<float>(n / 20),
                      0.25F + 0.5F * static_cast<float>(n % 20)},
                     {0, 0});
        }
    }
    weir::WorldDef def() const { return tank_def(scheme, 24, 16, 240, 2, 7); }
};

template <class Real>
void repeat(Report& report, const Scheme& scheme, std::int32_t steps) {
    const Run run{scheme, false};
    const Run reversed{scheme, true};
    Tank<Real> first(run.def(), 0x00);
    Tank<Real> again(run.def(), 0xFF);
    Tank<Real> among(run.def());
    Tank<Real> stranger(reversed.def());
    run.begin(first);
    run.begin(again);
    run.begin(among);
    reversed.begin(stranger);
    first.run(steps, scheme.dt_s());
    again.run(steps, scheme.dt_s());
    for (std::int32_t k = 0; k < steps; ++k) {
        among.step(scheme.dt_s());
        stranger.step(0.7F * scheme.dt_s());
        stranger.step(0.3F * scheme.dt_s());
    }
    const std::string name = label<Real>("S14", scheme);
    const std::uint64_t hash = first.world().state_hash();
    report.holds(name + ".again_in_dirty_memory", again.world().state_hash() == hash);
    report.holds(name + ".interleaved_with_another", among.world().state_hash() == hash);

    Tank<Real> mixed(run.def());
    reversed.begin(mixed);
    mixed.run(steps, scheme.dt_s());
    // Not promised: sums over particles have their order. A figure, not a target.
    report.figure(name + ".order_of_particles_not_promised.mean_height_differs",
                  mixed.mean_height() / first.mean_height() - 1.0, "1");
}

}  // namespace

// The pressure knows cells by their colour, even or odd, and by the coarse cell, 4 × 4, that they
// are in: what it leaves is the same where both are. Then in double what rounding makes different
// stays below 1e-8 (1e-5 with an equation of state, whose steps are a tenth as long). A splash
// multiplies it a thousandfold in 50 steps, though, and in float it is 1e-5 after ten: the same to
// the eye, not particle by particle for ever.
void moved_scene(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, true, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        const bool wide = sizeof(Real) == sizeof(double);
        const Agreement exact{1.0e-9, 1.0e-9};  // fixed point's places are shifted to the bit
        const Agreement near = wide ? Agreement{1.0e-11, scheme.elastic() ? 1.0e-5 : 1.0e-8}
                                    : Agreement{1.0e-3, 0.0};
        const Agreement same = kIsFixed<Real> ? exact : near;
        const Agreement other;
        compare<Real>(report, scheme, "shifted_4_4", {4, 4, false, 41}, same);
        compare<Real>(report, scheme, "shifted_back_4_12", {-4, 12, false, 41}, same);
        compare<Real>(report, scheme, "shifted_3_5", {3, 5, false, 41}, other);
        compare<Real>(report, scheme, "shifted_5_2_odd", {5, 2, false, 41}, other);
        compare<Real>(report, scheme, "mirrored", {0, 0, true, 41}, other);
        compare<Real>(report, scheme, "mirrored_even_width", {0, 0, true, 42}, other);
    });
}

void same_run(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, true, true, [&](const Scheme& scheme, auto real) {
        repeat<decltype(real)>(report, scheme, effort.full ? 2000 : 200);
    });
}

void save_and_restore(Report& report, const Effort&) {
    report.not_offered("S15.save_and_restore");
}

}  // namespace stability
