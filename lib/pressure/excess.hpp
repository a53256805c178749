// How much too dense cells are: what the volume stage drifts away from.
#pragma once

#include "pressure/excess_lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/thin_walls.hpp"
#include "solid/walls.hpp"

namespace weir {

template <class Real>
inline constexpr Real kWindow = Real(1);

/// At the surface the density is that of a few particles: only what exceeds this counts there.
/// Without it the surface of an agitated pool stands 5 % of ten cells too high.
template <class Real>
inline constexpr Real kSurfaceSlack = Real(0.2);

/// Just below the surface density is known to this: lattices are no continuum.
template <class Real>
inline constexpr Real kSubsurfaceSlack = Real(0.03);

/// A cell below the surface sees less than 1: its kernel reaches 1½ cells up. `lowest`: level of
/// the neighbour that is nearest to the surface, one cell less than its own, at most ½. Counted as
/// a deficit it would make a pool's surface creep; under surface tension that pull is what stills
/// ripples.
template <class Real>
inline Real expected_deficit(Real lowest) {
    const Real missing = Real(0.5) - lowest;
    return Real(0.125) * missing * missing;
}

/// Of a cell of liquid, as a pressure; a weaker gravity counts as this.
template <class Real>
inline constexpr Real kLeastWeight = Real(1.0e-4);

/// Which share of a deficit counts, by the pressure: liquid whose pressure is below the air's hangs
/// under gravity: to draw it together would lift it, and nothing would pay. Compressible liquid
/// knows no tension: there it takes the pressure of a cell's weight.
template <class Real>
struct Held {
    Real at_rest = Real(1);  ///< without pressure
    Real rise = Real(0);     ///< 1 / weight of a cell of liquid; 0 without gravity
    Real enough = Real(0);   ///< pressure from which on all of it does
    const VelocityOf<Real>* light_u = nullptr;  ///< inverse densities; null: one liquid
    const VelocityOf<Real>* light_v = nullptr;

    /// A cell's pressure, as much as it would be in the first liquid: others weigh more, or less.
    Real pressed(Real pressure, std::int32_t stride, std::int32_t c) const {
        if (light_u == nullptr) {
            return pressure;
        }
        const Real light = (Real(light_u[c]) + light_u[c + 1]) +
                           (Real(light_v[c]) + light_v[c + stride]);
        return (Real(0.25) * light) * pressure;
    }
    Real share(Real pressure) const {
        return clamp<Real>(at_rest + rise * pressure, Real(0), Real(1));
    }
};

template <class Real>
inline Held<Real> held_by(Real weight, const PressureFields<Real>& f,
                          const StaggeredGrid<Real>& grid) {
    if (!(weight > Real(0))) {
        return {};
    }
    const Real least = maximum(weight, kLeastWeight<Real>);
    const bool slack = f.sound_speed > Real(0);
    return {Real(slack ? 0 : 1), Real(1) / least,
            slack ? Real(1.0 + 1.0 / 1024.0) * least : Real(0),  // more than by rounding
            grid.inverse_density_u, grid.inverse_density_v};
}

/// How much too dense a cell is, or too thin where liquid is all around. `lowest`: level of the
/// lowest cell next to it.
template <class Real>
inline Real excess(const GridShape& s, const PressureFields<Real>& f, const Held<Real>& held,
                   std::int32_t c, Real lowest) {
    Real e = f.density[c] - Real(1);
    if (!(f.level[c] > Real(0) && lowest > Real(0))) {
        return clamp<Real>(e - kSurfaceSlack<Real>, Real(0), kWindow<Real>);
    }
    if (lowest + least_head(f) < Real(0.5) && !f.on_surface) {
        e += expected_deficit<Real>(lowest + least_head(f));
        e -= clamp(e, -kSubsurfaceSlack<Real>, kSubsurfaceSlack<Real>);
    }
    if (e < Real(0)) {
        e = held.share(held.pressed(f.pressure[c], s.stride, c)) * e;
    }
    return clamp(e, -kWindow<Real>, kWindow<Real>);
}

template <class Real>
[[gnu::noinline]] Real excess(const GridShape& s, const PressureFields<Real>& f,
                              const Held<Real>& held, std::int32_t c) {
    return excess<Real>(s, f, held, c,
                        minimum<Real>(minimum<Real>(f.level[c - 1], f.level[c + 1]),
                                      minimum<Real>(f.level[c - s.stride], f.level[c + s.stride])));
}

/// Beside closed faces: what is behind them is no surface. What has little room shows little, and
/// the density of few particles is known to the slack.
template <class Real>
[[gnu::noinline]] Real excess_beside_wall(const GridShape& s, const Walls<Real>& walls,
                                          const PressureFields<Real>& f, const Held<Real>& held,
                                          std::int32_t c) {
    Real lowest = f.level[c];
    const auto look = [&](Real open, std::int32_t neighbour) {
        lowest = open > Real(0) ? minimum<Real>(lowest, f.level[neighbour]) : lowest;
    };
    look(walls.open_u[c], c - 1);
    look(walls.open_u[c + 1], c + 1);
    look(walls.open_v[c], c - s.stride);
    look(walls.open_v[c + s.stride], c + s.stride);
    const Real e = excess<Real>(s, f, held, c, lowest);
    const Real known = e - clamp(e, -kSubsurfaceSlack<Real>, kSubsurfaceSlack<Real>);
    // What is more than a full cell too much counts by what it is, however little room there is.
    const Real dense = maximum<Real>(Real(1), Real(f.density[c]) - Real(1));
    return known * minimum<Real>(Real(1), dense * walls.full_density[c]);
}

template <class Real>
inline ExcessLimits excess_limits(const PressureFields<Real>& fields, const Held<Real>& held) {
    return {static_cast<float>(kSurfaceSlack<Real>), static_cast<float>(kSubsurfaceSlack<Real>),
            static_cast<float>(kWindow<Real>), fields.on_surface != kNoTension,
            static_cast<float>(held.at_rest), static_cast<float>(held.rise),
            held.light_u, held.light_v};
}

/// The same where it is told at once: in air, and in a cell with full ones all around.
template <class Real>
inline Real plain_excess(const GridShape& s, const PressureFields<Real>& f,
                         const Held<Real>& held, std::int32_t c) {
    const auto level = [&](std::int32_t cell) { return bound_key(Real(f.level[cell])); };
    const auto full = bound_key(Real(0.5));
    const auto one = bound_key(Real(1));
    const auto density = bound_key(Real(f.density[c]));
    if (level(c) <= bound_key(Real(0))) {
        if (density <= one) {
            return Real(0);
        }
    } else if (level(c - 1) >= full && level(c + 1) >= full && level(c - s.stride) >= full &&
               level(c + s.stride) >= full &&
               (density >= one || bound_key(f.pressure[c]) >= bound_key(held.enough))) {
        const Real e = f.density[c] - Real(1);
        return density > bound_key(Real(2)) ? kWindow<Real> : e;
    }
    return excess(s, f, held, c);
}

/// Cells of a row that drift asks for: those that stages work on and some beside them.
inline Part looked_at(const GridShape& s, std::int32_t j) {
    const Part entries = s.entries(j);
    return {maximum(entries.first, 0), minimum(entries.end, s.nx)};
}

/// Of the cells of some rows, into `divergence`.
template <class Real>
void find_excess(const GridShape& s, const Part& rows, const Held<Real>& held,
                 PressureFields<Real>& fields) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const Part columns = looked_at(s, j);
        std::int32_t c = s.index(columns.first, j);
        const std::int32_t end = s.index(columns.end, j);
        if constexpr (kHasLanes<Real>) {
            c = excess_lanes(fields, s.stride, excess_limits(fields, held), c, end);
        }
        for (; c < end; ++c) {
            fields.divergence[c] = plain_excess(s, fields, held, c);
        }
    }
}

