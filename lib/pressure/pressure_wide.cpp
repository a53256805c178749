// Loops over cells with eight lanes.
#include "pressure/cells_with.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

const WideCells cells_by_eight = CellsWith<EightLanes>::kLoops;

}  // namespace weir

#endif
