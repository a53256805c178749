// Loops with fewer lanes than the processor has.
#pragma once

#include "math/wide_lanes.hpp"

namespace weir {

/// With no more than so many lanes, until it ends. 0: with all of them.
class Fewer {
public:
    explicit Fewer(std::int32_t lanes) { set(lanes); }
    ~Fewer() { set(0); }
    Fewer(const Fewer&) = delete;
    Fewer& operator=(const Fewer&) = delete;

private:
    static void set([[maybe_unused]] std::int32_t lanes) {
        if constexpr (kMostLanes > 4) {
            lanes_known = lanes;
        }
    }
};

}  // namespace weir
