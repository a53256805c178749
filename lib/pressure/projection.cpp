#include "pressure/projection.hpp"

#include "pressure/coarse_correction.hpp"
#include "pressure/relax_lanes.hpp"
#include "pressure/relax_packed.hpp"

namespace weir {

namespace {

/// The first solve of a world's life starts from nothing: it gets this many cycles.
constexpr std::int32_t kColdStart = 8;

/// The coarse grid takes care of what is smooth: sweeps only have to smooth what is left.
template <class Real>
constexpr Real kRelaxation = Real(1.4);

/// One face of a cell: how much it adds to the diagonal.
template <class Real>
inline Real face_coefficient(Real weight, Real level, SameAs<Real> neighbour_level) {
    return neighbour_level > Real(0) ? weight : weight / liquid_fraction(level, neighbour_level);
}

/// What the pressure on the surface adds to a liquid cell's equation beyond what the sweeps read
/// from the air cell itself.
template <class Real>
inline Real surface_share(Real weight, Real level, std::int32_t neighbour,
                          const PressureFields<Real>& fields) {
    const Real air = fields.level[neighbour];
    return air > Real(0) ? Real(0)
                         : weight * fields.pressure[neighbour] *
                               (Real(1) / liquid_fraction(level, air) - Real(1));
}

/// Whether all faces of a cell are wide open. Such cells are relaxed without reading a weight.
template <class Real>
inline bool untouched(const Walls<Real>& walls, std::int32_t cell, std::int32_t up) {
    return walls.open_u[cell] == Real(1) && walls.open_u[cell + 1] == Real(1) &&
           walls.open_v[cell] == Real(1) && walls.open_v[up] == Real(1);
}

/// Rows low … high hold all the liquid; no other needs to be swept.
struct Rows {
    std::int32_t low = 0;
    std::int32_t high = -1;
};

template <bool Solids, bool Mixed, class Real>
Rows build(const FaceWeights<Solids, Mixed, Real>& weights, Real rescale,
           PressureFields<Real>& fields) {
    const Walls<Real>& walls = weights.walls;
    const GridShape& s = weights.grid.shape;
    Rows rows{s.ny, -1};
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            const Real level = fields.level[c];
            fields.inverse_diagonal[c] = Real(0);
            if (!(level > Real(0))) {
                fields.pressure[c] = fields.on_surface ? fields.pressure[c] : Real(0);
                continue;
            }
            const std::int32_t up = c + s.stride;
            const Faces<Real> w = weights.around(i, j);
            const Real diagonal =
                (face_coefficient(w.left, level, fields.level[c - 1]) +
                 face_coefficient(w.right, level, fields.level[c + 1])) +
                (face_coefficient(w.lower, level, fields.level[c - s.stride]) +
                 face_coefficient(w.upper, level, fields.level[up]));
            if (!(diagonal > Real(0))) {
                fields.pressure[c] = Real(0);
                continue;
            }
            Real divergence = weights.outflow(i, j);
            if (Solids && walls.moving && walls.cell_case[c] != 0) {
                divergence += wall_flow(s, walls, i, j);
            }
            if (fields.on_surface) {
                divergence -= (surface_share(w.left, level, c - 1, fields) +
                               surface_share(w.right, level, c + 1, fields)) +
                              (surface_share(w.lower, level, c - s.stride, fields) +
                               surface_share(w.upper, level, up, fields));
            }
            fields.divergence[c] = divergence;
            // The sign tells `relax` which cells a wall touches.
            const Real sign = Real(Solids && !untouched(walls, c, up) ? -1 : 1);
            if constexpr (Stored<Real>::shares_momentum) {
                fields.inverse_diagonal[c] = sign * diagonal;  // relax_packed.hpp
            } else {
                fields.inverse_diagonal[c] = sign / diagonal;
            }
            // A number that is none would stay for ever: the solve starts from the last pressure.
            const Real start = fields.pressure[c] * rescale;
            fields.pressure[c] = is_finite(start) ? bounded(start) : Real(0);
            rows = {minimum(rows.low, j), j};
        }
    }
    return rows;
}

template <bool Solids, bool Mixed, class Real>
void relax(const FaceWeights<Solids, Mixed, Real>& weights, Rows rows, std::int32_t colour,
           PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    Real* p = fields.pressure;
    for (std::int32_t j = rows.low; j <= rows.high; ++j) {
        const std::int32_t end = s.index(s.nx, j);
        std::int32_t c = s.index((j + colour) & 1, j);
        if constexpr (kHasLanes<Real> && !Mixed) {
            c = relax_row<Solids>(fields, weights.walls.open_u, weights.walls.open_v,
                                  kRelaxation<Real>, s.stride, c, end);
        }
        for (; c < end; c += 2) {
            const Real inverse = fields.inverse_diagonal[c];
            if (inverse != Real(0)) {
                const Real target =
                    (weights.weighted(p, c, inverse) - fields.divergence[c]) * absolute(inverse);
                p[c] += kRelaxation<Real> * (target - p[c]);
            }
        }
    }
}

