// What the liquid holds, on demand: for tests, tuning and curiosity, never needed by a step.
#pragma once

#include <cstdint>

#include "weir/types.hpp"

namespace weir {

/// Sums over all particles, in double. Per unit of the first liquid's density and of depth into the
/// page: multiply by ρ for kg/m and so on. A particle's share is cell² / particles_per_cell.
struct Diagnostics {
    double mass_m2 = 0.0;                   ///< particles × share, by density
    Vec2<double> momentum_m3ps;             ///< Σ share · v
    double angular_momentum_m4ps = 0.0;     ///< Σ share · x × v about the tank's lower left corner
    double kinetic_energy_m4ps2 = 0.0;      ///< Σ share · |v|² / 2
    /// −Σ share · g · x, half a step ago: positions and velocities leapfrog, and the velocities
    /// belong to that time.
    double potential_energy_m4ps2 = 0.0;
    double volume_m2 = 0.0;       ///< area that is filled: cells count as far as they are full
    double largest_density = 0.0;  ///< of any cell; 1 = at rest
    /// Largest |∇·u| of the velocity that the particles carry over the cells that hold liquid, 1/s.
    double divergence_per_s = 0.0;
};

/// What of the liquid is in a box (`World::liquid_in`).
struct LiquidIn {
    std::int32_t particles = 0;
    float area_m2 = 0.0F;  ///< that it fills at rest: particles × cell² / particles_per_cell
    Vec2f centroid_m;      ///< mean place; 0 if there is none
    Vec2f velocity_mps;    ///< mean, as from the last step; 0 if there is none
};

}  // namespace weir
