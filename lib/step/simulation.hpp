// Everything that a substep reads and writes: views into the caller's memory.
#pragma once

#include "fluid/particles.hpp"
#include "grid/staggered_grid.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/contacts.hpp"
#include "solid/free_body.hpp"
#include "solid/layers.hpp"
#include "step/settings.hpp"
#include "weir/report.hpp"

namespace weir {

/// What differs in a world with bodies (step/substep.hpp).
template <class Real>
struct Stages;

template <class Real>
struct Simulation {
    Settings<Real> settings;
    Particles<Real> particles;
    StaggeredGrid<Real> grid;  ///< between substeps of the whole tank
    GridShape occupied;        ///< what the last substep worked on
    PressureFields<Real> pressure;
    BodyTable<Real> bodies;
    Layers<Real> layers;
    const FreeBodyStages<Real>* free_bodies = nullptr;  ///< null: there was none yet
    Real* body_diagonal = nullptr;                      ///< for them, a cell field
    Contacts<Real> contacts;
    std::int32_t gathered = 0;  ///< particles to be moved in this substep
    Extent<Real> extent;       ///< of all particles
    Real max_speed = Real(0);  ///< largest speed of a particle along an axis, cells/s
    TickFunction ticks = nullptr;
    const Stages<Real>* stages = nullptr;
};

}  // namespace weir
