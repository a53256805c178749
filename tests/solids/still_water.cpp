// R4c and R6b: still water and sloshing between inclined walls, upright and with the whole scene
// turned by 17.3 degrees. Exact: p = ρ g depth; ω² = g / h for u = A y, v = A x about the apex of a
// 90 degree V, whose surface stays plane.
#include <cmath>

#include "problems.hpp"
#include "vessel.hpp"

namespace solids {

namespace {

constexpr double kTilt = 17.3 * M_PI / 180.0;

/// Apex, and what is inside.
struct Wedge {
    Vessel vessel;
    Vec apex;
    double depth;
};

/// What is rounded in the lattice and the contour depends on where they stand in their cells: each
/// figure is the mean of some starts, shifted by parts of a cell.
Vec shift_of(int start) {
    return {std::fmod(0.31 + 0.618034 * start, 1.0), std::fmod(0.17 + 0.754878 * start, 1.0)};
}

Wedge v_tank(int depth, double tilt, Vec shift) {
    Wedge wedge;
    const double half = 1.45 * depth;  // half of the tank: room for the V turned
    wedge.vessel.cells_x = static_cast<int>(2.0 * half) + 6;
    wedge.vessel.cells_y = static_cast<int>(2.0 * half) + 6;
    wedge.vessel.tilt = tilt;
    const Vec middle = wedge.vessel.middle();
    const Vec apex{middle.x + shift.x, middle.y - 0.62 * depth - shift.y};
    const double far = 4.0 * depth + 20.0;
    wedge.apex = apex;
    wedge.depth = depth;
    wedge.vessel.walls = {{apex,
                           {apex.x - far, apex.y + far},
                           {apex.x - far, apex.y - far},
                           {apex.x + far, apex.y - far},
                           {apex.x + far, apex.y + far}}};
    wedge.vessel.liquid = [apex, depth](Vec p) {
        const Vec d = p - apex;
        return d.y < depth && d.y > std::abs(d.x);
    };
    return wedge;
}

/// A box of four walls, three cells thick, half full.
Vessel turned_box(int depth, double tilt, Vec shift) {
    Vessel vessel;
    const double width = 1.5 * depth;
    const double height = 1.5 * depth;
    vessel.cells_x = static_cast<int>(1.45 * (width + 8.0));
    vessel.cells_y = vessel.cells_x;
    vessel.tilt = tilt;
    const Vec low{vessel.middle().x - 0.5 * width + shift.x,
                  vessel.middle().y - 0.5 * height + shift.y};
    const Vec high{low.x + width, low.y + height};
    const double t = 3.0;
    const auto slab = [](Vec a, Vec b) {
        return Points{{a.x, a.y}, {b.x, a.y}, {b.x, b.y}, {a.x, b.y}};
    };
    vessel.walls = {slab({low.x - t, low.y - t}, {high.x + t, low.y}),
                    slab({low.x - t, high.y}, {high.x + t, high.y + t}),
                    slab({low.x - t, low.y - t}, {low.x, high.y + t}),
                    slab({high.x, low.y - t}, {high.x + t, high.y + t})};
    vessel.liquid = [low, high, depth](Vec p) {
        return p.x > low.x && p.x < high.x && p.y > low.y && p.y < low.y + depth;
    };
    return vessel;
}

/// Root of the mean square of p − ρ g (depth below the surface), over ρ g h, of the cells whose
/// centres are in the liquid.
double pressure_error(const Vessel& vessel, const Pool& pool, double surface, double depth) {
    double squares = 0.0;
    int count = 0;
    for (int j = 0; j < vessel.cells_y; ++j) {
        for (int i = 0; i < vessel.cells_x; ++i) {
            const Vec p = vessel.to_frame({i + 0.5, j + 0.5});
            if (vessel.liquid(p) && surface - p.y > 0.5) {
                const double error =
                    pool.pressure(i, j) / (kGravity * depth) - (surface - p.y) / depth;
                squares += error * error;
                ++count;
            }
        }
    }
    return std::sqrt(squares / count);
}

/// Means over some steps.
struct Rest {
    double pressure_error = 0.0;
    double energy = 0.0;  ///< kinetic, of mgh/2
};

/// `surface`: where so much liquid comes to rest.
Rest rest_over(Pool& pool, int steps, const Vessel& vessel, double surface, double depth) {
    Rest mean;
    for (int k = 0; k < steps; ++k) {
        pool.step();
        const double speed = pool.rms_speed();
        mean.pressure_error += pressure_error(vessel, pool, surface, depth) / steps;
        mean.energy += speed * speed / (kGravity * depth) / steps;
    }
    return mean;
}

struct Still {
    Rest soon;     ///< over the last fifth of 40 √(h/g)
    Rest settled;  ///< once the level, which the lattice leaves a tenth of a cell off, has settled
};

/// surface_of(area): where so much liquid comes to rest.
template <class SurfaceOf>
Still still(const Vessel& vessel, double depth, const SurfaceOf& surface_of) {
    Pool pool(vessel);
    const double surface = surface_of(0.25 * pool.particles());
    const int steps = static_cast<int>(40.0 * std::sqrt(depth / kGravity) * 60.0);
    Still still;
    pool.run(steps - steps / 5);
    still.soon = rest_over(pool, steps / 5, vessel, surface, depth);
    pool.run(static_cast<int>(50.0 * depth));
    still.settled = rest_over(pool, steps / 5, vessel, surface, depth);
    return still;
}

constexpr int kStartsAtRest = 4;

/// still_of(start): of one start.
template <class StillOf>
void report_rest(Report& report, const std::string& name, int depth, const StillOf& still_of) {
    double error = 0.0;
    double error_soon = 0.0;
    double soon = 0.0;
    double settled = 0.0;
    for (int start = 0; start < kStartsAtRest; ++start) {
        const Still one = still_of(start);
        error += one.settled.pressure_error / kStartsAtRest;
        error_soon += one.soon.pressure_error / kStartsAtRest;
        soon += one.soon.energy / kStartsAtRest;
        settled += one.settled.energy / kStartsAtRest;
    }
    report.at_most(name + ".pressure_l2", 100.0 * error, "%",
                   depth <= 16 ? 1.5 : (depth <= 32 ? 0.5 : 0.1));
    report.figure(name + ".pressure_l2_soon", 100.0 * error_soon, "%");
    report.at_most(name + ".kinetic_energy", soon, "of mgh/2", 1e-5);
    report.figure(name + ".kinetic_energy_settled", settled, "of mgh/2");
}

/// What still moves after the same time, of √(gh).
double speed_at_end(const Vessel& vessel, double depth) {
    Pool pool(vessel);
    pool.run(static_cast<int>(40.0 * std::sqrt(depth / kGravity) * 60.0));
    return pool.rms_speed() / std::sqrt(kGravity * depth);
}

/// Gravity leans, or walls do: which of the two keeps liquid from resting.
void who_stirs(Report& report, int depth) {
    Vessel plain;
    plain.cells_x = plain.cells_y = 2 * depth;
    plain.tilt = kTilt;
    const double middle = plain.middle().y;
    plain.liquid = [middle](Vec p) { return p.y < middle; };
    report.figure("R4c.surface_leans_in_a_plain_tank." + std::to_string(depth) + ".speed",
                  speed_at_end(plain, depth), "sqrt(gh)");
    Vessel box = turned_box(depth, kTilt, {});
    box.gravity_tilts = false;
    const Vec centre = box.middle();
    box.liquid = [box, centre, depth](Vec p) {
        const double half = 0.75 * depth;
        return std::abs(p.x - centre.x) < half && std::abs(p.y - centre.y) < half &&
               box.to_tank(p).y < centre.y;
    };
    report.figure("R4c.walls_lean_under_a_level_surface." + std::to_string(depth) + ".speed",
                  speed_at_end(box, depth), "sqrt(gh)");
}

struct Slosh {
    double frequency_error = 0.0;
    double loss = 0.0;  ///< of the amplitude, a period
    double penetration = 0.0;
};

/// Four periods of the V's own mode, after the lattice has come to rest.
Slosh slosh(int depth, double tilt, Vec shift) {
    const Wedge wedge = v_tank(depth, tilt, shift);
    Pool pool(wedge.vessel);
    pool.run(300);
    const double h = std::sqrt(0.25 * pool.particles());  // area h²
    const double omega = std::sqrt(kGravity / h);
    const double a = 0.03 * omega;
    pool.stir([&](Vec p) {
        return Vec{a * (p.y - wedge.apex.y), a * (p.x - wedge.apex.x)};
    });
    const auto amplitude = [&] {
        double sum = 0.0;
        double squares = 0.0;
        for (int k = 0; k < pool.particles(); ++k) {
            const Vec d = pool.position(k) - wedge.apex;
            const Vec v = pool.velocity(k);
            sum += v.x * d.y + v.y * d.x;
            squares += weir::dot(d, d);
        }
        return sum / squares;
    };
    Slosh result;
    const float dt = kFrame_s / 2.0F;
    double time = 0.0;
    double before = amplitude();
    double first_crossing = 0.0;
    double last_crossing = 0.0;
    int crossings = 0;
    std::vector<double> peaks;
    double peak = 0.0;
    const double end = 4.1 * 2.0 * M_PI / omega;
    while (time < end) {
        pool.step(dt);
        time += static_cast<double>(pool.report().dt_s);
        const double now = amplitude();
        peak = std::max(peak, std::abs(now));
        if ((now > 0.0) != (before > 0.0)) {
            last_crossing = time - static_cast<double>(pool.report().dt_s) * now / (now - before);
            first_crossing = crossings == 0 ? last_crossing : first_crossing;
            if (crossings > 0) {
                peaks.push_back(peak);
            }
            peak = 0.0;
            ++crossings;
        }
        before = now;
        for (int k = 0; k < pool.particles(); ++k) {
            const Vec d = pool.position(k) - wedge.apex;
            result.penetration =
                std::max(result.penetration, (std::abs(d.x) - d.y) / std::sqrt(2.0));
        }
    }
    const double half_periods = crossings - 1;
    const double measured = M_PI * half_periods / (last_crossing - first_crossing);
    result.frequency_error = measured / omega - 1.0;
    const double span = 0.5 * static_cast<double>(peaks.size() - 1);
    result.loss = 1.0 - std::pow(peaks.back() / peaks.front(), 1.0 / span);
    return result;
}

/// Means of some starts.
Slosh mean_slosh(int depth, double tilt) {
    const int starts = depth > 32 ? 4 : 8;
    Slosh mean;
    for (int start = 0; start < starts; ++start) {
        const Slosh one = slosh(depth, tilt, shift_of(start));
        mean.frequency_error += std::abs(one.frequency_error) / starts;
        mean.loss += one.loss / starts;
        mean.penetration = std::max(mean.penetration, one.penetration);
    }
    return mean;
}

}  // namespace

void still_water(Report& report, const Effort& effort) {
    for (const int depth : {16, 32, 64}) {
        if (depth > 32 && !effort.full) {
            continue;
        }
        const std::string cells = "." + std::to_string(depth);
        for (const double tilt : {0.0, kTilt}) {
            const std::string turned = tilt > 0.0 ? "_turned" : "";
            report_rest(report, "R4c.v_tank" + turned + cells, depth, [&](int start) {
                const Wedge wedge = v_tank(depth, tilt, shift_of(start));
                return still(wedge.vessel, depth,
                             [&](double area) { return wedge.apex.y + std::sqrt(area); });
            });
        }
        report_rest(report, "R4c.box_turned" + cells, depth, [&](int start) {
            const Vessel box = turned_box(depth, kTilt, shift_of(start));
            const double floor = box.middle().y - 0.75 * depth + shift_of(start).y;
            return still(box, depth, [&](double area) { return floor + area / (1.5 * depth); });
        });
        who_stirs(report, depth);
    }
}

void sloshing(Report& report, const Effort& effort) {
    for (const int depth : {16, 32, 64}) {
        if (depth > 32 && !effort.full) {
            continue;
        }
        const std::string name = "R6b.v_tank." + std::to_string(depth);
        Slosh worst;
        for (const double tilt : {0.0, kTilt}) {
            const Slosh one = mean_slosh(depth, tilt);
            worst.frequency_error = std::max(worst.frequency_error, one.frequency_error);
            worst.loss = std::max(worst.loss, one.loss);
            worst.penetration = std::max(worst.penetration, one.penetration);
            report.figure(name + (tilt > 0.0 ? ".loss_turned" : ".loss_upright"),
                          100.0 * one.loss, "%/period");
        }
        if (depth == 16) {
            report.figure(name + ".frequency", 100.0 * worst.frequency_error, "%");
            report.figure(name + ".loss", 100.0 * worst.loss, "%/period");
        } else {
            report.at_most(name + ".frequency", 100.0 * worst.frequency_error, "%",
                           depth == 32 ? 0.3 : 0.15);
            report.at_most(name + ".loss", 100.0 * worst.loss, "%/period",
                           depth == 32 ? 1.9 : 0.7);
        }
        report.at_most(name + ".penetration", worst.penetration, "cells", 0.05);
    }
}

}  // namespace solids
