// Liquid poured over one polygon in a tank.
#pragma once

#include "polygon_list.hpp"

namespace solids {

struct PourResult {
    int particles = 0;
    int inside = 0;        ///< deeper in the polygon than kTrappedDepth when all is settled
    int lost = 0;          ///< neither in the tank nor reported as removed
    double deepest = 0.0;  ///< cells
};

/// Deeper than this behind the outline a particle is trapped, cells: the contour of a cell is a
/// line, which cuts corners of the outline by some hundredths of a cell.
inline constexpr double kTrappedDepth = 0.5;

/// A polygon 40 cells wide or high in a tank of 64 × 64 cells, a block of liquid above it, and
/// time to come to rest.
template <class Real>
PourResult pour(const ListedPolygon& polygon);

extern template PourResult pour<float>(const ListedPolygon&);
extern template PourResult pour<double>(const ListedPolygon&);
extern template PourResult pour<weir::Fixed>(const ListedPolygon&);
extern template PourResult pour<weir::SmallFixed>(const ListedPolygon&);

}  // namespace solids