#if WEIR_HAS_LANES
/// `find_excess_beside_walls` of some rows: 32 cells are told by a word.
inline void find_excess_by_words(const GridShape& s, const Walls<float>& walls,
                                 const ExcessLimits& limits, const Part& rows,
                                 PressureFields<float>& fields) {
    const std::int32_t words = near_words(s);
    // Groups are stored whole: nobody else's rows.
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::uint32_t* row = walls.near + (s.j0 + j) * words + s.i0 / 32;
        for (std::int32_t k = 0; 32 * k < s.nx; ++k) {
            const std::uint32_t here = row[k];
            const std::uint32_t right = 32 * (k + 1) < s.nx ? row[k + 1] : 0U;
            const std::uint32_t above = j + 1 < s.ny ? row[k + words] : 0U;
            std::uint32_t told = here | here >> 1U | right << 31U | above;
            if (told == 0) {
                continue;
            }
            const std::int32_t c = s.index(32 * k, j);
            if (const WideCells* wide = wide_cells()) {
                told = wide->excess_of_word(walls, fields, s.stride, limits, c, told,
                                            s.index(s.nx, j));
            }
            excess_of_word<FourLanes>(walls, fields, s.stride, limits, c, told,
                                      s.index(s.nx, j));
        }
    }
}
#endif

/// The same of a cell beside closed faces. Where it is dry there is none.
template <class Real>
inline void find_excess_beside_wall(const GridShape& s, const Walls<Real>& walls,
                                    const Held<Real>& held, std::int32_t c,
                                    PressureFields<Real>& fields) {
    if (is_positive(Real(fields.level[c]))) {
        fields.divergence[c] = excess_beside_wall(s, walls, fields, held, c);
    }
}

/// The same of cells that a thin wall is near.
template <class Real>
void find_excess_beside_thin_walls(const GridShape& s, const Walls<Real>& walls,
                                   const Held<Real>& held, const Part& rows,
                                   PressureFields<Real>& fields) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const Part columns = s.columns(j);
        const auto next = [&](std::int32_t i) {
            return next_marked(walls.thin, s, j, j, i, columns.end, kNear);
        };
        for (std::int32_t i = next(columns.first); i < columns.end; i = next(i + 1)) {
            find_excess_beside_wall(s, walls, held, s.index(i, j), fields);
        }
    }
}

/// The same of all cells beside closed faces.
template <class Real>
void find_excess_beside_walls(const GridShape& s, const Walls<Real>& walls,
                              const Held<Real>& held, PressureFields<Real>& fields, Work work) {
    const Part rows = work.take(s.ny, s.nx);
    if constexpr (kHasLanes<Real>) {
        find_excess_by_words(s, walls, excess_limits(fields, held), rows, fields);
    } else {
        const auto look = [&](std::int32_t i, std::int32_t j) {
            find_excess_beside_wall(s, walls, held, s.index(i, j), fields);
        };
        for_each_near(s, walls, rows, [&](std::int32_t i, std::int32_t j) {
            look(i, j);
            if (i > 0 && !is_near(walls, s, i - 1, j)) {
                look(i - 1, j);
            }
            if (j > 0 && !is_near(walls, s, i, j - 1)) {
                look(i, j - 1);
            }
        });
    }
    if (walls.thin != nullptr) {
        find_excess_beside_thin_walls(s, walls, held, rows, fields);
    }
}

}  // namespace weir
