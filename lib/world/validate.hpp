// The checks of set-up calls. Each answers with the first rule that is broken; none changes
// anything.
#pragma once

#include "math/scalar.hpp"
#include "weir/config.hpp"
#include "weir/status.hpp"

namespace weir {

Status check_capacity(const Capacity& capacity);
Status check_world(const WorldDef& def);
Status check_memory(const void* memory, std::size_t bytes, std::size_t needed);
Status check_motion(const Motion& motion, float cell_m);
Status check_body(const BodyDef& def, float cell_m);
Status check_box(const Box& box, float width_m, float height_m);
/// False for NaN.
template <class T>
constexpr bool within(T value, SameAs<T> low, SameAs<T> high) {
    return low <= value && value <= high;
}

}  // namespace weir
