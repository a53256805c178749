// R14, variants ii to iv: a column collapses in a vessel and stays in it, with its volume.
#include <cmath>

#include "problems.hpp"
#include "vessel.hpp"

namespace solids {

namespace {

Points slab(Vec a, Vec b) {
    return {{a.x, a.y}, {b.x, a.y}, {b.x, b.y}, {a.x, b.y}};
}

using Place = std::function<bool(Vec)>;

struct Soak {
    Vessel vessel;
    Place room;  ///< where liquid may be, in the vessel's frame
    Vec low;     ///< of the room
    Vec high;
    /// Parts of the room that only meet above the surface: each comes to rest at a level of its own.
    std::vector<Place> basins{[](Vec) { return true; }};
};

/// Closed box turned by 17.3 degrees, walls 3, 2, 1.5 and, where there are thin ones, 1 cell thick:
/// by nodes alone a drop of a jet got through such a lid once.
template <class Real>
Soak turned_box(int n) {
    Soak soak;
    const double lid = kThinWalls<Real> ? 1.0 : 1.5;
    soak.vessel.cells_x = soak.vessel.cells_y = static_cast<int>(1.6 * n) + 8;
    soak.vessel.tilt = 17.3 * M_PI / 180.0;
    soak.vessel.gravity_tilts = false;
    const Vec low = soak.vessel.middle() - Vec{0.5 * n + 0.3, 0.5 * n - 0.2};
    const Vec high = low + Vec{1.0 * n, 1.0 * n};
    soak.vessel.walls = {slab({low.x - 2.0, low.y - 3.0}, {high.x + 1.5, low.y}),
                         slab({low.x - 2.0, low.y - 3.0}, {low.x, high.y + lid}),
                         slab({high.x, low.y - 3.0}, {high.x + 1.5, high.y + lid}),
                         slab({low.x - 2.0, high.y}, {high.x + 1.5, high.y + lid})};
    soak.vessel.wall_edges = kThinWalls<Real> ? 40 * n : 0;
    soak.vessel.liquid = [low, n](Vec p) {
        return p.x > low.x && p.x < low.x + 0.5 * n && p.y > low.y && p.y < low.y + 0.8 * n;
    };
    soak.room = [low, high](Vec p) {
        return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y;
    };
    soak.low = low;
    soak.high = high;
    return soak;
}

/// A cup with walls one cell thick, which nodes alone would put up to a quarter of a cell off, water
/// inside only. It stands on its floor as a lattice does: a tenth of a cell too low is 2 % at 16.
Soak cup(int n) {
    Soak soak;
    soak.vessel.cells_x = soak.vessel.cells_y = 2 * n;
    const Vec low{0.5 * n + 0.3, 0.4 * n + 0.7};
    const Vec high = low + Vec{1.0 * n, 1.0 * n};
    soak.vessel.walls = {{{low.x - 1.0, low.y - 1.0},
                          {high.x + 1.0, low.y - 1.0},
                          {high.x + 1.0, high.y},
                          {high.x, high.y},
                          {high.x, low.y},
                          {low.x, low.y},
                          {low.x, high.y},
                          {low.x - 1.0, high.y}}};
    soak.vessel.wall_edges = 40 * n;
    soak.vessel.lattice = low;
    soak.vessel.liquid = [low, n](Vec p) {
        return p.x > low.x && p.x < low.x + n && p.y > low.y && p.y < low.y + 0.6 * n;
    };
    soak.room = [low, high](Vec p) { return p.x > low.x && p.x < high.x && p.y > low.y; };
    soak.low = low;
    soak.high = high;
    return soak;
}

/// A column over a floor with a 60 degree notch, and a needle one cell wide in its way, which stands
/// out of the liquid at rest: what has splashed over it stays there.
Soak notch_and_needle(int n) {
    Soak soak;
    soak.vessel.cells_x = soak.vessel.cells_y = n;
    const double floor = 0.25 * n + 0.3;
    const double half = (floor - 0.6) * std::tan(M_PI / 6.0);
    const Vec tip{0.35 * n + 0.2, 0.6};
    const double foot = 0.7 * n + 0.4;
    const double top = 0.6 * n;
    soak.vessel.walls = {
        {{-2.0, -2.0}, {tip.x, -2.0}, tip, {tip.x - half, floor}, {-2.0, floor}},
        {{tip.x, -2.0}, {n + 2.0, -2.0}, {n + 2.0, floor}, {tip.x + half, floor}, tip},
        {{foot, floor - 1.0}, {foot + 1.0, floor - 1.0}, {foot + 0.5, top}}};
    soak.vessel.wall_edges = 40 * n;  // for the needle
    soak.room = [=](Vec p) {
        const bool in_notch = std::abs(p.x - tip.x) < (p.y - tip.y) * std::tan(M_PI / 6.0);
        const bool in_needle = p.y < top && std::abs(p.x - foot - 0.5) <
                                                0.5 * (top - p.y) / (top - floor + 1.0);
        return p.x > 0.0 && p.x < n && (p.y > floor || (in_notch && p.y > tip.y)) && !in_needle;
    };
    soak.basins = {[=](Vec p) { return p.x <= foot + 0.5; }, [=](Vec p) { return p.x > foot + 0.5; }};
    soak.vessel.liquid = [room = soak.room, n, tip, half](Vec p) {
        return room(p) && p.x < 0.5 * n && p.y < 0.9 * n;
    };
    soak.low = {0.0, 0.0};
    soak.high = {1.0 * n, 1.0 * n};
    return soak;
}

/// Particles that are off the room by more than half a cell, along the axes: through half of the
/// thinnest wall. (The contour of a wall thinner than two cells is up to a quarter of a cell off.)
template <class Real>
int outside(const Soak& soak, const Pool<Real>& pool) {
    int count = 0;
    for (int k = 0; k < pool.particles(); ++k) {
        const Vec p = pool.position(k);
        constexpr double kNear = 0.5;
        const bool near = soak.room(p) || soak.room({p.x + kNear, p.y}) ||
                          soak.room({p.x - kNear, p.y}) || soak.room({p.x, p.y + kNear}) ||
                          soak.room({p.x, p.y - kNear});
        count += near ? 0 : 1;
    }
    return count;
}

/// Steps at the end that figures are means over: a few periods of what still sways.
constexpr int kMeasured = 300;

/// Sums over particles and steps.
struct Heights {
    double height = 0.0;  ///< less what swaying lifts: in the mean of a period as much as it moves
    std::vector<double> particles;  ///< in each basin
};

template <class Real>
void add_heights(Heights& sums, const Soak& soak, const Pool<Real>& pool, Vec up) {
    const double swaying = pool.rms_speed() * pool.rms_speed() / (2.0 * kGravity);
    sums.particles.resize(soak.basins.size());
    for (int k = 0; k < pool.particles(); ++k) {
        sums.height += weir::dot(pool.position(k), up) - swaying;
        for (std::size_t basin = 0; basin < soak.basins.size(); ++basin) {
            sums.particles[basin] += soak.basins[basin](pool.position(k)) ? 1.0 : 0.0;
        }
    }
}

/// How much higher the liquid stands than what is in each basin does at rest, of its height over the
/// lowest place.
double lift(const Heights& sums, const Soak& soak, int steps, Vec up) {
    double particles = 0.0;
    double height = 0.0;
    for (std::size_t basin = 0; basin < soak.basins.size(); ++basin) {
        const Place part = [&](Vec p) { return soak.room(p) && soak.basins[basin](p); };
        const double here = sums.particles[basin];
        height += here * at_rest(part, 0.25 * here / steps, soak.low, soak.high, up).mean_height;
        particles += here;
    }
    const double bottom = at_rest(soak.room, 0.01, soak.low, soak.high, up).mean_height;
    return (sums.height - height) / (height - particles * bottom);
}

template <class Real>
void run(Report& report, const std::string& name, const Soak& soak, int steps) {
    Pool<Real> pool(soak.vessel);
    const int particles = pool.particles();
    int most_outside = 0;
    const Vec up = soak.vessel.gravity_tilts ? Vec{0.0, 1.0} : soak.vessel.turned_back({0.0, 1.0});
    const int measured = std::min(steps, kMeasured);
    Heights sums;
    for (int step = 0; step < steps; ++step) {
        pool.step();
        if (step % 50 == 0 || step + 1 == steps) {
            most_outside = std::max(most_outside, outside(soak, pool));
        }
        if (step >= steps - measured) {
            add_heights(sums, soak, pool, up);
        }
    }
    report.equals(name + ".outside", most_outside, "1", 0.0);
    report.equals(name + ".lost", particles - pool.particles(), "1", 0.0);
    report.at_most(name + ".volume", 100.0 * std::abs(lift(sums, soak, measured, up)), "%", 1.0);
    report.figure(name + ".speed",
                  pool.rms_speed() / std::sqrt(kGravity * 0.4 * (soak.high.x - soak.low.x)),
                  "sqrt(gh)");
}

template <class Real>
void run_all(Report& report, int steps) {
    for (const int n : {16, 32}) {
        const std::string cells = "." + std::to_string(n);
        const auto in = [&](const std::string& vessel, const Soak& soak) {
            const std::string name = "R14." + vessel + cells;
            rows(report, name, [&] { run<Real>(report, name, soak, steps); });
        };
        in("ii_turned_box", turned_box<Real>(n));
        in("iii_cup", cup(n));
        in("iv_notch_and_needle", notch_and_needle(n));
    }
}

}  // namespace

void vessels_soak(Report& report, const Effort& effort) {
    const int steps = effort.full ? 1000000 : 3000;
    in_scalar(report, effort.real, [&](auto zero) { run_all<decltype(zero)>(report, steps); });
}

}  // namespace solids
