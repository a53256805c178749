// What stands at the head of the caller's memory.
#pragma once

#include "step/simulation.hpp"
#include "weir/world.hpp"

namespace weir::detail {

template <class Real>
struct WorldState {
    Simulation<Real> simulation;
    WorldDef def;
    Face<Real> cells_per_m = Face<Real>(0);
    float stepped_s = 0.0F;        ///< in the last step
    std::uint16_t tag = 0;         ///< this world's own, in the names of its bodies
    std::uint32_t pending = 0;     ///< Clamped bits that the next report shall carry
};
static_assert(sizeof(WorldState<float>) <= kWorldStateBytes<float>, "raise kWorldStateBytes");
static_assert(sizeof(WorldState<Fixed>) <= kWorldStateBytes<Fixed>, "raise kWorldStateBytes");
static_assert(sizeof(WorldState<double>) <= kWorldStateBytes<double>, "raise kWorldStateBytes");

}  // namespace weir::detail
