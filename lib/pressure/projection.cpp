#include "pressure/projection.hpp"

#include "pressure/build_packed.hpp"
#include "pressure/coarse_correction.hpp"
#include "pressure/equation_of_state.hpp"
#include "pressure/make_room.hpp"
#include "pressure/patch_drift.hpp"
#include "pressure/project.hpp"
#include "pressure/project_packed.hpp"
#include "pressure/relax.hpp"
#include "pressure/relax_packed.hpp"
#include "pressure/sharpen_between.hpp"
#include "pressure/start.hpp"
#include "pressure/system.hpp"

namespace weir {

namespace {

/// Σ correction × residual of the coarse equations.
template <class Real>
Face<Real> work_of_correction(const CoarseGrid<Real>& coarse) {
    Face<Real> work = Face<Real>(0);
    for (std::int32_t j = 0; j < coarse.shape.ny; ++j) {
        for (std::int32_t i = 0; i < coarse.shape.nx; ++i) {
            const std::int32_t q = coarse.shape.index(i, j);
            if (coarse.inverse_diagonal[q] != Real(0)) {
                work += static_cast<Face<Real>>(coarse.correction[q]) *
                        static_cast<Face<Real>>(coarse.residual[q]);
            }
        }
    }
    return work;
}

/// The coarse grid takes bodies to move as they do. They yield to its correction, by as much more
/// as they are light: the step along the correction is the one that suits the whole system.
template <class Real>
void yield_to_correction(const CoupledSolve<Real>& coupled, PressureFields<Real>& fields) {
    const Face<Real> stiff = coupled.stages->yielding(coupled);
    const Face<Real> work = work_of_correction(fields.coarse);
    const Face<Real> share = work > Face<Real>(0) ? work / (work + stiff) : Face<Real>(0);
    add_again(coupled.shape, static_cast<Real>(share - Face<Real>(1)), fields);
    coupled.stages->set_aside(coupled);
}

/// Half sweeps 0 … count − 1 over some rows, of which each next one has a row less at every end
/// that other rows go on from: rows further out are done afterwards. Row j of a half sweep waits
/// for row j + 1 of the one before, so that all half sweeps follow each other through the rows, and
/// find them in the cache. The bits are those of one half sweep after the other.
template <bool Solids, bool Mixed, class Real>
void relax_fronts(const FaceWeights<Solids, Mixed, Real>& weights, const Part& rows,
                  bool goes_on_below, bool goes_on_above, std::int32_t count,
                  PressureFields<Real>& fields) {
    const std::int32_t highest = rows.end - 1;
    for (std::int32_t front = rows.first; front < highest + count; ++front) {
        // Of half sweep n row front − n, whose first cell is in the same column for all n.
        const std::int32_t first = maximum(0, front - highest);
        std::int32_t last = minimum(count - 1, front - rows.first);
        if (goes_on_above && front >= highest) {
            continue;
        }
        if (goes_on_below) {
            last = minimum(last, (front - rows.first + 1) / 2 - 1);
        }
        relax_down(weights, front & 1, front - first, last - first + 1, fields);
    }
}

/// What `relax_fronts` left off on both sides of row `border`.
template <bool Solids, bool Mixed, class Real>
void relax_between(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t border,
                   std::int32_t count, PressureFields<Real>& fields) {
    for (std::int32_t half = 0; half < count; ++half) {
        relax(weights, {border - half - 1, border + half + 1}, half & 1, fields);
    }
}

/// All half sweeps over all rows that hold liquid, without seams and free bodies.
template <bool Solids, bool Mixed, class Real>
void sweep_in_fronts(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t count,
                     Work work, PressureFields<Real>& fields) {
    const Part rows{fields.solve.first_row, fields.solve.last_row + 1};
    const std::int32_t cost = count * (weights.grid.shape.nx + 1) / 2;
    const std::int32_t grain = 2 * (count + 1);
    work.share(rows, cost, grain, [&](const Part& some, std::int32_t) {
        relax_fronts(weights, some, some.first > rows.first, some.end < rows.end, count, fields);
    });
#if WEIR_PARALLEL
    const std::int32_t pieces = work.pieces(rows.end - rows.first, cost, grain);
    if (pieces > 1) {
        work.share({1, pieces}, cost * count, 1, [&](const Part& some, std::int32_t) {
            for (std::int32_t k = some.first; k < some.end; ++k) {
                const std::int32_t border = piece_of(rows, grain, pieces, k).first;
                relax_between(weights, border, count, fields);
            }
        });
    }
#endif
}

/// Sweep after sweep, one colour and then the other, row by row.
template <bool Solids, bool Mixed, class Real>
void sweep(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t sweeps,
           const CoupledSolve<Real>* coupled, Work work, PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const std::int32_t lowest = fields.solve.first_row;
    const std::int32_t height = rows_of(fields.solve);
    const Part part = work.take(2 * sweeps * height, (s.nx + 1) / 2);
    if constexpr (kHasLanes<Real>) {  // those have a cache
        const bool seams = weights.wraps_x() || weights.wraps_y();
        if (coupled == nullptr && !seams && part.first == 0 && part.end == 2 * sweeps * height) {
            sweep_in_fronts(weights, 2 * sweeps, work, fields);
            return;
        }
    }
    [[maybe_unused]] const Real omega =
        Stored<Real>::shares_momentum ? best_relaxation<Real>(fields.solve.depth(height), sweeps)
                                      : kRelaxation<Real>;
    for (std::int32_t at = part.first; at < part.end;) {
        const std::int32_t half_sweep = at / height;
        const std::int32_t begin = half_sweep * height;
        const std::int32_t end = minimum(part.end, begin + height);
        const Part rows{lowest + at - begin, lowest + end - begin};
        if constexpr (Stored<Real>::shares_momentum) {
            relax_packed(weights, rows, half_sweep & 1, omega, fields);
        } else {
            relax(weights, rows, half_sweep & 1, fields);
        }
        if (end == begin + height) {
            if (coupled != nullptr) {
                coupled->stages->relax(*coupled, kRelaxation<Real>, half_sweep & 1);
            }
            extend_cells<!Solids>(weights.borders, s, fields.pressure);
        }
        at = end;
    }
}

/// Puts up the equations, for the velocity that `weights` know. Not inline: it is called twice.
template <bool Solids, bool Mixed, class Real>
[[gnu::noinline]] void build(const FaceWeights<Solids, Mixed, Real>& weights,
                             PressureFields<Real>& fields, Work work) {
    const GridShape& s = weights.grid.shape;
    const Part built = work.take(s.ny, s.nx);
    if constexpr (Stored<Real>::coarse) {
        build_packed<Solids>(weights, built, fields);
    } else {
        add_rows(work, built, s, fields,
                 [&](std::int32_t j) { return build_row(weights, j, fields); });
    }
}

/// The pressure of a compressible liquid, one step in time later. It answers to the flow that there
/// was: gravity, which it holds up, has not pulled at that yet.
template <bool Solids, bool Mixed, class Real>
void advance(const Domain<Real>& domain, Work work) {
    PressureFields<Real>& fields = domain.fields;
    StaggeredGrid<Real> before = domain.grid;
    before.u = before.mass_u;
    before.v = before.mass_v;
    const FaceWeights<Solids, Mixed, Real> weights{before, domain.borders, domain.walls};
    fields.elasticity->carry_pressure({before, domain.borders, domain.walls}, fields, work);
    build(weights, fields, work);
    fields.elasticity->compress(domain, work);
}

/// Of what free bodies, a body that was put into the liquid, or more than inlets take have pressed
/// together. Packed worlds know but the last two, and ask otherwise.
template <bool Solids, class Real>
void make_room_of_crowds(const GridShape& s, bool among_free, Work work,
                         PressureFields<Real>& fields) {
    if constexpr (!Stored<Real>::coarse) {
        if (!among_free && !fields.solve.makes_room && !work.foreseeing()) {
            return;
        }
        const Real gain = among_free ? kRoomGain<Real> : kRoomGainAround<Real>;
        if constexpr (Solids) {
            make_room(s, gain, work, fields);
        } else if (fields.inlets.make_room_around != nullptr) {
            fields.inlets.make_room_around(s, gain, work, fields);
        } else {  // foreseen, though nobody asks before something was added
            for_each_patch(s, fields.coarse.shape, work, [](const Patch&) {});
        }
    }
}

/// The pressure of an incompressible liquid, as near as so many sweeps bring it.
template <bool Solids, bool Mixed, class Real>
void solve(const Domain<Real>& domain, std::int32_t sweeps, const CoupledSolve<Real>* free_bodies,
           Work work) {
    const CoupledSolve<Real>* const coupled = Solids ? free_bodies : nullptr;
    const auto weights = domain.template face_weights<Solids, Mixed>();
    const GridShape& s = domain.grid.shape;
    const Borders<Real>& borders = domain.borders;
    PressureFields<Real>& fields = domain.fields;
    build(weights, fields, work);
    make_room_of_crowds<Solids>(s, coupled != nullptr, work, fields);
    if (work.once(s.border())) {
        make_room_at_inlets(domain);
        extend_cells<!Solids>(borders, s, fields.pressure);
    }
    if constexpr (Stored<Real>::coarse) {
        if ((fields.solve.makes_room || work.foreseeing()) && work.once(s.size())) {
            make_room_packed(s, fields);
        }
    }
    if (!fields.on_surface) {
        weigh_start(weights, work, fields);
    }
    if constexpr (Stored<Real>::shares_momentum) {
        const Solve<Real>& from = fields.solve;
        const std::int32_t all = from.cycles * (sweeps + kSweepsForCoarse);
        const std::int32_t depth = from.depth(rows_of(from));
        sweep(weights, sweeps_of_depth(depth, all, from.cycles > 1), coupled, work, fields);
        weigh_end(weights, work, fields);
    } else {
        set_up_coarse(weights, fields, work);
        for (std::int32_t cycle = 0; cycle < fields.solve.cycles; ++cycle) {
            if (coupled != nullptr && work.once(s.size())) {
                coupled->stages->begin(*coupled);
            }
            correct_coarse(weights, fields, work);
            if (coupled != nullptr && work.once(s.size())) {
                yield_to_correction(*coupled, fields);
            }
            if (work.once(s.border())) {
                extend_cells<!Solids>(borders, s, fields.pressure);
            }
            sweep(weights, sweeps, coupled, work, fields);
            if (coupled != nullptr && work.once(s.size())) {
                coupled->stages->end(*coupled);
            }
        }
    }
}

template <bool Solids, bool Mixed, class Real>
void solve_and_project(const Domain<Real>& domain, std::int32_t sweeps,
                       const CoupledSolve<Real>* coupled, Work work) {
    StaggeredGrid<Real>& grid = domain.grid;
    PressureFields<Real>& fields = domain.fields;
    const GridShape& s = grid.shape;
    if (fields.elasticity != nullptr) {
        advance<Solids, Mixed>(domain, work);
    } else {
        solve<Solids, Mixed>(domain, sweeps, coupled, work);
    }
    const auto weights = domain.template face_weights<Solids, Mixed>();
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        if constexpr (Stored<Real>::coarse) {
            if (fields.elasticity != nullptr) {
                fields.elasticity->push(domain, rows);
            } else {
                project_packed(weights, rows, fields, grid);
            }
        } else {
            project(weights, rows, fields, grid);
        }
    });
}

