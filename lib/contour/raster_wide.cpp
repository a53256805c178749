// Nodes of a rectangle, eight at a time.
#include "contour/raster_lanes.hpp"
#include "math/eight_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

const RasterLoops raster_by_eight{8, prepare_edges<EightLanes>, measure_nodes<EightLanes>,
                                  turn_nodes<EightLanes>, merge_nodes<EightLanes>};

}  // namespace weir

#endif
