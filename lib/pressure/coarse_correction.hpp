// Pressure, within the projection: what sweeps are slow at. Reads the fine equations and what they
// still lack; writes pressure.
#pragma once

#include "pressure/face_weights.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// Relaxation carries the pressure over a few cells a sweep, so that deep liquid would want many.
/// Here the same equations are set up on cells four times as large and relaxed there, at a
/// sixteenth of the cost, and the result is added to the pressure (two-grid correction, Brandt
/// 1977). A coarse cell's unknown stands in the middle of its liquid; between it and its
/// neighbours, and to the surface, the correction is linear, and residuals are gathered with the
/// same shares. That is what keeps the surface where it is: a residual close to it asks for next
/// to nothing (as cells at their centres would not know).
///
/// `set_up` once a solve, after the fine equations; `correct` then adds one correction.
/// Order: by row. Cost: set-up about 2 sweeps on the fine grid, each correction about 3.
template <bool Solids, bool Mixed, class Real>
void set_up_coarse(const FaceWeights<Solids, Mixed, Real>& weights, PressureFields<Real>& fields,
                   Work work);

template <bool Solids, bool Mixed, class Real>
void correct_coarse(const FaceWeights<Solids, Mixed, Real>& weights, PressureFields<Real>& fields,
                    Work work);

/// Adds the last correction once more, times a factor.
template <class Real>
void add_again(const GridShape& shape, Real factor, PressureFields<Real>& fields);

}  // namespace weir
