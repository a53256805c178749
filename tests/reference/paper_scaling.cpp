#include "paper_scaling.hpp"

#include <cmath>

namespace paper {

float Scaling::sound_speed_mps() const {
    return sound_ratio * std::sqrt(gravity_mps2 * depth_m);
}

float Scaling::seconds_per_step() const {
    return cfl * cell_m / sound_speed_mps();
}

void Scaling::apply(FluidConfig& config) const {
    const float dt_s = seconds_per_step();
    config.gravity = {0.0F, -gravity_mps2 * dt_s * dt_s / cell_m};
    config.stiffness = cfl * cfl;
    config.viscosity = kShearShare * cfl;
    config.bulk_viscosity = kBulkShare * cfl;
}

}  // namespace paper
