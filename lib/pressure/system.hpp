// The equations of the projection: diagonal, right-hand side and where the solve starts, of every
// liquid cell.
#pragma once

#include "pressure/face_weights.hpp"
#include "pressure/leap.hpp"
#include "pressure/projection.hpp"
#include "pressure/relax_packed.hpp"
#include "pressure/system_lanes.hpp"
#include "solid/moving_walls.hpp"

namespace weir {

/// One face of a cell: how much it adds to the diagonal.
template <class Real>
inline Real face_coefficient(const PressureFields<Real>& fields, Real weight, Real open,
                             Real level, SameAs<Real> neighbour_level) {
    return is_positive(neighbour_level)
               ? weight
               : weight / liquid_fraction(fields, level, neighbour_level, open);
}

/// What the pressure on the surface adds to a liquid cell's equation beyond what the sweeps read
/// from the air cell itself.
template <class Real>
inline Real surface_share(Real weight, Real open, Real level, std::int32_t neighbour,
                          const PressureFields<Real>& fields) {
    const Real air = fields.level[neighbour];
    return air > Real(0) ? Real(0)
                         : weight * fields.pressure[neighbour] *
                               (Real(1) / liquid_fraction(fields, level, air, open) - Real(1));
}

/// Sum of what a liquid cell's faces add to its diagonal.
template <bool Solids, bool Mixed, class Real>
WEIR_ALWAYS_INLINE Real diagonal_of(const FaceWeights<Solids, Mixed, Real>& weights,
                                    std::int32_t i, std::int32_t j,
                                    const PressureFields<Real>& fields) {
    const std::int32_t c = weights.grid.shape.index(i, j);
    const std::int32_t up = c + weights.grid.shape.stride;
    const std::int32_t down = c - weights.grid.shape.stride;
    const Real level = fields.level[c];
    const Faces<Real> w = weights.around(i, j);
    const auto share = [&](Real weight, Real open, std::int32_t neighbour) {
        return face_coefficient(fields, weight, open, level, fields.level[neighbour]);
    };
    return (share(w.left, weights.open_u(c), c - 1) +
            share(w.right, weights.open_u(c + 1), c + 1)) +
           (share(w.lower, weights.open_v(c), down) + share(w.upper, weights.open_v(up), up));
}

/// What flows out of it, less what is asked for and what pressure on the surface answers. `wide`:
/// all its faces are.
template <bool Solids, bool Mixed, class Real>
WEIR_ALWAYS_INLINE Real divergence_of(
    const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t i, std::int32_t j, bool wide,
    const Leap<Real>& leap, const PressureFields<Real>& fields) {
    const Walls<Real>& walls = weights.walls;
    const GridShape& s = weights.grid.shape;
    const std::int32_t c = s.index(i, j);
    Real divergence = weights.outflow(i, j);
    if (wide && goes_straight(fields, s, weights.borders, i, j)) {
        divergence += wanted_convergence(weights.grid, c, leap);
    }
    if (Solids && walls.moving != nullptr && (!wide || touches_wall(walls, c))) {
        divergence += walls.moving->flow(weights.grid, walls, i, j);
    }
    if (fields.on_surface) {
        const std::int32_t up = c + s.stride;
        const std::int32_t down = c - s.stride;
        const Real level = fields.level[c];
        const Faces<Real> w = weights.around(i, j);
        divergence -=
            (surface_share(w.left, weights.open_u(c), level, c - 1, fields) +
             surface_share(w.right, weights.open_u(c + 1), level, c + 1, fields)) +
            (surface_share(w.lower, weights.open_v(c), level, down, fields) +
             surface_share(w.upper, weights.open_v(up), level, up, fields));
    }
    return divergence;
}

/// The equation of one liquid cell.
template <class Real>
struct Equation {
    Real diagonal;  ///< 0: no face moves
    Real divergence;
};

/// Of any kind. Writes the inverse diagonal. Not inline: most cells are plain.
template <bool Solids, bool Mixed, class Real>
[[gnu::noinline]] Equation<Real> any_equation(const FaceWeights<Solids, Mixed, Real>& weights,
                                              std::int32_t i, std::int32_t j,
                                              const Leap<Real>& leap,
                                              PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const std::int32_t c = s.index(i, j);
    const Real diagonal = diagonal_of(weights, i, j, fields);
    if (!(diagonal > Real(0))) {
        fields.inverse_diagonal[c] = Real(0);
        return {Real(0), Real(0)};
    }
    const bool wide = !Solids || untouched(weights.walls, c, c + s.stride);
    // The sign tells `relax` which cells a wall touches.
    const Real inverse = stored_inverse(diagonal);
    fields.inverse_diagonal[c] = wide ? inverse : -inverse;
    return {diagonal, divergence_of(weights, i, j, wide, leap, fields)};
}

/// Of one with liquid all around, inside the tank, whose faces are all wide open.
template <class Real>
inline Equation<Real> plain_equation(const StaggeredGrid<Real>& grid, std::int32_t c,
                                     const Leap<Real>& leap, PressureFields<Real>& fields) {
    Real divergence = (Real(grid.u[c + 1]) - Real(grid.u[c])) +
                      (Real(grid.v[c + grid.shape.stride]) - Real(grid.v[c]));
    if (fields.leaps) {
        divergence += wanted_convergence(grid, c, leap);
    }
    fields.inverse_diagonal[c] = stored_quarter<Real>();
    return {Real(4), divergence};
}

template <class Real>
inline void note_liquid(bool any, std::int32_t j, Solve<Real>& system) {
    if (any) {
        system.first_row = minimum(system.first_row, j);
        system.last_row = j;
    }
}

/// Equations of cells i … end − 1 of a row, and where their solve starts. Adds to the sums of the
/// system.
template <bool Solids, bool Mixed, class Real>
void build_cells(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t i,
                 std::int32_t end, std::int32_t j, const Leap<Real>& leap,
                 PressureFields<Real>& fields, Solve<Real>& system) {
    const Walls<Real>& walls = weights.walls;
    const GridShape& s = weights.grid.shape;
    const std::int32_t up = s.stride;
    const bool row_inside =
        !Mixed && (weights.borders.wrap_y || (j > 0 && j + 1 < s.ny));
    const std::int32_t first_inside = weights.borders.wrap_x ? 0 : 1;
    const auto inside =
        static_cast<std::uint32_t>(row_inside ? maximum(0, s.nx - 2 * first_inside) : 0);
    const Real rescale = system.rescale;
    Product<Real> wanted = system.wanted;
    Product<Real> there = system.there;
    bool any = false;
    std::int32_t c = s.index(i, j);
    const LevelOf<Real>* level = fields.level + c;
    const auto wet = [&](std::int32_t further) { return is_positive(Real(level[further])); };
    for (; i < end; ++i, ++c, level = whole(level + 1)) {
        if (!wet(0)) {
            fields.inverse_diagonal[c] = Real(0);
            if (!fields.on_surface) {  // otherwise other rows read it meanwhile
                fields.pressure[c] = Real(0);
            }
            continue;
        }
        const bool plain = static_cast<std::uint32_t>(i - first_inside) < inside && wet(-1) &&
                           wet(1) && wet(-up) && wet(up) &&
                           (!Solids || (untouched(walls, c, c + up) &&
                                        !(walls.moving != nullptr && touches_wall(walls, c))));
        const Equation<Real> equation = plain ? plain_equation(weights.grid, c, leap, fields)
                                              : any_equation(weights, i, j, leap, fields);
        if (!(equation.diagonal > Real(0))) {
            fields.pressure[c] = Real(0);
            continue;
        }
        fields.divergence[c] = equation.divergence;
        // A number that is none would stay for ever: the solve starts from the last pressure.
        const Real scaled = fields.pressure[c] * rescale;
        const Real start = is_finite(scaled) ? bounded(scaled) : Real(0);
        fields.pressure[c] = start;
        any = true;
        wanted = wanted - product(start, equation.divergence);
        there = there + product(start * equation.diagonal, start);
    }
    system.wanted = wanted;
    system.there = there;
    note_liquid(any, j, system);
}

#if WEIR_HAS_LANES

/// As RowTask::add_flow.
inline void add_wall_flow(const RowTask& task, std::int32_t c, std::uint32_t asked,
                          std::uint32_t wide, float* divergence) {
    const GridShape& s = task.grid.shape;
    const Walls<float>& walls = *task.walls;
    for (; asked != 0; asked &= asked - 1U) {
        const std::int32_t k = WEIR_TRAILING_ZEROS(asked);
        if ((wide >> static_cast<std::uint32_t>(k) & 1U) == 0 || touches_wall(walls, c + k)) {
            divergence[k] +=
                walls.moving->flow(task.grid, walls, c + k - s.index(0, task.j), task.j);
        }
    }
}

/// Cells of a row, some at a time; returns the next one to do. one_by_one(i, end) does
/// others.
template <class OneByOne>
std::int32_t build_in_lanes(RowTask& task, const Part& columns, const OneByOne& one_by_one) {
    const std::int32_t row = task.grid.shape.index(0, task.j);
    const WideCells* wide = wide_cells();
    std::int32_t i = columns.first;
    while (i + 4 <= columns.end) {
        if (wide != nullptr) {
            i = wide->build_groups(task, row + i, row + columns.end) - row;
        }
        for (const std::int32_t end = i + 8; i < end && i + 4 <= columns.end; i += 4) {
            if (!build_group<FourLanes>(task, row + i)) {
                one_by_one(i, i + 4);
            }
        }
    }
    return i;
}

#endif

/// Whether sums over a row can be kept in a number of the grid until all rows are done.
template <class Real>
inline constexpr bool kSharesSums = sizeof(Product<Real>) == sizeof(VelocityOf<Real>) &&
                                    !Stored<Real>::shares_momentum;

/// Adds up what rows say of the system, in their order: row(j) answers a Solve, whoever computes
/// it. Until then the sums stand beside their rows, in scratch.
template <class Real, class Row>
void add_rows(Work work, const Part& rows, const GridShape& s, PressureFields<Real>& fields,
              const Row& row) {
    Solve<Real> total = fields.solve;
    const auto add = [&](std::int32_t j, Product<Real> wanted, Product<Real> there, bool wet) {
        total.wanted = total.wanted + wanted;
        total.there = total.there + there;
        total.first_row = wet ? minimum(total.first_row, j) : total.first_row;
        total.last_row = wet ? j : total.last_row;
    };
    if constexpr (kSharesSums<Real>) {
        work.share(rows, s.nx, 1, [&](const Part& some, std::int32_t) {
            for (std::int32_t j = some.first; j < some.end; ++j) {
                const Solve<Real> one = row(j);
                fields.divergence[s.index(-1, j)] = one.wanted;
                fields.inverse_diagonal[s.index(-1, j)] = one.there;
                fields.divergence[s.index(s.nx, j)] = Real(one.last_row < 0 ? 0 : 1);
            }
        });
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
            add(j, fields.divergence[s.index(-1, j)], fields.inverse_diagonal[s.index(-1, j)],
                fields.divergence[s.index(s.nx, j)] != Real(0));
        }
    } else {
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
            const Solve<Real> one = row(j);
            add(j, one.wanted, one.there, one.last_row >= 0);
            total.off = maximum(total.off, one.off);
        }
    }
    fields.solve = total;
}

