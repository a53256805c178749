// Cut cells, eight at a time.
#include "math/eight_lanes.hpp"
#include "solid/wide_cuts.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

const CutLoops cuts_by_eight{8,
                             contour_groups<EightLanes>,
                             list_groups<EightLanes>,
                             look_at_eight<EightLanes>,
                             areas_of_group<EightLanes>,
                             shares_of_group<EightLanes>};

}  // namespace weir

#endif