/// Packed worlds have one liquid.
template <bool Solids, class Real>
constexpr detail::SecondLiquid<Real> stages_of_two() {
    detail::SecondLiquid<Real> stages{};
    if constexpr (!Stored<Real>::shares_momentum) {
        stages.in_open = solve_and_project<false, true, Real>;
        stages.sharpen_between = sharpen_between<Real>;
        if constexpr (Solids) {
            stages.among_solids = solve_and_project<true, true, Real>;
        }
    }
    return stages;
}

template <bool Solids, class Real>
void make_incompressible(const Domain<Real>& domain, Seconds<Real> dt_s, std::int32_t sweeps,
                         const CoupledSolve<Real>* coupled, Work work) {
    StaggeredGrid<Real>& grid = domain.grid;
    PressureFields<Real>& fields = domain.fields;
    const Borders<Real>& borders = domain.borders;
    if (work.once(1)) {
        fields.solve = begin_solve(grid.shape.ny, dt_s, fields);
        if (domain.sideways) {
            fields.solve.longest_row = 0;
        }
    }
    const bool seams = !Solids && (borders.wrap_x || borders.wrap_y);
    if (seams && work.once(grid.shape.border())) {  // leaps look across, and what is carried
        extend_velocity(borders, grid.shape, grid.mass_u, grid.mass_v);
    }
    auto solver = solve_and_project<Solids, false, Real>;
    if (fields.second_liquid != nullptr) {
        solver = Solids ? fields.second_liquid->among_solids : fields.second_liquid->in_open;
    }
    solver(domain, sweeps, coupled, work);
}

}  // namespace

