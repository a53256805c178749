// Loops over cells with sixteen lanes.
#include "math/sixteen_lanes.hpp"
#include "pressure/cells_with.hpp"

#if WEIR_HAS_WIDEST_LANES

namespace weir {

const WideCells cells_by_sixteen = CellsWith<SixteenLanes>::kLoops;

}  // namespace weir

#endif
