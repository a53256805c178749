// Loops over faces with sixteen lanes.
#include "math/sixteen_lanes.hpp"
#include "step/faces_with.hpp"

#if WEIR_HAS_WIDEST_LANES

namespace weir {

const WideFaces faces_by_sixteen = FacesWith<SixteenLanes>::kLoops;

}  // namespace weir

#endif
