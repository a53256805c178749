// Skip: the stages of the grid work on the part of the tank that particles can reach, a rectangle.
// Its cells are stored where they are in the whole: loops begin later and end earlier, and what
// they would have found beyond is empty.
#pragma once

#include "fluid/particles.hpp"
#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Rows above the row of the highest particle and below that of the lowest one: one that its mass
/// reaches, one that velocity is extrapolated to, and what stencils of smoothing and mirroring look
/// at beyond. Columns on either side likewise.
inline constexpr std::int32_t kMargin = 4;
/// Above and to the right in packed worlds: liquid that a mirror's place is beside is no further up
/// than the row that mass reaches, and its stencil begins a row beyond that place.
inline constexpr std::int32_t kMarginPacked = 3;

/// Cost: 4 comparisons a particle, of which there is at least one. From so many columns on it does
/// not matter how far they reach.
template <class Real>
Extent<Real> extent_of(const Particles<Real>& particles,
                       std::int32_t columns = kMaxCellsFixed);

/// The part of the tank that this substep needs. Along a seam it is always the whole tank;
/// `from_corner`: it begins in the lower left corner whatever is empty there.
template <class Real>
GridShape occupied_part(const GridShape& tank, const Borders<Real>& borders,
                        const Extent<Real>& extent, bool from_corner);

/// Whether a solid has to do with that part: if not, the stages need not know that there are any.
/// Whoever counts what bodies receive always has. Cost: a comparison a body.
template <class Real>
bool walls_reach(const GridShape& part, const BodyTable<Real>& bodies);

/// Empties the cells that the last substep's part had and this one's has not: pressure, density
/// and level are what a cell without liquid has.
template <class Real>
void empty_beyond(const GridShape& tank, const GridShape& last, const GridShape& now,
                  PressureFields<Real>& fields, Work work);

}  // namespace weir
