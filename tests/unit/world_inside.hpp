// What is inside a world, for tests of its parts.
#pragma once

#include "test_world.hpp"
#include "world/world_state.hpp"

namespace weir {

template <class Real>
detail::WorldState<Real>& state_of(TestWorld<Real>& world) {
    return *reinterpret_cast<detail::WorldState<Real>*>(world.memory());
}

}  // namespace weir
