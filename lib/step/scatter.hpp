// What a particle gives to the four faces of a stencil.
#pragma once

#include "grid/staggered_grid.hpp"

namespace weir {

/// Bits: lower left, lower right, upper left, upper right.
inline constexpr std::uint32_t kAllFour = 15U;

/// Mass and momentum.
template <class Mass, class Real>
inline void scatter(Mass* mass, Real* momentum, std::int32_t stride, const Stencil<Real>& at,
                    Real velocity) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;                       // fx (1 − fy)
    const Real upper = at.fy - w1;                       // (1 − fx) fy
    const Real w0 = (Real(1) - at.fx) - upper;           // (1 − fx)(1 − fy)
    Mass* m = mass + at.base;
    Real* p = momentum + at.base;
    m[0] += w0;
    p[0] += w0 * velocity;
    m[1] += right;
    p[1] += right * velocity;
    m = whole(m + stride);  // one address for two numbers
    p = whole(p + stride);
    m[0] += upper;
    p[0] += upper * velocity;
    m[1] += w1;
    p[1] += w1 * velocity;
}

/// The same of a particle of some density.
template <class Real>
inline void scatter_dense(VelocityOf<Real>* volume, VelocityOf<Real>* mass, Real* momentum,
                          std::int32_t stride, const Stencil<Real>& at, Real density,
                          Real velocity) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;
    const Real upper = at.fy - w1;
    const auto add = [&](std::int32_t node, Real weight) {
        const Real share = weight * density;
        volume[node] += weight;
        mass[node] += share;
        momentum[node] += share * velocity;
    };
    add(at.base, (Real(1) - at.fx) - upper);
    add(at.base + 1, right);
    add(at.base + stride, upper);
    add(at.base + stride + 1, w1);
}

/// The same to those of the four that `seen` names. `mass` null: one liquid, whose count is its
/// mass.
template <class Real>
inline void scatter_weighed(VelocityOf<Real>* volume, VelocityOf<Real>* mass, Real* momentum,
                            std::int32_t stride, const Stencil<Real>& at, Real density,
                            Real velocity, std::uint32_t seen) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;
    const Real upper = at.fy - w1;
    const Real weight[] = {(Real(1) - at.fx) - upper, right, upper, w1};
    const std::int32_t node[] = {at.base, at.base + 1, at.base + stride, at.base + stride + 1};
    for (std::uint32_t k = 0; k < 4; ++k) {
        if ((seen >> k & 1U) == 0) {
            continue;
        }
        const Real share = weight[k] * density;
        volume[node[k]] += weight[k];
        if (mass != nullptr) {
            mass[node[k]] += share;
        }
        momentum[node[k]] += share * velocity;
    }
}

}  // namespace weir
