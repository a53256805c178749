// The contour matrix and what it leaves open of every cell and face (cut cells).
#pragma once

#include "solid/walls.hpp"

namespace weir {

/// Recomputes case, open fractions and full density of all cells that depend on a node of the
/// box. Reads the merged distances. `scratch`: a cell field, overwritten. `thin`: the world has
/// room for thin walls.
/// Cost: about 60 operations a cell of the box.
template <class Real>
void update_cut_cells(const GridShape& shape, const NodeBox& nodes, bool thin,
                      VelocityOf<Real>* scratch, Walls<Real>& walls);

}  // namespace weir
