// Which particles are in cells with solid, and which of them clearly outside it, eight at a time.
#include "math/eight_lanes.hpp"
#include "solid/near_wall_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

std::int32_t find_near_wall_wide(const BlockTask& task, std::int32_t count, NearWall& found) {
    return task.far ? find_near_wall<EightLanes, true>(task, count, found)
                    : find_near_wall<EightLanes, false>(task, count, found);
}

std::uint32_t clear_of_eight_wide(const ClearTask& task, const NearWall& near, std::int32_t next) {
    return clear_of_group<EightLanes>(task, near, next);
}

}  // namespace weir

#endif
