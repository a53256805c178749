// Free bodies: solids that gravity and the liquid move.
//
// The pressure solve knows their masses: a body's velocity is an unknown of the solve beside the
// pressures, so that a body far lighter than the liquid that it has to push away is as stable as a
// heavy one. All of it is reached through FreeBodyStages, which are null until the first free body
// is added: a program that adds none does not link this file.
#pragma once

#include "base/work.hpp"
#include "solid/body_force.hpp"
#include "solid/obstacles.hpp"

namespace weir {

template <class Real>
struct FreeBodyStages;

/// The pressure solve as the coupling sees it.
template <class Real>
struct CoupledSolve {
    const FreeBodyStages<Real>* stages;
    const GridShape& shape;
    const Walls<Real>& walls;
    const VelocityOf<Real>* light_u;  ///< inverse densities, null: one liquid
    const VelocityOf<Real>* light_v;
    PressedCells<Real> cells;
    Obstacles<Real> obstacles;
    Real* pressure;
    VelocityOf<Real>* divergence;        ///< with the bodies' velocities before the pressure
    VelocityOf<Real>* inverse_diagonal;  ///< 0 where a free body presses: those cells are ours
    Real* diagonal;  ///< of those cells, 0 elsewhere; valid in the bodies' rectangles
};

template <class Real>
struct FreeBodyStages {
    /// The most that `accelerate` can cost, and all rounds of `stop` in a substep: of those points
    /// that there are, or of all that there is room for.
    std::int32_t (*most_looks)(const BodyTable<Real>&);
    std::int32_t (*rounds)(const BodyTable<Real>&, std::int32_t half_sweeps, std::int32_t cycles,
                           bool most);
    /// Before the pressure: gravity and blows give them a velocity, and what they meet as if there
    /// were no liquid. Returns the cost.
    std::int32_t (*accelerate)(const Obstacles<Real>&, BodyTable<Real>&);
    /// Begin of a cycle: the divergence takes in what the pressure makes of the bodies.
    void (*begin)(const CoupledSolve<Real>&);
    /// After the coarse correction: takes that back, and answers with the work that the bodies'
    /// yielding to the correction costs, ½ of which is their kinetic energy.
    Face<Real> (*yielding)(const CoupledSolve<Real>&);
    /// Takes the cells on which free bodies press out of the sweeps that follow;
    void (*set_aside)(const CoupledSolve<Real>&);
    /// relaxes them, after each half sweep over the others of a colour;
    void (*relax)(const CoupledSolve<Real>&, Real omega, std::int32_t colour);
    /// and gives them back.
    void (*end)(const CoupledSolve<Real>&);
    /// After the pressure: the velocity that came of it and of what stops them. Returns how many
    /// were too fast for a substep and were slowed.
    std::int32_t (*finish)(const Obstacles<Real>&, const PressedCells<Real>&, BodyTable<Real>&,
                           Contacts<Real>&);
    /// Moves them with it, and apart if they are in something; none of them leaves the tank.
    /// Returns how many were held back: their way was too long for a substep, or led nowhere.
    std::int32_t (*move)(const Obstacles<Real>&, BodyTable<Real>&, Seconds<Real> dt_s);
};

/// The stages of free_body.cpp.
template <class Real>
const FreeBodyStages<Real>& free_body_stages();

}  // namespace weir
