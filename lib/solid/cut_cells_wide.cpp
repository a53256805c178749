// Cut cells, eight at a time.
#include "math/eight_lanes.hpp"
#include "solid/wide_cuts.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

const CutLoops cuts_by_eight = kCutLoops<EightLanes>;

}  // namespace weir

#endif
