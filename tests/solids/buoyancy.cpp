// R4d: the force of still water on a submerged polygon, ρ g A upwards, summed over the closed parts
// of the cells' faces.
#include <cmath>

#include "contour/marching_squares.hpp"
#include "problems.hpp"
#include "vessel.hpp"

namespace solids {

namespace {

/// Pressure times what of each cell's outline is wall, cells³/s² times density.
template <class Real>
Vec force_on_solids(const Pool<Real>& pool, Vec low, Vec high) {
    const auto field = pool.world().signed_distance();
    const auto at = [&](int i, int j) { return static_cast<float>(field.at(i, j)); };
    // As the library has it: cells with less than 2 % of room are closed all around.
    const auto room = [&](int i, int j) {
        const float corner[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        return weir::open_area(corner) >= 0.02F;
    };
    const auto open_u = [&](int i, int j) {
        return room(i - 1, j) && room(i, j)
                   ? static_cast<double>(weir::open_fraction(at(i, j), at(i, j + 1)))
                   : 0.0;
    };
    const auto open_v = [&](int i, int j) {
        return room(i, j - 1) && room(i, j)
                   ? static_cast<double>(weir::open_fraction(at(i, j), at(i + 1, j)))
                   : 0.0;
    };
    Vec force;
    for (int j = static_cast<int>(low.y); j < static_cast<int>(high.y); ++j) {
        for (int i = static_cast<int>(low.x); i < static_cast<int>(high.x); ++i) {
            const double p = pool.pressure(i, j);
            force.x += p * (open_u(i, j) - open_u(i + 1, j));
            force.y += p * (open_v(i, j) - open_v(i, j + 1));
        }
    }
    return force;
}

double area_of(const Points& ring) {
    double twice = 0.0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        twice += weir::cross(ring[k], ring[(k + 1) % ring.size()]);
    }
    return 0.5 * twice;
}

/// Of the buoyancy, worst of upward and sideways.
template <class Real>
double force_error(int depth, int corners, double size, double angle) {
    Vessel vessel;
    vessel.cells_x = 2 * depth;
    vessel.cells_y = depth + depth / 2;
    const Vec centre{depth + 0.37, 0.5 * depth + 0.21};
    const Points ring = regular_polygon(corners, size / (2.0 * std::sin(M_PI / corners)), centre,
                                        angle + M_PI / corners);
    vessel.walls = {ring};
    vessel.liquid = [depth](Vec p) { return p.y < depth; };
    Pool<Real> pool(vessel);
    pool.run(300);
    Vec force;
    constexpr int kMean = 60;
    for (int k = 0; k < kMean; ++k) {
        pool.step();
        force = force + (1.0 / kMean) * force_on_solids(pool, {centre.x - 2.0 * size, centre.y - 2.0 * size},
                                                        {centre.x + 2.0 * size, centre.y + 2.0 * size});
    }
    const double buoyancy = kGravity * area_of(ring);
    return std::max(std::abs(force.y / buoyancy - 1.0), std::abs(force.x / buoyancy));
}

template <class Real>
void submerged(Report& report, int depth) {
    constexpr double kDegree = M_PI / 180.0;
    double worst = 0.0;
    for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
        worst = std::max(worst, force_error<Real>(depth, 4, 0.25 * depth, degrees * kDegree));
    }
    worst = std::max(worst, force_error<Real>(depth, 3, 0.25 * depth, 0.1));
    worst = std::max(worst, force_error<Real>(depth, 8, 0.125 * depth, 0.1));
    accurate<Real>(report, "R4d.force." + std::to_string(depth), 100.0 * worst, "%",
                   depth == 16 ? 3.0 : (depth == 32 ? 1.5 : 0.75));
}

}  // namespace

void buoyancy(Report& report, const Effort& effort) {
    at_resolutions(report, effort, {16, 32, 64}, [&](auto zero, int depth) {
        submerged<decltype(zero)>(report, depth);
    });
}

}  // namespace solids