template <bool Solids, class Real>
void projection(const Domain<Real>& domain, Seconds<Real> dt_s, std::int32_t sweeps,
                const CoupledSolve<Real>* coupled, Work work) {
    // Packed worlds have one for both: little room for code.
    const auto stage = Stored<Real>::coarse || domain.walls.active
                           ? make_incompressible<Solids, Real>
                           : make_incompressible<false, Real>;
    stage(domain, dt_s, sweeps, coupled, work);
}

template <bool Solids, class Real>
const detail::SecondLiquid<Real>& detail::second_liquid() {
    static constexpr SecondLiquid<Real> kStages = stages_of_two<Solids, Real>();
    return kStages;
}

#define WEIR_INSTANTIATE_PROJECTION(Solids, Real)                                      \
    template const detail::SecondLiquid<Real>& detail::second_liquid<Solids, Real>();  \
    template void projection<Solids>(const Domain<Real>&, Seconds<Real>, std::int32_t, \
                                     const CoupledSolve<Real>*, Work);
#define WEIR_INSTANTIATE(Real) \
    WEIR_INSTANTIATE_PROJECTION(false, Real) WEIR_INSTANTIATE_PROJECTION(true, Real)
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE
#undef WEIR_INSTANTIATE_PROJECTION

}  // namespace weir
