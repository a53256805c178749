// What a step costs at most: its own walk, told that the tank is full, adds up what it would do.
// So the bound cannot differ from the code. Nothing of the world is written: a walk that is given
// no work does none, which is what steps in slices rest on.
#include "pressure/projection.hpp"
#include "step/ladder.hpp"
#include "step/substep.hpp"
#include "step/viscosity.hpp"
#include "world/sleep.hpp"
#include "world/step_input.hpp"
#include "world/world_state.hpp"

namespace weir {

namespace {

/// Whatever a state decides about how much there is to be done, at its most, if the cells that are
/// stored have that shape.
template <class Real>
void fill_up(const GridShape& stored, Simulation<Real>& simulation) {
    simulation.particles.count = simulation.particles.capacity;
    simulation.gathered = simulation.particles.capacity;
    simulation.grid.shape = stored;
    simulation.occupied = stored;
    if constexpr (kHasWindow<Real>) {
        simulation.layers.walls.stored.at = stored;
    }
    PressureFields<Real>& fields = simulation.pressure;
    CoarseGrid<Real>& coarse = fields.coarse;
    coarse.shape = {coarse_cells(stored.nx), coarse_cells(stored.ny), coarse.shape.stride};
    coarse.first_row = 0;
    coarse.last_row = static_cast<std::int16_t>(coarse.shape.ny - 1);
    fields.solve.first_row = 0;
    fields.solve.last_row = stored.ny - 1;
    fields.solve.longest_row = simulation.settings.pulls_sideways()
                                   ? static_cast<std::int16_t>(stored.nx)
                                   : Solve<Real>::kNotAsked;
    fields.solve.share = Real(0);  // of the last pressure: scaled
    fields.on_surface = kNoTension;
    Walls<Real>& walls = simulation.layers.walls;
    walls.active = simulation.bodies.used > 0;
    walls.sticking = walls.active && simulation.settings.viscosity > Real(0)
                         ? simulation.viscosity->sticking
                         : nullptr;
}

template <class Real>
std::int64_t foresee(Simulation<Real>& simulation, const SubstepPlan<Real>& plan,
                     std::int32_t cycles, std::int64_t (&stage)[kStageCount],
                     std::int32_t& largest_item) {
    StepReport report;
    Progress progress;
    progress.foresee();
    simulation.pressure.solve.cycles = static_cast<std::int8_t>(cycles);
    simulation.stages->substep(simulation, plan, Work(progress), report);
    // A part of the tank that was left is emptied, whatever the next one is.
    report.work[static_cast<std::int32_t>(Stage::particle_to_grid)] +=
        static_cast<std::uint32_t>(simulation.grid.shape.size());
    std::int64_t sum = 0;
    for (std::int32_t k = 0; k < kStageCount; ++k) {
        stage[k] = maximum<std::int64_t>(stage[k], report.work[k]);
        sum += report.work[k];
    }
    largest_item = maximum(largest_item, progress.largest_item());
    return sum;
}

}  // namespace

template <class Real>
Status World<Real>::work_bound(float dt_s, WorkBound* bound, std::int32_t rung) const {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    if (bound == nullptr) {
        return Status::output_missing;
    }
    *bound = {};
    Simulation<Real> simulation = state_->simulation;
    simulation.ticks = nullptr;
    StepReport report;
    const Seconds<Real> dt =
        sane_time_step(simulation.settings, dt_s * units_per_s(*state_), report);
    SubstepPlan<Real> plan;
    if (dt > Seconds<Real>{}) {
        plan = plan_substeps(simulation, dt);
        climb(clamp(rung, 0, kRungs - 1), simulation, plan);
        bound->substeps = plan.substeps;
    }
    plan.viscosity = simulation.settings.viscosity;
    plan.surface_tension = simulation.settings.surface_tension;
    const bool cold = !(simulation.pressure.last_dt > Seconds<Real>{});
    std::int32_t& item = bound->largest_item;
    std::int32_t patches = 0;
    const auto foresee_in = [&](const GridShape& stored) {
        fill_up(stored, simulation);
        patches = maximum(patches, simulation.pressure.coarse.shape.size());
        const std::int64_t one = foresee(simulation, plan, 1, bound->substep, item);
        const std::int64_t first =
            foresee(simulation, plan, kColdStart, bound->first_substep, item);
        bound->step = maximum(bound->step,
                              bound->substeps * one +
                                  (cold && bound->substeps > 0 ? first - one : 0));
    };
    if (simulation.window.cells == 0) {
        foresee_in(simulation.layers.shape);
    } else {
        for_each_window(state_->def.capacity, [&](std::int32_t columns, std::int32_t rows) {
            const Borders<Real>& borders = simulation.settings.borders;
            const GridShape& tank = simulation.layers.shape;
            if ((!borders.wrap_x || columns == tank.nx) && (!borders.wrap_y || rows == tank.ny)) {
                foresee_in({columns, rows, columns + 2});
            }
        });
    }
    const std::int32_t looks = most_looks(*state_, patches);  // once, at the end of a step
    if (looks > 0) {
        constexpr std::int32_t kLast = kStageCount - 1;
        bound->substep[kLast] += looks;
        bound->first_substep[kLast] += looks;
        bound->step += looks;
        bound->largest_item += looks;
    }
    return Status::ok;
}

template <class Real>
std::int32_t World<Real>::rung_within(float dt_s, std::int64_t work) const {
    WorkBound bound;
    std::int32_t rung = 0;
    while (rung < kRungs - 1 &&
           (work_bound(dt_s, &bound, rung) != Status::ok || bound.step > work)) {
        ++rung;
    }
    return rung;
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template Status World<Real>::work_bound(float, WorkBound*, std::int32_t) const; \
    template std::int32_t World<Real>::rung_within(float, std::int64_t) const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
