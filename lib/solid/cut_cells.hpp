// The contour matrix and what it leaves open of every cell and face (cut cells).
#pragma once

#include "solid/walls.hpp"

namespace weir {

/// Recomputes case, open fractions and full density of all cells that depend on a node of the
/// box. Reads the merged distances. `scratch`: a cell field, overwritten. `thin`: the world has
/// room for thin walls.
/// `rim`: of a part of the tank, columns on the left and rows below of which full density is not
/// asked for, since their neighbours are unknown.
/// Cost: about 60 operations a cell of the box.
struct Rim {
    std::int32_t left = 0;
    std::int32_t below = 0;
};
template <class Real>
void update_cut_cells(const GridShape& shape, const NodeBox& nodes, const Rim& rim, bool thin,
                      VelocityOf<Real>* scratch, Walls<Real>& walls);

}  // namespace weir
