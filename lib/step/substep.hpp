// One substep, from particles back to particles.
#pragma once

#include "pressure/slivers.hpp"
#include "step/time_step_limit.hpp"
#include "weir/features.hpp"

namespace weir {

/// What differs in a world with room for bodies: one without links no code for solids.
template <class Real>
struct Stages {
    /// Advances everything by plan.dt_s, or does as much of it as the work allows. Adds counts and
    /// ticks to the report.
    void (*substep)(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                    StepReport& report);
    /// Null: none can.
    void (*move_bodies)(BodyTable<Real>& table, Walls<Real>& walls, Seconds<Real> dt_s);
    /// Between steps. Null: none can.
    void (*note_moving)(const BodyTable<Real>& table, Walls<Real>& walls);
    bool (*inside_solid)(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> point);
    Vec2<Real> (*centre_seen)(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> place);
    /// Draws the bodies that were put elsewhere since the last step: somebody looks at them.
    std::int32_t (*draw_moved)(Layers<Real>& layers, BodyTable<Real>& table);
    /// The most nodes that this can be in a substep (solid/layers.hpp).
    std::int32_t (*most_moved)(const Layers<Real>& layers, const BodyTable<Real>& table);
    /// Draws all bodies, if any: the world is new, or another part of the tank is stored.
    std::int32_t (*draw_stored)(Layers<Real>& layers, const BodyTable<Real>& table);
    EmptySlivers<Real> empty_slivers;
    /// At the end of a step, if bodies can move; the next one if there are any.
    void (*end_leads)(BodyTable<Real>& table, bool held);
    /// At the beginning of one after a step that held them, or null.
    void (*slow_leads)(BodyTable<Real>& table, Face<Real> share);
};

}  // namespace weir
