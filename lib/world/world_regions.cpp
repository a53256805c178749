// Regions that sleep: only a program that asks for them links what they take.
#include <new>

#include "step/regions.hpp"
#include "weir/world.hpp"
#include "world/sleep.hpp"

namespace weir {

template <class Real>
Status World<Real>::let_regions_sleep() {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    const WorldDef& def = state_->def;
    if (!def.capacity.sleeping_regions || !may_sleep(*state_)) {
        return Status::regions_missing;
    }
    Simulation<Real>& simulation = state_->simulation;
    if (simulation.regions != nullptr) {
        return Status::ok;
    }
    const Layout plan = layout<Real>(def.capacity);
    const auto at = [&](Block block) {
        return reinterpret_cast<std::byte*>(state_) + plan.offset[static_cast<std::int32_t>(block)];
    };
    auto* regions = new (at(Block::regions)) Regions<Real>();
    regions->stages = &region_stages<Real>();
    regions->tiles_x = coarse_cells(def.capacity.cells_x);
    regions->tiles_y = coarse_cells(def.capacity.cells_y);
    regions->tile = reinterpret_cast<std::uint8_t*>(at(Block::region_tile));
    regions->pressure = reinterpret_cast<Real*>(at(Block::kept_pressure));
    regions->density = reinterpret_cast<DensityOf<Real>*>(at(Block::kept_density));
    regions->speed = resting_speed(*state_);
    regions->after_s = def.sleep.after_s * units_per_s(*state_);
    simulation.regions = regions;
    return Status::ok;
}

#define WEIR_INSTANTIATE(Real) template Status World<Real>::let_regions_sleep();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
