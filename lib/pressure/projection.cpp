#include "pressure/projection.hpp"

#include "pressure/relax_lanes.hpp"

namespace weir {

namespace {

/// The first solve of a world's life starts from nothing: it gets this many times the sweeps.
constexpr std::int32_t kColdStart = 8;

/// Best for liquid n rows deep, closed below and with its surface on top: 2 / (1 + sin(π / 2n))
/// (Young 1954), and sin x ≈ x. Beyond 32 rows the best factor is too much for a few sweeps on a
/// surface that breaks: a dam break 64 rows high exploded with it.
template <class Real>
Real over_relaxation(std::int32_t depth, std::int32_t sweeps) {
    if (sweeps < 8) {
        return Real(1.4);  // too few to damp what over-relaxation stirs up
    }
    const Real n = static_cast<Real>(clamp(depth, 16, 32));
    return Real(2) / (Real(1) + Real(1.5707963) / n);
}

/// What a pressure difference of 1 across a face moves through it: open share × 1/density.
template <bool Solids, bool Mixed, class Real>
struct Weights {
    const Walls<Real>& walls;
    const StaggeredGrid<Real>& grid;

    Real open_u(std::int32_t face) const { return Solids ? walls.open_u[face] : Real(1); }
    Real open_v(std::int32_t face) const { return Solids ? walls.open_v[face] : Real(1); }
    Real light_u(std::int32_t face) const {
        return Mixed ? grid.inverse_density_u[face] : Real(1);
    }
    Real light_v(std::int32_t face) const {
        return Mixed ? grid.inverse_density_v[face] : Real(1);
    }
    Real u(std::int32_t face) const {
        return Solids && Mixed ? open_u(face) * light_u(face)
                               : (Solids ? open_u(face) : light_u(face));
    }
    Real v(std::int32_t face) const {
        return Solids && Mixed ? open_v(face) * light_v(face)
                               : (Solids ? open_v(face) : light_v(face));
    }
};

/// One face of a cell: how much it adds to the diagonal.
template <class Real>
inline Real face_coefficient(Real weight, Real level, Real neighbour_level) {
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
Rows build(const StaggeredGrid<Real>& grid, const Borders<Real>& borders,
           const Walls<Real>& walls, Real rescale, PressureFields<Real>& fields) {
    const GridShape& s = grid.shape;
    const Weights<Solids, Mixed, Real> weights{walls, grid};
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
            const bool has_left = i > 0 || borders.wrap_x;
            const bool has_right = i + 1 < s.nx || borders.wrap_x;
            const bool has_lower = j > 0 || borders.wrap_y;
            const bool has_upper = j + 1 < s.ny || borders.wrap_y;
            const Real left = has_left ? weights.u(c) : Real(0);
            const Real right = has_right ? weights.u(c + 1) : Real(0);
            const Real lower = has_lower ? weights.v(c) : Real(0);
            const Real upper = has_upper ? weights.v(up) : Real(0);
            const Real diagonal = (face_coefficient(left, level, fields.level[c - 1]) +
                                   face_coefficient(right, level, fields.level[c + 1])) +
                                  (face_coefficient(lower, level, fields.level[c - s.stride]) +
                                   face_coefficient(upper, level, fields.level[up]));
            if (!(diagonal > Real(0))) {
                fields.pressure[c] = Real(0);
                continue;
            }
            const Real out_right = (has_right ? weights.open_u(c + 1) : Real(0)) * grid.u[c + 1];
            const Real out_left = (has_left ? weights.open_u(c) : Real(0)) * grid.u[c];
            const Real out_upper = (has_upper ? weights.open_v(up) : Real(0)) * grid.v[up];
            const Real out_lower = (has_lower ? weights.open_v(c) : Real(0)) * grid.v[c];
            Real divergence = (out_right - out_left) + (out_upper - out_lower);
            if (Solids && walls.moving && walls.cell_case[c] != 0) {
                divergence += wall_flow(s, walls, i, j);
            }
            if (fields.on_surface) {
                divergence -= (surface_share(left, level, c - 1, fields) +
                               surface_share(right, level, c + 1, fields)) +
                              (surface_share(lower, level, c - s.stride, fields) +
                               surface_share(upper, level, up, fields));
            }
            fields.divergence[c] = divergence;
            // The sign tells `relax` which cells a wall touches.
            fields.inverse_diagonal[c] =
                Real(Solids && !untouched(walls, c, up) ? -1 : 1) / diagonal;
            // A number that is none would stay for ever: the solve starts from the last pressure.
            const Real start = fields.pressure[c] * rescale;
            fields.pressure[c] = is_finite(start) ? start : Real(0);
            rows = {minimum(rows.low, j), j};
        }
    }
    return rows;
}

template <bool Solids, bool Mixed, class Real>
void relax(const StaggeredGrid<Real>& grid, const Walls<Real>& walls, Rows rows, Real omega,
           std::int32_t colour, PressureFields<Real>& fields) {
    const GridShape& s = grid.shape;
    const Weights<Solids, Mixed, Real> weights{walls, grid};
    Real* p = fields.pressure;
    for (std::int32_t j = rows.low; j <= rows.high; ++j) {
        const std::int32_t end = s.index(s.nx, j);
        std::int32_t c = s.index((j + colour) & 1, j);
        if constexpr (kHasLanes<Real> && !Mixed) {
            c = relax_row<Solids>(fields, walls.open_u, walls.open_v, omega, s.stride, c, end);
        }
        for (; c < end; c += 2) {
            const Real inverse = fields.inverse_diagonal[c];
            const std::int32_t up = c + s.stride;
            if (!Mixed && inverse > Real(0)) {
                // Beyond the tank and in air the pressure is 0: only the diagonal tells them apart.
                const Real sum = (p[c - 1] + p[c + 1]) + (p[c - s.stride] + p[up]);
                p[c] += omega * ((sum - fields.divergence[c]) * inverse - p[c]);
            } else if ((Solids || Mixed) && inverse != Real(0)) {
                const Real sum = (weights.u(c) * p[c - 1] + weights.u(c + 1) * p[c + 1]) +
                                 (weights.v(c) * p[c - s.stride] + weights.v(up) * p[up]);
                p[c] += omega * ((sum - fields.divergence[c]) * absolute(inverse) - p[c]);
            }
        }
    }
}

/// u −= 1/density · ∂p/∂x on the face between two neighbouring cells. `open` null: no solids.
template <class Real>
inline void accelerate(Real* velocity, std::int32_t face, std::int32_t before, Real light,
                       const Real* open, const PressureFields<Real>& fields) {
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
void project(const Borders<Real>& borders, const Walls<Real>& walls,
             const PressureFields<Real>& fields, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    const Weights<Solids, Mixed, Real> weights{walls, grid};
    for (std::int32_t j = 0; j < s.ny; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            if (i > 0 || borders.wrap_x) {
                accelerate(grid.u, c, c - 1, weights.light_u(c), Solids ? walls.open_u : nullptr,
                           fields);
            }
            if (j > 0 || borders.wrap_y) {
                accelerate(grid.v, c, c - s.stride, weights.light_v(c),
                           Solids ? walls.open_v : nullptr, fields);
            }
        }
    }
}

template <bool Solids, bool Mixed, class Real>
void solve(const Borders<Real>& borders, const Walls<Real>& walls, Real rescale,
           std::int32_t sweeps, StaggeredGrid<Real>& grid, PressureFields<Real>& fields) {
    const Rows rows = build<Solids, Mixed>(grid, borders, walls, rescale, fields);
    // A drop's pressure is held all around: less suits it better.
    const Real omega = fields.on_surface
                           ? Real(1.8)
                           : over_relaxation<Real>(rows.high - rows.low + 1, sweeps);
    extend_cells(borders, grid.shape, fields.pressure);
    for (std::int32_t half_sweep = 0; half_sweep < 2 * sweeps; ++half_sweep) {
        relax<Solids, Mixed>(grid, walls, rows, omega, half_sweep & 1, fields);
        extend_cells(borders, grid.shape, fields.pressure);
    }
    project<Solids, Mixed>(borders, walls, fields, grid);
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
    const std::int32_t times = fields.last_dt > Seconds<Real>{} ? sweeps : kColdStart * sweeps;
    fields.last_dt = dt_s;
    const bool mixed = grid.inverse_density_u != nullptr;
    const auto solver = walls.active ? (mixed ? solve<true, true, Real> : solve<true, false, Real>)
                                     : (mixed ? solve<false, true, Real>
                                              : solve<false, false, Real>);
    solver(borders, walls, rescale, times, grid, fields);
}

template void projection(const Borders<float>&, const Walls<float>&, float, std::int32_t,
                         StaggeredGrid<float>&, PressureFields<float>&);
template void projection(const Borders<double>&, const Walls<double>&, double, std::int32_t,
                         StaggeredGrid<double>&, PressureFields<double>&);
template void projection(const Borders<Fixed>&, const Walls<Fixed>&, FixedSeconds, std::int32_t,
                         StaggeredGrid<Fixed>&, PressureFields<Fixed>&);

}  // namespace weir
