// Which particles are in cells with solid, eight at a time.
#include "solid/near_wall_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

std::int32_t find_near_wall_wide(const std::uint8_t* cell_case, std::int32_t stride,
                                 const float* position, std::int32_t count, NearWall& found) {
    return find_near_wall<EightLanes>(cell_case, stride, position, count, found);
}

}  // namespace weir

#endif
