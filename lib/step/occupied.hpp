// Skip: the stages of the grid work on the part of the tank that particles can reach, from its
// lower left corner on. A grid of fewer columns and rows is numbered as the whole one is: loops
// end earlier, and what they would have found beyond is empty.
#pragma once

#include "fluid/particles.hpp"
#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// The larger of what is known so far and of the particles' places, along either axis.
/// Cost: 2 comparisons a particle.
template <class Real>
Vec2<PositionOf<Real>> furthest_of(const Particles<Real>& particles,
                                   Vec2<PositionOf<Real>> so_far);

/// The part of the tank that this substep needs. Along a seam it is always the whole tank.
template <class Real>
GridShape occupied_part(const GridShape& tank, const Borders<Real>& borders,
                        Vec2<PositionOf<Real>> furthest);

/// Whether a solid has to do with that part: if not, the stages need not know that there are any.
/// Thin walls, and whoever counts what bodies receive, always have. Cost: a comparison a body.
template <class Real>
bool walls_reach(const GridShape& part, const BodyTable<Real>& bodies, const Walls<Real>& walls);

/// Empties the cells that the last substep's part had and this one's has not: pressure, density
/// and level are what a cell without liquid has.
template <class Real>
void empty_beyond(const GridShape& tank, const GridShape& last, const GridShape& now,
                  PressureFields<Real>& fields, Work work);

}  // namespace weir
