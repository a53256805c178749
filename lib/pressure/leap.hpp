// Second order in time. Particles go straight on for dt with the velocity where they are, and
// position and velocity leap over each other (Störmer 1907, Verlet 1967). That changes areas by
// 1 + dt ∇·u + dt² det ∇u: they are kept where the pressure makes ∇·u = −dt det ∇u instead of 0.
// It does so where liquid is all around; elsewhere `bend_paths` bends what is straight.
#pragma once

#include "grid/borders.hpp"
#include "math/four_lanes.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Whether a cell and the four around it hold liquid.
template <class Real>
inline bool liquid_around(const LevelOf<Real>* level, std::int32_t stride, std::int32_t c) {
    const auto wet = [&](std::int32_t cell) { return is_positive(Real(level[cell])); };
    return wet(c) && wet(c - 1) && wet(c + 1) && wet(c - stride) && wet(c + stride);
}

#if WEIR_HAS_LANES

/// Lowest level of some cells and the four around each.
template <class L>
inline auto lowest_around(const float* level, std::int32_t stride, std::int32_t c) {
    const auto across = L::minimum(L::load(level + c - 1), L::load(level + c + 1));
    const auto up_and_down = L::minimum(L::load(level + c - stride), L::load(level + c + stride));
    return L::minimum(L::load(level + c), L::minimum(across, up_and_down));
}

#endif

/// Whether cells `low` … `high` of a row touch none of the tank's walls.
template <class Real>
inline bool inside_tank(const Borders<Real>& borders, const GridShape& s, std::int32_t low,
                        std::int32_t high, std::int32_t j) {
    return (borders.wrap_x || (low > 0 && high + 1 < s.nx)) &&
           (borders.wrap_y || (j > 0 && j + 1 < s.ny));
}

/// Whether the pressure sees to what straight paths do in a cell, if no solid touches it.
template <class Real>
inline bool goes_straight(const PressureFields<Real>& fields, const GridShape& s,
                          const Borders<Real>& borders, std::int32_t i, std::int32_t j) {
    return fields.leaps && inside_tank(borders, s, i, i, j) &&
           liquid_around<Real>(fields.level, s.stride, s.index(i, j));
}

/// A step's length, and the most divergence that is asked for: a 16th of the area.
template <class Real>
struct Leap {
    explicit Leap(Seconds<Real> step_s) : dt_s(step_s), most(Real(0.0625) / step_s) {}
    Seconds<Real> dt_s;
    Real most;
};

/// −∇·u to ask for in a cell. ∇u is that of the velocity before the step, without its trace.
template <class Real>
inline Real wanted_convergence(const StaggeredGrid<Real>& grid, std::int32_t c,
                               const Leap<Real>& leap) {
    const std::int32_t stride = grid.shape.stride;
    const VelocityOf<Real>* u = whole(grid.mass_u + c);
    const VelocityOf<Real>* v = whole(grid.mass_v + c);
    const VelocityOf<Real>* above = whole(u + stride);
    const VelocityOf<Real>* below = whole(u - stride);
    const VelocityOf<Real>* upper = whole(v + stride);
    const Real strain = Real(0.5) * ((u[1] - u[0]) - (upper[0] - v[0]));
    const Real u_over_y = Real(0.25) * ((above[0] + above[1]) - (below[0] + below[1]));
    const Real v_over_x = Real(0.25) * ((v[1] + upper[1]) - (v[-1] + upper[-1]));
    const Real det = -((leap.dt_s * strain) * strain + (leap.dt_s * u_over_y) * v_over_x);
    // Seldom as much, which whole numbers tell.
    return magnitude_key(det) <= magnitude_key(leap.most) ? det
                                                          : clamp(det, -leap.most, leap.most);
}

#if WEIR_HAS_LANES

/// The same for some cells.
template <class L>
inline auto wanted_convergence_lanes(const StaggeredGrid<float>& grid, std::int32_t c,
                                     const Leap<float>& leap) {
    const float* u = grid.mass_u;
    const float* v = grid.mass_v;
    const std::int32_t up = c + grid.shape.stride;
    const std::int32_t down = c - grid.shape.stride;
    const auto strain = L::all(0.5F) * ((L::load(u + c + 1) - L::load(u + c)) -
                                        (L::load(v + up) - L::load(v + c)));
    const auto u_over_y = L::all(0.25F) * ((L::load(u + up) + L::load(u + up + 1)) -
                                           (L::load(u + down) + L::load(u + down + 1)));
    const auto v_over_x = L::all(0.25F) * ((L::load(v + c + 1) + L::load(v + up + 1)) -
                                           (L::load(v + c - 1) + L::load(v + up - 1)));
    const auto dt = L::all(leap.dt_s);
    const auto det = -((dt * strain) * strain + (dt * u_over_y) * v_over_x);
    return L::clamp(det, L::all(-leap.most), L::all(leap.most));
}

#endif

}  // namespace weir
