// Stages between liquid and bodies, in worlds with room for them (`Capacity::two_way`): what
// bodies and tank receive, and free bodies.
#pragma once

#include "step/simulation.hpp"
#include "step/time_step_limit.hpp"
#include "weir/features.hpp"

namespace weir {

/// What a substep does for it; those of bodies are null where there is no room for any.
template <class Real>
struct detail::TwoWay {
    /// At the top (step/momentum_ledger.hpp).
    void (*open_ledger)(Simulation<Real>& simulation, Work work);
    /// After the pressure, where there are no bodies: its impulse on the tank.
    void (*press_tank)(Simulation<Real>& simulation, Seconds<Real> dt_s);
    /// At the end.
    void (*close_ledger)(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work);

    /// Before anything that bodies receive is counted: where they are.
    void (*locate_bodies)(Simulation<Real>& simulation, Work work);
    /// After viscosity, before the pressure: free bodies take up gravity, blows, and what pulled at
    /// them. Viscosity is to meet them without what they fall, as it meets those that are led: it
    /// lets liquid fall past both alike (step/no_slip.cpp).
    void (*accelerate_bodies)(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work);
    /// The pressure solve, as free bodies share in it.
    CoupledSolve<Real> (*coupled_solve)(const Simulation<Real>& simulation, Seconds<Real> dt_s);
    /// After the pressure: its impulse on the tank and on all bodies, and the velocity that free
    /// ones get of it.
    void (*press_bodies)(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work,
                         StepReport& report);
    /// Free bodies go on, before the particles do, which meet them where they then are.
    void (*move_bodies)(Simulation<Real>& simulation, Seconds<Real> dt_s, StepReport& report);
    /// Whoever is added is cut into the pieces by which bodies meet; null in packed worlds, too.
    Decompose<Real> decompose;
    /// Finds what a body weighs. False: nothing, though it is closed.
    bool (*weigh)(const BodyDef& def, const BodyTable<Real>& table, const Body<Real>& body,
                  BodyLoad<Real>& load);
};

/// Before particles are scattered, and what bodies receive of them is counted.
template <bool Solids, class Real>
inline void locate_before(Simulation<Real>& simulation, Work work) {
    if (Solids && simulation.two_way != nullptr) {
        simulation.two_way->locate_bodies(simulation, work);
    }
}

/// Free bodies take up what they fell and received since the last substep.
template <class Real>
inline void accelerate_free(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work) {
    if (simulation.free_bodies != nullptr) {
        simulation.two_way->accelerate_bodies(simulation, dt_s, work);
    }
}

/// Free bodies move, as the pressure has left them.
template <class Real>
inline void move_free(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work,
                      StepReport& report) {
    if (work.once(simulation.bodies.vertices_used + 1)) {
        const std::int32_t before = report.nodes_rasterized;
        simulation.two_way->move_bodies(simulation, dt_s, report);
        work.spend(report.nodes_rasterized - before);
    }
}

}  // namespace weir
