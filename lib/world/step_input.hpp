// The time that a step is asked for, made sane.
#pragma once

#include "step/time_step_limit.hpp"
#include "world/validate.hpp"

namespace weir {

inline void mark(StepReport& report, Clamped what) {
    report.clamped |= static_cast<std::uint32_t>(what);
}

/// Shorter steps are none: velocities per step would round to nothing.
inline constexpr float kShortestStep = 1.0e-9F;

/// A usable dt: 0 for none and for nonsense, and not so long that max_substeps could not carry it.
/// Time then runs slower than the caller's, which is the one thing that stays stable.
template <class Real>
Seconds<Real> sane_time_step(const Settings<Real>& settings, float dt_s, StepReport& report) {
    if (!is_finite(dt_s) || !(dt_s >= kShortestStep)) {
        if (dt_s != 0.0F) {
            mark(report, Clamped::time_step);
        }
        return {};
    }
    const Seconds<Real> longest = longest_step(settings);
    const auto wanted = static_cast<Seconds<Real>>(dt_s);
    if (wanted > longest) {
        mark(report, Clamped::time_step);
        return longest;
    }
    return wanted;
}

}  // namespace weir
