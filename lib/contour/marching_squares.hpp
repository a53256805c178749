// Marching squares: the contour of one cell from the signed distances at its four nodes, and what
// it leaves open. Nodes are numbered 0 = (0,0), 1 = (1,0), 2 = (1,1), 3 = (0,1) in the cell's own
// unit square; distances are in cells, negative inside solids, finite.
//
// A node at distance exactly 0 counts as inside. So a wall that lies exactly on grid nodes has
// its contour line exactly there, on the rim of the cells on its liquid side; the cell faces along
// it are closed; and a solid one cell thick, all of whose nodes are at 0, is not lost.
//
// The paper's binary contour is the same code fed with -½ (inside) and +½ (outside).
#pragma once

#include <cstdint>

#include "math/vec2.hpp"

namespace weir {

/// A piece of contour within a cell. From → to has the solid on its right, the liquid on its left.
template <class Real>
struct ContourLine {
    Vec2<Real> from;
    Vec2<Real> to;
    Vec2<Real> normal;  ///< unit, points into the liquid; sound also where from = to
};

/// The contour of a cell. A point of the cell is solid if it is behind every line (both_needed)
/// or behind any line (else). Thus a cell without lines is all solid, or all open.
template <class Real>
struct ContourCell {
    ContourLine<Real> line[2];
    std::int32_t lines = 0;    ///< 0, 1, or 2 for a saddle
    bool both_needed = false;  ///< a saddle whose solids are joined, or a cell full of solid
};

/// Bit k is set if node k is inside: 0 (open) … 15 (solid).
template <class Real>
std::uint8_t contour_case(const Real distance[4]);

/// The lines of all 16 cases. Crossings are where the distance, linear along a cell edge, is
/// zero; neighbouring cells get the same bits for the edge they share. In a saddle (cases 5 and
/// 10) solids are joined if the four distances sum to ≤ 0, so that nothing slips between them.
template <class Real>
ContourCell<Real> contour_cell(const Real distance[4]);

/// Where a point stands to the contour of its cell.
template <class Real>
struct ContourHit {
    Real distance;      ///< cells, negative in the solid; -1 or 1 if the cell has no line
    Vec2<Real> normal;  ///< of the line to leave by; zero if the cell has none
};

/// @param p in the cell's unit square.
template <class Real>
ContourHit<Real> contour_hit(const Real distance[4], Vec2<Real> p);

/// Open part of a cell edge, 0 … 1, from the distances at its two nodes: 1 if both are outside, 0
/// if both are inside, else φ⁺ / (φ⁺ − φ⁻) (Ng, Min & Gibou 2009, "An efficient fluid-solid
/// coupling algorithm for single-phase flows").
template <class Real>
Real open_fraction(Real distance_0, Real distance_1);

/// Area of the liquid in the unit cell that the contour lines leave, 0 … 1.
template <class Real>
Real open_area(const Real distance[4]);

/// Integrals over the liquid in the unit cell, about its centre.
template <class Real>
struct OpenMoments {
    Real area = Real(0);
    Vec2<Real> first;   ///< ∫ x, ∫ y
    Vec2<Real> upper;   ///< ∫ x⁺, ∫ y⁺, where x⁺ is x to the right of the centre and 0 to its left
    Real x_above = Real(0);  ///< ∫ x y⁺
    Real y_right = Real(0);  ///< ∫ x⁺ y
    Real product = Real(0);  ///< ∫ x y
};

/// Exact for the contour lines, to rounding.
template <class Real>
OpenMoments<Real> open_moments(const Real distance[4]);

}  // namespace weir
