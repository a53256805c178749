// Stage: pressure, implicit. Reads level and u*; writes pressure and the projected velocity.
#pragma once

#include "grid/borders.hpp"
#include "math/packed_arithmetic.hpp"
#include "math/quotient_packed.hpp"
#include "pressure/domain.hpp"
#include "solid/free_body.hpp"
#include "weir/features.hpp"

namespace weir {

/// The first solve of a world's life starts from nothing: it gets this many cycles.
inline constexpr std::int32_t kColdStart = 8;

/// Makes the velocity free of divergence in the liquid (Chorin 1968), with the free surface where
/// the level is zero between two cell centres (Gibou, Fedkiw, Cheng & Kang 2002), at the pressure
/// that the air cell beside it holds (`fields.on_surface`; otherwise 0), and with faces open as far
/// as the solids leave them (Ng, Min & Gibou 2009). With two liquids faces answer by the inverse
/// density that the grid holds. Starts from the last pressure, makes one correction on a coarse
/// grid and then `sweeps` red-black relaxations, no more and no less: time is bounded, the result
/// is the same on every machine. Cost: about 10 operations a liquid cell and sweep.
/// Compressible liquid (`fields.elasticity`) is not solved for: its pressure moves on by a step of
/// the equation of state. `coupled`: free bodies that are solved for together with the pressure,
/// or null. Without `Solids`: a program that adds none links nothing of them.
template <bool Solids, class Real>
void projection(const Domain<Real>& domain, Seconds<Real> dt_s, std::int32_t sweeps,
                const CoupledSolve<Real>* coupled = nullptr, Work work = {});

/// Of some rows those that are so near to liquid, once there are equations; all across a seam.
template <class Real>
inline Part rows_near_liquid(const Part& rows, const Borders<Real>& borders,
                             const Solve<Real>& solve, std::int32_t below, std::int32_t above) {
    if (borders.wrap_y) {
        return rows;
    }
    return {maximum(rows.first, solve.first_row - below),
            minimum(rows.end, solve.last_row + above + 1)};
}

/// 1 for a face, less for one that is open by less than a quarter: a narrow gap.
template <class Real>
inline Real width_of(Real open) {
    return minimum(Real(1), Real(4) * open);
}

/// The same with two liquids: a program whose definition has room for one links nothing of it.
template <class Real>
struct detail::SecondLiquid {
    using Solver = void (*)(const Domain<Real>& domain, std::int32_t sweeps,
                            const CoupledSolve<Real>* coupled, Work work);
    Solver in_open;
    /// Of velocities between the transfers (pressure/sharpen_between.hpp).
    void (*sharpen_between)(const Domain<Real>& domain, Real smoothing, VelocityOf<Real>* sharp_u,
                            VelocityOf<Real>* sharp_v, Work work);
    Solver among_solids = nullptr;  ///< null: there is room for none
};

/// Way from a liquid cell's centre to the surface, over that to its air neighbour's centre. The
/// face between them answers to the pressure by its inverse.
template <class Real>
inline Real liquid_fraction(const PressureFields<Real>& fields, Real level_liquid, Real level_air,
                            Real open) {
    // A narrow gap hardly moves the liquid that drives it: with a small share as its lever it would
    // shoot particles through, each of them with its whole mass.
    const Real least = maximum(least_fraction(fields), Real(1) - width_of(open));
    const Real fraction = (level_liquid + least_head(fields)) / (level_liquid - level_air);
    return clamp(fraction, least, kLargestFraction<Real>);
}

/// Share of the pressure's rise that an open face passes on where it pushes, and does not brake:
/// particles around a narrow gap have more mass than goes through, and what the pressure would give
/// them in energy nothing has lost. At its surface a compressible liquid stores so much that only
/// the open share itself is safe.
template <class Real>
inline Real push_through(const PressureFields<Real>& fields, bool surface, Real open) {
    return surface && fields.sound_speed > Real(0) ? open : width_of(open);
}

/// Share of the push from a wet cell on the surface into a dry one, beyond what stops the liquid
/// and, if it is incompressible, what gravity gives in a step. Where the two cells hold more than
/// the liquid fraction, as jets along a wall do, all of that has to be moved by what is more than
/// the weight of a cell. Densities about a flat surface add up to its fraction and a half; a
/// compressible liquid's fraction is no less than a quarter, the mean suits that. Incompressible
/// liquid without weight or with surface tension is left alone: there smooth flow and bent surfaces
/// make pressure, too. `light`: 1/density, for what weighs more than the first liquid presses more.
template <class Real>
inline Real jet_share(const PressureFields<Real>& fields, std::int32_t wet, std::int32_t dry,
                      Real light, Real open) {
    const bool elastic = fields.sound_speed > Real(0);
    const bool weighs = fields.cell_weight > Real(0) && !fields.on_surface;
    const Real fraction = liquid_fraction<Real>(fields, fields.level[wet], fields.level[dry], open);
    const Real both = Real(fields.density[wet]) + Real(fields.density[dry]);
    const Real mass = elastic ? Real(0.5) * both : both - Real(0.5);
    const Real pressure = light * (fields.pressure[wet] - fields.pressure[dry]);
    const Real weight = fields.cell_weight * Real(fields.level[wet]);
    if (!(mass > fraction && pressure > weight && (elastic || weighs))) {
        return Real(1);
    }
    const Real jet = pressure < weight + weight ? (pressure - weight) / weight : Real(1);
    return (Real(1) - jet) + jet * (fraction / mass);
}

/// What a face adds to the diagonal of a liquid cell beside air, in 128ths as `weight` and `open`:
/// weight over liquid fraction, in whole numbers; levels in 64ths.
[[gnu::noinline]] inline std::int32_t packed_coefficient(std::int32_t weight, std::int32_t open,
                                                         std::int32_t level_liquid,
                                                         std::int32_t level_air) {
    const std::int32_t least = maximum(6, 128 - 4 * open);
    const std::int32_t height = level_liquid + kHeadRaw;
    const std::int32_t both = maximum(level_liquid - level_air, (height + 1) / 2);
    const bool limited = height * 128 <= least * both;
    return static_cast<std::int32_t>(
        small_quotient_of(static_cast<std::uint32_t>(weight * (limited ? 128 : both)),
                          static_cast<std::uint32_t>(limited ? least : height)));
}

/// From one cell to the next, of which at least one is liquid: what the face between them loses in
/// velocity, times its density. `open`: open fraction of the face.
template <class Real>
inline Real pressure_rise(const PressureFields<Real>& fields, std::int32_t before,
                          std::int32_t after, Real open) {
    if constexpr (Stored<Real>::coarse) {
        const std::int32_t a = fields.level[before].raw;
        const std::int32_t b = fields.level[after].raw;
        const std::int32_t whole = fields.pressure[after].raw - fields.pressure[before].raw;
        return Real::of_raw(a > 0 && b > 0
                                ? whole
                                : scaled(packed_coefficient(128, open.raw >> 9, maximum(a, b),
                                                            minimum(a, b)),
                                         whole));
    }
    const Real level_before = fields.level[before];
    const Real level_after = fields.level[after];
    const Real difference = fields.pressure[after] - fields.pressure[before];
    if (level_before > Real(0)) {
        return level_after > Real(0)
                   ? difference
                   : difference / liquid_fraction(fields, level_before, level_after, open);
    }
    return difference / liquid_fraction(fields, level_after, level_before, open);
}

}  // namespace weir