/// One row of equations: its part of the sums, and whether there is liquid in it (`last_row`).
template <bool Solids, bool Mixed, class Real>
Solve<Real> build_row(const FaceWeights<Solids, Mixed, Real>& weights, std::int32_t j,
                      PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    const Leap<Real> leap(fields.last_dt);
    Solve<Real> system;
    system.rescale = fields.solve.rescale;
    const auto one_by_one = [&](std::int32_t i, std::int32_t end) {
        build_cells(weights, i, end, j, leap, fields, system);
    };
    const Part columns = s.columns(j);
    std::int32_t i = columns.first;
#if WEIR_HAS_LANES
    if constexpr (kHasLanes<Real> && !Mixed) {
        const bool seam = weights.borders.wrap_x;
        RowTask task{weights.grid, Solids ? &weights.walls : nullptr, fields, leap, system,
                     weights.has_lower(j), weights.has_upper(j), seam ? -1 : s.index(0, j),
                     seam ? kMostWork : s.index(s.nx - 1, j), j, nullptr};
        if constexpr (Solids) {
            task.add_flow = weights.walls.moving != nullptr ? add_wall_flow : nullptr;
        }
        i = build_in_lanes(task, columns, one_by_one);
        note_liquid(task.any, j, system);
    }
#endif
    one_by_one(i, columns.end);
    return system;
}

}  // namespace weir
