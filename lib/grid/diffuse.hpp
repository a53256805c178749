// A five-point Laplacian on the faces that hold liquid.
#pragma once

#include "grid/staggered_grid.hpp"

namespace weir {

/// out = field + amount ∇²field on one component's faces. `back`: from a face to the cell before
/// it (1 for u, stride for v); `first_i`, `first_j`: the first face that is no wall. A face counts
/// if both its cells have seen a particle; one that does not exerts nothing. Ghost lines of the
/// field have been extended, of the level mirrored. `out` keeps its value where no liquid is.
template <class Real>
void diffuse(const GridShape& shape, const LevelOf<Real>* level, std::int32_t back,
             std::int32_t first_i, std::int32_t first_j, Real amount, const VelocityOf<Real>* field,
             VelocityOf<Real>* out);

}  // namespace weir
