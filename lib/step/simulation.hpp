// Everything that a substep reads and writes: views into the caller's memory.
#pragma once

#include "fluid/particles.hpp"
#include "pressure/domain.hpp"
#include "solid/contacts.hpp"
#include "solid/free_body.hpp"
#include "solid/layers.hpp"
#include "step/fall.hpp"
#include "step/settings.hpp"
#include "weir/features.hpp"
#include "weir/report.hpp"

namespace weir {

/// What differs in a world with bodies (step/substep.hpp).
template <class Real>
struct Stages;

template <class Real>
struct Regions;

/// Room for a part of the tank.
template <class Real, bool Has = kHasWindow<Real>>
struct Window {
    std::int32_t cells = 0;   ///< how many entries there is room for; 0: for all of it
    std::int32_t beyond = 0;  ///< particles that a substep leaves out: they stand before the pool
};
template <class Real>
struct Window<Real, false> {
    static constexpr std::int32_t cells = 0;
    static constexpr std::int32_t beyond = 0;
};

/// How far a look through the tank is (step/part_met.hpp).
template <class Real, bool Looks = Stored<Real>::coarse>
struct Look {};
template <class Real>
struct Look<Real, true> {
    std::uint32_t substeps_left = 0;
};

/// Packed worlds have none.
template <class Real>
inline constexpr bool kHasFreeBodies = !Stored<Real>::shares_momentum;
/// A pointer to what they do without.
template <class Real, class T>
using OfRoomy = std::conditional_t<Stored<Real>::shares_momentum, Never<T>, T*>;

template <class Real>
struct Simulation {
    Settings<Real> settings;
    Particles<Real> particles;
    StaggeredGrid<Real> grid;  ///< between substeps of the whole tank
    SmallShape occupied;       ///< what the last substep worked on
    WEIR_NO_UNIQUE_ADDRESS Window<Real> window;
    PressureFields<Real> pressure;
    BodyTable<Real> bodies;
    Layers<Real> layers;
    Seconds<Real> walls_behind_s{};  ///< moving bodies were held for so long in the last step
    Seconds<Real> walls_moved_s{};   ///< and moved on for so long in this substep
    WEIR_NO_UNIQUE_ADDRESS OfRoomy<Real, const FreeBodyStages<Real>> free_bodies =
        nullptr;  ///< null: there was none yet
    WEIR_NO_UNIQUE_ADDRESS OfRoomy<Real, Real> body_diagonal = nullptr;  ///< a cell field
    Contacts<Real> contacts;
    std::int32_t gathered = 0;  ///< particles to be moved in this substep
    WEIR_NO_UNIQUE_ADDRESS Fall<Real> fall;  ///< empty where velocities are no units
    WEIR_NO_UNIQUE_ADDRESS Look<Real> look;  ///< for particles that have met, in packed worlds
    Extent<Real> extent;       ///< of all particles
    Real max_speed = Real(0);  ///< largest speed of a particle along an axis, cells/s
    TickFunction ticks = nullptr;
    const Stages<Real>* stages = nullptr;
    Regions<Real>* regions = nullptr;  ///< null: the world sleeps as a whole (step/regions.hpp)
    // Null: the definition does without.
    WEIR_NO_UNIQUE_ADDRESS OfRoomy<Real, const detail::MassMatrix<Real>> mass_matrix = nullptr;
    const detail::RowOrder<Real>* row_order = nullptr;
    const detail::Tension<Real>* tension = nullptr;
    const detail::TwoWay<Real>* two_way = nullptr;
    const detail::Viscosity<Real>* viscosity = nullptr;
};

template <class Real>
Domain<Real> domain_of(Simulation<Real>& simulation) {
    return {simulation.grid, simulation.pressure, simulation.settings.borders,
            simulation.layers.walls, simulation.settings.pulls_sideways()};
}

template <class Real>
GridShape stored_part(const Simulation<Real>& simulation) {
    return stored_part(simulation.layers.walls, simulation.layers.shape);
}

}  // namespace weir
