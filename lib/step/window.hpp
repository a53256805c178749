// Window: of a huge tank only a rectangle of cells around the liquid is stored. Cells keep the
// tank's numbers, so that no stage knows of it: rows are as long as the window's, and pointers
// stand before their arrays by the number of the first cell that is stored.
#pragma once

#include "step/occupied.hpp"
#include "step/simulation.hpp"
#include "step/time_step_limit.hpp"

namespace weir {

/// The window that a particle anywhere wants, in the tank's corner.
inline GridShape least_window(const Capacity& capacity, bool seam_x, bool seam_y) {
    const auto least = [](std::int32_t cells, std::int32_t at_once, bool seam) {
        return seam ? cells : minimum(cells, 2 * at_once);
    };
    const std::int32_t nx = least(capacity.cells_x, kWindowColumns, seam_x);
    const std::int32_t ny = least(capacity.cells_y, kWindowRows, seam_y);
    // Among solids one more row is wanted than two groups have.
    const std::int32_t more = capacity.bodies > 0 ? kWindowRows : 0;
    return {nx, minimum(capacity.cells_y, ny + more), nx + 2};
}

/// From now on the arrays hold that window, whatever is in them.
template <class Real>
void number_cells(const GridShape& window, Simulation<Real>& simulation);

/// Whether there is a window that fits and holds that part of the tank.
template <class Real>
bool fits_window(const Simulation<Real>& simulation, const GridShape& part);

/// Whether a window can be that part of the tank: a snapshot says so.
template <class Real>
bool is_window(const Simulation<Real>& simulation, const GridShape& part);

/// Leaves out the particles that are too far from the others for a window, until
/// `show_beyond`: the tank's sides with the fewest of them. They come to stand before the pool.
/// Returns the part of the tank that the others need. Cost: three looks at each particle.
template <class Real>
GridShape hide_beyond(Simulation<Real>& simulation);
template <class Real>
void show_beyond(Simulation<Real>& simulation);

/// Has the window hold that part, which fits: where it has to move, the last pressure is carried
/// along, the solids are drawn there, and all else is empty. Returns the cost.
template <class Real>
std::int32_t move_window(const GridShape& part, Simulation<Real>& simulation);

/// Gives the grid the part that the particles are in now, as a substep does, and loses no pressure
/// of the last one, nor densities if they are shown. False: there is no room for that, and nothing
/// was done.
template <class Real>
bool look_around(Simulation<Real>& simulation, bool densities_are_shown);

}  // namespace weir
