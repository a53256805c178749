// Numbers of the bodies that are nearest to some places, one a lane.
#pragma once

#include <cstddef>

#include "math/four_lanes.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

template <class L>
struct NearestBodies {
    const float* body;
    typename L::Ints at;   ///< of the body, in numbers of 32 bits
    typename L::Ints any;  ///< a body is near

    NearestBodies(const Walls<float>& walls, typename L::Ints slot)
        : body(&walls.body->position.x), any(slot != static_cast<std::int32_t>(kNoBody)) {
        at = (any ? slot : typename L::Ints{}) * static_cast<std::int32_t>(sizeof(Body<float>) / 4);
    }

    /// One of a body's numbers.
    typename L::Floats number(std::size_t bytes_from_first) const {
        return L::numbers_at(body + bytes_from_first / sizeof(float), at);
    }
};
static_assert(sizeof(Body<float>) % sizeof(float) == 0 && offsetof(Body<float>, position) == 0);

#endif

}  // namespace weir
