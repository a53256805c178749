// Lowest and highest of particles' places, four a group of eight lanes.
#include "fluid/extent_lanes.hpp"
#include "math/eight_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

Extent<float> extent_in_wide_lanes(const Vec2<float>* places, std::int32_t count) {
    return extent_in_lanes<EightLanes>(places, count);
}

}  // namespace weir

#endif
