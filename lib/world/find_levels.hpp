// Between steps: what a substep's first stages find out about the liquid as it stands.
#pragma once

#include "pressure/surface_level.hpp"
#include "step/particle_to_grid.hpp"
#include "step/substep.hpp"

namespace weir {

template <class Real>
void scatter_all(Simulation<Real>& simulation) {
    const Settings<Real>& settings = simulation.settings;
    particle_to_grid<Real>(simulation.particles, settings.borders, settings.second_density,
                           simulation.grid, simulation.layers.walls.thin);
}

/// Density and level, from mass on faces.
template <class Real>
void find_levels(Simulation<Real>& simulation) {
    surface_level(domain_of(simulation), simulation.settings.rest_count,
                  simulation.stages->empty_slivers);
}

}  // namespace weir
