// How free bodies share in the pressure solve: FreeBodyStages begin … end, see there.
#pragma once

#include "solid/free_body.hpp"

namespace weir {

template <class Real>
void begin_coupling(const CoupledSolve<Real>& solve);
template <class Real>
Face<Real> yielding(const CoupledSolve<Real>& solve);
template <class Real>
void set_aside(const CoupledSolve<Real>& solve);
template <class Real>
void relax_coupled(const CoupledSolve<Real>& solve, Real omega, std::int32_t colour);
template <class Real>
void end_coupling(const CoupledSolve<Real>& solve);

}  // namespace weir
