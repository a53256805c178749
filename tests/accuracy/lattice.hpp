// The three lattices on which every problem starts: a grid flatters the one aligned with it.
#pragma once

#include <functional>

#include "scheme.hpp"

namespace accuracy {

enum class Lattice {
    aligned,  ///< 2×2 in each cell, at 1/4 and 3/4
    shifted,  ///< moved by a fixed, arbitrary part of a cell
    rotated,  ///< turned by 17.3 degrees about an arbitrary point
};
inline constexpr Lattice kLattices[] = {Lattice::aligned, Lattice::shifted, Lattice::rotated};
const char* lattice_name(Lattice lattice);

inline constexpr double kPerCell = 4.0;    ///< particles in a full cell
inline constexpr double kSpacing = 0.5;    ///< between neighbours, cells
inline constexpr double kWallGap = 0.02;   ///< least distance from a wall that is asked for, cells

using Region = std::function<bool(Vector)>;

/// Lattice points of [low, high] that lie in the region, at rest.
Particles seed(Lattice lattice, Vector low, Vector high, const Region& region);

/// The whole box.
Particles seed_box(Lattice lattice, Vector low, Vector high);

/// A disc. Its centre of mass is not quite its centre: take that of the particles.
Particles seed_disc(Lattice lattice, Vector centre, double radius);

}  // namespace accuracy
