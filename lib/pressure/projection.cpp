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
inline Real face_coefficient(Real weight, Real open, Real level, SameAs<Real> neighbour_level) {
    return neighbour_level > Real(0) ? weight
                                     : weight / liquid_fraction(level, neighbour_level, open);
}

/// What the pressure on the surface adds to a liquid cell's equation beyond what the sweeps read
/// from the air cell itself.
template <class Real>
inline Real surface_share(Real weight, Real open, Real level, std::int32_t neighbour,
                          const PressureFields<Real>& fields) {
    const Real air = fields.level[neighbour];
    return air > Real(0) ? Real(0)
                         : weight * fields.pressure[neighbour] *
                               (Real(1) / liquid_fraction(level, air, open) - Real(1));
}

/// Rows low … high hold all the liquid; no other needs to be swept.
struct Rows {
    std::int32_t low = 0;
    std::int32_t high = -1;
};

/// The equations Ap = b, and the old pressure p in them.
template <class Real>
struct System {
    Rows rows;
    Product<Real> wanted{};  ///< pᵀb
    Product<Real> own{};     ///< pᵀ(diagonal of A)p
};

template <bool Solids, bool Mixed, class Real>
System<Real> build(const FaceWeights<Solids, Mixed, Real>& weights, Real rescale,
                   PressureFields<Real>& fields) {
    const Walls<Real>& walls = weights.walls;
    const GridShape& s = weights.grid.shape;
    System<Real> system{{s.ny, -1}};
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
            const std::int32_t down = c - s.stride;
            const Faces<Real> w = weights.around(i, j);
            const Faces<Real> open{weights.open_u(c), weights.open_u(c + 1), weights.open_v(c),
                                   weights.open_v(up)};
            const Real diagonal =
                (face_coefficient(w.left, open.left, level, fields.level[c - 1]) +
                 face_coefficient(w.right, open.right, level, fields.level[c + 1])) +
                (face_coefficient(w.lower, open.lower, level, fields.level[down]) +
                 face_coefficient(w.upper, open.upper, level, fields.level[up]));
            if (!(diagonal > Real(0))) {
                fields.pressure[c] = Real(0);
                continue;
            }
            const bool wide = !Solids || untouched(walls, c, up);
            Real divergence = weights.outflow(i, j);
            if (Solids && walls.moving && (!wide || touches_wall(walls, c))) {
                divergence += wall_flow(s, walls, i, j);
            }
            if (fields.on_surface) {
                divergence -= (surface_share(w.left, open.left, level, c - 1, fields) +
                               surface_share(w.right, open.right, level, c + 1, fields)) +
                              (surface_share(w.lower, open.lower, level, down, fields) +
                               surface_share(w.upper, open.upper, level, up, fields));
            }
            fields.divergence[c] = divergence;
            // The sign tells `relax` which cells a wall touches.
            const Real sign = Real(wide ? 1 : -1);
            if constexpr (Stored<Real>::shares_momentum) {
                fields.inverse_diagonal[c] = sign * diagonal;  // relax_packed.hpp
            } else {
                fields.inverse_diagonal[c] = sign / diagonal;
            }
            // A number that is none would stay for ever: the solve starts from the last pressure.
            const Real scaled = fields.pressure[c] * rescale;
            const Real start = is_finite(scaled) ? bounded(scaled) : Real(0);
            fields.pressure[c] = start;
            system.rows = {minimum(system.rows.low, j), j};
            system.wanted = system.wanted - product(start, divergence);
            system.own = system.own + product(start * diagonal, start);
        }
    }
    return system;
}

