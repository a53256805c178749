// Loops over faces with eight lanes.
#include "step/faces_with.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

const WideFaces faces_by_eight = FacesWith<EightLanes>::kLoops;

}  // namespace weir

#endif
