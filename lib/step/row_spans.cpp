#include "step/row_spans.hpp"

#include "step/mass_matrix.hpp"

namespace weir {

#if WEIR_PARALLEL && WEIR_HAS_LANES

namespace {

static_assert(sizeof(RowSpan) == kRowSpanBytes);
static_assert(kRowsOfSpan == kCoarseEdge, "coarse cells are worked on whole");

/// No particle goes further within a substep, cells; of one that a solid took further along
/// `CollideResult::leapt` tells.
constexpr std::int32_t kMostWay = 2;
/// Columns and rows worked on beside liquid: what drifts goes from one coarse cell to the next.
constexpr std::int32_t kBeside = kCoarseEdge;
/// Spans below and above in which liquid may be a substep later, or what is beside it.
constexpr std::int32_t kSpansBeside = (kMostWay + kBeside + kRowsOfSpan - 1) / kRowsOfSpan;
/// What stages look at beyond the cells that they work on, and more than that.
constexpr std::int32_t kLookedAt = 8;
/// Spans begin and end at multiples of this: groups of cells are whole.
constexpr std::int32_t kTogether = 8;

Part joined(const Part& a, const Part& b) {
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    return {minimum(a.first, b.first), maximum(a.end, b.end)};
}

/// Spans of the rows of a part.
Part spans_of(const GridShape& part) {
    return {part.j0 / kRowsOfSpan, (part.j0 + part.ny + kRowsOfSpan - 1) / kRowsOfSpan};
}

Part rows_of(std::int32_t span, const GridShape& tank) {
    return {kRowsOfSpan * span, minimum(kRowsOfSpan * (span + 1), tank.ny)};
}

/// Of the tank's columns in some rows, those from the first to the last that hold mass.
Part liquid_in(const GridShape& tank, const Part& rows, Part columns, const float* density) {
    const auto dry = [&](std::int32_t i) {
        std::int32_t any = 0;  // −0 is no dry cell (`kNoRoom`)
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
            any |= bound_key(density[tank.index(i, j)]);
        }
        return any == 0;
    };
    while (!columns.empty() && dry(columns.first)) {
        ++columns.first;
    }
    while (!columns.empty() && dry(columns.end - 1)) {
        --columns.end;
    }
    return columns;
}

/// A part's columns around liquid in the tank's columns.
Part work_beside(const Part& liquid, const GridShape& part) {
    if (liquid.empty()) {
        return {};
    }
    const std::int32_t low = liquid.first - (kMostWay + kBeside) - part.i0;
    const std::int32_t high = liquid.end + (kMostWay + kBeside) - part.i0;
    const std::int32_t first = maximum(0, low) / kTogether * kTogether;
    const std::int32_t end = minimum(part.nx, (high + kTogether - 1) / kTogether * kTogether);
    return first < end ? Part{first, end} : Part{};
}

Part looked_at(const Part& columns, const GridShape& part) {
    return columns.empty() ? Part{}
                           : Part{maximum(-1, columns.first - kLookedAt),
                                  minimum(part.nx + 1, columns.end + kLookedAt)};
}

/// All that spans k − by … k + by of those `among` say.
template <class Say>
Part around(std::int32_t k, std::int32_t by, const Part& among, const Say& say) {
    Part all;
    for (std::int32_t n = maximum(k - by, among.first); n <= k + by && n < among.end; ++n) {
        all = joined(all, say(n));
    }
    return all;
}

/// Whether all stages of this substep know of spans.
bool all_know(const Simulation<float>& simulation, const SubstepPlan<float>& plan) {
    const Settings<float>& settings = simulation.settings;
    const PressureFields<float>& fields = simulation.pressure;
    const bool plain = simulation.regions == nullptr && simulation.two_way == nullptr &&
                       !simulation.layers.any_thin() && fields.elasticity == nullptr &&
                       fields.second_liquid == nullptr;
    return plain && !settings.borders.wrap_x && !settings.borders.wrap_y &&
           settings.surface_tension == 0.0F && !interpolates(simulation, plan);
}

/// Around what was liquid in the last substep, which worked on that part. What is no longer worked
/// on was without liquid, and need not be emptied. False: it would spare little.
bool find_spans(const GridShape& tank, const GridShape& last, const float* density,
                StaggeredGrid<float>& grid) {
    const GridShape& now = grid.shape;
    RowSpan* const spans = grid.row_spans;
    const Part before = spans_of(last);
    const Part here = spans_of(now);
    for (std::int32_t k = before.first; k < before.end; ++k) {
        const Part columns = grid.whole_rows ? Part{0, last.nx} : spans[k].columns;
        spans[k].liquid = liquid_in(tank, rows_of(k, tank),
                                    {columns.first + last.i0, columns.end + last.i0}, density);
    }
    std::int32_t worked_on = 0;
    for (std::int32_t k = here.first; k < here.end; ++k) {
        const Part columns = work_beside(
            around(k, kSpansBeside, before, [&](std::int32_t n) { return spans[n].liquid; }), now);
        spans[k].columns = columns;
        worked_on += columns.end - columns.first;
    }
    for (std::int32_t k = here.first; k < here.end; ++k) {
        spans[k].entries = looked_at(
            around(k, 1, here, [&](std::int32_t n) { return spans[n].columns; }), now);
    }
    return 8 * worked_on <= 7 * now.nx * (here.end - here.first);
}

}  // namespace

void narrow_rows(Simulation<float>& simulation, const SubstepPlan<float>& plan) {
    StaggeredGrid<float>& grid = simulation.grid;
    const bool may = grid.row_spans != nullptr && all_know(simulation, plan);
    if (may && grid.knows_rows && grid.shape.nx >= kLeastSpanned &&
        find_spans(simulation.layers.shape, simulation.occupied, simulation.pressure.density,
                   grid)) {
        grid.shape.spans = grid.row_spans;
    }
    grid.whole_rows = grid.shape.spans == nullptr;
    grid.knows_rows = true;  // unless somebody leaps in this substep
}

#endif

}  // namespace weir
