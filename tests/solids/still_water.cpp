// R4c: still water between inclined walls, upright and with the whole scene turned by 17.3 degrees.
// Exact: p = ρ g depth.
#include <cmath>

#include "problems.hpp"
#include "v_tank.hpp"

namespace solids {

namespace {

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
template <class Real>
double pressure_error(const Vessel& vessel, const Pool<Real>& pool, double surface, double depth) {
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
template <class Real>
Rest rest_over(Pool<Real>& pool, int steps, const Vessel& vessel, double surface, double depth) {
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
template <class Real, class SurfaceOf>
Still still(const Vessel& vessel, double depth, const SurfaceOf& surface_of) {
    Pool<Real> pool(vessel);
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
template <class Real, class StillOf>
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
    accurate<Real>(report, name + ".pressure_l2", 100.0 * error, "%",
                   depth <= 16 ? 1.5 : (depth <= 32 ? 0.5 : 0.1));
    report.figure(name + ".pressure_l2_soon", 100.0 * error_soon, "%");
    accurate<Real>(report, name + ".kinetic_energy", soon, "of mgh/2", 1e-5);
    report.figure(name + ".kinetic_energy_settled", settled, "of mgh/2");
}

/// What still moves after the same time, of √(gh).
template <class Real>
double speed_at_end(const Vessel& vessel, double depth) {
    Pool<Real> pool(vessel);
    pool.run(static_cast<int>(40.0 * std::sqrt(depth / kGravity) * 60.0));
    return pool.rms_speed() / std::sqrt(kGravity * depth);
}

/// Gravity leans, or walls do: which of the two keeps liquid from resting.
template <class Real>
void who_stirs(Report& report, int depth) {
    Vessel plain;
    plain.cells_x = plain.cells_y = 2 * depth;
    plain.tilt = kTilt;
    const double middle = plain.middle().y;
    plain.liquid = [middle](Vec p) { return p.y < middle; };
    report.figure("R4c.surface_leans_in_a_plain_tank." + std::to_string(depth) + ".speed",
                  speed_at_end<Real>(plain, depth), "sqrt(gh)");
    Vessel box = turned_box(depth, kTilt, {});
    box.gravity_tilts = false;
    const Vec centre = box.middle();
    box.liquid = [box, centre, depth](Vec p) {
        const double half = 0.75 * depth;
        return std::abs(p.x - centre.x) < half && std::abs(p.y - centre.y) < half &&
               box.to_tank(p).y < centre.y;
    };
    report.figure("R4c.walls_lean_under_a_level_surface." + std::to_string(depth) + ".speed",
                  speed_at_end<Real>(box, depth), "sqrt(gh)");
}

template <class Real>
void rest_at(Report& report, int depth) {
    const std::string cells = "." + std::to_string(depth);
    for (const double tilt : {0.0, kTilt}) {
        const std::string turned = tilt > 0.0 ? "_turned" : "";
        report_rest<Real>(report, "R4c.v_tank" + turned + cells, depth, [&](int start) {
            const Wedge wedge = v_tank(depth, tilt, shift_of(start));
            return still<Real>(wedge.vessel, depth,
                               [&](double area) { return wedge.apex.y + std::sqrt(area); });
        });
    }
    report_rest<Real>(report, "R4c.box_turned" + cells, depth, [&](int start) {
        const Vessel box = turned_box(depth, kTilt, shift_of(start));
        const double floor = box.middle().y - 0.75 * depth + shift_of(start).y;
        return still<Real>(box, depth,
                           [&](double area) { return floor + area / (1.5 * depth); });
    });
    who_stirs<Real>(report, depth);
}

}  // namespace

void still_water(Report& report, const Effort& effort) {
    at_resolutions(report, effort, {16, 32, 64}, [&](auto zero, int depth) {
        rest_at<decltype(zero)>(report, depth);
    });
}

}  // namespace solids