/// u −= 1/density · ∂p/∂x on the face between two neighbouring cells. `open` null: no solids.
template <class Real>
inline void accelerate(VelocityOf<Real>* velocity, std::int32_t face, std::int32_t before,
                       Real light, const ShareOf<Real>* open, const PressureFields<Real>& fields) {
    const Real level_before = fields.level[before];
    const Real level_after = fields.level[face];
    const bool liquid_before = level_before > Real(0);
    const bool liquid_after = level_after > Real(0);
    if ((!liquid_before && !liquid_after) || (open != nullptr && !(open[face] > Real(0)))) {
        return;
    }
    Real difference = fields.pressure[face] - fields.pressure[before];
    if (liquid_before != liquid_after) {
        difference = difference / (liquid_before ? liquid_fraction(level_before, level_after)
                                                 : liquid_fraction(level_after, level_before));
    }
    velocity[face] -= light * difference;
}

template <bool Solids, bool Mixed, class Real>
void project(const FaceWeights<Solids, Mixed, Real>& weights, const PressureFields<Real>& fields,
             StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const ShareOf<Real>* open_u = Solids ? weights.walls.open_u : nullptr;
    const ShareOf<Real>* open_v = Solids ? weights.walls.open_v : nullptr;
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            if (weights.has_left(i)) {
                accelerate(grid.u, c, c - 1, weights.light_u(c), open_u, fields);
            }
            if (weights.has_lower(j)) {
                accelerate(grid.v, c, c - s.stride, weights.light_v(c), open_v, fields);
            }
        }
    }
}

template <bool Solids, bool Mixed, class Real>
void solve(const Borders<Real>& borders, const Walls<Real>& walls, Real rescale,
           std::int32_t cycles, std::int32_t sweeps, StaggeredGrid<Real>& grid,
           PressureFields<Real>& fields) {
    const FaceWeights<Solids, Mixed, Real> weights{grid, borders, walls};
    const Rows rows = build(weights, rescale, fields);
    extend_cells(borders, grid.shape, fields.pressure);
    if constexpr (Stored<Real>::shares_momentum) {
        relax_packed(weights, rows.low, rows.high, cycles * (sweeps + kSweepsForCoarse), fields);
    } else {
        set_up_coarse(weights, fields);
        for (std::int32_t cycle = 0; cycle < cycles; ++cycle) {
            correct_coarse(weights, fields);
            extend_cells(borders, grid.shape, fields.pressure);
            for (std::int32_t half_sweep = 0; half_sweep < 2 * sweeps; ++half_sweep) {
                relax(weights, rows, half_sweep & 1, fields);
                extend_cells(borders, grid.shape, fields.pressure);
            }
        }
    }
    project(weights, fields, grid);
}

}  // namespace

template <class Real>
void projection(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                std::int32_t sweeps, StaggeredGrid<Real>& grid, PressureFields<Real>& fields) {
    // A much longer step than the last starts from less than the last pressure would suggest.
    const Real rescale =
        fields.last_dt > Seconds<Real>{}
            ? minimum(fields.gravity_change * (dt_s / fields.last_dt), Real(16))
            : Real(0);
    fields.gravity_change = Real(1);
    const std::int32_t cycles = fields.last_dt > Seconds<Real>{} ? 1 : kColdStart;
    fields.last_dt = dt_s;
    const bool mixed = grid.inverse_density_u != nullptr;
    const auto solver = walls.active ? (mixed ? solve<true, true, Real> : solve<true, false, Real>)
                                     : (mixed ? solve<false, true, Real>
                                              : solve<false, false, Real>);
    solver(borders, walls, rescale, cycles, sweeps, grid, fields);
}

template void projection(const Borders<float>&, const Walls<float>&, float, std::int32_t,
                         StaggeredGrid<float>&, PressureFields<float>&);
template void projection(const Borders<double>&, const Walls<double>&, double, std::int32_t,
                         StaggeredGrid<double>&, PressureFields<double>&);
template void projection(const Borders<Fixed>&, const Walls<Fixed>&, Seconds<Fixed>, std::int32_t,
                         StaggeredGrid<Fixed>&, PressureFields<Fixed>&);
template void projection(const Borders<SmallFixed>&, const Walls<SmallFixed>&, Seconds<SmallFixed>,
                         std::int32_t, StaggeredGrid<SmallFixed>&, PressureFields<SmallFixed>&);

}  // namespace weir