/// The old pressure is where the solve starts, but not if it is further from the solution than no
/// pressure at all, as after an impact: few sweeps would leave most of it, and it would push. The
/// distance is that in kinetic energy, √(eᵀAe), which is shortest at pᵀb/pᵀAp times the old
/// pressure; eighths are near enough. From such a start sweeps leave the velocity with no more
/// energy than it came with.
template <bool Solids, bool Mixed, class Real>
void weigh_start(const FaceWeights<Solids, Mixed, Real>& weights, const System<Real>& system,
                 PressureFields<Real>& fields) {
    const GridShape& s = weights.grid.shape;
    Real* p = fields.pressure;
    Product<Real> there = system.own;
    for (std::int32_t j = system.rows.low; j <= system.rows.high; ++j) {
        for (std::int32_t c = s.index(0, j); c < s.index(s.nx, j); ++c) {
            const Real inverse = fields.inverse_diagonal[c];
            if (inverse != Real(0)) {
                there = there - product(p[c], weights.weighted(p, c, inverse));
            }
        }
    }
    const Product<Real> twice = system.wanted + system.wanted;
    if (twice >= there) {
        return;  // nearer than none
    }
    const Product<Real> eight_times = (twice + twice) + (twice + twice);
    Real share = eight_times >= (there + there) + there
                     ? Real(0.375)
                     : (eight_times >= there + there ? Real(0.25) : Real(0.125));
    share = eight_times >= there ? share : Real(0);
    for (std::int32_t j = system.rows.low; j <= system.rows.high; ++j) {
        for (std::int32_t c = s.index(0, j); c < s.index(s.nx, j); ++c) {
            p[c] = share * p[c];
        }
    }
    extend_cells(weights.borders, s, p);
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
    const Real through = open != nullptr ? Real(open[face]) : Real(1);
    const bool liquid = fields.level[before] > Real(0) || fields.level[face] > Real(0);
    if (liquid && through > Real(0)) {
        velocity[face] -= light * pressure_rise(fields, before, face, through);
    }
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

template <bool Solids, bool Mixed, class Real>
void solve(const Borders<Real>& borders, const Walls<Real>& walls, Real rescale,
           std::int32_t cycles, std::int32_t sweeps, const CoupledSolve<Real>* coupled,
           StaggeredGrid<Real>& grid, PressureFields<Real>& fields) {
    const FaceWeights<Solids, Mixed, Real> weights{grid, borders, walls};
    const System<Real> system = build(weights, rescale, fields);
    const Rows rows = system.rows;
    extend_cells(borders, grid.shape, fields.pressure);
    if (!fields.on_surface) {
        weigh_start(weights, system, fields);
    }
    if constexpr (Stored<Real>::shares_momentum) {
        relax_packed(weights, rows.low, rows.high, cycles * (sweeps + kSweepsForCoarse), fields);
    } else {
        set_up_coarse(weights, fields);
        for (std::int32_t cycle = 0; cycle < cycles; ++cycle) {
            if (coupled != nullptr) {
                coupled->stages->begin(*coupled);
            }
            correct_coarse(weights, fields);
            if (coupled != nullptr) {
                yield_to_correction(*coupled, fields);
            }
            extend_cells(borders, grid.shape, fields.pressure);
            for (std::int32_t half_sweep = 0; half_sweep < 2 * sweeps; ++half_sweep) {
                relax(weights, rows, half_sweep & 1, fields);
                if (coupled != nullptr) {
                    coupled->stages->relax(*coupled, kRelaxation<Real>, half_sweep & 1);
                }
                extend_cells(borders, grid.shape, fields.pressure);
            }
            if (coupled != nullptr) {
                coupled->stages->end(*coupled);
            }
        }
    }
    project(weights, fields, grid);
}

}  // namespace

template <class Real>
void projection(const Borders<Real>& borders, const Walls<Real>& walls, Seconds<Real> dt_s,
                std::int32_t sweeps, StaggeredGrid<Real>& grid, PressureFields<Real>& fields,
                const CoupledSolve<Real>* coupled) {
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
    solver(borders, walls, rescale, cycles, sweeps, coupled, grid, fields);
}

#define WEIR_INSTANTIATE(Real)                                                                \
    template void projection(const Borders<Real>&, const Walls<Real>&, Seconds<Real>,         \
                             std::int32_t, StaggeredGrid<Real>&, PressureFields<Real>&,       \
                             const CoupledSolve<Real>*);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(double)
WEIR_INSTANTIATE(Fixed)
WEIR_INSTANTIATE(SmallFixed)
#undef WEIR_INSTANTIATE

}  // namespace weir
