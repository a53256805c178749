// Loops over cut cells with as many lanes as the processor has.
#pragma once

#include "solid/cut_cells_lanes.hpp"
#include "solid/open_moments_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As the loops in `..._lanes.hpp` that have their names.
struct CutLoops {
    std::int32_t lanes;
    std::int32_t (*contour)(const CutTask& task, std::int32_t c, std::int32_t end);
    std::int32_t (*list)(const CutRow& row, std::int32_t i, std::int32_t i1, CutList& list);
    AroundEight (*look_at_eight)(const CutTask& task, const AroundTask& around, std::int32_t c);
    void (*areas)(const CutTask& task, const std::int32_t* cell, float* area);
    void (*shares)(const float* distance, std::int32_t stride, const std::int32_t* cell,
                   RowsOfShares* shares);
};

template <class L>
inline constexpr CutLoops kCutLoops{L::kLanes, contour_groups<L>, list_groups<L>,
                                    look_at_eight<L>, areas_of_group<L>, shares_of_group<L>};

#if WEIR_HAS_WIDE_LANES
extern const CutLoops cuts_by_eight;
#endif

inline const CutLoops& cut_loops() {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        return cuts_by_eight;
    }
#endif
    return kCutLoops<FourLanes>;
}

#endif

}  // namespace weir
